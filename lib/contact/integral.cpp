#include "contact/integral.h"

#include <cmath>

namespace rolling {

double Integral::push(double t, double y) {
  if (begun_) {
    const double part = 0.5 * (t - t_) * (y + y_), sum = sum_ + part;
    error_ += std::abs(sum_) >= std::abs(part) ? (sum_ - sum) + part : (part - sum) + sum_;
    sum_ = sum;
  }
  begun_ = true;
  t_ = t, y_ = y;
  return sum_ + error_;
}

}  // namespace rolling
