// SPDX-License-Identifier: GPL-3.0-or-later
// Prints rolls to the last bit: tests/pipeline/fused.sh compares what builds with and without fused
// multiplications and additions print.
#include <cstdio>
#include <initializer_list>

#include "motion/scene.h"

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
      print(*start({{1.375, 0.04, K}, law, {0}, 0.5, 0}, {Method::closed}, 0));
      for (const double slope : {0.0, 1e-3, 0.05})
        print(*start(
            {{.m = 1.375, .R = 0.04, .K = K, .slope = slope, .exact = true}, law, {0}, 0.5, 0},
            {Method::exact}, 0));
    }
}
