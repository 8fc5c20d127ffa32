#include "signal/hampel.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace rolling {
namespace {

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return std::midpoint(*std::max_element(values.begin(), middle), *middle);
}

}  // namespace

std::span<const Judged> Hampel::push(double t, double y) {
  const double step = std::abs(y - last_);
  if (std::exchange(begun_, true) && step > 0) step_ = step_ > 0 ? std::min(step_, step) : step;
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
    work_.clear();
    for (std::size_t i = windows_.begin(); i < windows_.end(); ++i)
      work_.push_back(windows_.sample(i).y);
    const double centre = median(work_);
    for (double& y : work_) y = std::abs(y - centre);
    const double scale = std::max(1.4826 * median(work_), step_);
    const Sample& s = windows_.sample(windows_.at());
    judged_.push_back({s.t, s.y, std::abs(s.y - centre) <= threshold_ * scale});
  }
  return judged_;
}

}  // namespace rolling
