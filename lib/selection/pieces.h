// SPDX-License-Identifier: GPL-3.0-or-later
// A run as smooth pieces with sudden changes between them: the best partition, a piece, and where
// the joint between two pieces may lie. The pieces are polynomials.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/quantity.h"
#include "selection/polynomial.h"
#include "signal/windows.h"

namespace rolling {

/// The coefficients that a piece of positions or of speeds may have.
constexpr std::size_t most_coefficients(Quantity of) { return of == Quantity::x ? 4 : 3; }

/// The cost of a piece of n samples in all and the number of its coefficients: RSS over the
/// variance of the noise, and a penalty that grows with its free numbers, 1.5 ln n for each
/// coefficient and for the joint.
template <std::size_t P>
std::pair<double, std::size_t> cost_of(const Polynomial<P>& piece, std::size_t n) {
  const double weight = 1.5 * std::log(static_cast<double>(n));
  std::pair<double, std::size_t> least{INFINITY, 0};
  for (std::size_t k = 1; k <= std::min(P, piece.size()); ++k)
    least = std::min(least, {piece.rss(k) + weight * static_cast<double>(k + 1), k});
  return least;
}

/// The indices at which the pieces of the partition of least cost begin, and the number of samples.
/// There are no conditions at the joints, and a piece may be as short as one sample, so that a
/// reading that is off does not spoil the pieces beside it. Exact, by dynamic programming (Bellman
/// 1961, Commun. ACM 4, 284). O(n^2), with P^2 operations each.
template <std::size_t P>
std::vector<std::size_t> best_partition(std::span<const Sample> samples, double noise) {
  const std::size_t n = samples.size();
  std::vector<double> least(n + 1, 0);  // cost of the first samples
  std::vector<std::size_t> back(n + 1, 0), joints{n};
  for (std::size_t end = 1; end <= n; ++end) {
    Polynomial<P> piece;
    double& cost = least[end] = INFINITY;
    for (std::size_t i = end; i-- > 0 && piece.rss() < cost;) {
      piece.add(samples[i].t - samples[end - 1].t, samples[i].y / noise);
      const double here = least[i] + cost_of(piece, n).first;
      if (here < cost) cost = here, back[end] = i;
    }
  }
  while (joints.back() > 0) joints.push_back(back[joints.back()]);
  std::ranges::reverse(joints);
  return joints;
}

/// The samples [begin, end) and their polynomial, with as many coefficients as they are worth.
template <Quantity of>
class Piece {
  static constexpr std::size_t P = most_coefficients(of), speed = of == Quantity::x ? 1 : 0;

 public:
  /// `noise` is the standard deviation of the samples.
  Piece(std::span<const Sample> samples, std::size_t first, std::size_t last, double noise)
      : begin(first), end(last), from(samples[first].t), to(samples[last - 1].t), noise_(noise) {
    for (const Sample& s : samples.subspan(begin, end - begin))
      fit_.add(s.t - middle(), s.y / noise_);
    order = cost_of(fit_, samples.size()).second;
  }
  using Value = typename Polynomial<P>::Estimate;
  Value y(double t) const { return derivative(0, t); }
  Value v(double t) const { return derivative(speed, t); }
  Value a(double t) const { return derivative(speed + 1, t); }
  double rss() const { return fit_.rss(order); }
  double middle() const { return std::midpoint(from, to); }
  double duration() const { return to - from; }
  std::size_t size() const { return end - begin; }
  bool is_short() const { return size() < 5; }  // it has a place but hardly an acceleration

  std::size_t begin, end;
  double from, to;
  std::size_t order;  ///< number of coefficients

 private:
  Value derivative(std::size_t k, double t) const {
    const auto e = fit_.derivative(k, t - middle(), order);
    return {noise_ * e.value, noise_ * e.error};
  }

  Polynomial<P> fit_;
  double noise_;
};

/// The joints of samples of this noise, which are polynomials on either side. Each RSS is in units
/// of the variance of the noise.
template <Quantity of>
class Joints {
  static constexpr std::size_t P = most_coefficients(of);
  static constexpr bool positions = of == Quantity::x;

 public:
  Joints(std::span<const Sample> samples, double noise) : samples_(samples), noise_(noise) {}

