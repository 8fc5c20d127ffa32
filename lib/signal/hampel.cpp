#include "signal/hampel.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rounding.h"

namespace rolling {

namespace {

Width at_least_11(Width width) {
  constexpr std::size_t least = 11;
  width.least = least;
  if (width.seconds == 0) width.samples = std::max(width.samples, least);
  return width;
}

}  // namespace

Hampel::Hampel(Width width, double threshold)
    : windows_(at_least_11(width), Windows::Ends::cut), threshold_(threshold) {}

std::span<const Judged> Hampel::push(double t, double y) {
  if (std::exchange(begun_, true)) {
    large_ = std::max(large_, std::min(std::abs(y), std::abs(last_)));
    const double step = std::abs(y - last_), least = program_rounding * large_;
    if (step > least && (step < step_ || step_ <= least)) step_ = step;
  }
  last_ = y;
  windows_.push(t, y);
  return judge();
}

std::span<const Judged> Hampel::finish() {
  windows_.finish();
  return judge();
}

std::span<const Judged> Hampel::judge() {
  judged_.clear();
  while (windows_.next()) {
    windows_.slide(
        begin_, end_, [this](const Sample& s) { sorted_.insert(s.y); },
        [this](const Sample& s) { sorted_.erase(s.y); });
    const double centre = sorted_.median();
    const double scale =
        std::max({1.4826 * sorted_.median_distance(centre), step_, program_rounding * large_});
    const Sample& s = windows_.sample(windows_.at());
    judged_.push_back({s.t, s.y, std::abs(s.y - centre) <= threshold_ * scale});
  }
  return judged_;
}

}  // namespace rolling
