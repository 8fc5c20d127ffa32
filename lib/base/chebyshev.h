// SPDX-License-Identifier: GPL-3.0-or-later
// Chebyshev series of smooth functions of time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

namespace rolling {

/// The Chebyshev series of a function with N values, from its values at as many nodes as the series
/// has terms.
template <std::size_t N, std::size_t terms>
class ChebyshevSeries {
 public:
  using Values = std::array<double, N>;

  ChebyshevSeries() = default;
  /// The series for from <= t <= to. The nodes lie between these limits.
  template <typename Function>
  ChebyshevSeries(double from, double to, Function&& f) : from_(from), to_(to) {
    // cos(j (2k + 1) pi / (2 terms)); the integer is reduced by the period before it is rounded.
    static const auto cosines = [] {
      std::array<double, 4 * terms> all;
      for (std::size_t halves = 0; halves < all.size(); ++halves)
        all[halves] = std::cos(std::numbers::pi * static_cast<double>(halves) / (2 * terms));
      return all;
    }();
    const auto cosine = [](std::size_t halves) { return cosines[halves % (4 * terms)]; };
    std::array<Values, terms> y;
    for (std::size_t k = 0; k < terms; ++k)
      y[k] = f(from + (to - from) * (1 + cosine(2 * k + 1)) / 2);
    for (std::size_t j = 0; j < terms; ++j) {
      Values sum{};
      for (std::size_t k = 0; k < terms; ++k) add(sum, cosine(j * (2 * k + 1)), y[k]);
      for (double& x : sum) x *= (j == 0 ? 1. : 2.) / terms;
      terms_[j] = sum;
    }
  }

  /// The integral of the series from its beginning.
  ChebyshevSeries integral() const {
    ChebyshevSeries sum;
    sum.from_ = from_, sum.to_ = to_;
    for (std::size_t j = 1; j < terms; ++j) {
      const double unit = (to_ - from_) / 4 / static_cast<double>(j);
      const double first = j == 1 ? 2 : 1;
      for (std::size_t i = 0; i < N; ++i) {
        const double term =
            unit * (first * terms_[j - 1][i] - (j + 1 < terms ? terms_[j + 1][i] : 0));
        sum.terms_[j][i] = term;
        sum.terms_[0][i] += j % 2 ? term : -term;  // 0 at the beginning
      }
    }
    return sum;
  }
  /// The value number i at t, and its derivative.
  std::pair<double, double> value_and_slope(std::size_t i, double t) const {
    const double x = 2 * (t - from_) / (to_ - from_) - 1;
    double T = 1;
    double next_T = x;
    double U = 1;
    double next_U = 2 * x;
    double sum = terms_[0][i];
    double slope = 0;
    for (std::size_t j = 1; j < terms; ++j) {
      slope += static_cast<double>(j) * U * terms_[j][i];
      T = std::exchange(next_T, 2 * x * next_T - T);
      U = std::exchange(next_U, 2 * x * next_U - U);
      sum += T * terms_[j][i];
    }
    return {sum, slope * 2 / (to_ - from_)};
  }

  bool contains(double t) const { return t >= from_ && t <= to_; }
  Values operator()(double t) const {
    const double x = 2 * (t - from_) / (to_ - from_) - 1;
    double T = 1;
    double next = x;  // the polynomials T_j and T_j+1
    Values sum = terms_[0];
    for (std::size_t j = 1; j < terms; ++j) {
      T = std::exchange(next, 2 * x * next - T);
      add(sum, T, terms_[j]);
    }
    return sum;
  }
  /// The larger of the last two terms of value i (of an even or odd function, every second one is
  /// 0), and its largest term.
  double last(std::size_t i) const {
    return std::max(std::abs(terms_[terms - 2][i]), std::abs(terms_[terms - 1][i]));
  }
  double largest(std::size_t i) const {
    double most = 0;
    for (const Values& term : terms_) most = std::max(most, std::abs(term[i]));
    return most;
  }
  /// True if the last terms of the first value are at most `tolerance` times its largest term, and
  /// of the others `of_others`.
  bool converges(double tolerance, double of_others) const {
    for (std::size_t i = 0; i < N; ++i)
      if (!(last(i) <= (i == 0 ? tolerance : of_others) * largest(i))) return false;
    return true;
  }

 private:
  static void add(Values& sum, double T, const Values& term) {
    // -O2 alone does not unroll the loop: the sums then stay in registers.
#pragma GCC unroll 32
    for (std::size_t i = 0; i < N; ++i) sum[i] += T * term[i];
  }

  double from_ = 0, to_ = -1;
  std::array<Values, terms> terms_{};
};

/// A function of time, with an array of values, at times that are dense: a Chebyshev series takes
/// the place of the function wherever it holds for 80 times or more, the first value to within
/// rounding and the others, its derivatives, to within 1e-12. At other times the function itself is
/// called.
template <typename Function>
class ChebyshevPanels {
 public:
  using Values = std::invoke_result_t<Function, double>;

  /// `times` must not decrease, and must exist as long as this object. f is smooth between these
  /// two corners.
  ChebyshevPanels(std::span<const double> times, std::array<double, 2> corners, Function f)
      : times_(times), corners_(corners), f_(std::move(f)) {}

  /// The values at t, which is one of the times; cheapest in their order.
  Values operator()(double t) {
    if (panel_.contains(t) || (--direct_ < 0 && begin_panel(t))) return panel_(t);
    return f_(t);
  }

 private:
  static constexpr std::size_t terms = 10, least = 8 * terms;

  bool begin_panel(double t) {
    const auto rest = times_.subspan(
        static_cast<std::size_t>(std::ranges::lower_bound(times_, t) - times_.begin()));
    for (size_ = std::min(2 * size_, rest.size()); size_ >= least; size_ /= 2) {
      const double last = rest[size_ - 1];
      if (!(last > t) || std::ranges::any_of(corners_, [=](double corner) {
            return t <= corner && corner <= last;
          }))
        continue;
      panel_ = {t, last, f_};
      if (panel_.converges(2e-15, 1e-13)) return true;
    }
    size_ = least;
    direct_ = least;
    panel_ = {};
    return false;
  }

  std::span<const double> times_;
  std::array<double, 2> corners_;
  Function f_;
  ChebyshevSeries<std::tuple_size_v<Values>, terms> panel_;
  std::size_t size_ = least;   // number of times in the panel
  std::ptrdiff_t direct_ = 0;  // number of calls before the next panel is tried
};

}  // namespace rolling
