// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/savitzky_golay.h"

#include <cmath>

#include "base/error.h"
#include "unit/catch.h"
#include "unit/signal/through.h"

using namespace rolling;

namespace {

constexpr std::size_t value = 0, slope = 1;  // the derivatives

Series filtered(const Series& t, const Series& y, std::size_t width, std::size_t order,
                std::size_t what) {
  return through(*savitzky_golay({width, 0}, order, what), t, y);
}

/// The weights of the middle of a run on even times with step 1: what the filter makes of an
/// impulse, seen backwards.
Series weights(std::size_t width, std::size_t order, std::size_t what) {
  Series y(3 * width, 0);
  y[3 * width / 2] = 1;
  const auto out = filtered(even_times(y.size(), 1), y, width, order, what);
  Series w;
  for (std::size_t i = width; i < 2 * width; ++i) w.push_back(out[i]);
  return backwards(w);
}

void check_close(const Series& a, const Series& b, double tolerance) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    INFO(i << ": " << a[i] << " " << b[i]);
    CHECK(std::abs(a[i] - b[i]) <= tolerance);
  }
}

/// By another way: normal equations of monomials about the sample, by elimination in long double.
double by_elimination(const Series& t, const Series& y, std::size_t i, std::size_t begin,
                      std::size_t end, std::size_t order, bool derivative) {
  const std::size_t p = order + 1;
  std::vector<std::vector<long double>> A(p, std::vector<long double>(p + 1, 0));
  for (std::size_t j = begin; j < end; ++j) {
    const long double u = (static_cast<long double>(t[j]) - t[i]) / 0.2L;
    for (std::size_t a = 0; a < p; ++a) {
      for (std::size_t b = 0; b < p; ++b) A[a][b] += std::pow(u, static_cast<long double>(a + b));
      A[a][p] += std::pow(u, static_cast<long double>(a)) * y[j];
    }
  }
  for (std::size_t k = 0; k < p; ++k)
    for (std::size_t r = 0; r < p; ++r)
      if (r != k) {
        const long double f = A[r][k] / A[k][k];
        for (std::size_t c = k; c <= p; ++c) A[r][c] -= f * A[k][c];
      }
  return static_cast<double>(derivative ? A[1][p] / A[1][1] / 0.2L : A[0][p] / A[0][0]);
}

/// By a third way, for high orders: an orthonormal basis by Gram and Schmidt, each polynomial made
/// orthogonal to all before it, twice, in long double. `size` is the length of the weights.
struct Projection {
  long double value = 0, slope = 0, value_size = 0, slope_size = 0;
};
Projection projection(const Series& t, const Series& y, std::size_t at, std::size_t order) {
  using Long = std::vector<long double>;
  const std::size_t n = t.size();
  const long double scale = static_cast<long double>(t.back()) - t.front();
  const auto dot = [n](const Long& a, const Long& b) {
    long double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += a[j] * b[j];
    return sum;
  };
  std::vector<Long> basis;
  Long slopes;  // of each at the sample
  Projection result;
  for (std::size_t k = 0; k <= order; ++k) {
    Long p(n, 1);
    long double steep = 0;
    if (k > 0) {
      for (std::size_t j = 0; j < n; ++j)
        p[j] = (static_cast<long double>(t[j]) - t[at]) / scale * basis[k - 1][j];
      steep = basis[k - 1][at] / scale;
    }
    for (int round = 0; round < 2; ++round)
      for (std::size_t m = 0; m < k; ++m) {
        const long double c = dot(p, basis[m]);
        for (std::size_t j = 0; j < n; ++j) p[j] -= c * basis[m][j];
        steep -= c * slopes[m];
      }
    const long double size = std::sqrt(dot(p, p));
    for (long double& x : p) x /= size;
    slopes.push_back(steep / size);
    const long double c = dot(p, Long(y.begin(), y.end()));
    result.value += c * p[at], result.slope += c * slopes[k];
    result.value_size += p[at] * p[at], result.slope_size += slopes[k] * slopes[k];
    basis.push_back(std::move(p));
  }
  result.value_size = std::sqrt(result.value_size);
  result.slope_size = std::sqrt(result.slope_size);
  return result;
}

}  // namespace

