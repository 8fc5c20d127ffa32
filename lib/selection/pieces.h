// SPDX-License-Identifier: GPL-3.0-or-later
// A run as smooth pieces with sudden changes between them: the best partition, and a piece. The
// pieces are polynomials.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "selection/polynomial.h"
#include "signal/windows.h"

namespace rolling {

/// The coefficients that a piece of positions or of speeds may have.
constexpr std::size_t most_coefficients(bool positions) { return positions ? 4 : 3; }

/// The cost of a piece of n samples in all and the number of its coefficients: RSS over the
/// variance of the noise, and a penalty that grows with its free numbers, 1.5 ln n for each
/// coefficient, `most` at most, and for the joint.
inline std::pair<double, std::size_t> cost_of(const Polynomial<4>& piece, std::size_t most,
                                              std::size_t n) {
  const double weight = 1.5 * std::log(static_cast<double>(n));
  std::pair<double, std::size_t> least{INFINITY, 0};
  for (std::size_t k = 1; k <= std::min(most, piece.size()); ++k)
    least = std::min(least, {piece.rss(k) + weight * static_cast<double>(k + 1), k});
  return least;
}

/// The indices at which the pieces of the partition of least cost begin, and the number of samples.
/// There are no conditions at the joints, and a piece may be as short as one sample, so that a
/// reading that is off does not spoil the pieces beside it. Exact, by dynamic programming (Bellman
/// 1961, Commun. ACM 4, 284). O(n^2).
inline std::vector<std::size_t> best_partition(std::span<const Sample> samples, bool positions,
                                               double noise) {
  const std::size_t most = most_coefficients(positions);
  const std::size_t n = samples.size();
  std::vector<double> least(n + 1, 0);  // cost of the first samples
  std::vector<std::size_t> back(n + 1, 0);
  for (std::size_t end = 1; end <= n; ++end) {
    Polynomial<4> piece;
    double& cost = least[end] = INFINITY;
    for (std::size_t i = end; i-- > 0 && piece.rss(most) < cost;) {
      piece.add(samples[i].t - samples[end - 1].t, samples[i].y / noise);
      const double here = least[i] + cost_of(piece, most, n).first;
      if (here < cost) {
        cost = here;
        back[end] = i;
      }
    }
  }
  std::vector<std::size_t> joints{n};
  while (joints.back() > 0) joints.push_back(back[joints.back()]);
  std::ranges::reverse(joints);
  return joints;
}

/// The samples [begin, end) and their polynomial, with as many coefficients as they are worth.
class Piece {
 public:
  /// `noise` is the standard deviation of the samples.
  Piece(std::span<const Sample> samples, bool positions, std::size_t first, std::size_t last,
        double noise)
      : begin(first), end(last), from(samples[first].t), to(samples[last - 1].t),
        speed_(positions ? 1 : 0), noise_(noise) {
    for (const Sample& s : samples.subspan(begin, end - begin))
      fit_.add(s.t - middle(), s.y / noise_);
    order = cost_of(fit_, most_coefficients(positions), samples.size()).second;
  }
  Estimate y(double t) const { return derivative(0, t); }
  Estimate v(double t) const { return derivative(speed_, t); }
  Estimate a(double t) const { return derivative(speed_ + 1, t); }
  double rss() const { return fit_.rss(order); }
  double middle() const { return std::midpoint(from, to); }
  double duration() const { return to - from; }
  std::size_t size() const { return end - begin; }
  bool is_short() const { return size() < few; }

  static constexpr std::size_t few = 5;  ///< fewer have a place but hardly an acceleration

  std::size_t begin, end;
  double from, to;
  std::size_t order;  ///< number of coefficients

 private:
  Estimate derivative(std::size_t k, double t) const {
    const auto e = fit_.derivative(k, t - middle(), order);
    return {noise_ * e.value, noise_ * e.sigma};
  }

  Polynomial<4> fit_;
  std::size_t speed_;  // the derivative that is v
  double noise_;
};

}  // namespace rolling