  /// The RSS of the samples [begin, end) as two polynomials of these numbers of coefficients, of
  /// which the first has k samples, for each k.
  std::vector<double> costs(std::size_t begin, std::size_t order, std::size_t order_after,
                            std::size_t end) const {
    const auto rss = [](std::size_t n) { return [n](const auto& fit) { return fit.rss(n); }; };
    auto cost = sums<P>(begin, end - 1, rss(order));
    const auto after = sums<P>(end - 1, begin, rss(order_after));
    for (std::size_t k = 0; k < cost.size(); ++k) cost[k] += after[cost.size() - 1 - k];
    return cost;
  }
  /// From `joint`, at most `far` inwards (+1 or -1): the furthest joint within three standard
  /// errors of the best.
  static std::size_t inner(const std::vector<double>& cost, std::size_t joint, std::size_t far,
                           int inwards) {
    const auto at = [&](std::size_t k) { return inwards > 0 ? joint + k : joint - k; };
    double least = cost[joint];
    for (std::size_t k = 1; k <= far; ++k) least = std::min(least, cost[at(k)]);
    while (far > 0 && cost[at(far)] > least + three_sigma) --far;
    return at(far);
  }
  /// The number of samples, of those from `from` to `to`, that agree with one another: the last
  /// half may be left out at twice the mean share of chi square.
  std::size_t agreeing(std::size_t from, std::size_t to) const {
    const double weight = 0.75 * std::log(static_cast<double>(samples_.size()));
    const auto cost = sums<P + 1>(from, to, [&](const auto& fit) {
      double least = fit.rss(1) + weight;
      for (std::size_t k = 2; k <= P + 1; ++k)
        least = std::min(least, fit.rss(k) + weight * static_cast<double>(k));
      return least;
    });
    const std::size_t n = cost.size() - 1;
    const double unit = n > P ? 2 * std::max(1.0, cost[n] / static_cast<double>(n - P)) : 2;
    std::size_t best = n;
    for (std::size_t k = n; k > n / 2; --k)
      if (cost[k] - cost[best] + unit * static_cast<double>(best - k) < 0) best = k;
    return best;
  }
  /// The end of a roll whose body comes to rest by itself, at s: its speed falls to 0 without a
  /// jump, so that its positions are y + sum c_k (s - t)^k, k > 1, before s and y from then on, but
  /// for the rounding that all readings of the rest share. The sum has three powers, and so has
  /// that of speeds, from k = 1 on: with fewer, a law whose speed falls like another power looks
  /// like a hand. Also the RSS of the best s, of the samples [begin, end); s is sought behind the
  /// middle of begin and `roughly`.
  std::pair<std::size_t, double> before_stop(std::size_t begin, std::size_t roughly,
                                             std::size_t end) const {
    const std::size_t least = begin + (roughly - begin) / 2;
    const auto rss = [&](std::size_t joint, double stop) {
      Polynomial<P + 1> fit;
      std::array<double, P + 1> row{};
      row[P] = 1;
      if (positions) fit.add(row, 0);
      for (std::size_t i = begin; i < end; ++i) {
        const double u = i < joint ? samples_[i].t - stop : 0;
        row = {1, positions ? u * u : u};
        for (std::size_t k = 2; k <= P; ++k) row[k] = row[k - 1] * u;
        if (positions) row[P] = i >= joint;
        fit.add(row, samples_[i].y / noise_);
      }
      return fit.rss();
    };
    std::vector<double> cost;
    for (std::size_t joint = least; joint < end; ++joint) {
      cost.push_back(INFINITY);
      for (const double part : {0.0, 0.25, 0.5, 0.75})
        cost.back() = std::min(
            cost.back(), rss(joint, std::lerp(samples_[joint - 1].t, samples_[joint].t, part)));
    }
    cost.push_back(sums<P>(begin, end - 1, [](const auto& fit) { return fit.rss(); }).back());
    const auto lowest = std::min_element(cost.begin(), cost.end());
    const auto best = static_cast<std::size_t>(lowest - cost.begin());
    return {least + inner(cost, best, best, -1), *lowest};
  }
  /// The same of a roll that a hand ends: it takes the speed v to 0 as v (1 + cos(pi s/T))/2,
  /// within a time T of no more than a quarter of the roll.
  std::pair<std::size_t, double> before_hand(std::size_t begin, std::size_t roughly,
                                             std::size_t end) const {
    std::pair<std::size_t, double> best{roughly, INFINITY};
    Polynomial<P + 1> roll;
    std::array<double, P + 1> row{}, slope{};
    row[P] = 1;
    roll.add(row, 0);
    for (std::size_t joint = begin; joint + 1 < roughly; ++joint) {
      const double past = samples_[joint].t - samples_[begin].t;
      row = {1};
      for (std::size_t k = 1; k < P; ++k) {
        slope[k] = static_cast<double>(k) * row[k - 1];
        row[k] = row[k - 1] * past;
      }
      roll.add(row, samples_[joint].y / noise_);
      if (3 * (joint - begin) < 2 * (roughly - begin)) continue;
      const double longest = std::min(samples_[end - 1].t - samples_[joint].t, past / 4);
      for (double T = samples_[joint + 1].t - samples_[joint].t; T < longest; T *= 1.25) {
        Polynomial<P + 1> fit = roll;
        for (std::size_t i = joint + 1; i < end && fit.rss() < best.second; ++i) {
          constexpr double pi = std::numbers::pi;
          const double s = std::min(1.0, (samples_[i].t - samples_[joint].t) / T),
                       share = (1 + std::cos(pi * s)) / 2,
                       way = T * (s + std::sin(pi * s) / pi) / 2;
          auto held = row;
          for (std::size_t k = 0; k < P; ++k)
            held[k] = positions ? row[k] + way * slope[k] : share * row[k];
          held[P] = positions && s == 1;
          fit.add(held, samples_[i].y / noise_);
        }
        if (fit.rss() < best.second) best = {joint, fit.rss()};
      }
    }
    return best;
  }

 private:
  static constexpr double three_sigma = 9;

  /// RSS of the samples from `from` to `to`, forwards or backwards, of the first k for each k.
  template <std::size_t Q>
  std::vector<double> sums(std::size_t from, std::size_t to, auto value) const {
    Polynomial<Q> fit;
    std::vector<double> sums{0};
    for (std::size_t i = from;; i += to > from ? 1 : std::size_t(-1)) {
      fit.add(samples_[i].t - samples_[from].t, samples_[i].y / noise_);
      sums.push_back(value(fit));
      if (i == to) return sums;
    }
  }

  std::span<const Sample> samples_;
  double noise_;
};

}  // namespace rolling