// Savitzky and Golay (1964), Anal. Chem. 36, 1627, tables I, II, III and IV, as corrected by
// Steinier et al. (1972), 44, 1906.
TEST_CASE("savitzky_golay: the weights of the tables on even times", "[signal]") {
  const auto over = [](Series w, double norm) {
    for (double& x : w) x /= norm;
    return w;
  };
  check_close(weights(5, 2, value), over({-3, 12, 17, 12, -3}, 35), 1e-15);
  check_close(weights(5, 3, value), over({-3, 12, 17, 12, -3}, 35), 1e-15);
  check_close(weights(7, 2, value), over({-2, 3, 6, 7, 6, 3, -2}, 21), 1e-15);
  check_close(weights(11, 2, value), over({-36, 9, 44, 69, 84, 89, 84, 69, 44, 9, -36}, 429),
              1e-15);
  check_close(weights(7, 4, value), over({5, -30, 75, 131, 75, -30, 5}, 231), 1e-15);
  check_close(weights(5, 2, slope), over({-2, -1, 0, 1, 2}, 10), 1e-15);
  check_close(weights(7, 2, slope), over({-3, -2, -1, 0, 1, 2, 3}, 28), 1e-15);
  check_close(weights(5, 3, slope), over({1, -8, 0, 8, -1}, 12), 1e-15);
  check_close(weights(7, 4, slope), over({22, -67, -58, 0, 58, 67, -22}, 252), 1e-15);
}

TEST_CASE("savitzky_golay: exact on polynomials of its order, uneven times, ends and all",
          "[signal]") {
  for (std::size_t order = 0; order <= 8; ++order)
    for (const double start : {0.0, 1e4}) {
      Series t = uneven_times(40), y, dy;
      for (double& time : t) time += start;
      for (const double time : t) {
        const double u = time - start - 1;
        double f = 0, d = 0;
        for (std::size_t k = order + 1; k-- > 0;)
          d = d * u + f, f = f * u + (k % 2 ? -1 : 1) / (1 + static_cast<double>(k));
        y.push_back(f), dy.push_back(d);
      }
      INFO("order " << order << " from " << start);
      const double rounding =
          start > 0 ? 1e-9 : 1e-13;  // the times themselves are rounded to 1e-12 s there
      check_close(filtered(t, y, 11, order, value), y, rounding);
      if (order > 0) check_close(filtered(t, y, 11, order, slope), dy, 100 * rounding);
    }
}

TEST_CASE("savitzky_golay: least squares, as elimination in long double has it", "[signal]") {
  const Series t = uneven_times(30), y = noise(30, 4);
  for (const std::size_t order : {1u, 2u, 3u, 5u}) {
    Series values, slopes;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const std::size_t begin = std::min(i - std::min<std::size_t>(i, 4), t.size() - 9);
      values.push_back(by_elimination(t, y, i, begin, begin + 9, order, false));
      slopes.push_back(by_elimination(t, y, i, begin, begin + 9, order, true));
    }
    check_close(filtered(t, y, 9, order, value), values, 1e-11);
    check_close(filtered(t, y, 9, order, slope), slopes, 1e-9);
  }
}

TEST_CASE("savitzky_golay: no order that is taken loses digits", "[signal]") {
  for (std::size_t order = 0; order <= most_order; ++order)
    for (const std::size_t width :
         {order / 2 * 2 + 1, order / 2 * 2 + 3, std::size_t{31}, std::size_t{201}})
      for (const bool even : {true, false}) {
        if (width <= order) continue;
        INFO("order " << order << " width " << width << (even ? " even" : " uneven"));
        const Series t = even ? even_times(width) : uneven_times(width), y = noise(width, 7);
        const auto values = filtered(t, y, width, order, value);
        const auto slopes = width > 1 ? filtered(t, y, width, order, slope) : Series{0};
        for (const std::size_t at : {std::size_t{0}, width / 3, width / 2, width - 1}) {
          const Projection exact =
              width > 1 ? projection(t, y, at, order) : Projection{y[0], 0, 1, 1};
          CHECK(std::abs(static_cast<double>(values[at] - exact.value)) <
                2e-13 * static_cast<double>(exact.value_size));
          CHECK(std::abs(static_cast<double>(slopes[at] - exact.slope)) <=
                2e-13 * static_cast<double>(exact.slope_size));
        }
      }
  for (const std::size_t order : {11u, 50u, 74u})
    CHECK_THROWS_AS(savitzky_golay({order + 1 + order % 2, 0}, order, value), Error);
  CHECK_THROWS_AS(savitzky_golay({0, 100}, 11, slope), Error);
}

