// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_squares/minimise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/matrix.h"
#include "least_squares/triangles.h"

namespace rolling {
namespace {

constexpr double undetermined = 1e-10;  // sine between a column of J and those before it
constexpr double round_off = 1e-15;     // relative size of a step that is rounding alone
constexpr double unseen = 1e-11;        // negligible step / (standard deviation * residuals)

/// The residuals at one theta and the Gauss-Newton step from there. The step comes from the QR
/// decomposition of J, because the condition number of the normal equations is the square of that
/// of J.
struct Iterate {
  explicit Iterate(const System& system) : R(system.runs.size(), system.own, system.shared) {
    f.reserve(system.residuals());
  }

  std::vector<double> theta, f;
  Triangles R;
  double rss = 0;
  std::vector<double> step, lengths;  // lengths: norms of the columns of J
  double size = 0;                    // largest relative change of a parameter in that step
  double reduction = 0;               // of the sum of squares, predicted by the linear model
  double angle = 1;                   // smallest sine between a column of J and those before it

  /// True if the next step is below rounding, relative to theta or to the standard deviations:
  /// the rounding errors of sums over the residuals grow with their number n.
  bool negligible() const {
    const double n = static_cast<double>(f.size());
    return size < round_off || reduction < unseen * unseen * n * rss;
  }
};

/// Evaluates the system at theta; false if theta is not allowed or the residuals are not finite.
bool evaluate_at(const System& system, Iterate& at, std::vector<double> theta) {
  at.theta = std::move(theta);
  at.f.clear();
  at.R = Triangles(system.runs.size(), system.own, system.shared);
  at.rss = 0;
  try {
    system.evaluate(at.theta, [&](std::size_t run, std::span<double> f, std::span<double> J) {
      at.f.insert(at.f.end(), f.begin(), f.end());
      at.rss += dot(f, f);
      at.R.add(run, f, J);
    });
  } catch (const Error&) {
    return false;
  }
  at.R.join();
  at.lengths = at.R.lengths();
  at.step = at.R.solve();
  at.reduction = at.R.reduction();
  at.angle = at.R.smallest_sine();
  at.size = 0;
  for (std::size_t j = 0; j < at.theta.size(); ++j)
    at.size = std::max(at.size, std::abs(at.step[j]) / std::max(1.0, std::abs(at.theta[j])));
  return std::isfinite(at.rss) && std::isfinite(dot(at.lengths, at.lengths));
}

std::vector<double> moved(std::vector<double> theta, const std::vector<double>& step) {
  std::transform(theta.begin(), theta.end(), step.begin(), theta.begin(), std::plus());
  return theta;
}

/// Levenberg-Marquardt steps, scaled after More (1978, Lecture Notes in Mathematics 630, 105) and
/// damped after Nielsen (1999, IMM-REP-1999-05), until they make no further progress. The caller
/// tests whether the result is a minimum.
Iterate descend(const System& system, Iterate at) {
  Iterate next(system);
  double mu = 1e-3, growth = 2;
  std::vector<double> D = at.lengths;
  for (double& d : D)
    if (d == 0) d = 1;
  for (int accepted = 0, refused = 0; accepted < 300 && refused <= 15;) {
    const Triangles damped = at.R.damped(D, mu);
    const auto step = damped.solve();
    double scaled = 0;
    for (std::size_t j = 0; j < D.size(); ++j) scaled += D[j] * step[j] * D[j] * step[j];
    const bool allowed = evaluate_at(system, next, moved(at.theta, step));
    if (!allowed || !(next.rss < at.rss)) {
      mu *= growth;
      growth *= 2;
      ++refused;
      continue;
    }
    const double gain = (at.rss - next.rss) / (damped.reduction() + mu * scaled);
    mu *= std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3));
    growth = 2;
    refused = 0;
    ++accepted;
    std::swap(at, next);
    for (std::size_t j = 0; j < D.size(); ++j) D[j] = std::max(D[j], at.lengths[j]);
    if (at.negligible()) break;
  }
  return at;
}

Minimum minimum_at(Iterate at) {
  return {std::move(at.theta), std::move(at.f), at.R.without_f(), at.rss};
}

/// Evaluates the system at a start; throws Error where it has no finite values.
Iterate at_start(const System& system, std::vector<double> theta) {
  Iterate start(system);
  if (!evaluate_at(system, start, std::move(theta)))
    fail("the fit cannot start: the law has no finite values at the starting point");
  return start;
}

