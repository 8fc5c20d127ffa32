#include "fit/laws.h"

#include "base/error.h"
#include "unit/fit/simulated.h"
#include "unit/catch.h"

#include <limits>
#include <string>

using namespace rolling;

namespace {

const Body unit{1, 1, 0, 1};  // g/((K + 1) R) = 1: D is the deceleration

enum Law { power, constant, linear, quadratic };

/// Rolls to the stop under D = 0.2 sqrt(v); 0.1; 0.1 + 0.2 v; 0.1 + 0.4 v^2, all from v0 = 1, by
/// hand.
FitRun roll(Law law, Route route, double size) {
  FitRun run{};
  run.body = unit;
  simulated::Noise noise(31);
  for (double t = 0; t < 12; t += 0.05) {
    double v = 0, x = 0;
    if (law == power) v = std::pow(1 - 0.1 * t, 2), x = (1 - std::pow(1 - 0.1 * t, 3)) / 0.3;
    if (law == constant) v = 1 - 0.1 * t, x = t - 0.05 * t * t;
    if (law == linear)
      v = 1.5 * std::exp(-0.2 * t) - 0.5, x = 7.5 * (1 - std::exp(-0.2 * t)) - 0.5 * t;
    if (law == quadratic)
      v = 0.5 * std::tan(std::atan(2) - 0.2 * t),
      x = 2.5 * std::log(std::cos(std::atan(2) - 0.2 * t) / std::cos(std::atan(2)));
    if (v <= 0 || (law == power && t > 10)) break;
    run.t.push_back(t);
    run.v.push_back(v + (route == Route::velocity ? noise(size) : 0));
    run.x.push_back(x + noise(size));
    run.D.push_back((law == power      ? 0.2 * std::sqrt(v)
                     : law == constant ? 0.1
                     : law == linear   ? 0.1 + 0.2 * v
                                       : 0.1 + 0.4 * v * v) +
                    noise(size / 10));
  }
  return run;
}

}  // namespace

TEST_CASE("laws: on every route the law that made the record is not beaten, and lesser laws are",
          "[fit]") {
  for (Route route : {Route::loglog, Route::shift, Route::velocity, Route::position})
    for (Law law : {power, constant, linear, quadratic}) {
      const auto scores = compare_laws(route, {roll(law, route, 1e-3)}, {});
      CAPTURE(static_cast<int>(route), static_cast<int>(law));
      REQUIRE(scores.size() == 4);
      double least = std::numeric_limits<double>::infinity();
      for (const auto& s : scores) least = std::min(least, s.aicc);
      CHECK(scores[law].aicc <
            least + 4);  // an unneeded coefficient wins by more than 2 in one of twenty
      if (law != constant) CHECK(scores[constant].aicc > least + 100);
      if (law == quadratic) CHECK(scores[linear].aicc > least + 10);
      if (law == linear || law == quadratic) CHECK(scores[power].aicc > least + 10);
      if (law == power) CHECK(scores[linear].aicc > least + 10);
    }
}

TEST_CASE("laws: a law that the records cannot determine is not among those that win", "[fit]") {
  FitRun run{};
  run.body = unit;
  simulated::Noise noise(3);
  for (int i = 0; i < 20; ++i)
    run.v.push_back(i % 2 ? 1 : 2), run.D.push_back(run.v.back() + noise(0.01));
  const auto scores =
      compare_laws(Route::shift, {run}, {});  // two speeds: a line through them, and no parabola
  CHECK(std::isfinite(scores[linear].aicc));
  CHECK(scores[quadratic].aicc == std::numeric_limits<double>::infinity());
}

TEST_CASE("laws: what is held stays held, and a robust comparison is refused", "[fit]") {
  FitRun run = roll(linear, Route::velocity, 1e-3);
  FitOptions options;
  options.v0 = 0.7;  // a wrong one: no law can mend it
  const auto held = compare_laws(Route::velocity, {run}, options),
             free = compare_laws(Route::velocity, {run}, {});
  CHECK(held[linear].aicc > free[linear].aicc + 100);
  options = {};
  options.robust = true;
  CHECK_THROWS_AS(compare_laws(Route::velocity, {run}, options), Error);
}
