// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/matrix.h"
#include "base/error.h"
#include "fit/routes.h"
#include "fit/fitted.h"
#include "fit/uncertainty.h"
#include "statistics/residuals.h"

namespace rolling {
namespace {

/// The number of independent rows, from the law that leaves the smallest autocorrelation.
double independent_rows(const std::vector<Fitted>& all) {
  const double n = static_cast<double>(all.front().minimum.f.size());
  double r = 1;
  for (const Fitted& law : all)
    if (const Minimum& m = law.minimum; m.rss > 0 && was_found(law))
      r = std::min(r, lagged(m.f, law.model.rows(), 1) / m.rss);
  return r > 0 && r < 1 ? n * (1 - r) / (1 + r) : n;
}

}  // namespace

LawComparison compare_laws(Route route, const std::vector<Run>& runs, FitOptions options) {
  if (options.robust) fail("laws are compared by squares only");
  // The mean of ln D is not the logarithm of the mean of D if D is noisy; other laws would fit the
  // difference.
  if (route == Route::loglog) route = Route::shift;
  const LawForm* const asked = std::exchange(options.law, &laws().front());
  FitOptions::Fixed fixed = {};
  if (asked != options.law) std::swap(fixed, options.fixed);
  std::vector<Fitted> all{of_means(fit_route(route, runs, options), options)};
  for (const LawForm& law : laws())
    if (&law != options.law)
      all.push_back(fit_beside(all.front(), law, &law == asked ? fixed : FitOptions::Fixed{}));
  const double n = static_cast<double>(all.front().minimum.f.size());
  const double independent = independent_rows(all);
  const double least =
      std::max(variance_of_rounding(all.front()), std::numeric_limits<double>::min());
  LawComparison result;
  for (const Fitted& found : all) {
    LawFit& of_law = result.fits.emplace_back(LawFit{.law = &found.parameters().form()});
    if (!was_found(found)) continue;
    const Minimum& m = found.minimum;
    const double k =
        static_cast<double>(m.theta.size()) + 1;  // the variance of the noise is a parameter, too
    if (independent > k + 1)
      of_law.aicc = independent * std::log(std::max(m.rss / n, least)) + 2 * k +
                    2 * k * (k + 1) / (independent - k - 1);
    const Matrix covariance = uncertainty_of(found).covariance;
    for (std::size_t j = 0; j < found.coefficients.size(); ++j)
      of_law.coefficients.push_back({found.coefficients[j].value, std::sqrt(covariance[j][j])});
    of_law.correlations = correlations_of(covariance, found.coefficients.size());
  }
  double of_asked = INFINITY;
  double of_other = INFINITY;
  for (const LawFit& fit : result.fits)
    if (fit.law == asked) of_asked = fit.aicc;
    else if (fit.aicc < of_other && !(fit.law->is_power && asked->is_power)) {
      result.other = fit.law;
      of_other = fit.aicc;
    }
  if (std::isfinite(of_asked) && result.other) result.against = of_asked - of_other;
  return result;
}

}  // namespace rolling
