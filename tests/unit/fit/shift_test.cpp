#include "base/error.h"
#include "unit/fit/simulated.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

// NIST StRD DanWood (Daniel & Wood 1980): y = b1 x^b2. The values with 25 digits:
// reference-data/nist/README.md.
FitRun danwood() {
  return {.t = {},
          .x = {},
          .v = {1.309, 1.471, 1.490, 1.565, 1.611, 1.680},
          .D = {2.138, 3.421, 3.597, 4.340, 4.882, 5.660},
          .body = {},
          .filters = {}};
}

double digits(double x, double certified) {
  return x == certified ? 17 : -std::log10(std::abs(x / certified - 1));
}

}  // namespace

TEST_CASE("shift: DanWood to 12 digits, from NIST's starts and from none", "[fit]") {
  const std::vector<std::pair<std::optional<double>, std::optional<double>>> starts{
      {{}, {}}, {1, 5}, {0.7, 4}};
  for (const auto& [a, b] : starts) {
    FitOptions options;
    options.start_a = a;
    options.start_b = b;
    const auto r = fit(Route::shift, {danwood()}, options);
    CHECK(digits(r.a, 0.7688622617649829315716521) > 12);
    CHECK(digits(r.b, 3.860405587076056567422589) > 12);
    CHECK(digits(r.sigma_a, 0.01828197386014182071121) > 12);
    CHECK(digits(r.sigma_b, 0.05172661091286822269107) > 12);
    CHECK(digits(r.corr, -0.9907719376796512486) > 12);
    CHECK(digits(r.rms, 0.03285311403920179263363) > 12);
    CHECK(r.n == 6);
    CHECK(r.errors == Errors::classical);
  }
}

TEST_CASE("shift: against c v, a is divided by c^b and b stays; D in other units scales a",
          "[fit]") {
  const auto one = fit(Route::shift, {danwood()}, {});
  FitRun scaled = danwood();
  for (double& v : scaled.v) v *= 1000;
  for (double& D : scaled.D) D *= 1e-6;
  const auto r = fit(Route::shift, {scaled}, {});
  CHECK(std::abs(r.b / one.b - 1) < 1e-12);
  CHECK(std::abs(r.a * 1e6 * std::pow(1000, r.b) / one.a - 1) < 1e-11);
  CHECK(std::abs(r.sigma_b / one.sigma_b - 1) < 1e-11);
}

TEST_CASE("shift: exact data give the law back, with errors of rounding size", "[fit]") {
  FitRun run{};
  for (double v : {0.1, 0.2, 0.3, 0.5, 0.8})
    run.v.push_back(v), run.D.push_back(1.87e-3 * std::pow(v, 0.215));
  const auto r = fit(Route::shift, {run}, {});
  CHECK(std::abs(r.a / 1.87e-3 - 1) < 1e-13);
  CHECK(std::abs(r.b - 0.215) < 1e-13);
  CHECK(r.sigma_b >= 0);
  CHECK(r.sigma_b < 1e-13);
}

TEST_CASE(
    "shift: one of a and b held; records at v <= 0 and below --min-speed are counted, D <= 0 is "
    "not left out",
    "[fit]") {
  FitRun run{};
  for (double v : {-0.1, 0.0, 0.01, 0.2, 0.4, 0.8}) run.v.push_back(v), run.D.push_back(2 * v * v);
  run.D[4] = -0.1;
  FitOptions options;
  options.b = 2;
  options.min_speed = 0.1;
  const auto r = fit(Route::shift, {run}, options);
  CHECK(r.n == 3);
  CHECK(r.left_out == 3);
  CHECK(r.sigma_b == 0);
  CHECK(r.corr == 0);
  // one linear parameter: a = sum(v^2 D) / sum(v^4)
  const double expected = (0.04 * 0.08 - 0.16 * 0.1 + 0.64 * 1.28) / (0.0016 + 0.0256 + 0.4096);
  CHECK(std::abs(r.a / expected - 1) < 1e-13);
  options.b.reset();
  options.a = 2;
  run.D[4] = 0.32;
  const auto held = fit(Route::shift, {run}, options);
  CHECK(std::abs(held.b - 2) < 1e-12);
  CHECK(held.sigma_a == 0);
}

