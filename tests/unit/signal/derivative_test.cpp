// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/derivative.h"

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "base/error.h"
#include "signal/method.h"
#include "unit/catch.h"
#include "unit/signal/through.h"

using namespace rolling;

namespace {

std::vector<double> differentiated(const std::vector<double>& t, const std::vector<double>& y) {
  const auto derivative = central_derivative();
  std::vector<double> out;
  for (std::size_t i = 0; i < t.size(); ++i)
    for (const double value : derivative->push(t[i], y[i])) out.push_back(value);
  for (const double value : derivative->finish()) out.push_back(value);
  return out;
}

/// Times from 0 to 1 in steps that differ by up to a factor of 3, in a pattern that stays as n
/// grows.
std::vector<double> uneven_times(int n) {
  std::vector<double> t;
  for (int i = 0; i <= n; ++i) t.push_back((i + (i % 2 ? 0.5 : 0) * (i < n)) / n);
  return t;
}

struct Errors {
  double inside, ends;
};

Errors worst_errors(const std::vector<double>& t, const std::function<double(double)>& f,
                    const std::function<double(double)>& slope) {
  std::vector<double> y;
  for (const double time : t) y.push_back(f(time));
  const auto d = differentiated(t, y);
  REQUIRE(d.size() == t.size());
  Errors worst{0, 0};
  for (std::size_t i = 0; i < t.size(); ++i) {
    double& error = i == 0 || i + 1 == t.size() ? worst.ends : worst.inside;
    error = std::max(error, std::abs(d[i] - slope(t[i])));
  }
  return worst;
}

}  // namespace

TEST_CASE("derivative: exact on a parabola, even times and uneven, ends and all", "[signal]") {
  // Binary fractions, so that there is no rounding to excuse.
  const std::vector<double> even = {0, 0.25, 0.5, 0.75, 1}, uneven = {-2, -1.5, 0.5, 1, 5, 5.25};
  for (const auto& t : {even, uneven}) {
    std::vector<double> y, slope;
    for (const double time : t)
      y.push_back(3 - 2 * time + 4 * time * time), slope.push_back(-2 + 8 * time);
    const auto d = differentiated(t, y);
    REQUIRE(d.size() == t.size());
    for (std::size_t i = 0; i < t.size(); ++i) CHECK(std::abs(d[i] - slope[i]) < 1e-13);
  }
}

TEST_CASE("derivative: exact on 100 random parabolas, uneven times", "[signal]") {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 100; ++trial) {
    const double a = any(random), b = any(random), c = any(random);
    std::vector<double> t = {any(random)};
    for (int i = 0; i < 20; ++i) t.push_back(t.back() + 0.05 + std::abs(any(random)));
    const Errors worst = worst_errors(
        t, [&](double x) { return a + b * x + c * x * x; },
        [&](double x) { return b + 2 * c * x; });
    CHECK(std::max(worst.inside, worst.ends) < 1e-11);
  }
}

TEST_CASE("derivative: by hand", "[signal]") {
  CHECK(differentiated({0, 1, 2}, {0, 1, 4}) == std::vector<double>{0, 2, 4});
  CHECK(differentiated({0, 1, 3}, {0, 1, 9}) == std::vector<double>{0, 2, 6});
  CHECK(differentiated({0, 1, 2, 3}, {0, 0, 6, 0}) == std::vector<double>{-3, 3, 0, -12});
}

TEST_CASE("derivative: second order on any spacing, at the ends too", "[signal]") {
  const auto f = [](double t) { return std::sin(5 * t); };
  const auto slope = [](double t) { return 5 * std::cos(5 * t); };
  for (const bool even : {true, false}) {
    const auto times = [&](int n) {
      auto t = uneven_times(n);
      if (even)
        for (int i = 0; i <= n; ++i) t[static_cast<std::size_t>(i)] = static_cast<double>(i) / n;
      return t;
    };
    Errors last = worst_errors(times(16), f, slope);
    // The parabola's error is f''' h1 h2 / 6 inside and f''' h1 (h1 + h2) / 6 at an end, f''' <=
    // 125, h <= 1.5 / 16.
    CHECK(last.inside <= 125 * std::pow(1.5 / 16, 2) / 6);
    CHECK(last.ends <= 125 * 2 * std::pow(1.5 / 16, 2) / 6);
    for (int n = 32; n <= 4096; n *= 2) {
      const Errors now = worst_errors(times(n), f, slope);
      INFO(n << (even ? " even" : " uneven"));
      CHECK(std::abs(std::log2(last.inside / now.inside) - 2) < 0.35);
      CHECK(std::abs(std::log2(last.ends / now.ends) - 2) < 0.35);
      last = now;
    }
  }
}

TEST_CASE("derivative: two samples have one slope, one sample has none", "[signal]") {
  CHECK(differentiated({1, 3}, {5, 4}) == std::vector<double>{-0.5, -0.5});
  CHECK_THROWS_AS(differentiated({1}, {5}), Error);
  CHECK(differentiated({}, {}).empty());
}

TEST_CASE("derivative: each is known one sample later", "[signal]") {
  const auto derivative = central_derivative();
  CHECK(derivative->push(0, 0).empty());
  CHECK(derivative->push(1, 1).empty());
  CHECK(derivative->push(2, 4).size() == 2);
  CHECK(derivative->push(3, 9).size() == 1);
  CHECK(derivative->finish().size() == 1);
}

