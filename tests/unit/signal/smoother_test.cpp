// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/smoother.h"

#include <cmath>
#include <utility>
#include <vector>

#include "unit/catch.h"
#include "unit/signal/through.h"

using namespace rolling;

namespace {

const auto methods = by_name(smoothing_methods);

std::size_t width_for(double curvature, double size, unsigned seed, const char* method = "mean") {
  const Series t = even_times(300), e = noise(300, seed);
  std::vector<Sample> run;
  for (std::size_t i = 0; i < t.size(); ++i)
    run.push_back({t[i], std::sin(curvature * t[i]) + size * e[i]});
  return best_width(run, {methods.at(method)});
}

double error_of(std::size_t width, double curvature, double size, unsigned seed) {
  const Series t = even_times(300), e = noise(300, seed);
  Series y;
  for (std::size_t i = 0; i < t.size(); ++i) y.push_back(std::sin(curvature * t[i]) + size * e[i]);
  const auto s = through(*make_signal({methods.at("mean"), {width, 0}}), t, y);
  double sum = 0;
  for (std::size_t i = 3; i + 3 < t.size(); ++i)
    sum += std::pow(s[i] - std::sin(curvature * t[i]), 2);
  return std::sqrt(sum / 294);
}

}  // namespace

TEST_CASE("smoother: the best width grows with the noise and falls with the curvature",
          "[signal]") {
  CHECK(width_for(3, 0.2, 1) > width_for(3, 0.01, 1));
  CHECK(width_for(1, 0.05, 2) > width_for(5, 0.05, 2));
  CHECK(width_for(3, 0.05, 3, "savgol") > width_for(3, 0.05, 3));
  CHECK(width_for(3, 0, 1) == 7);
  CHECK(width_for(3, 0, 1, "savgol") == 9);
}

TEST_CASE("smoother: the best width has nearly the least error that any width has", "[signal]") {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u})
    for (const double curvature : {1.0, 3.0}) {
      double least = INFINITY;
      for (std::size_t width = 7; width < 150; width += 2)
        least = std::min(least, error_of(width, curvature, 0.1, seed));
      CHECK(error_of(width_for(curvature, 0.1, seed), curvature, 0.1, seed) < 1.3 * least);
    }
}

namespace {

std::vector<Sample> noisy_sine(const Series& t, double curvature, unsigned seed) {
  const Series e = noise(t.size(), seed);
  std::vector<Sample> run;
  for (std::size_t i = 0; i < t.size(); ++i)
    run.push_back({t[i], std::sin(curvature * t[i]) + 0.1 * e[i]});
  return run;
}

}  // namespace

TEST_CASE(
    "smoother: the best width is that of all the lines through the others, where there are few",
    "[signal]") {
  const Series t = uneven_times(35);  // half widths from 3 to 8
  for (const double curvature : {2.0, 0.0})
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
      const std::vector<Sample> run = noisy_sine(t, curvature, seed);
      std::size_t best = 0;
      long double least = INFINITY;
      for (std::size_t half = 3; half <= 8; ++half) {
        long double sum = 0;
        for (std::size_t i = 3; i + 3 < run.size(); ++i) {
          const std::size_t k = std::min({half, i, run.size() - 1 - i});
          long double n = 0, s = 0, ss = 0, y = 0,
                      sy = 0;  // of the regression of y on s, the time from row i
          for (std::size_t j = i - k; j <= i + k; ++j) {
            if (std::max(i, j) - std::min(i, j) <= 2) continue;
            const long double from = static_cast<long double>(run[j].t) - run[i].t;
            ++n, s += from, ss += from * from, y += run[j].y, sy += from * run[j].y;
          }
          const long double off = run[i].y - (ss * y - s * sy) / (n * ss - s * s);
          sum += off * off;
        }
        if (sum < least) least = sum, best = 2 * half + 1;
      }
      CHECK(best_width(run, {methods.at("mean")}) == best);
    }
}

namespace {

/// The value at 0 of the parabola through points (u, y) by least squares: Cramer's rule.
long double parabola_at_0(const std::vector<std::pair<long double, long double>>& points) {
  long double s[5] = {}, r[3] = {};
  for (const auto& [u, y] : points) {
    long double power = 1;
    for (int k = 0; k < 5; ++k, power *= u) {
      s[k] += power;
      if (k < 3) r[k] += power * y;
    }
  }
  const auto determinant = [&](long double a, long double b, long double c) {
    return a * (s[2] * s[4] - s[3] * s[3]) - s[1] * (b * s[4] - s[3] * c) +
           s[2] * (b * s[3] - s[2] * c);
  };
  return determinant(r[0], r[1], r[2]) / determinant(s[0], s[1], s[2]);
}

}  // namespace

