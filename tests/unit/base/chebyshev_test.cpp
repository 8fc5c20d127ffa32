// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/chebyshev.h"

#include <limits>
#include <vector>

#include "unit/catch.h"

using namespace rolling;

namespace {

std::vector<double> times_every(double dt, std::size_t n) {
  std::vector<double> t;
  for (std::size_t i = 0; i < n; ++i) t.push_back(dt * static_cast<double>(i));
  return t;
}

/// The panels of a function of one value, and how often they have called it.
template <typename Function>
struct Counted {
  struct Call {
    Function f;
    int* calls;
    std::array<double, 1> operator()(double t) const {
      ++*calls;
      return {f(t)};
    }
  };
  Counted(const std::vector<double>& times, double end, Function function)
      : f(function), panels(times, {end, end}, Call{function, &calls}) {}
  Function f;
  int calls = 0;
  ChebyshevPanels<Call> panels;
};

}  // namespace

TEST_CASE("chebyshev: a series is exact for a polynomial of as many terms", "[base]") {
  // T_3 on 2 .. 6, and a constant
  const auto f = [](double t) {
    const double x = (t - 4) / 2;
    return std::array{4 * x * x * x - 3 * x, 7.0};
  };
  const ChebyshevSeries<2, 4> series(2, 6, f);
  for (const double t : {2.0, 2.3, 4.0, 5.9, 6.0}) {
    CHECK(std::abs(series(t)[0] - f(t)[0]) < 2e-15);
    CHECK(std::abs(series(t)[1] - 7) < 2e-15);
  }
  CHECK(series.contains(2));
  CHECK(series.contains(6));
  CHECK_FALSE(series.contains(6.0001));
  CHECK_FALSE(series.contains(1.9999));
  CHECK_FALSE(series.converges(0.9, 0.9));  // the last term is all there is of the first value
  CHECK_FALSE(ChebyshevSeries<2, 5>(2, 6, f).converges(0.9, 0.9));  // here the last but one
  CHECK(ChebyshevSeries<2, 6>(2, 6, f).converges(1e-15, 1e-15));
}

TEST_CASE("chebyshev: a series of exp has its coefficients, those of the Bessel functions",
          "[base]") {
  const auto f = [](double t) { return std::array{std::exp(t)}; };
  const ChebyshevSeries<1, 16> series(-1, 1, f);
  for (const double t : {-1.0, -0.7, 0.0, 0.3, 1.0})
    CHECK(std::abs(series(t)[0] / std::exp(t) - 1) < 3e-15);
  // The terms are I_0(1) and 2 I_n(1) (Abramowitz and Stegun 1964, 9.6.34): of eight, the last two
  // are at most 2 I_6(1) / I_0(1) = 3.55e-5 times the first.
  const ChebyshevSeries<1, 8> eight(-1, 1, f);
  CHECK(eight.converges(3.6e-5, 3.6e-5));
  CHECK_FALSE(eight.converges(3.5e-5, 3.5e-5));
}

TEST_CASE("chebyshev: panels over dense times, and the function itself over others", "[base]") {
  const auto f = [](double t) { return std::exp(-t) * std::sin(3 * t); };
  const auto dense = times_every(1e-4, 30000), sparse = times_every(0.1, 30);
  Counted often(dense, 1e300, f);
  double worst = 0;
  for (const double t : dense) worst = std::max(worst, std::abs(often.panels(t)[0] - f(t)));
  CHECK(worst < 2e-15);
  CHECK(often.calls < 30000 / 10);
  // once more, and backwards
  for (const double t : dense) worst = std::max(worst, std::abs(often.panels(t)[0] - f(t)));
  for (auto t = dense.rbegin(); t != dense.rend(); t += 100)
    worst = std::max(worst, std::abs(often.panels(*t)[0] - f(*t)));
  CHECK(worst < 2e-15);

  Counted seldom(sparse, 1e300, f);
  for (const double t : sparse) CHECK(seldom.panels(t)[0] == f(t));
  CHECK(seldom.calls == 30);
}

TEST_CASE("chebyshev: panels do not reach over the end, a kink or what is not a number", "[base]") {
  const auto dense = times_every(1e-4, 20000);
  const double step = dense[12345];
  const auto worst = [&](auto& function) {
    double largest = 0;
    for (const double t : dense)
      largest = std::max(largest, std::abs(function.panels(t)[0] - function.f(t)));
    return largest;
  };
  // A jump that is known.
  Counted stops(dense, step, [step](double t) { return t < step ? 1 + t : 3.0; });
  CHECK(worst(stops) < 5e-15);
  CHECK(stops.calls < 20000 / 10);
  // A kink that nobody has told.
  Counted bends(dense, 1e300, [step](double t) { return 1 + std::abs(t - step); });
  CHECK(worst(bends) < 5e-15);
  CHECK(bends.calls < 20000 / 4);
  Counted none(dense, 1e300, [](double) { return std::numeric_limits<double>::quiet_NaN(); });
  for (const double t : {dense[0], dense[1], dense[5000]}) CHECK(std::isnan(none.panels(t)[0]));
}
