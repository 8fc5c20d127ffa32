#include "fit/beginning.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

#include <algorithm>
#include <utility>

#include "base/gsl.h"
#include "fit/dot.h"
#include "fit/errors.h"
#include "fit/fitted.h"

namespace rolling {
namespace {

/// The change of a fit when the first records of one run are removed, to first order: the residuals
/// f = model - data change by Q c, and the sum of squares falls by `reduction`.
struct Without {
  double reduction;
  std::vector<double> c;
};

/// f_S are the first k residuals, Q_S their rows of the orthonormal Q. A = I - Q_S^T Q_S is the
/// normal matrix of the other records. Then c = A^-1 Q_S^T f_S, and the reduction is |f_S|^2 +
/// f_S^T Q_S c.
Without without_first(std::size_t k, std::size_t q, const double* Q, const double* f) {
  std::vector<double> A(q * q, 0), g(q, 0);
  double squares = 0;
  for (std::size_t i = 0; i < q; ++i) A[i * q + i] = 1;
  for (std::size_t s = 0; s < k; ++s) {
    const double* const row = Q + s * q;
    squares += f[s] * f[s];
    for (std::size_t i = 0; i < q; ++i) {
      g[i] += row[i] * f[s];
      for (std::size_t j = 0; j < q; ++j) A[i * q + j] -= row[i] * row[j];
    }
  }
  Without result{squares, g};
  gsl_matrix_view normal = gsl_matrix_view_array(A.data(), q, q);
  gsl_vector_view c = gsl_vector_view_array(result.c.data(), q);
  // A is not positive definite if the removed records alone determine a parameter.
  if (gsl_linalg_cholesky_decomp1(&normal.matrix) != GSL_SUCCESS ||
      gsl_linalg_cholesky_svx(&normal.matrix, &c.vector) != GSL_SUCCESS)
    return {0, std::vector<double>(q, 0)};
  result.reduction += dot(g.data(), result.c.data(), q);
  return result;
}

}  // namespace

std::optional<Beginning> disturbed_beginning(Route route, const std::vector<FitRun>& runs,
                                             const FitOptions& options) {
  constexpr double decisive = 0.001, white = 0.005;
  for (const FitRun& run : runs)
    if (!run.filters.empty()) return {};
  silence_gsl();
  const Fitted fit = fit_route(route, runs, options);
  const std::size_t n = fit.minimum.f.size(), p = fit.minimum.theta.size(),
                    q = fit.system.columns();
  if (!fit.rolls || fit.noise->known() || n < p + 20 || !(fit.minimum.rss > 0)) return {};
  const auto Q = orthonormal(fit.system, fit.minimum);
  const auto rows = usable(route, runs);
  std::optional<Beginning> found;
  std::vector<double> rest;
  double tests = 0;
  for (std::size_t r = 0, first = 0; r < runs.size(); first += fit.system.runs[r++]) {
    const std::size_t records = std::min(fit.system.runs[r], rows[r].size());
    for (std::size_t k = 3, next = 5; 4 * k <= records; k = std::exchange(next, k + next)) {
      ++tests;
      const Without without = without_first(k, q, &Q[first * q], &fit.minimum.f[first]);
      const double gone = static_cast<double>(k), left = static_cast<double>(n - p - k),
                   others = fit.minimum.rss - without.reduction,
                   chance = gsl_cdf_fdist_Q(without.reduction / gone / (others / left), gone, left);
      if (found && chance >= found->significance) continue;
      const auto& t = runs[r].t;
      found = Beginning{r, k, t[rows[r][k]] - t[rows[r][0]], chance};
      rest.assign(fit.minimum.f.begin() + static_cast<std::ptrdiff_t>(first + k),
                  fit.minimum.f.begin() + static_cast<std::ptrdiff_t>(first + fit.system.runs[r]));
      for (std::size_t i = 0; i < rest.size(); ++i)
        rest[i] += dot(&Q[(first + k + i) * q], without.c.data(), q);
    }
  }
  if (!found) return {};
  found->significance = std::min(1.0, found->significance * tests);
  const std::size_t size[] = {rest.size()};
  if (found->significance > decisive || ljung_box(rest, q, size) <= white) return {};
  return found;
}

}  // namespace rolling
