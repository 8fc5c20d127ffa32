// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/routes.h"

#include <numeric>
#include <tuple>

#include "base/error.h"
#include "contact/road.h"
#include "motion/roll.h"
#include "unit/fit/simulated.h"
#include "unit/catch.h"
#include "least_squares/minimise.h"

using namespace rolling;

namespace {
const Body cylinder{1.375, 0.04, 0.5};
}

TEST_CASE("first guess: near the law of exact runs, whatever the exponent, from the data alone",
          "[fit]") {
  for (const bool position : {false, true})
    for (const double b : {-0.3, 0.1, 0.4, 0.8, 1.2, 1.7}) {
      const auto truth = simulated::roll(cylinder, 1e-3, b, 0.4);
      Run run{};
      run.body = cylinder;
      for (int i = 0; i < 150; ++i) {
        run.t.push_back(0.02 * i);
        run.x.push_back(0.3 + truth.x(run.t.back()));
        run.v.push_back(truth.v(run.t.back()));
      }
      Rows all(150);
      std::iota(all.begin(), all.end(), 0);
      const Route route = position ? Route::position : Route::velocity;
      const auto [q, starts] = first_guess(observe(route, {run}, {all}, {}, {}), {});
      const std::vector<double>& theta = starts.front();
      const PowerLaw law = *q.law(theta).power();
      const double at = 0.3, D = law(at), true_D = 1e-3 * std::pow(at, b);
      INFO((position ? "x, b " : "v, b ")
           << b << ": guessed b " << law.b << ", v0 " << q.v0(theta, 0) << ", D(0.3) " << D / true_D
           << " of the true one");
      CHECK(std::abs(law.b - b) < 0.1);
      CHECK(std::abs(q.v0(theta, 0) / 0.4 - 1) < 0.02);
      CHECK(std::abs(D / true_D - 1) < 0.05);
      if (position) CHECK(std::abs(q.x0(theta, 0) - 0.3) < 0.01);
    }
}

TEST_CASE("first guess: the means of many rows are those of all of them, each once", "[fit]") {
  const auto truth = simulated::roll(cylinder, 1.87e-3, 0.215, 0.5);
  simulated::Noise noise(13);
  Run run{};
  run.body = cylinder;
  run.x0 = 0.25;
  constexpr double step = 2e-4;
  for (int i = 0; i < 10000; ++i) {
    run.t.push_back(step * i);
    run.v.push_back(truth.v(run.t.back()) + noise(2e-3));
  }
  const Fitted few = of_means(fit_route(Route::velocity, {run}, {}), {});
  const auto& [t, y] = std::tie(few.model.runs()[0].t, few.model.runs()[0].y);
  REQUIRE(t.size() == 3334);  // blocks of three, for 10000 are more than twice 4096
  CHECK(few.model.runs()[0].x0 == run.x0);
  // A block from t = first to t = last has its mean half way and its number of rows between its
  // neighbours': the blocks end where the next ones begin.
  double end = 0, sum = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double rows = 2 * (t[i] / step - end) + 1;
    CHECK(rows == Approx(i + 1 < t.size() ? 3 : 1));
    sum += y[i] * rows;
    end += rows;
  }
  CHECK(end == Approx(10000));
  CHECK(sum == Approx(std::accumulate(run.v.begin(), run.v.end(), 0.0)).epsilon(1e-9));
}

TEST_CASE("first guess: of a long run all rows count, where means of them come near", "[fit]") {
  const double v0 = 0.5, a = 1.87e-3, b = 0.215;
  constexpr std::size_t n = 10000;
  const auto truth = simulated::roll(cylinder, a, b, v0);
  simulated::Noise noise(14);
  Run run{};
  run.body = cylinder;
  for (std::size_t i = 0; i < n; ++i) {
    run.t.push_back(2.2 * static_cast<double>(i) / n);
    run.v.push_back(truth.v(run.t.back()) + noise(2e-3));
    run.x.push_back(truth.x(run.t.back()) + noise(3e-4));
  }
  for (Route route : {Route::velocity, Route::position}) {
    FitOptions options;
    options.x0 = 0;
    const auto r = fit(route, {run}, options);
    // No neighbour is better: the sum of squares has its minimum there, by differences of the
    // closed formula that is typed in simulated.h.
    const auto residual = [&](std::size_t i, double da, double db, double dv0) {
      const auto roll = simulated::roll(cylinder, r.a + da, r.b + db, r.v0[0].value + dv0);
      return route == Route::velocity ? roll.v(run.t[i]) - run.v[i] : roll.x(run.t[i]) - run.x[i];
    };
    for (int j = 0; j < 3; ++j) {
      const double step = 1e-5, da = j == 0 ? step * a : 0, db = j == 1 ? step : 0,
                   dv0 = j == 2 ? step * v0 : 0;
      double slope = 0, squares = 0;
      for (std::size_t i = 0; i < n; ++i) {
        const double change = residual(i, da, db, dv0) - residual(i, -da, -db, -dv0);
        slope += change * residual(i, 0, 0, 0);
        squares += change * change;
      }
      CHECK(std::abs(slope) < 1e-7 * r.rms * std::sqrt(n * squares));
    }
  }
}

TEST_CASE(
    "first guess: a long row whose means have no minimum is refused for what the whole of it "
    "lacks",
    "[fit]") {
  const auto refused = [](double (*v)(int)) {
    Run run{};
    run.body = cylinder;
    for (int i = 0; i < 5000; ++i) run.t.push_back(0.01 * i), run.v.push_back(v(i));
    try {
      fit(Route::velocity, {run}, {});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("not at all");
  };
  CHECK(refused([](int) { return 1.0; }).starts_with("the data do not determine "));
  CHECK(refused([](int i) { return i < 2 ? 1.0 : 0.0; }) ==
        "the data do not determine the parameters");
}

// The one law that is left comes to its stop while the body still rolls the other way.
TEST_CASE("first guess: speeds that the one law held has against them are refused", "[fit]") {
  Run run{};
  run.body = cylinder;
  for (int i = 0; i < 10; ++i) run.t.push_back(i), run.v.push_back(i < 2 ? -0.5 : 1);
  FitOptions held;
  held.fixed[0] = 0.03;
  held.fixed[1] = 0;
  CHECK_THROWS_WITH(fit(Route::velocity, {run}, held), "no law a v^b comes near the data");
  run.v[0] = 2;  // the body stops at once, as that law has it
  CHECK(fit(Route::velocity, {run}, held).v0[0].value > 0);
}

// From a start with b of no more than 0.03 the search went behind the wall of b = 0, for laws like
// that of rubber.
TEST_CASE("first guess: rubber in a bowl is found, whatever its exponent", "[fit]") {
  std::vector<double> x;
  std::vector<double> h;
  for (int i = -40; i <= 40; ++i) {
    x.push_back(0.025 * i);
    h.push_back(0.05 * x.back() * x.back());
  }
  const Road bowl(x, h);
  Body body = cylinder;
  body.road = &bowl;
  for (const double b : {0.1, 0.15, 0.215, 0.25, 0.4}) {
    Roll truth(body, PowerLaw{1.87e-3, b}, 0.5, -0.3);
    Run run{};
    run.body = body;
    for (int i = 0; i < 100; ++i) {
      run.t.push_back(0.041 * i);
      run.x.push_back(-0.3 + truth.at(run.t.back()).x);
    }
    CAPTURE(b);
    CHECK(std::abs(fit(Route::position, {run}, {}).b - b) < 1e-5);
  }
}
