// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/ledger.h"

#include <cmath>
#include <random>

#include "unit/signal/exact.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

double integral_of_sine(int n) {  // of sin(t) from 0 to 2: 1 - cos 2
  Integral integral;
  double sum = 0;
  for (int i = 0; i <= n; ++i) sum = integral.push(2.0 * i / n, std::sin(2.0 * i / n));
  return sum;
}

/// What the last of three samples adds: the parabola through them over the last step.
double last_part(double t0, double y0, double t1, double y1, double t2, double y2) {
  const double h = t2 - t1, k = t1 - t0;
  return 0.5 * h * (y2 + y1) - h * h / (6 * (h + k) * k) * ((y2 - y1) * k - (y1 - y0) * h);
}

}  // namespace

TEST_CASE("integral: by hand", "[contact]") {
  Integral line;  // a straight line over the first step and after a long gap
  CHECK(line.push(5, 100) == 0);
  CHECK(line.push(6, 300) == 200);
  CHECK(line.push(9, 500) == 1400);
  Integral parabola;  // t^2 over uneven steps: exact from the second on
  CHECK(parabola.push(0, 1) == 0);
  CHECK(parabola.push(1, 4) == 2.5);
  CHECK(std::abs(parabola.push(3, 16) - (2.5 + (64 - 8) / 3.0)) < 1e-14);
}

TEST_CASE("integral: at rest nothing is added", "[contact]") {
  Integral integral;
  integral.push(0, 4);
  integral.push(1, 1);
  const double at_rest = integral.push(2, 0);
  for (const double t : {3.0, 4.0, 5.0}) CHECK(integral.push(t, 0) == at_rest);
  CHECK(integral.push(6, 1) == at_rest + 0.5);
}

TEST_CASE("integral: the step to rest is exact for any power of the time left", "[contact]") {
  for (const double power : {-0.4, -1e-12, 0.0, 0.025, 0.27, 1.0, 2.5})
    for (const double h : {0.25, 1.0, 2.0}) {
      const auto y = [&](double left) { return 3 * std::pow(left, power); };
      Integral integral;
      integral.push(0, y(h + 1));
      const double before = integral.push(1, y(h));
      INFO(power << " " << h);
      CHECK(std::abs(integral.push(1 + h, 0) - before - y(h) * h / (1 + power)) < 1e-14);
      // On a slope the force does not vanish at rest.
      Integral inclined(-7);
      inclined.push(0, y(h + 1) - 7);
      const double so_far = inclined.push(1, y(h) - 7);
      CHECK(std::abs(inclined.push(1 + h, -7) - so_far - y(h) * h / (1 + power) + 7 * h) < 1e-13);
    }
  // What rises steeply towards rest has no such power: the integral might not exist.
  Integral rising;
  rising.push(0, 1);
  const double before = rising.push(1, 2);
  CHECK(rising.push(2, 0) == before + 1);
}

TEST_CASE("integral: a spike up and down again leaves no trace", "[contact]") {
  Integral integral;
  double sum = -1, t = 0;
  for (const double y : {1.0, 0.0, 1e100, -1e100, 0.0, 1.0}) sum = integral.push(t += 2, y);
  // The parts are 1, 1e100, that of the parabola, -1e100, 1.
  CHECK(sum == 2 + last_part(4, 0, 6, 1e100, 8, -1e100));
}

TEST_CASE("integral: exact on a straight line, uneven times", "[contact]") {
  Integral integral;
  for (const double t : {0.0, 0.25, 1.0, 1.125, 4.0, 16.0})
    CHECK(integral.push(t, 3 + 2 * t) == 3 * t + t * t);
}

TEST_CASE("integral: the beginning of the time does not matter, lost rows or not", "[contact]") {
  const auto from = [](int first) {  // 25 Hz; one row in five is lost
    Integral integral;
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> any(0, 1);
    double sum = 0;
    for (int i = 0; i < 500; ++i)
      if (const double y = any(random); any(random) > 0.2)
        sum = integral.push((first + i) / 25., y);
    return sum;
  };
  for (const int first : {1, 44, 1000, 25 * 86400}) CHECK(std::abs(from(first) - from(0)) < 1e-9);
}

