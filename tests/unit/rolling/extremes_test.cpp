// Stiff and extreme scenes: what must come out of the default, and of every solver: the answer or a refusal, never a NaN, never v < 0
// under a law without memory.
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "bench/bare_gsl.h"
#include "rolling/roll.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

enum class Bare { reaches, no_number, gives_up };

struct Extreme {
  const char* name;
  double a, b, v0;
  Geometry geometry;
  double length;  // of the memory
  double stop;    // [s], relative error below 1e-13 (memory: 1e-7)
  Bare rkf45, msbdf;  // GSL's bare steppers with pow(v, b), to 1.2 times the stop
};

constexpr double infinite = std::numeric_limits<double>::infinity();

// Stops without memory and A = 1: 50 digits; exact: model of Eq. 12 by quadrature; memory: agreement of three solvers.
const Extreme extremes[] = {
    {"CR", 1.87e-3, 0.215, 0.5, Geometry::approximate, 0, 2.418034166692385, Bare::no_number, Bare::gives_up},
    {"CF", 5.75e-4, 0.0244, 0.5, Geometry::approximate, 0, 5.54444070025161, Bare::no_number, Bare::gives_up},
    {"constant shift", 1.87e-3, 0, 0.5, Geometry::approximate, 0, 1.635349719537523, Bare::reaches, Bare::reaches},
    {"b next to 0", 1.87e-3, 1e-8, 0.5, Geometry::approximate, 0, 1.6353497472264011, Bare::no_number, Bare::gives_up},
    {"b below 1", 1.87e-3, 0.9, 0.5, Geometry::approximate, 0, 30.51670482057949, Bare::no_number, Bare::gives_up},
    {"b = 1", 1.87e-3, 1, 0.5, Geometry::approximate, 0, infinite, Bare::reaches, Bare::reaches},
    {"b = 2", 1.87e-3, 2, 0.5, Geometry::approximate, 0, infinite, Bare::reaches, Bare::reaches},
    {"CR exact", 1.87e-3, 0.215, 0.5, Geometry::exact, 0, 2.41718911155359, Bare::no_number, Bare::gives_up},
    {"memory 1e-3", 1.87e-3, 0.215, 0.5, Geometry::approximate, 1e-3, 11.83778, Bare::reaches, Bare::reaches},
    {"memory 1e-7", 1.87e-3, 0.215, 0.5, Geometry::approximate, 1e-7, 2.417228542052, Bare::gives_up, Bare::reaches},
};

Roll roll_of(const Extreme& e) {
  Roll roll{};
  roll.body = {1.375, 0.04, 0.5}, roll.geometry = e.geometry, roll.law = {e.a, e.b}, roll.v0 = e.v0, roll.bulge.length = e.length;
  return roll;
}

Bare run_bare(const Roll& roll, const gsl_odeiv2_step_type* type, double end) {
  try {
    BareGsl bare(roll, type, 1e-6, false);
    for (int i = 1; i <= 200; ++i) {
      bare.seek(end * i / 200);
      if (!std::isfinite(bare.velocity())) return Bare::no_number;
    }
    return Bare::reaches;
  } catch (const Error&) {
    return Bare::gives_up;
  }
}

}  // namespace

TEST_CASE("Extremes: the stop, no NaN and no v < 0 by any solver; and what bare steppers do", "[rolling]") {
  for (const Extreme& e : extremes) {
    const Roll roll = roll_of(e);
    const auto motion = start(roll, best_method(roll), 1e-10);
    const double stop = motion->stop_time(), end = std::isinf(stop) ? 10 : 1.2 * stop;
    INFO(e.name << ": stop " << fmt::format("{}", stop));
    CHECK((std::isinf(e.stop) ? std::isinf(stop) : std::abs(stop / e.stop - 1) < (e.length > 0 ? 1e-7 : 1e-13)));
    for (const Stepper stepper : {Stepper::rk2, Stepper::rk4, Stepper::rkf45, Stepper::rkck, Stepper::rk8pd, Stepper::msadams, Stepper::rk2imp,
                                  Stepper::rk4imp, Stepper::bsimp, Stepper::msbdf}) {
      if (e.length > 0 && stepper != Stepper::rk4imp && stepper != Stepper::bsimp && stepper != Stepper::msbdf) continue;
      INFO("stepper " << static_cast<int>(stepper));
      const auto solver = start(roll, {Method::solver, stepper}, 1e-6), exact = start(roll, best_method(roll), 1e-10);
      try {
        for (int i = 1; i <= 100; ++i) {
          solver->seek(end * i / 100);
          exact->seek(end * i / 100);
          REQUIRE(std::isfinite(solver->velocity()));
          if (e.length == 0) REQUIRE(solver->velocity() >= 0);
          CHECK(std::abs(solver->velocity() - exact->velocity()) < 1e-3 * e.v0);
        }
        if (e.length == 0 && !std::isinf(stop)) CHECK(solver->velocity() == 0);
      } catch (const Error& refusal) {
        CHECK(std::string(refusal.what()).find("integration") != std::string::npos);
      }
    }
    CHECK(run_bare(roll, gsl_odeiv2_step_rkf45, end) == e.rkf45);
    CHECK(run_bare(roll, gsl_odeiv2_step_msbdf, end) == e.msbdf);
  }
}

TEST_CASE("Extremes: speeds and shifts at the ends of the range", "[rolling]") {
  for (const double v0 : {1e-300, 1e-30, 1e30, 1e150})
    for (const double b : {0.0, 0.215, 0.9, 1.0, 1.5}) {
      const double a = std::pow(v0, -b) * 1e-3;
      if (!(a > 1e-300 && a < 1e300)) continue;
      Roll roll = roll_of({"", a, b, v0, Geometry::approximate, 0, 0, Bare::reaches, Bare::reaches});
      for (const Geometry geometry : {Geometry::approximate, Geometry::exact}) {
        roll.geometry = geometry;
        const auto motion = start(roll, best_method(roll), 1e-10);
        motion->seek(2 * v0);  // v/v0 depends on t/v0 alone
        const double k = 1e-3 * 9.81 / 0.06, s = 1 - b;
        const double expected = s == 0 ? std::exp(-2 * k) : std::pow(1 - s * k * 2, 1 / s);
        INFO("v0 " << v0 << " b " << b);
        CHECK(std::abs(motion->velocity() / v0 - expected) < (geometry == Geometry::exact ? 1e-3 : 1e-13));
      }
    }
  Roll deep = roll_of({"", 0.04, 0.2, 1, Geometry::exact, 0, 0, Bare::reaches, Bare::reaches});
  CHECK_NOTHROW(start(deep, best_method(deep), 1e-10));
  deep.law.a = 0.0401;
  CHECK_THROWS_AS(start(deep, best_method(deep), 1e-10), Error);
}
