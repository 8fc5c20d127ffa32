// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_squares/minimise.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/matrix.h"

namespace rolling {

std::vector<double> moved(std::vector<double> theta, const std::vector<double>& step) {
  std::transform(theta.begin(), theta.end(), step.begin(), theta.begin(), std::plus());
  return theta;
}

double relative_size(const std::vector<double>& step, const std::vector<double>& theta) {
  double size = 0;
  for (std::size_t j = 0; j < step.size(); ++j)
    size = std::max(size, std::abs(step[j]) / std::max(1.0, std::abs(theta[j])));
  return size;
}

Minimum tried(const System& system, std::vector<double> theta) {
  Minimum at{std::move(theta), {}, {system.runs.size(), system.own, system.shared}, 0};
  at.f.reserve(system.residuals());
  try {
    system.evaluate(at.theta, [&](std::size_t run, std::span<double> f, std::span<double> J) {
      at.f.insert(at.f.end(), f.begin(), f.end());
      at.rss += dot(f, f);
      at.R.add(run, f, J);
    });
  } catch (const Error&) {
    return {std::move(at.theta)};
  }
  at.R.join();
  const std::vector<double> lengths = at.R.lengths();
  if (!std::isfinite(at.rss + dot(lengths, lengths))) return {std::move(at.theta)};
  return at;
}

namespace {

constexpr double undetermined = 1e-10;  // sine between a column of J and those before it
constexpr double round_off = 1e-15;     // relative size of a step that is rounding alone
constexpr double unseen = 1e-11;        // negligible step / (standard deviation * residuals)

/// That of the Gauss-Newton step.
double size_of_step(const Minimum& at) { return relative_size(at.R.solve(), at.theta); }

/// True if the next step is below rounding, relative to theta or to the standard deviations: the
/// rounding errors of sums over the residuals grow with their number n.
bool negligible(const System& system, const Minimum& at) {
  const double n = static_cast<double>(at.f.size());
  if (system.rough && at.R.reduction() < 1e-3 * at.rss / n) return true;
  return size_of_step(at) < round_off || at.R.reduction() < unseen * unseen * n * at.rss;
}

bool determined(const Minimum& at) { return at.R.smallest_sine() > undetermined; }

/// Levenberg-Marquardt steps, scaled after More (1978, Lecture Notes in Mathematics 630, 105) and
/// damped after Nielsen (1999, IMM-REP-1999-05), until they make no further progress. The caller
/// tests whether the result is a minimum.
Minimum descend(const System& system, Minimum at) {
  double mu = 1e-3;
  double growth = 2;
  std::vector<double> D = at.R.lengths();
  for (double& d : D)
    if (d == 0) d = 1;
  for (int accepted = 0, refused = 0; accepted < (system.rough ? 30 : 300) && refused <= 15;) {
    const Triangles damped = at.R.damped(D, mu);
    const auto step = damped.solve();
    double scaled = 0;
    for (std::size_t j = 0; j < D.size(); ++j) scaled += D[j] * step[j] * D[j] * step[j];
    Minimum next = tried(system, moved(at.theta, step));
    if (!(next.rss < at.rss)) {
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
    at = std::move(next);
    std::ranges::transform(D, at.R.lengths(), D.begin(),
                           [](double x, double y) { return std::max(x, y); });
    if (negligible(system, at)) break;
  }
  return at;
}

/// Gauss-Newton steps down to the limit of rounding, as long as each step reduces the sum of
/// squares by at least the fraction `share` of the reduction that the linear model predicts.
Minimum polish(const System& system, Minimum best, double share) {
  for (int i = 0; i < 100 && determined(best) && !negligible(system, best); ++i) {
    Minimum next = tried(system, moved(best.theta, best.R.solve()));
    if (!(next.rss <= best.rss * (1 + 1e-10) - share * best.R.reduction())) break;
    const double size = size_of_step(best);
    if (size < 1e-9 && !(size_of_step(next) < size)) break;  // round-off
    best = std::move(next);
  }
  return best;
}

}  // namespace

Minimum minimise(const System& system, const std::vector<double>& start) {
  // If the residuals are linear or nearly linear between the start and the minimum, Gauss-Newton
  // steps are sufficient.
  Minimum best = polish(system, evaluated(system, start), 0.9);
  // Convergence after Bates and Watts (1981, Technometrics 23, 179): the component of the residuals
  // in the tangent plane is small relative to the orthogonal component. An exact fit has no
  // orthogonal component; there the step itself must vanish.
  const std::size_t n = system.residuals();
  const std::size_t p = system.parameters();
  const double freedom = n > p ? static_cast<double>(n - p) : 0;
  const auto offset = [&] {
    const double reduction = best.R.reduction();
    return std::sqrt(reduction / static_cast<double>(p) * freedom /
                     std::max(best.rss - reduction, 0.0));
  };
  const auto converged = [&] {
    if (system.rough && determined(best) && negligible(system, best)) return true;
    return determined(best) && (size_of_step(best) < 1e-7 || (freedom > 0 && offset() < 1e-3));
  };
  for (int round = 0; !converged(); ++round) {
    const double before = best.rss;
    const double size_before = size_of_step(best);
    Minimum next = polish(system, descend(system, best), 0);
    // Parameters as many as residuals may move on to where they are not determined.
    if (freedom == 0 && !determined(next)) break;
    best = std::move(next);
    if (converged()) break;
    const double gain = 1 - best.rss / before;
    const double size = size_of_step(best);
    // The minimum of a trajectory fit may lie on a kink, where the time of the stop coincides with
    // a row: no step reduces the sum of squares noticeably, but the gradient on either side is
    // not zero. The search ends there, unless the remaining step is more than a standard deviation
    // and changes a parameter by more than its own size.
    const bool near = freedom == 0 || offset() < 1 || size < 1;
    if (!determined(best) || (gain < std::max(1e-8, 1e-3 / freedom) && near)) break;
    // If all steps of a round reduce the sum of squares by less than one standard deviation would,
    // and yet the next step changes a parameter by more than its own size, and by more than in the
    // round before, the minimum lies at infinity.
    const bool lost = freedom > 0 && gain * freedom < 1 && size > std::max(1.0, size_before);
    if (lost || gain == 0 || round == (system.rough ? 0 : 20))
      fail<NotOneRoll>("the fit does not converge");
  }
  if (!determined(best)) fail<NotOneRoll>("the data do not determine the parameters");
  // A negligible step is taken without evaluating the residuals again.
  if (negligible(system, best)) best.theta = moved(std::move(best.theta), best.R.solve());
  return best;
}

void improve(Minimum& best, const System& system, const std::vector<double>& start) try {
  if (Minimum found = minimise(system, start); found.rss < best.rss) best = std::move(found);
} catch (const Error&) {  // no minimum is found
}

Minimum evaluated(const System& system, std::vector<double> theta) {
  Minimum at = tried(system, std::move(theta));
  if (!std::isfinite(at.rss))
    fail("the fit cannot start: the law has no finite values at the starting point");
  return at;
}

System linearised(const System& system, const std::vector<double>& theta) {
  std::vector<std::pair<std::vector<double>, std::vector<double>>> runs;  // f and J
  system.evaluate(theta, [&](std::size_t, std::span<double> f, std::span<double> J) {
    runs.push_back({{f.begin(), f.end()}, {J.begin(), J.end()}});
  });
  System linear{system.runs, system.own, system.shared, {}};
  linear.evaluate = [layout = linear, runs = std::move(runs)](const std::vector<double>& delta,
                                                              const TakeRows& take) {
    for (std::size_t r = 0; r < runs.size(); ++r) {
      auto [f, J] = runs[r];
      for (std::size_t j = 0; j < layout.columns(); ++j)
        for (std::size_t i = 0; i < f.size(); ++i)
          f[i] += J[j * f.size() + i] * delta[layout.place(r, j)];
      take(r, f, J);
    }
  };
  return linear;
}

double restricted_likelihood(const Minimum& at) {
  const double freedom = static_cast<double>(at.f.size()) - static_cast<double>(at.theta.size());
  return -0.5 * freedom * std::log(at.rss - at.R.reduction()) - at.R.log_determinant();
}

}  // namespace rolling