TEST_CASE("integral: third order in the spacing", "[contact]") {
  const double exact = 1 - std::cos(2.0);
  for (int n = 16; n <= 4096; n *= 2) {
    const double error = std::abs(integral_of_sine(n) - exact),
                 half = std::abs(integral_of_sine(2 * n) - exact);
    INFO(n);
    CHECK(error <= 0.2 * std::pow(2.0 / n, 3));
    CHECK(std::abs(std::log2(error / half) - 3) < 0.2);
  }
}

TEST_CASE("integral: a million steps do not drift from the exact sum of them", "[contact]") {
  Integral integral;
  FixedPoint exact;
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> power(-1, 1);
  double t_older = 0, y_older = 0, t_before = 0, y_before = 0, sum = 0, magnitude = 0;
  int failures = 0;
  for (int i = 0; i < 1000000; ++i) {
    const double t = i * 0.04,
                 y = power(random) +
                     (i == 1000 ? 1e12 : 0);  // and a spike that has to leave no trace
    sum = integral.push(t, y);
    if (i > 0) {
      const double part = i == 1 ? 0.5 * (t - t_before) * (y + y_before)
                                 : last_part(t_older, y_older, t_before, y_before, t, y);
      exact.add(part);
      magnitude += std::abs(part);
    }
    if (i % 1000 == 999)
      failures +=
          std::abs(sum - exact.nearly()) > eps * std::abs(exact.nearly()) + 1e-12 * eps * magnitude;
    t_older = t_before, y_older = y_before, t_before = t, y_before = y;
  }
  CHECK(failures == 0);
}

TEST_CASE("integral: a constant over a million steps is constant times time", "[contact]") {
  Integral integral;
  double sum = 0, t = 0;
  for (int i = 0; i <= 1000000; ++i) {
    t = i * 0.0009765625;  // 2^-10: the times are exact, a step's part is not
    sum = integral.push(t, 0.1);
    REQUIRE(std::abs(sum - 0.1 * t) <= eps * sum);
  }
}

namespace {

/// The largest distance, in ulps, of the running integral over `rows` samples from the exact sum of
/// its trapezoids.
double drift_in_ulps(std::size_t rows) {
  __extension__ typedef __int128
      Exact;  // in units of 2^-80: the trapezoids are doubles between 2^-9 and 2^-4
  rolling::Integral integral;
  std::mt19937_64 random(12);
  Exact exact = 0;
  double t_older = 0, y_older = 0, t_before = 0, y_before = 0, largest = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = 0.04 * static_cast<double>(i),
                 y = 0.1 + std::ldexp(static_cast<double>(random() >> 11), -53);
    const double sum = integral.push(t, y);
    if (i > 0) {
      const double part = i == 1 ? 0.5 * (t - t_before) * (y + y_before)
                                 : last_part(t_older, y_older, t_before, y_before, t, y);
      exact += static_cast<Exact>(std::ldexp(part, 80));
      const double ulp = std::nextafter(sum, 1e300) - sum;
      const auto off = static_cast<double>(exact - static_cast<Exact>(std::ldexp(sum, 80)));
      largest = std::max(largest, std::abs(std::ldexp(off, -80)) / ulp);
    }
    t_older = t_before, y_older = y_before, t_before = t, y_before = y;
  }
  return largest;
}

}  // namespace

TEST_CASE("integral: it does not drift over a million rows", "[contact]") {
  const double ulps = drift_in_ulps(1'000'000);
  CAPTURE(ulps);
  CHECK(ulps <= 1);
  CHECK(ulps > 0.4);  // the measure sees rounding
}

TEST_CASE("integral: it does not drift over a hundred million rows", "[.long]") {
  const double ulps = drift_in_ulps(100'000'000);
  WARN("largest drift: " << ulps << " ulp");
  CHECK(ulps <= 1);
}