TEST_CASE("shift: a held, the gradient by b vanishes", "[fit]") {
  FitOptions options;
  options.a = 0.75;
  const FitRun run = danwood();
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
  FitRun run{};
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

// D = -e / 100 for noise e on v: what is left of D - a v^b is (-1/100 - a b v^(b-1)) e, so the
// records weigh by its inverse (to which the floor adds the middle one of these numbers), and the
// fit solves these normal equations.
TEST_CASE("shift: the noise of v counts with the slope of the law", "[fit]") {
  simulated::Noise noise(1);
  FitRun run{};
  for (int i = 0; i < 15; ++i) {
    const double v = 0.2 + 0.1 * i, e = noise(0.01);
    run.t.push_back(i);
    run.v.push_back(v + e);
    run.D.push_back(2 * v * v * v - e / 100);
  }
  const auto plain = fit(Route::shift, {run}, {});
  run.filters = {{"v", "D", 0, [](std::span<const double>, std::span<const double> y) {
                    std::vector<double> D(y.begin(), y.end());
                    for (double& d : D) d *= -0.01;
                    return D;
                  }}};
  run.t =
      std::vector<double>(15, 0);  // no time passes: no roll from which smoothing could be judged
  const auto r = fit(Route::shift, {run}, {});
  std::vector<double> sizes;
  for (double v : run.v) sizes.push_back(0.01 + r.a * r.b * std::pow(v, r.b - 1));
  auto sorted = sizes;
  std::sort(sorted.begin(), sorted.end());
  double by_a = 0, by_b = 0, all_a = 0, all_b = 0;
  for (std::size_t i = 0; i < 15; ++i) {
    const double law = r.a * std::pow(run.v[i], r.b),
                 g = (law - run.D[i]) * law / (sizes[i] * sizes[i] + sorted[7] * sorted[7]);
    by_a += g;
    by_b += g * std::log(run.v[i]);
    all_a += std::abs(g);
    all_b += std::abs(g * std::log(run.v[i]));
  }
  CHECK(std::abs(by_a) < 1e-4 * all_a);
  CHECK(std::abs(by_b) < 1e-4 * all_b);
  CHECK(std::abs(r.b - plain.b) > 1e-4);
}

// The first and last means have narrow windows: a plain fit rests on them and has an sd of b near
// 0.05. A law that is smoothed over half of the roll is biased as well.
TEST_CASE(
    "shift: smoothed and differentiated speeds, the filters known: nothing biased, intervals that "
    "hold",
    "[fit]") {
  const Body body{1.375, 0.04, 0.5};
  for (const auto& [width, b] : {std::pair(5u, 0.215), std::pair(31u, 0.215), std::pair(9u, 1.5)}) {
    const auto truth = simulated::roll(body, b > 1 ? 8e-3 : 1.87e-3, b, 0.5);
    simulated::Noise noise(2026);
    int covered = 0;
    double sum = 0, squares = 0;
    constexpr int runs = 200;
    for (int k = 0; k < runs; ++k) {
      FitRun run{};
      for (int i = 0; i <= 58; ++i)
        run.t.push_back(0.04 * i), run.v.push_back(truth.v(0.04 * i) + noise(0.0053));
      run.filters = {simulated::smooth_v(width), simulated::differentiate("v", "a"),
                     simulated::shift(body)};
      run.v = run.filters[0].apply(run.t, run.v);
      run.D = run.filters[2].apply(run.t, run.filters[1].apply(run.t, run.v));
      const auto r = fit(Route::shift, {run}, {});
      CHECK(r.errors == Errors::filters);
      covered += std::abs(r.b - b) < 1.96 * r.sigma_b;
      sum += r.b - b;
      squares += (r.b - b) * (r.b - b);
    }
    CHECK(covered >= 178);  // 200 of 95 %: fewer by chance in 0.02 % (binomial)
    CHECK(std::abs(sum / runs) < 3.3 * std::sqrt(squares) / runs);
    if (b < 1) CHECK(std::sqrt(squares / runs) < 0.020);  // measured: 0.014; of a plain fit 0.05
  }
}

TEST_CASE("shift: another unit of length gives the same law, the filters known", "[fit]") {
  const auto fitted = [](double unit) {
    Body body{1.375, 0.04 * unit, 0.5};
    body.g *= unit;
    const auto truth =
        simulated::roll(body, 1.87e-3 * std::pow(unit, 1 - 0.215), 0.215, 0.5 * unit);
    simulated::Noise noise(2026);
    FitRun run{};
    for (int i = 0; i <= 58; ++i)
      run.t.push_back(0.04 * i), run.v.push_back(truth.v(0.04 * i) + unit * noise(0.0053));
    run.filters = {simulated::smooth_v(9), simulated::differentiate("v", "a"),
                   simulated::shift(body)};
    run.v = run.filters[0].apply(run.t, run.v);
    run.D = run.filters[2].apply(run.t, run.filters[1].apply(run.t, run.v));
    return fit(Route::shift, {run}, {});
  };
  const auto metres = fitted(1), megametres = fitted(1e-6);
  CHECK(std::abs(megametres.b / metres.b - 1) < 1e-9);
  CHECK(std::abs(megametres.sigma_b / metres.sigma_b - 1) < 1e-7);
  CHECK(std::abs(megametres.a / std::pow(1e-6, 1 - metres.b) / metres.a - 1) < 1e-8);
}

TEST_CASE(
    "shift: of many records all count, where few are enough to come near; of these few some may be "
    "worth nothing",
    "[fit]") {
  simulated::Noise noise(12);
  FitRun run{};
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
