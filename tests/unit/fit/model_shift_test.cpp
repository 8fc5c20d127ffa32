// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "contact/contact.h"
#include "motion/roll.h"
#include "unit/fit/simulated.h"
#include "unit/catch.h"
#include "unit/exact_body.h"

#include <limits>

using namespace rolling;

namespace {

// NIST StRD DanWood (Daniel & Wood 1980): y = b1 x^b2. The expected values agree with the 11 digits
// that NIST certifies, and were computed with 25.
Run danwood() {
  return {.t = {},
          .x = {},
          .v = {1.309, 1.471, 1.490, 1.565, 1.611, 1.680},
          .a = {},
          .D = {2.138, 3.421, 3.597, 4.340, 4.882, 5.660},
          .body = {},
          .filters = {}};
}

double digits(double x, double certified) {
  return x == certified ? 17 : -std::log10(std::abs(x / certified - 1));
}

}  // namespace

TEST_CASE("shift: DanWood to 12 digits", "[fit]") {
  const auto r = fit(Route::shift, {danwood()}, {});
  CHECK(digits(r.a, 0.7688622617649829315716521) > 12);
  CHECK(digits(r.b, 3.860405587076056567422589) > 12);
  CHECK(digits(r.sigma_a, 0.01828197386014182071121) > 12);
  CHECK(digits(r.sigma_b, 0.05172661091286822269107) > 12);
  CHECK(digits(r.corr, -0.9907719376796512486) > 12);
  CHECK(digits(r.rms, 0.03285311403920179263363) > 12);
  CHECK(r.n == 6);
  CHECK(r.errors == Errors::classical);
}

// A row that is a thousand times slower than the others makes a narrow minimum beside a wide
// one.
TEST_CASE("shift: no exponent that is held fits better than the one that is found", "[fit]") {
  simulated::Noise noise(45);
  for (int k = 0; k < 40; ++k) {
    Run run{};
    run.v = {1e-4}, run.D = {7e-4 * (1 + noise(0.2))};
    for (const double v : {0.044, 0.065, 0.04, 0.46, 0.58, 0.1, 0.23, 0.27, 0.48, 0.22}) {
      run.v.push_back(v);
      run.D.push_back(1e-3 * std::pow(v, 0.97) * (1 + noise(0.01)));
    }
    const double free = fit(Route::shift, {run}, {}).rms * std::sqrt(9.0);
    for (double b = -1; b < 2; b += 0.02) {
      FitOptions held;
      held.fixed[1] = b;
      CAPTURE(k, b);
      CHECK(fit(Route::shift, {run}, held).rms * std::sqrt(10.0) > free * (1 - 1e-9));
    }
  }
}

TEST_CASE("shift: against c v, a is divided by c^b and b stays; D in other units scales a",
          "[fit]") {
  const auto one = fit(Route::shift, {danwood()}, {});
  Run scaled = danwood();
  for (double& v : scaled.v) v *= 1000;
  for (double& D : scaled.D) D *= 1e-6;
  const auto r = fit(Route::shift, {scaled}, {});
  CHECK(std::abs(r.b / one.b - 1) < 1e-12);
  CHECK(std::abs(r.a * 1e6 * std::pow(1000, r.b) / one.a - 1) < 1e-11);
  CHECK(std::abs(r.sigma_b / one.sigma_b - 1) < 1e-11);
}

TEST_CASE("shift: exact data give the law back, with errors of rounding size", "[fit]") {
  Run run{};
  for (double v : {0.1, 0.2, 0.3, 0.5, 0.8})
    run.v.push_back(v), run.D.push_back(1.87e-3 * std::pow(v, 0.215));
  const auto r = fit(Route::shift, {run}, {});
  CHECK(std::abs(r.a / 1.87e-3 - 1) < 1e-13);
  CHECK(std::abs(r.b - 0.215) < 1e-13);
  CHECK(r.sigma_b < 1e-13);
}

