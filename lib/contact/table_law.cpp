#include "contact/table_law.h"

#include <gsl/gsl_interp.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/gsl.h"

namespace rolling {

struct TableLaw::Curve {
  std::unique_ptr<gsl_interp, void (*)(gsl_interp*)> gsl;

  Curve(const std::vector<double>& v, const std::vector<double>& D)
      : gsl(own(gsl_interp_alloc(v.size() > 2 ? gsl_interp_steffen : gsl_interp_linear, v.size()),
                gsl_interp_free)) {
    silence_gsl();
    gsl_interp_init(gsl.get(), v.data(), D.data(), v.size());
  }
};

TableLaw::TableLaw(std::vector<double> v, std::vector<double> D) {
  if (v.empty() || v.size() != D.size())
    fail("a table of a law needs a point at least, and a D to each v");
  std::vector<std::size_t> order(v.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return v[i] < v[j]; });
  for (const std::size_t i : order) {
    if (!(v[i] >= 0 && std::isfinite(v[i])))
      fail("v = {} in the table of a law must be a number that is not negative", v[i]);
    if (!(D[i] > 0 && std::isfinite(D[i])))
      fail("D = {} at v = {} in the table of a law must be a positive number", D[i], v[i]);
    if (!v_.empty() && v[i] == v_.back()) fail("v = {} stands twice in the table of a law", v[i]);
    v_.push_back(v[i]);
    D_.push_back(D[i]);
  }
  if (v_.size() > 1) curve_ = std::make_shared<Curve>(v_, D_);
}

double TableLaw::operator()(double v) const {
  if (v <= v_.front() || !curve_) return D_.front();
  if (v > highest()) return D_.back() + slope(v) * (v - highest());
  const std::size_t i = gsl_interp_bsearch(v_.data(), v, 0, v_.size() - 1);
  gsl_interp_accel place{i, 0, 0};
  const auto [least, most] = std::minmax(D_[i], D_[i + 1]);
  // Rounding may lead beyond the two points.
  return std::clamp(gsl_interp_eval(curve_->gsl.get(), v_.data(), D_.data(), v, &place), least,
                    most);
}

double TableLaw::slope(double v) const {
  if (v < v_.front() || !curve_) return 0;
  return gsl_interp_eval_deriv(curve_->gsl.get(), v_.data(), D_.data(), std::min(v, highest()),
                               nullptr);
}

double TableLaw::largest_shift(double v) const {
  double largest = std::max(D_.front(), (*this)(v));
  for (std::size_t i = 0; i < v_.size() && v_[i] <= v; ++i) largest = std::max(largest, D_[i]);
  return largest;
}

}  // namespace rolling
