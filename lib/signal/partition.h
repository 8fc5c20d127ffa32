// SPDX-License-Identifier: GPL-3.0-or-later
// The best partition of a run into smooth pieces with sudden changes between them, and a piece.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "signal/polynomial.h"
#include "signal/windows.h"

namespace rolling {

/// The partition of n samples into polynomials of P coefficients, without conditions at the joints,
/// that has the least cost: RSS over the variance of the noise, and a penalty for each piece that
/// grows with its free numbers, 1.5 ln n for each coefficient and for the joint. A piece may be as
/// short as one sample, so that a reading that is off does not spoil the pieces beside it. Exact,
/// by dynamic programming (Bellman 1961, Commun. ACM 4, 284). O(n^2), with P^2 operations each.
template <std::size_t P>
class Partition {
 public:
  Partition(std::span<const Sample> samples, double sigma)
      : samples_(samples), back_(samples.size() + 1, 0) {
    const std::size_t n = samples.size();
    std::vector<double> least(n + 1, 0);  // cost of the first samples
    for (std::size_t end = 1; end <= n; ++end) {
      Polynomial<P> piece;
      double& cost = least[end] = std::numeric_limits<double>::infinity();
      for (std::size_t i = end; i-- > 0 && piece.rss() < cost;) {
        piece.add(samples[i].t - samples[end - 1].t, samples[i].y / sigma);
        const double here = least[i] + cost_of(piece, n).first;
        if (here < cost) cost = here, back_[end] = i;
      }
    }
  }
  /// The indices at which pieces begin, and n.
  std::vector<std::size_t> joints() const {
    std::vector<std::size_t> joints{samples_.size()};
    while (joints.back() > 0) joints.push_back(back_[joints.back()]);
    std::reverse(joints.begin(), joints.end());
    return joints;
  }
  /// The cost of a piece and the number of its coefficients.
  static std::pair<double, std::size_t> cost_of(const Polynomial<P>& piece, std::size_t n) {
    const double weight = 1.5 * std::log(static_cast<double>(n));
    std::pair<double, std::size_t> least{std::numeric_limits<double>::infinity(), 0};
    for (std::size_t k = 1; k <= std::min(P, piece.size()); ++k)
      least = std::min(least, {piece.rss(k) + weight * static_cast<double>(k + 1), k});
    return least;
  }

 private:
  std::span<const Sample> samples_;
  std::vector<std::size_t> back_;
};

/// The samples [begin, end) and their polynomial, with as many coefficients as they are worth.
template <std::size_t P>
class Piece {
 public:
  /// `noise` is the standard deviation of the samples.
  Piece(std::span<const Sample> samples, std::size_t first, std::size_t last, double noise,
        bool positions)
      : begin(first), end(last), from(samples[first].t), to(samples[last - 1].t), noise_(noise),
        speed_(positions ? 1 : 0) {
    for (const Sample& s : samples.subspan(begin, end - begin))
      fit_.add(s.t - middle(), s.y / noise_);
    order = Partition<P>::cost_of(fit_, samples.size()).second;
  }
  using Value = typename Polynomial<P>::Estimate;
  Value y(double t) const { return derivative(0, t); }
  Value v(double t) const { return derivative(speed_, t); }
  Value a(double t) const { return derivative(speed_ + 1, t); }
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
  std::size_t speed_;  // which derivative of the samples is the speed
};

}  // namespace rolling