TEST_CASE(
    "shift: one of a and b held; rows at v <= 0 and below --min-speed are counted, D <= 0 is "
    "not left out",
    "[fit]") {
  Run run{};
  for (double v : {-0.1, 0.0, 0.01, 0.2, 0.4, 0.8}) run.v.push_back(v), run.D.push_back(2 * v * v);
  run.D[4] = -0.1;
  FitOptions options;
  options.fixed[1] = 2;
  options.min_speed = 0.1;
  const auto r = fit(Route::shift, {run}, options);
  CHECK(r.n == 3);
  CHECK(r.left_out == 3);
  CHECK(r.sigma_b == 0);
  CHECK(r.corr == 0);
  // one linear parameter: a = sum(v^2 D) / sum(v^4)
  const double expected = (0.04 * 0.08 - 0.16 * 0.1 + 0.64 * 1.28) / (0.0016 + 0.0256 + 0.4096);
  CHECK(std::abs(r.a / expected - 1) < 1e-13);
  options.fixed[1].reset();
  options.fixed[0] = 2;
  run.D[4] = 0.32;
  const auto held = fit(Route::shift, {run}, options);
  CHECK(std::abs(held.b - 2) < 1e-12);
  CHECK(held.sigma_a == 0);
}

TEST_CASE("shift: a held, the gradient by b vanishes", "[fit]") {
  FitOptions options;
  options.fixed[0] = 0.75;
  const Run run = danwood();
  const double b = fit(Route::shift, {run}, options).b;
  double gradient = 0;
  for (std::size_t i = 0; i < run.v.size(); ++i) {
    const double law = 0.75 * std::pow(run.v[i], b);
    gradient += (law - run.D[i]) * law * std::log(run.v[i]);
  }
  CHECK(std::abs(gradient) < 1e-12);
}

TEST_CASE("shift: two points have a law but no errors; what cannot be determined is refused",
          "[fit]") {
  Run run{};
  run.v = {1, 4};
  run.D = {3, 6};
  const auto r = fit(Route::shift, {run}, {});
  CHECK(std::abs(r.a - 3) < 1e-13);
  CHECK(std::abs(r.b - 0.5) < 1e-13);
  CHECK(r.errors == Errors::none);
  CHECK(std::isnan(r.sigma_a));
  run.v = {1};
  run.D = {3};
  CHECK_THROWS_AS(fit(Route::shift, {run}, {}), Error);
  run.v = {};
  run.D = {};
  CHECK_THROWS_AS(fit(Route::shift, {run}, {}), Error);
  run.v = {2, 2, 2};
  run.D = {3, 4, 5};
  CHECK_THROWS_AS(fit(Route::shift, {run}, {}), Error);
  CHECK_THROWS_AS(fit(Route::loglog, {run}, {}), Error);
}

// The first and last means have narrow windows, and a mean over half of the roll bends the law.
TEST_CASE(
    "shift: smoothed and differentiated columns, the filters known: as good as the raw column, "
    "nothing biased, intervals that hold",
    "[fit][many]") {
  const Body body{1.375, 0.04, 0.5};
  struct Case {
    std::size_t width;
    double a, b;
    const char* source;
  };
  for (const auto& [width, a, b, source] :
       {Case{5, 1.87e-3, 0.215, "v"}, Case{31, 1.87e-3, 0.215, "x"}, Case{9, 8e-3, 1.5, "v"}}) {
    const auto truth = simulated::roll(body, a, b, 0.5);
    simulated::Noise noise(2026);
    int covered = 0;
    double sum = 0, squares = 0, raw_squares = 0, variances = 0;
    constexpr int runs = 200;
    for (int k = 0; k < runs; ++k) {
      std::vector<double> t, raw;
      const bool position = source[0] == 'x';
      for (int i = 0; i <= 58; ++i) {
        t.push_back(0.04 * i);
        raw.push_back(position ? truth.x(t.back()) + noise(3e-4)
                               : truth.v(t.back()) + noise(0.0053));
      }
      Run as_recorded{};
      as_recorded.body = body;
      as_recorded.t = t;
      (position ? as_recorded.x : as_recorded.v) = raw;
      const double raw_b = fit(position ? Route::position : Route::velocity, {as_recorded}, {}).b;
      const auto r = fit(Route::shift, {simulated::shifts(body, t, raw, width, source)}, {});
      covered += std::abs(r.b - b) < 1.96 * r.sigma_b;
      variances += r.sigma_b * r.sigma_b;
      sum += r.b - b;
      squares += (r.b - b) * (r.b - b);
      raw_squares += (raw_b - b) * (raw_b - b);
    }
    CAPTURE(width, b, covered, variances / squares, squares / raw_squares);
    CHECK(covered >= 178);  // 200 of 95 %: fewer by chance in 0.02 % (binomial)
    CHECK(std::abs(sum / runs) < 3.3 * std::sqrt(squares) / runs);
    CHECK(squares < 1.1 * 1.1 * raw_squares);
    CHECK(std::abs(variances / squares - 1) < 0.32);  // 3.3 times the scatter sqrt(2/200)
  }
}

