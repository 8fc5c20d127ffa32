#include "signal/derivative.h"

#include "base/error.h"

namespace rolling {

// Newton's form of the parabola through three samples: slopes s1, s2 over steps h1, h2, bend c = (s2 - s1) / (h1 + h2).
// Derivatives: s1 - c h1 at the first, s1 + c h1 = s2 - c h2 in the middle, s2 + c h2 at the last.
std::span<const double> CentralDerivative::push(double t, double y) {
  const double step = t - t_, slope = (y - y_) / step;
  ++count_;
  std::size_t known = 0;
  if (count_ >= 3) {
    bend_ = (slope - slope_) / (step_ + step);
    if (count_ == 3) known_[known++] = slope_ - bend_ * step_;
    known_[known++] = slope_ + bend_ * step_;
  }
  t_ = t, y_ = y, step_ = step, slope_ = slope;
  return {known_.data(), known};
}

std::span<const double> CentralDerivative::finish() {
  if (count_ == 0) return {};
  if (count_ == 1) fail("a run of one record has no derivative");
  known_[0] = known_[1] = slope_ + bend_ * step_;  // the bend is 0 in a run of two
  return {known_.data(), count_ == 2 ? std::size_t{2} : std::size_t{1}};
}

}  // namespace rolling
