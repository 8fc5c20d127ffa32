// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/refits.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/gsl.h"
#include "base/matrix.h"
#include "fit/fitted.h"
#include "statistics/levels.h"
#include "fit/routes.h"
#include "least_squares/minimise.h"
#include "statistics/residuals.h"

namespace rolling {
namespace {

/// The variance of white noise from its second differences, which a smooth deviation hardly has.
double local_variance(std::span<const double> f) {
  double squares = 0;
  for (std::size_t i = 2; i < f.size(); ++i) squares += std::pow(f[i] - 2 * f[i - 1] + f[i - 2], 2);
  return squares / (6 * static_cast<double>(f.size() - 2));
}

/// The beginnings of all runs that were tested, and that of the smallest p.
struct BeginningSearch {
  double tests = 0;
  Beginning found{.run = 0, .rows = 0, .time = 0, .p = levels::beginning};
  std::vector<double> rest = {};  // the residuals of the other rows of its run

  /// `fit` is that of this run by itself, taken as linear around its minimum.
  void add(const Fitted& fit, std::size_t run) {
    const auto& t = fit.model.runs().front().t;
    const System linear = linearised(fit.system(), fit.minimum.theta);
    const std::size_t n = linear.residuals();
    const std::size_t q = linear.columns();
    for (std::size_t k = 3, next = 5; 4 * k <= n; k = std::exchange(next, k + next)) {
      ++tests;
      std::vector<double> factors(n, 1);
      std::fill_n(factors.begin(), k, 0.0);
      const Minimum others = evaluated(weighted(linear, factors), std::vector<double>(q));
      if (!(others.R.smallest_sine() > 1e-6)) return;  // the first alone determine a parameter
      const std::vector<double> e = evaluated(linear, others.R.solve()).f;  // around their roll
      const std::span<const double> of_others = std::span(e).subspan(k);
      const double gone = static_cast<double>(k);
      const double squares = dot(of_others, of_others);
      const double left = static_cast<double>(n - q - k);
      if (!(squares > 0)) continue;
      const double noise = std::max(squares / left, local_variance(std::span(e).first(k + 5)));
      const double p = gsl_cdf_fdist_Q((fit.minimum.rss - squares) / gone / noise, gone, left);
      if (p < found.p) {
        found = {run, k, t[k] - t[0], p};
        rest.assign(of_others.begin(), of_others.end());
      }
    }
  }
};

}  // namespace

std::optional<Beginning> disturbed_beginning(Route route, const std::vector<Run>& runs,
                                             const FitOptions& options) {
  if (options.robust) return {};
  for (const Run& run : runs)
    if (!run.filters.empty()) return {};
  silence_gsl();
  const Fitted joint = fit_route(route, runs, options);
  if (!joint.is_roll() || joint.noise().known()) return {};
  const std::size_t parameters = joint.parameters().of_one_run().count();
  BeginningSearch search;
  for (std::size_t r = 0; r < runs.size(); ++r) try {
      if (joint.model.runs()[r].y.size() >= 20 + parameters)
        search.add(fit_of_run(joint, r, options), r);
    } catch (const Error&) {  // the run does not determine a law by itself
    }
  search.found.p *= search.tests;
  const std::size_t size[] = {search.rest.size()};
  if (search.rest.empty() || search.found.p > levels::beginning ||
      ljung_box(search.rest, taken_by_few(parameters), size) <= levels::beginning_white)
    return {};
  return search.found;
}

}  // namespace rolling
