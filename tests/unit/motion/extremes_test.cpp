// SPDX-License-Identifier: GPL-3.0-or-later
// Stiff and extreme scenes: what must come out of the default, and of every solver: the answer or a
// refusal, never a NaN, never v < 0 under a law without memory.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "bench/bare_gsl.h"
#include "motion/scene.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

enum class Bare { reaches, no_number, gives_up };

struct Extreme {
  const char* name;
  double a, b, K;
  bool is_exact;
  double length;  // of the memory
  int points;     // of a table
  double stop;    // [s]
  double within;  // relative
  Bare rkf45, rk8pd, bsimp,
      msbdf;  // GSL's bare steppers with pow(v, b), to 1.2 times the stop or to 10 s
};

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr bool paper = false, exact = true;
constexpr auto reaches = Bare::reaches, no_number = Bare::no_number, gives_up = Bare::gives_up;

// v0 = 0.5. Stops without memory: t* of Eq. 13, and Eq. 12 by quadrature, in 50 digits; with memory
// and for tables: what four solvers agree on.
const Extreme extremes[] = {
    {"CR", 1.87e-3, 0.215, 0.5, paper, 0, 0, 2.4180341666923846, 1e-15, no_number, no_number,
     no_number, gives_up},
    {"CF", 5.75e-4, 0.0244, 0.5, paper, 0, 0, 5.54444070025161, 1e-15, no_number, no_number,
     no_number, gives_up},
    {"SR", 1.78e-3, 0.255, 0.83, paper, 0, 0, 3.3573641742662677, 1e-15, no_number, no_number,
     no_number, gives_up},
    {"SF", 5.75e-4, 0.0244, 0.83, paper, 0, 0, 6.7642176543069642, 1e-15, no_number, no_number,
     no_number, gives_up},
    {"b = 0", 1.87e-3, 0, 0.5, paper, 0, 0, 1.635349719537523, 1e-15, reaches, reaches, reaches,
     reaches},
    {"b next to 0", 1.87e-3, 1e-8, 0.5, paper, 0, 0, 1.6353497472264011, 1e-15, no_number,
     no_number, no_number, gives_up},
    {"b = 0.5", 1.87e-3, 0.5, 0.5, paper, 0, 0, 4.6254675051860049, 1e-15, no_number, no_number,
     no_number, gives_up},
    {"b = 0.9", 1.87e-3, 0.9, 0.5, paper, 0, 0, 30.51670482057949, 1e-15, no_number, no_number,
     no_number, gives_up},
    {"b below 1", 1.87e-3, 1 - 1e-12, 0.5, paper, 0, 0, 3270771794170.9912, 1e-15, reaches, reaches,
     reaches, reaches},
    {"b = 1", 1.87e-3, 1, 0.5, paper, 0, 0, infinite, 0, reaches, reaches, reaches, reaches},
    {"b above 1", 1.87e-3, 1 + 1e-12, 0.5, paper, 0, 0, infinite, 0, reaches, reaches, reaches,
     reaches},
    {"b = 1.5", 1.87e-3, 1.5, 0.5, paper, 0, 0, infinite, 0, reaches, reaches, reaches, reaches},
    {"b = 2", 1.87e-3, 2, 0.5, paper, 0, 0, infinite, 0, reaches, reaches, reaches, reaches},
    {"b = -0.5", 1.87e-3, -0.5, 0.5, paper, 0, 0, 0.77091125086433415, 1e-15, no_number, no_number,
     no_number, gives_up},
    {"CR exact", 1.87e-3, 0.215, 0.5, exact, 0, 0, 2.417189111553591, 1e-14, no_number, no_number,
     no_number, gives_up},
    {"deep exact", 0.04, 0.215, 0.5, exact, 0, 0, 0.091231040573432385, 1e-14, no_number, no_number,
     no_number, gives_up},
    {"memory 1e-3", 1.87e-3, 0.215, 0.5, paper, 1e-3, 0, 11.83777956, 1e-8, reaches, reaches,
     reaches, reaches},
    {"memory 1e-4", 1.87e-3, 0.215, 0.5, paper, 1e-4, 0, 3.266627668, 1e-8, reaches, reaches,
     reaches, reaches},
    {"memory 1e-5", 1.87e-3, 0.215, 0.5, paper, 1e-5, 0, 2.496392290, 1e-8, reaches, reaches,
     reaches, reaches},
    {"memory 1e-6", 1.87e-3, 0.215, 0.5, paper, 1e-6, 0, 2.430917356, 1e-8, gives_up, gives_up,
     reaches, reaches},
    {"memory 1e-7", 1.87e-3, 0.215, 0.5, paper, 1e-7, 0, 2.422714071, 1e-8, gives_up, gives_up,
     reaches, reaches},
    {"table of 5", 1.87e-3, 0.215, 0.5, paper, 0, 5, 0, 1e-9, reaches, reaches, reaches, reaches},
    {"table of 50", 1.87e-3, 0.215, 0.5, paper, 0, 50, 0, 1e-9, reaches, reaches, reaches, reaches},
};

