// SPDX-License-Identifier: GPL-3.0-or-later
#include <gsl/gsl_cdf.h>

#include <cmath>
#include <numbers>

#include "base/matrix.h"
#include "base/median.h"
#include "fit/diagnostics.h"

namespace rolling {

double few_reversals(const Fitted& fit) {
  if (!fit.is_roll() || fit.noise->known()) return 1;
  double expected = 0;
  unsigned seen = 0;
  const auto residuals = by_run(fit.minimum.f, fit.system.runs);  // model - reading
  for (std::size_t r = 0; r < residuals.size(); ++r) {
    const std::vector<double>& y = fit.model->runs()[r].y;
    const auto f = residuals[r];
    std::vector<double> sizes;
    for (const double residual : f) sizes.push_back(std::abs(residual));
    const double sigma = deviation(sizes);
    for (std::size_t i = 1; i < f.size(); ++i) {
      const double step = y[i] - y[i - 1], motion = step + f[i] - f[i - 1];
      seen += step * motion <= 0;
      expected += gsl_cdf_ugaussian_P(-std::abs(motion) / (std::numbers::sqrt2 * sigma));
    }
  }
  return expected > 0 ? gsl_cdf_poisson_P(seen, expected) : 1;
}

}  // namespace rolling