/// Gauss-Newton steps down to the limit of rounding, as long as each step reduces the sum of
/// squares by at least the fraction `share` of the reduction that the linear model predicts.
Iterate polish(const System& system, Iterate best, double share) {
  Iterate next(system);
  for (int i = 0; i < 100 && best.angle > undetermined && !best.negligible(); ++i) {
    if (!evaluate_at(system, next, moved(best.theta, best.step)) ||
        !(next.rss <= best.rss * (1 + 1e-10) - share * best.reduction))
      break;
    if (best.size < 1e-9 && !(next.size < best.size)) break;  // round-off
    std::swap(best, next);
  }
  return best;
}

}  // namespace

Minimum minimise(const System& system, const std::vector<double>& start) {
  // If the residuals are linear or nearly linear between the start and the minimum, Gauss-Newton
  // steps are sufficient.
  Iterate best = polish(system, at_start(system, start), 0.9);
  // Convergence after Bates and Watts (1981, Technometrics 23, 179): the component of the residuals
  // in the tangent plane is small relative to the orthogonal component. An exact fit has no
  // orthogonal component; there the step itself must vanish.
  const std::size_t n = system.residuals(), p = system.parameters();
  const double freedom = n > p ? static_cast<double>(n - p) : 0;
  const auto offset = [&] {
    return std::sqrt(best.reduction / static_cast<double>(p) * freedom /
                     std::max(best.rss - best.reduction, 0.0));
  };
  const auto determined = [&] { return best.angle > undetermined; };
  const auto converged = [&] {
    return determined() && (best.size < 1e-7 || (freedom > 0 && offset() < 1e-3));
  };
  for (int round = 0; !converged(); ++round) {
    const double before = best.rss, size = best.size;
    Iterate next = polish(system, descend(system, best), 0);
    // Parameters as many as residuals may move on to where they are not determined.
    if (freedom == 0 && !(next.angle > undetermined)) break;
    best = std::move(next);
    if (converged()) break;
    const double gain = 1 - best.rss / before;
    // The minimum of a trajectory fit may lie on a kink, where the time of the stop coincides with
    // a row: no step reduces the sum of squares noticeably, but the gradient on either side is
    // not zero. The search ends there, unless the remaining step is more than a standard deviation
    // and changes a parameter by more than its own size.
    const bool near = freedom == 0 || offset() < 1 || best.size < 1;
    if (!determined() || (gain < std::max(1e-8, 1e-3 / freedom) && near)) break;
    // If all steps of a round reduce the sum of squares by less than one standard deviation would,
    // and yet the next step changes a parameter by more than its own size, and by more than in the
    // round before, the minimum lies at infinity.
    const bool lost = freedom > 0 && gain * freedom < 1 && best.size > std::max(1.0, size);
    if (lost || gain == 0 || round == 20) fail("the fit does not converge: {}", choose_the_roll);
  }
  if (!determined()) fail("the data do not determine the parameters: {}", choose_the_roll);
  // A negligible step is taken without evaluating the residuals again.
  std::vector<double> theta = best.negligible() ? moved(best.theta, best.step) : best.theta;
  Minimum minimum = minimum_at(std::move(best));
  minimum.theta = std::move(theta);
  return minimum;
}

Minimum attempt(const System& system, const std::vector<double>& start) {
  try {
    return minimise(system, start);
  } catch (const Error&) {
    return {start, {}, {}, std::numeric_limits<double>::infinity()};
  }
}

std::vector<double> stepped(const System& system, std::vector<double> theta, double longer) {
  Iterate at = at_start(system, std::move(theta));
  for (double& x : at.step) x *= longer;
  return moved(std::move(at.theta), at.step);
}

Minimum evaluated(const System& system, std::vector<double> theta) {
  return minimum_at(at_start(system, std::move(theta)));
}

void solve_transposed(const double* R, std::span<double> g) {
  const std::size_t q = g.size();
  for (std::size_t j = 0; j < q; ++j) {
    for (std::size_t k = 0; k < j; ++k) g[j] -= R[k * q + j] * g[k];
    g[j] /= R[j * q + j];
  }
}

double restricted_likelihood(const System& system, const std::vector<double>& theta) {
  const Iterate at = at_start(system, theta);
  const double freedom =
      static_cast<double>(system.residuals()) - static_cast<double>(system.parameters());
  return -0.5 * freedom * std::log(at.rss - at.reduction) - at.R.log_determinant();
}

}  // namespace rolling