constexpr double v0 = 0.5;

Scene roll_of(const Extreme& e) {
  Scene roll{};
  roll.body = {1.375, 0.04, e.K}, roll.body.exact = e.is_exact, roll.law = PowerLaw{e.a, e.b},
  roll.v0 = v0, roll.bulge.length = e.length;
  std::vector<double> v, D;
  for (int i = 1; i <= e.points; ++i)
    v.push_back(v0 * i / e.points),
        D.push_back(PowerLaw{e.a, e.b}(v.back()) * (1 + 0.05 * std::sin(7.0 * i)));
  if (e.points > 0) roll.law = TableLaw(v, D);
  return roll;
}

Bare run_bare(const Scene& roll, const gsl_odeiv2_step_type* type, double end) {
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

TEST_CASE("Extremes: the stop, no NaN and no v < 0 by any solver; and what bare steppers do",
          "[rolling]") {
  for (const Extreme& e : extremes) {
    const Scene roll = roll_of(e);
    const auto motion = start(roll, best_method(roll), 1e-10);
    const double stop = motion->stop_time(), end = stop > 100 ? 10 : 1.2 * stop;
    INFO(e.name << ": stop " << fmt::format("{}", stop));
    const double right =
        e.points > 0 ? start(roll, {Method::solver, gsl_odeiv2_step_rk8pd}, 1e-12)->stop_time()
                     : e.stop;
    CHECK((std::isinf(right) ? std::isinf(stop) : std::abs(stop / right - 1) <= e.within));
    for (const Stepper stepper :
         {gsl_odeiv2_step_rk2, gsl_odeiv2_step_rk4, gsl_odeiv2_step_rkf45, gsl_odeiv2_step_rkck,
          gsl_odeiv2_step_rk8pd, gsl_odeiv2_step_msadams, gsl_odeiv2_step_rk2imp,
          gsl_odeiv2_step_rk4imp, gsl_odeiv2_step_bsimp, gsl_odeiv2_step_msbdf}) {
      if (e.length > 0 && stepper != gsl_odeiv2_step_rk4imp && stepper != gsl_odeiv2_step_bsimp &&
          stepper != gsl_odeiv2_step_msbdf)
        continue;
      INFO("stepper " << stepper->name);
      const auto solver = start(roll, {Method::solver, stepper}, 1e-6),
                 best = start(roll, best_method(roll), 1e-10);
      for (int i = 1; i <= 100; ++i) {
        solver->seek(end * i / 100);
        best->seek(end * i / 100);
        REQUIRE(std::isfinite(solver->velocity()));
        if (e.length == 0) REQUIRE(solver->velocity() >= 0);
        CHECK(std::abs(solver->velocity() - best->velocity()) < 1e-3 * v0);
      }
      if (e.length == 0 && stop < end) CHECK(solver->velocity() == 0);
    }
    CHECK(run_bare(roll, gsl_odeiv2_step_rkf45, end) == e.rkf45);
    CHECK(run_bare(roll, gsl_odeiv2_step_rk8pd, end) == e.rk8pd);
    CHECK(run_bare(roll, gsl_odeiv2_step_bsimp, end) == e.bsimp);
    CHECK(run_bare(roll, gsl_odeiv2_step_msbdf, end) == e.msbdf);
  }
}

TEST_CASE("Extremes: speeds and shifts at the ends of the range", "[rolling]") {
  for (const double speed : {1e-300, 1e-30, 1e30, 1e150})
    for (const double b : {0.0, 0.215, 0.9, 1.0, 1.5}) {
      const double a = std::pow(speed, -b) * 1e-3;
      if (!(a > 1e-300 && a < 1e300)) continue;
      Scene roll = roll_of({"", a, b, 0.5, paper, 0, 0, 0, 0, reaches, reaches, reaches, reaches});
      roll.v0 = speed;
      for (const bool is_exact : {false, true}) {
        roll.body.exact = is_exact;
        const auto motion = start(roll, best_method(roll), 1e-10);
        motion->seek(2 * speed);  // v/v0 depends on t/v0 alone
        const double k = 1e-3 * 9.81 / 0.06, s = 1 - b;
        const double expected = s == 0 ? std::exp(-2 * k) : std::pow(1 - s * k * 2, 1 / s);
        INFO("v0 " << speed << " b " << b);
        CHECK(std::abs(motion->velocity() / speed - expected) < (is_exact ? 1e-3 : 1e-13));
      }
    }
  Scene deep = roll_of({"", 0.04, 0.2, 0.5, exact, 0, 0, 0, 0, reaches, reaches, reaches, reaches});
  deep.v0 = 1;
  CHECK_NOTHROW(start(deep, best_method(deep), 1e-10));
  deep.law = PowerLaw{0.0401, 0.2};
  CHECK_THROWS_AS(start(deep, best_method(deep), 1e-10), Error);
}