// Of n rows the noise of a second derivative spans n^4 in its covariance, more than double
// precision holds. The shifts tell what the positions tell all the same.
TEST_CASE("shift: as precise as the positions at any rate of the rows", "[fit]") {
  const Body body{1.375, 0.04, 0.5};
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.5);
  for (const double rate : {25., 1000., 4000., 40000.}) {
    simulated::Noise noise(8);
    Run raw{};
    raw.body = body;
    for (int i = 0; i < 2.2 * rate; ++i) {
      raw.t.push_back(i / rate);
      raw.x.push_back(truth.x(raw.t.back()) + noise(3e-4));
    }
    const auto by_x = fit(Route::position, {raw}, {}),
               by_D = fit(Route::shift, {simulated::shifts(body, raw.t, raw.x, 11, "x")}, {});
    CAPTURE(rate, by_x.b, by_x.sigma_b, by_D.b, by_D.sigma_b);
    CHECK(std::abs(by_D.b - by_x.b) < 0.2 * by_x.sigma_b);
    CHECK(std::abs(by_D.sigma_b / by_x.sigma_b - 1) < 0.05);
  }
}

// A lost echo makes a window lopsided and a difference longer; the filters act on the times of the
// run and know.
TEST_CASE("shift: without noise, lost echoes and wide windows leave the law as it is", "[fit]") {
  const Body body{1.375, 0.04, 0.5};
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.5);
  std::mt19937 random(1);
  for (const std::size_t width : {5u, 31u}) {
    Run run{};
    run.shift_of = body;
    std::vector<double> x;
    for (int i = 0; i < 58; ++i) {
      if (i > 0 && random() % 5 == 0) continue;
      run.t.push_back(0.04 * i);
      x.push_back(truth.x(0.04 * i));
    }
    const auto uneven = [](Quantity from, Quantity to) {
      return LinearFilter{from, to, 1, [](std::span<const double> t, std::span<const double> y) {
                            std::vector<double> slopes;
                            for (std::size_t i = 0; i < t.size(); ++i) {
                              const std::size_t k = std::clamp<std::size_t>(i, 1, t.size() - 2);
                              const double p = t[k - 1], q = t[k], r = t[k + 1];
                              slopes.push_back(y[k - 1] * (2 * t[i] - q - r) / ((p - q) * (p - r)) +
                                               y[k] * (2 * t[i] - p - r) / ((q - p) * (q - r)) +
                                               y[k + 1] * (2 * t[i] - p - q) / ((r - p) * (r - q)));
                            }
                            return slopes;
                          }};
    };
    run.filters = {uneven(Quantity::x, Quantity::v), simulated::smooth_v(width),
                   uneven(Quantity::v, Quantity::a), simulated::shift()};
    run.v = run.filters[1].apply(run.t, run.filters[0].apply(run.t, x));
    run.D = run.filters[2].apply(run.t, run.v);
    for (double& D : run.D) D *= -(1 + body.K) * body.R / body.g;
    const auto r = fit(Route::shift, {run}, {});
    CAPTURE(width);
    CHECK(std::abs(r.a / 1.87e-3 - 1) < 1e-6);
    CHECK(std::abs(r.b - 0.215) < 1e-6);
  }
}

