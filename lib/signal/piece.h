// SPDX-License-Identifier: GPL-3.0-or-later
// A smooth piece of a motion.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>

#include "signal/partition.h"

namespace rolling {

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
  struct Value {
    double value, error;
    bool is_known() const { return std::abs(value) > 3 * error; }
  };
  Value y(double t) const { return derivative(0, t); }
  Value v(double t) const { return derivative(speed_, t); }
  Value a(double t) const { return derivative(speed_ + 1, t); }
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
