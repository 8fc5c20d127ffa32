#include "contact/integral.h"

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

}  // namespace

TEST_CASE("integral: by hand", "[signal]") {
  Integral integral;
  CHECK(integral.push(5, 100) == 0);
  CHECK(integral.push(6, 300) == 200);
  CHECK(integral.push(8, -100) == 400);
  CHECK(integral.push(8.5, -100) == 350);
}

TEST_CASE("integral: a spike up and down again leaves no trace", "[signal]") {
  Integral integral;
  double sum = -1, t = 0;
  for (const double y : {1.0, 0.0, 1e100, -1e100, 0.0, 1.0})
    sum = integral.push(t += 2, y);  // parts 1, 1e100, 0, -1e100, 1
  CHECK(sum == 2);
}

TEST_CASE("integral: exact on a straight line, uneven times", "[signal]") {
  Integral integral;
  for (const double t : {0.0, 0.25, 1.0, 1.125, 4.0, 16.0})
    CHECK(integral.push(t, 3 + 2 * t) == 3 * t + t * t);
}

TEST_CASE("integral: second order in the spacing", "[signal]") {
  const double exact = 1 - std::cos(2.0);
  // The error of the rule is h^2 (b - a) f'' / 12 at most.
  for (int n = 16; n <= 4096; n *= 2) {
    const double error = std::abs(integral_of_sine(n) - exact),
                 half = std::abs(integral_of_sine(2 * n) - exact);
    INFO(n);
    CHECK(error <= std::pow(2.0 / n, 2) * 2 / 12);
    CHECK(std::abs(std::log2(error / half) - 2) < 0.05);
  }
}

TEST_CASE("integral: a million steps do not drift from the exact sum of them", "[signal]") {
  Integral integral;
  Expansion exact;
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> power(-1, 1);
  double t_before = 0, y_before = 0, sum = 0, magnitude = 0;
  int failures = 0;
  for (int i = 0; i < 1000000; ++i) {
    const double t = i * 0.04,
                 y = power(random) +
                     (i == 1000 ? 1e12 : 0);  // and a spike that has to leave no trace
    sum = integral.push(t, y);
    if (i > 0) {
      const double part = 0.5 * (t - t_before) * (y + y_before);
      exact.add(part);
      magnitude += std::abs(part);
    }
    if (i % 1000 == 999)
      failures +=
          std::abs(sum - exact.nearly()) > eps * std::abs(exact.nearly()) + 1e-12 * eps * magnitude;
    t_before = t, y_before = y;
  }
  CHECK(failures == 0);
}

TEST_CASE("integral: a constant over a million steps is constant times time", "[signal]") {
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
  double t_before = 0, y_before = 0, largest = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = 0.04 * static_cast<double>(i),
                 y = 0.1 + std::ldexp(static_cast<double>(random() >> 11), -53);
    const double sum = integral.push(t, y);
    if (i > 0) {
      const double part = 0.5 * (t - t_before) * (y + y_before);
      exact += static_cast<Exact>(std::ldexp(part, 80));
      const double ulp = std::nextafter(sum, 1e300) - sum;
      const auto off = static_cast<double>(exact - static_cast<Exact>(std::ldexp(sum, 80)));
      largest = std::max(largest, std::abs(std::ldexp(off, -80)) / ulp);
    }
    t_before = t, y_before = y;
  }
  return largest;
}

}  // namespace

TEST_CASE("integral: it does not drift over a million rows", "[signal]") {
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
