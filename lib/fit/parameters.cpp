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

std::vector<double> Parameters::theta_of_run(const std::vector<double>& theta,
                                             std::size_t run) const {
  const auto at = [&](std::size_t i) { return theta.begin() + static_cast<std::ptrdiff_t>(i); };
  std::vector<double> one(at(run * own()), at((run + 1) * own()));
  one.insert(one.end(), at(runs_ * own()), at(count() - slope_));
  return one;
}

}  // namespace rolling
