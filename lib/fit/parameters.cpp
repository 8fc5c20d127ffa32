#include "fit/parameters.h"

namespace rolling {

std::vector<double> Parameters::theta(PowerLaw law, const std::vector<double>& v0,
                                      const std::vector<double>& x0) const {
  std::vector<double> all;
  for (std::size_t r = 0; r < runs_; ++r) {
    if (!v0_) all.push_back(v0[r] / v_ref_);
    if (free_x0()) all.push_back(x0[r] / x_ref_);
  }
  if (!a_) all.push_back(std::log(law.a) + law.b * log_v_ref_);
  if (!b_) all.push_back(law.b);
  if (slope_) all.push_back(0);
  return all;
}

}  // namespace rolling
