#include "contact/integral.h"

#include <algorithm>

#include "base/double_double.h"

namespace rolling {

double Integral::push(double t, double y) {
  if (samples_ > 0) {
    const double h = t - t_, k = last_step_, rise = y - y_;
    double part = 0.5 * h * (y + y_);
    if (samples_ > 1 && h <= 2 * k && y != 0 && y_ != 0)
      part -= h * h / (6 * (h + k) * k) * (rise * k - last_rise_ * h);
    const DoubleDouble sum = two_sum(sum_, part);
    sum_ = sum.hi, error_ += sum.lo;
    last_step_ = h, last_rise_ = rise;
  }
  samples_ = std::min(samples_ + 1, 2);
  t_ = t, y_ = y;
  return sum_ + error_;
}

}  // namespace rolling