TEST_CASE("smoother: the best width of savgol is judged in its first and last whole window",
          "[signal]") {
  const Series t = uneven_times(35);  // half widths from 4 to 8
  for (const double curvature : {4.0, 2.0, 0.0})
    for (unsigned seed = 1; seed <= 12; ++seed) {
      const std::vector<Sample> run = noisy_sine(t, curvature, seed);
      std::size_t best = 0;
      long double least = INFINITY;
      for (std::size_t width = 9; width <= 17; width += 2) {
        long double sum = 0;
        for (std::size_t i = 0; i < 35; ++i) {
          const std::size_t from = i < width / 2 ? 0 : std::min(i - width / 2, 35 - width);
          std::vector<std::pair<long double, long double>> others;
          for (std::size_t j = from; j < from + width; ++j)
            if (std::max(i, j) - std::min(i, j) > 2)
              others.emplace_back(static_cast<long double>(run[j].t) - run[i].t, run[j].y);
          sum += std::pow(run[i].y - parabola_at_0(others), 2);
        }
        if (sum < least) least = sum, best = width;
      }
      INFO("curvature " << curvature << ", seed " << seed);
      CHECK(best_width(run, {methods.at("savgol")}) == best);
    }
}

TEST_CASE("smoother: the best width is not misled by the noise of central differences",
          "[signal]") {
  // Their noise is bound at a distance of two; leaving out the one row alone would take it for a
  // signal.
  const Series t = even_times(300), e = noise(302, 5);
  std::vector<Sample> run;
  for (std::size_t i = 0; i < t.size(); ++i)
    run.push_back({t[i], 0.5 - 0.1 * t[i] + 0.01 * (e[i + 2] - e[i])});
  CHECK(best_width(run, {methods.at("mean")}) > 31);
}

TEST_CASE(
    "smoother: automatic is the same as the width it finds, and short runs have the narrowest",
    "[signal]") {
  const Series t = uneven_times(120), y = noise(120, 2);
  for (const auto& [name, method] : methods) {
    AutoSmoother automatic({method});
    const auto out = through(automatic, t, y);
    CHECK(out == through(*make_signal(automatic.options()), t, y));
  }
  for (std::size_t n = 0; n < 9; ++n) {
    AutoSmoother automatic({methods.at("mean")});
    CHECK(through(automatic, even_times(n), noise(n, 1)).size() == n);
    CHECK(automatic.options().width.samples == 7);
  }
}

TEST_CASE("smoother: the best width of a long run, of which every tenth row is predicted",
          "[signal]") {
  const Series t = even_times(20000), e = noise(20000, 4);
  std::vector<Sample> line, wave;
  for (std::size_t i = 0; i < t.size(); ++i) {
    line.push_back({t[i], 0.1 * t[i] + e[i]});
    wave.push_back({t[i], std::sin(3 * t[i]) + 0.1 * e[i]});
  }
  CHECK(best_width(line, {methods.at("mean")}) > 1000);
  CHECK(best_width(line, {methods.at("mean")}) <= 2001);
  // As of its first 2000 rows, all of which are predicted, to a step of the widths that are
  // tried.
  const auto whole = static_cast<double>(best_width(wave, {methods.at("mean")}));
  const auto part =
      static_cast<double>(best_width(std::span(wave).subspan(0, 2000), {methods.at("mean")}));
  CHECK(std::abs(whole - part) <= 0.3 * part);
}

TEST_CASE("smoother: the units of the readings do not change the best width", "[signal]") {
  const std::vector<Sample> run = noisy_sine(even_times(300), 1, 1);
  for (const char* method : {"mean", "savgol"}) {
    const std::size_t expected = best_width(run, {methods.at(method)});
    CHECK(expected > 9);
    for (const int power : {-900, -600, 600, 900}) {
      std::vector<Sample> scaled = run;
      for (Sample& s : scaled) s.y = std::ldexp(s.y, power);
      INFO(method << ", 2^" << power);
      CHECK(best_width(scaled, {methods.at(method)}) == expected);
    }
  }
}
