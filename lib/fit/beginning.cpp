// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/beginning.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/dot.h"
#include "base/error.h"
#include "base/gsl.h"
#include "fit/errors.h"
#include "fit/fitted.h"
#include "fit/levels.h"
#include "fit/roll_fit.h"
#include "fit/route.h"
#include "statistics/residuals.h"

namespace rolling {
namespace {

/// The change of a fit when the first rows of one run are removed, to first order: the residuals
/// f = model - data change by Q c, and the sum of squares falls by `reduction`.
struct Without {
  double reduction;
  std::vector<double> c;
};

/// f_S are the first k residuals, Q_S their rows of the orthonormal Q. A = I - Q_S^T Q_S is the
/// normal matrix of the other rows. Then c = A^-1 Q_S^T f_S, and the reduction is |f_S|^2 +
/// f_S^T Q_S c.
Without without(std::size_t k, const Matrix& Q, const std::vector<double>& f) {
  const std::size_t q = Q.size();
  std::vector<double> A(q * q), g(q);
  for (std::size_t i = 0; i < q; ++i) {
    for (std::size_t j = 0; j < q; ++j) A[i * q + j] = (i == j) - dot(Q[i].data(), Q[j].data(), k);
    g[i] = dot(Q[i].data(), f.data(), k);
  }
  Without result{dot(f.data(), f.data(), k), g};
  gsl_matrix_view normal = gsl_matrix_view_array(A.data(), q, q);
  gsl_vector_view c = gsl_vector_view_array(result.c.data(), q);
  // A is not positive definite if the removed rows alone determine a parameter.
  if (gsl_linalg_cholesky_decomp1(&normal.matrix) != GSL_SUCCESS ||
      gsl_linalg_cholesky_svx(&normal.matrix, &c.vector) != GSL_SUCCESS)
    return {0, std::vector<double>(q, 0)};
  result.reduction += dot(g, result.c);
  return result;
}

/// The variance of white noise from its second differences, which a smooth deviation hardly has.
double local_variance(std::span<const double> f) {
  double squares = 0;
  for (std::size_t i = 2; i < f.size(); ++i) squares += std::pow(f[i] - 2 * f[i - 1] + f[i - 2], 2);
  return squares / (6 * static_cast<double>(f.size() - 2));
}

struct Candidate {
  Beginning beginning;
  std::vector<double> rest;  // the residuals of the other rows of the run
  std::size_t parameters;    // of its fit
};

/// The beginnings of all runs that were tested, and that of the smallest p.
struct Search {
  double tests = 0;
  std::optional<Candidate> found;

  /// `fit` is that of this run by itself.
  void add(const Fitted& fit, std::size_t run) {
    const auto& f = fit.minimum.f;
    const auto& t = fit.rolls->runs().front().t;
    const Matrix Q = orthonormal(fit);
    const std::size_t q = Q.size();
    const auto changed = [&](const Without& by, std::size_t from, std::size_t end) {
      std::vector<double> rest(f.begin() + static_cast<std::ptrdiff_t>(from),
                               f.begin() + static_cast<std::ptrdiff_t>(end));
      for (std::size_t j = 0; j < q; ++j)
        for (std::size_t i = from; i < end; ++i) rest[i - from] += by.c[j] * Q[j][i];
      return rest;
    };
    for (std::size_t k = 3, next = 5; 4 * k <= f.size(); k = std::exchange(next, k + next)) {
      ++tests;
      const Without by = without(k, Q, f);
      const double gone = static_cast<double>(k), squares = fit.minimum.rss - by.reduction,
                   left = static_cast<double>(f.size() - q - k);
      if (!(squares > 0)) continue;
      const double noise = std::max(squares / left, local_variance(changed(by, 0, k + 5))),
                   chance = gsl_cdf_fdist_Q(by.reduction / gone / noise, gone, left);
      if (chance >= (found ? found->beginning.p : levels::beginning)) continue;
      // Where the removed rows alone determine a parameter, nothing but rounding may remain: the
      // squares are then more than those of a fit.
      std::vector<double> others = changed(by, k, f.size());
      if (!(dot(others, others) < 1.01 * squares)) continue;
      found = {{run, k, t[k] - t[0], chance}, std::move(others), q};
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
  if (!joint.rolls || joint.noise->known()) return {};
  const std::size_t fewest = 20 + joint.rolls->parameters().of_one_run().count();
  Search search;
  for (std::size_t r = 0; r < runs.size(); ++r) try {
      if (joint.system.runs[r] < fewest) continue;
      else if (runs.size() == 1 && !options.fit_slope) search.add(joint, r);
      else search.add(fit_of_run(joint, r, options), r);
    } catch (const Error&) {  // the run does not determine a law by itself
    }
  if (!search.found) return {};
  auto& [found, rest, parameters] = *search.found;
  found.p = std::min(1.0, found.p * search.tests);
  const std::size_t size[] = {rest.size()};
  if (found.p > levels::beginning ||
      ljung_box(rest, taken_by_few(parameters), size) <= levels::beginning_white)
    return {};
  return found;
}

}  // namespace rolling