TEST_CASE(
    "savitzky_golay: a slope of order 2 is of second order, of order 4 of fourth, at the ends too",
    "[signal]") {
  for (const std::size_t order : {2u, 4u}) {
    double last = 0;
    for (const std::size_t n : {65u, 129u, 257u}) {
      const double h = 2.0 / static_cast<double>(n - 1);
      Series t = even_times(n, h), y;
      for (std::size_t i = 0; i < n; ++i) {
        t[i] += i % 2 ? 0.4 * h : 0;
        y.push_back(std::sin(2 * t[i]));
      }
      const auto d = filtered(t, y, 7, order, slope);
      double worst = 0;
      for (std::size_t i = 0; i < n; ++i)
        worst = std::max(worst, std::abs(d[i] - 2 * std::cos(2 * t[i])));
      if (last > 0) {
        INFO("order " << order << " n " << n << " ratio " << last / worst);
        CHECK(std::abs(std::log2(last / worst) - static_cast<double>(order)) < 0.3);
      }
      last = worst;
    }
  }
}

TEST_CASE("savitzky_golay: time reversed, values are the same and slopes change their sign",
          "[signal]") {
  const Series t = uneven_times(50), y = noise(50, 9);
  for (const Width width : {Width{9, 0}, Width{0, 0.5}}) {
    for (const auto what : {value, slope}) {
      const auto ahead = through(*savitzky_golay(width, 2, what), t, y);
      const auto back = through(*savitzky_golay(width, 2, what), backwards(t, -1), backwards(y));
      check_close(backwards(back, what == slope ? -1 : 1), ahead, 1e-11);
    }
  }
}

TEST_CASE("savitzky_golay: windows of seconds are those of samples on even times", "[signal]") {
  const Series t = even_times(100), y = noise(100, 1);
  check_close(through(*savitzky_golay({0, 0.4}, 2, value), t, y), filtered(t, y, 11, 2, value),
              1e-12);
}

TEST_CASE("savitzky_golay: few samples", "[signal]") {
  CHECK(filtered({}, {}, 5, 2, value).empty());
  CHECK(filtered({1}, {7}, 5, 2, value) == Series{7});
  CHECK_THROWS_AS(filtered({1}, {7}, 5, 2, slope), Error);
  check_close(filtered({1, 3}, {7, 8}, 5, 2, slope), {0.5, 0.5}, 1e-15);
  check_close(filtered({0, 1, 3}, {0, 1, 9}, 5, 2, slope), {0, 2, 6}, 1e-14);
  check_close(filtered({0, 1, 3}, {5, -1, 9}, 5, 2, value), {5, -1, 9},
              1e-14);  // one less than there are: through all
  CHECK_THROWS_AS(savitzky_golay({10, 0}, 2, value), Error);
  CHECK_THROWS_AS(savitzky_golay({5, 0}, 5, value), Error);
}

TEST_CASE("savitzky_golay: a number is known half a window later", "[signal]") {
  const auto filter = savitzky_golay({5, 0}, 2, value);
  for (int i = 0; i < 4; ++i) CHECK(filter->push(i, 1).empty());
  CHECK(filter->push(4, 1).size() == 3);
  for (int i = 5; i < 50; ++i) CHECK(filter->push(i, 1).size() == 1);
  CHECK(filter->finish().size() == 2);
}
