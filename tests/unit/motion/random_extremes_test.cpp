// SPDX-License-Identifier: GPL-3.0-or-later
// Random extreme scenes: every roll ends within a bounded number of evaluations, with finite
// numbers or with an Error of one line, and on a mat that does not fall v is never above v0.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/error.h"
#include "motion/scene.h"
#include "sensor/sonar.h"
#include "unit/catch.h"
#include "unit/many.h"

using namespace rolling;

namespace {

class Extremes {
 public:
  explicit Extremes(unsigned seed) : random_(seed) {}
  double between(double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random_); }
  bool one_in(int n) { return std::uniform_int_distribution(1, n)(random_) == 1; }
  double power(double lo, double hi) { return std::pow(10, between(lo, hi)); }

  Scene roll() {
    Scene roll{};
    PowerLaw law;
    const double R = one_in(5) ? power(-300, 300) : 0.04;
    roll.body = {1, R, one_in(4) ? 0 : between(0, 1), one_in(8) ? power(-300, 300) : 9.81};
    if (one_in(3)) roll.body.slope = std::copysign(power(-12, 1), between(-1, 1));
    roll.body.exact = one_in(2);
    roll.v0 = one_in(8) ? 0 : one_in(3) ? power(-300, 150) : power(-3, 1);
    law.b = one_in(6) ? std::copysign(power(-20, 308), between(-1, 1)) : between(-0.5, 3);
    const double depth = one_in(3) ? 1 - power(-16, -1) : power(-9, 0);
    law.a = depth * R * std::pow(roll.v0, -law.b);
    roll.law = law;
    if (one_in(4)) {
      std::vector<double> v, D;
      for (int i = 0; i < 5; ++i) v.push_back(roll.v0 * (i + 1) / 5), D.push_back(R * power(-6, 0));
      try {
        roll.law = TableLaw(v, D);
      } catch (const Error&) {}
    } else if (one_in(5)) {
      roll.bulge = {power(-9, one_in(3) ? 300 : 0), one_in(2) ? 0 : power(-9, 1)};
    }
    return roll;
  }

  Method method(const Scene& roll) {
    const Stepper few[] = {gsl_odeiv2_step_rk2,    gsl_odeiv2_step_rkf45,  gsl_odeiv2_step_rk8pd,
                           gsl_odeiv2_step_rk2imp, gsl_odeiv2_step_rk4imp, gsl_odeiv2_step_msbdf};
    if (one_in(2)) return best_method(roll);
    return {Method::solver, few[std::uniform_int_distribution(0, 5)(random_)]};
  }

 private:
  std::mt19937_64 random_;
};

void check_message(const Error& error) {
  const std::string text = error.what();
  CHECK((!text.empty() && text.size() < 400 && text.find('\n') == std::string::npos));
}

}  // namespace

TEST_CASE("Extremes: random scenes end with finite numbers or one line, and never above v0",
          "[rolling]") {
  Extremes extremes(5);
  const unsigned scenes = of_many(1000);
  unsigned finished = 0;
  for (unsigned i = 0; i < scenes; ++i) {
    const Scene scene = extremes.roll();
    const PowerLaw law = scene.law.power().value_or(PowerLaw{0, 0});
    INFO("i " << i << " R " << scene.body.R << " K " << scene.body.K << " g " << scene.body.g
              << " S " << scene.body.slope << " a " << law.a << " b " << law.b << " v0 " << scene.v0
              << " L " << scene.bulge.length << " table " << scene.law.has_points() << " exact "
              << scene.body.exact);
    try {
      const Method method = extremes.method(scene);
      const auto motion = start(scene, method, 1e-6, 10'000);
      const double other = extremes.power(-9, 300);
      const bool memory = scene.bulge.length > 0, to_stop = extremes.one_in(2);
      const double stop = to_stop ? motion->stop_time() : other;
      if (std::isnan(stop)) fail("beyond the range");
      REQUIRE(stop >= 0);
      const double end = std::isinf(stop) ? other : stop;
      for (const double part : {0.0, 1e-9, 0.1, 0.5, 0.999, 1.0, 2.0}) {
        const double t = part * end;
        if (std::isinf(t)) continue;
        motion->seek(t);
        const double v = motion->velocity(), x = motion->position();
        const double a = motion->acceleration(), D = motion->shift();
        // Beyond the range of double the tools refuse to print: see Output::number.
        if (!std::isfinite(v + x + a + D)) fail("beyond the range");
        // A bulge that lags behind the body may push it beyond v0.
        if (memory) continue;
        if (scene.body.slope >= 0) REQUIRE(v <= scene.v0);
        if (scene.body.slope <= 0) REQUIRE(v >= 0);  // it never comes back
      }
      INFO("evaluations " << motion->evaluations());
      REQUIRE(motion->evaluations() < 3'000'000);
      ++finished;
    } catch (const Error& error) {
      check_message(error);
    }
  }
  CHECK(finished > scenes / 4);
}