TEST_CASE("derivative: a shift of the time axis by a power of two changes no bit", "[signal]") {
  const std::vector<double> t = {0, 0.25, 0.75, 1, 1.25}, y = {0.1, 0.7, 0.3, 0.2, 0.9};
  std::vector<double> later;
  for (const double time : t) later.push_back(time + 1024);
  CHECK(differentiated(later, y) == differentiated(t, y));
}

namespace {

std::vector<double> by(std::string_view method, const std::vector<double>& t,
                       const std::vector<double>& y) {
  const auto signal = make_signal({by_name(derivative_methods).at(std::string(method)), {23, 0}});
  return through(*signal, t, y);
}

}  // namespace

TEST_CASE("derivative: vernier by hand, to the last bit", "[signal]") {
  // 3, 2, 1 on the slopes over one, two and three samples to either side; beyond an end the sample
  // at the end.
  const std::vector<double> t = {0, 1, 2, 3, 4, 5, 6, 7}, y = {0, 0, 0, 12, 0, 0, 0, 0};
  CHECK(by("vernier", t, y) == std::vector<double>{4. / 6, 8. / 6, 3, 0, -3, -1, -0.5, 0});
  // As its definition reads, on uneven times and runs shorter than the window.
  for (std::size_t n = 2; n <= 12; ++n) {
    const auto times = uneven_times(static_cast<int>(n) - 1), values = noise(n, 3);
    const auto d = by("vernier", times, values);
    REQUIRE(d.size() == n);
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0;
      for (std::size_t k = 1; k <= 3; ++k) {
        const std::size_t a = i >= k ? i - k : 0, b = std::min(i + k, n - 1);
        sum += static_cast<double>(4 - k) * (values[b] - values[a]) / (times[b] - times[a]);
      }
      CHECK(d[i] == sum / 6);
    }
  }
}

TEST_CASE("derivative: pasco by hand", "[signal]") {
  const std::vector<double> t = {0, 1, 2, 3, 4, 5, 6}, y = {0, 1, 4, 9, 10, 0, 0};
  // inside (y[i+1] + y[i+2] - y[i-1] - y[i-2]) / 6; the second and the last but one central; the
  // outer ones as a parabola
  CHECK(by("pasco", t, y) == std::vector<double>{0, 2, 18. / 6, 5. / 6, -13. / 6, -5, 5});
  CHECK(by("pasco", {0, 2}, {1, 2}) == std::vector<double>{0.5, 0.5});
  CHECK(by("pasco", {0, 1, 3}, {0, 1, 9}) == std::vector<double>{0, 3, 6});
  CHECK(by("pasco", {0, 1, 2, 4}, {0, 1, 4, 16}) == std::vector<double>{0, 2, 5, 8});
}

TEST_CASE(
    "derivative: every method has a number for each sample, the slope of a line, and turns with "
    "time",
    "[signal]") {
  for (const SignalMethod& method : derivative_methods)
    for (const int n : {2, 3, 4, 5, 6, 7, 8, 30}) {
      const auto t = uneven_times(n - 1), y = noise(t.size(), 6);
      std::vector<double> line;
      for (const double time : t) line.push_back(7 - 3 * time);
      INFO(method.name << " of " << n);
      const auto slopes = by(method.name, t, line), ahead = by(method.name, t, y),
                 back = backwards(by(method.name, backwards(t, -1), backwards(y)), -1);
      REQUIRE(slopes.size() == t.size());
      for (std::size_t i = 0; i < t.size(); ++i) {
        CHECK(std::abs(slopes[i] + 3) < 1e-11);
        CHECK(std::abs(ahead[i] - back[i]) <
              (method.name == "spline" ? 1e-3 : 1e-10) * (1 + std::abs(ahead[i])));
      }
    }
  for (const SignalMethod& method : derivative_methods) {
    INFO(method.name);
    CHECK_THROWS_AS(by(method.name, {1}, {5}), Error);
    CHECK(by(method.name, {}, {}).empty());
  }
}

TEST_CASE("derivative: vernier and pasco are exact on a parabola inside, on even times",
          "[signal]") {
  std::vector<double> t, y;
  for (int i = 0; i < 20; ++i)
    t.push_back(0.25 * i), y.push_back(3 - 2 * t.back() + 4 * t.back() * t.back());
  for (const auto method : {"vernier", "pasco"}) {
    const auto d = by(method, t, y);
    for (std::size_t i = 3; i + 3 < t.size(); ++i) CHECK(std::abs(d[i] - (-2 + 8 * t[i])) < 1e-12);
  }
}

TEST_CASE("derivative: what all readings have in common changes no bit, whatever the method",
          "[signal]") {
  std::mt19937_64 random(2);
  std::vector<double> t{0}, y, higher;
  while (t.size() < 60) t.push_back(t.back() + 0.25 * static_cast<double>(1 + random() % 4));
  for (const double time : t)
    y.push_back(std::round(time * time / 4) + static_cast<double>(random() % 5));
  for (const double reading : y) higher.push_back(reading + 0x1p51);  // exact
  for (const SignalMethod& method : derivative_methods) {
    INFO(method.name);
    CHECK(by(method.name, t, higher) == by(method.name, t, y));
  }
}
