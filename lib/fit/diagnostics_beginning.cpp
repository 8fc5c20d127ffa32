// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/diagnostics.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/gsl.h"
#include "base/matrix.h"
#include "fit/errors.h"
#include "fit/fitted.h"
#include "fit/left_out.h"
#include "fit/levels.h"
#include "fit/roll_fit.h"
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

  /// `fit` is that of this run by itself.
  void add(const Fitted& fit, std::size_t run) {
    const auto& f = fit.minimum.f;
    const auto& t = fit.model->runs().front().t;
    const Matrix Q = orthonormal(fit);
    const std::size_t q = Q.size(), n = f.size();
    LeftOut others(f, {Q.begin(), Q.end()});
    const auto residuals = [&](std::size_t from, std::size_t end) {
      std::vector<double> some;
      for (std::size_t i = from; i < end; ++i) some.push_back(others.residual(i));
      return some;
    };
    std::size_t out = 0;
    for (std::size_t k = 3, next = 5; 4 * k <= n; k = std::exchange(next, k + next)) {
      ++tests;
      for (; out < k; ++out) {
        if (!(others.left(out) > 1e-6)) return;  // they alone determine a parameter
        others.leave_out(out);
      }
      const double gone = static_cast<double>(k), squares = others.squares(),
                   left = static_cast<double>(n - q - k);
      if (!(squares > 0)) continue;
      const double noise = std::max(squares / left, local_variance(residuals(0, k + 5))),
                   chance = gsl_cdf_fdist_Q((fit.minimum.rss - squares) / gone / noise, gone, left);
      if (chance < found.p) found = {run, k, t[k] - t[0], chance}, rest = residuals(k, n);
    }
  }
};

}  // namespace

std::optional<Beginning> disturbed_beginning(Route route, const std::vector<FitRun>& runs,
                                             const FitOptions& options) {
  if (options.robust) return {};
  for (const FitRun& run : runs)
    if (!run.filters.empty()) return {};
  silence_gsl();
  const Fitted joint = fit_route(route, runs, options);
  if (!joint.is_roll() || joint.noise->known()) return {};
  const std::size_t parameters = joint.parameters().of_one_run().count();
  BeginningSearch search;
  for (std::size_t r = 0; r < runs.size(); ++r) try {
      if (joint.system.runs[r] >= 20 + parameters) search.add(fit_of_run(joint, r, options), r);
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