TEST_CASE("shift: made by the exact root of Eq. 9, it gives the law of an exact roll", "[fit]") {
  const Body body{1.375, 0.04, 0.5};
  Roll roll(exact_body(body), PowerLaw{1.2e-2, 0.3}, 0.5);  // D/R = 0.24 at first
  Run run{};
  run.shift_of = exact_body(body);
  for (int i = 0; i < 80; ++i) {
    run.t.push_back(0.005 * i);
    run.v.push_back(roll.at(run.t.back()).v);
  }
  run.filters = {simulated::differentiate(Quantity::v, Quantity::a), simulated::shift()};
  for (double a : run.filters[0].apply(run.t, run.v))
    run.D.push_back(shift_from_acceleration(exact_body(body), a));
  const auto r = fit(Route::shift, {run}, {});
  CHECK(std::abs(r.a / 1.2e-2 - 1) < 1e-6);
  CHECK(std::abs(r.b - 0.3) < 1e-6);
  run.shift_of->exact = false;
  CHECK(std::abs(fit(Route::shift, {run}, {}).a / 1.2e-2 - 1) > 1e-3);
}

TEST_CASE("shift: towards the sensor v and D are negative and the law is the same", "[fit]") {
  const Body body{1.375, 0.04, 0.5};
  const auto truth = simulated::roll(body, 1.87e-3, 0.215, 0.5);
  for (const bool known : {false, true}) {
    std::vector<double> t, v;
    for (int i = 0; i < 55; ++i) t.push_back(0.04 * i), v.push_back(truth.v(0.04 * i));
    Run run = simulated::shifts(body, t, v, 1);
    if (!known) run.filters.clear();
    const auto away = fit(Route::shift, {run}, {});
    for (double& x : run.v) x = -x;
    for (double& x : run.D) x = -x;
    const auto towards = fit(Route::shift, {run}, {});
    CHECK(std::abs(towards.a / away.a - 1) < 1e-9);
    CHECK(std::abs(towards.b - away.b) < 1e-9);
  }
}

TEST_CASE("shift: another unit of length gives the same law, the filters known", "[fit]") {
  const auto fitted = [](double unit) {
    Body body{1.375, 0.04 * unit, 0.5};
    body.g *= unit;
    const auto truth =
        simulated::roll(body, 1.87e-3 * std::pow(unit, 1 - 0.215), 0.215, 0.5 * unit);
    simulated::Noise noise(2026);
    std::vector<double> t, v;
    for (int i = 0; i <= 58; ++i)
      t.push_back(0.04 * i), v.push_back(truth.v(0.04 * i) + unit * noise(0.0053));
    return fit(Route::shift, {simulated::shifts(body, t, v, 9)}, {});
  };
  const auto metres = fitted(1), megametres = fitted(1e-6);
  CHECK(std::abs(megametres.b / metres.b - 1) < 1e-9);
  CHECK(std::abs(megametres.sigma_b / metres.sigma_b - 1) < 1e-7);
  CHECK(std::abs(megametres.a / std::pow(1e-6, 1 - metres.b) / metres.a - 1) < 1e-8);
}

TEST_CASE(
    "shift: of many rows all count, where few are enough to come near; of these few some may be "
    "worth nothing",
    "[fit]") {
  simulated::Noise noise(12);
  Run run{};
  for (int i = 0; i < 20000; ++i) {
    run.v.push_back(0.02 + 0.5 * i / 20000);
    run.D.push_back(2e-3 * std::pow(run.v.back(), 0.3) + noise(1e-4));
  }
  const auto check = [&] {
    const auto r = fit(Route::shift, {run}, {});
    double by_a = 0, by_b = 0, squares = 0,
           squares_b = 0;  // the residuals are orthogonal to the derivatives
    for (std::size_t i = 0; i < run.v.size(); ++i) {
      const double power = std::pow(run.v[i], r.b), f = r.a * power - run.D[i],
                   log = std::log(run.v[i]);
      by_a += f * power;
      by_b += f * power * log;
      squares += power * power;
      squares_b += power * log * power * log;
    }
    const double size = r.rms * std::sqrt(20000.0);
    CHECK(std::abs(by_a) < 1e-10 * size * std::sqrt(squares));
    CHECK(std::abs(by_b) < 1e-10 * size * std::sqrt(squares_b));
  };
  check();
  for (std::size_t i = 0; i < run.v.size(); i += 5)
    run.v[i] = 0.3;  // every fifth of them is looked at first
  check();
}
