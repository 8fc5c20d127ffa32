// Prints rolls to the last bit: tests/pipeline/fused.sh compares what builds with and without fused
// multiplications and additions print.
#include <cstdio>
#include <initializer_list>

#include "motion/closed_form.h"
#include "motion/exact_form.h"
#include "motion/slope_roll.h"

using namespace rolling;

namespace {

void print(Motion& motion) {
  const double stop = motion.stop_time(), end = stop < 100 ? stop : 100;
  std::printf("%a\n", stop);
  for (int i = 0; i <= 200; ++i) {
    motion.seek(end * i / 200);
    std::printf("%a %a %a %a\n", motion.velocity(), motion.position(), motion.acceleration(),
                motion.shift());
  }
}

}  // namespace

int main() {
  for (const double b : {0.0, 0.0244, 0.215, 0.9, 1.0 - 1e-12, 1.0, 1.5})
    for (const double K : {0.5, 0.83}) {
      const PowerLaw law{1.87e-3, b};
      ClosedForm closed({1.375, 0.04, K}, law, 0.5, 0);
      ExactForm exact({1.375, 0.04, K}, law, 0.5, 0);
      SlopeRoll slope({1.375, 0.04, K, 9.81, 1e-3}, Geometry::exact, law, 0.5, 0);
      for (Motion* motion : {static_cast<Motion*>(&closed), static_cast<Motion*>(&exact),
                             static_cast<Motion*>(&slope)})
        print(*motion);
    }
}
