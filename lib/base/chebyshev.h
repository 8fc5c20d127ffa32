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
    const auto cosine = [](std::size_t halves) {
      return std::cos(std::numbers::pi * static_cast<double>(halves % (4 * terms)) / (2 * terms));
    };
    for (std::size_t k = 0; k < terms; ++k) {
      const Values y = f(from + (to - from) * (1 + cosine(2 * k + 1)) / 2);
      for (std::size_t j = 0; j < terms; ++j) {
        const double weight = (j == 0 ? 1 : 2) * cosine(j * (2 * k + 1)) / terms;
        for (std::size_t i = 0; i < N; ++i) terms_[j][i] += weight * y[i];
      }
    }
  }

  bool contains(double t) const { return t >= from_ && t <= to_; }
  Values operator()(double t) const {
    const double x = 2 * (t - from_) / (to_ - from_) - 1;
    double T = 1, next = x;  // the polynomials T_j and T_j+1
    Pairs sum = terms_[0];
    for (std::size_t j = 1; j < terms; ++j) {
      T = std::exchange(next, 2 * x * next - T);
      add(sum, T, terms_[j], std::make_index_sequence<std::tuple_size_v<Pairs>>());
    }
    Values y;
    std::copy_n(sum.begin(), N, y.begin());
    return y;
  }
  /// True if the last two terms of each value are at most `tolerance` times its largest term; of an
  /// even or odd function, every second term is 0.
  bool converges(double tolerance) const {
    for (std::size_t i = 0; i < N; ++i) {
      double largest = 0;
      for (const Pairs& term : terms_) largest = std::max(largest, std::abs(term[i]));
      for (const std::size_t last : {terms - 2, terms - 1})
        if (!(std::abs(terms_[last][i]) <= tolerance * largest)) return false;
    }
    return true;
  }

 private:
  using Pairs = std::array<double, N + N % 2>;  // two values fill one vector register

  /// A fold, since -O2 does not unroll a loop: the sums then stay in registers.
  template <std::size_t... i>
  static void add(Pairs& sum, double T, const Pairs& term, std::index_sequence<i...>) {
    ((sum[i] += T * term[i]), ...);
  }

  double from_ = 0, to_ = -1;
  std::array<Pairs, terms> terms_{};
};

/// A function of time, with an array of values, at times that are dense: a Chebyshev series takes
/// the place of the function wherever it holds for 80 times or more to within rounding. At other
/// times the function itself is called.
template <typename Function>
class ChebyshevPanels {
 public:
  using Values = std::invoke_result_t<Function, double>;

  /// `times` must not decrease, and must exist as long as this object. f is smooth before `end`.
  ChebyshevPanels(std::span<const double> times, double end, Function f)
      : times_(times), end_(end), f_(std::move(f)) {}

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
      if (!(last > t && last < end_)) continue;
      panel_ = {t, last, f_};
      if (panel_.converges(2e-15)) return true;
    }
    size_ = least, direct_ = least, panel_ = {};
    return false;
  }

  std::span<const double> times_;
  double end_;
  Function f_;
  ChebyshevSeries<std::tuple_size_v<Values>, terms> panel_;
  std::size_t size_ = least;   // number of times in the panel
  std::ptrdiff_t direct_ = 0;  // number of calls before the next panel is tried
};

}  // namespace rolling
