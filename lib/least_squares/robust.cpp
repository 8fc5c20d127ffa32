// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_squares/robust.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/grid.h"
#include "base/matrix.h"
#include "base/median.h"
#include "least_squares/minimise.h"

namespace rolling {
namespace {

/// The median size of residuals, divided by that of a standard normal variable. The p smallest are
/// not counted: the p parameters may have made as many vanish.
double median_scale(std::vector<double> residuals, std::size_t p) {
  for (double& x : residuals) x = std::abs(x);
  const std::size_t first = std::min(p, residuals.size() - 1);
  return nth_smallest(residuals, first + (residuals.size() - first) / 2) / 0.6745;
}

/// The residuals at theta, and the root of the mean square of the scales of the runs: of the median
/// size of the residuals of a run, divided by that of a standard normal variable (0.6745). So a run
/// of much noise is no outlier as a whole. A scale of its own would be known to a fifth for a run
/// of 30 rows, and few rows that outliers have drawn away would take them for their noise. Runs
/// without noise, as at rest, do not count. Where most rows lie on the model, the scale is above
/// rounding, as theta is of order one.
struct Residuals {
  std::vector<double> f;
  double scale = 0;
};

/// Throws Error if the model has no finite values at theta.
Residuals residuals_at(const System& system, const std::vector<double>& theta) {
  Residuals at;
  at.f.reserve(system.residuals());
  std::vector<double> scales;
  double squares = 0;  // of J
  system.evaluate(theta, [&](std::size_t, std::span<double> f, std::span<double> J) {
    at.f.insert(at.f.end(), f.begin(), f.end());
    scales.push_back(median_scale({f.begin(), f.end()}, system.columns()));
    squares += dot(J, J);
  });
  const double n = static_cast<double>(at.f.size());
  if (!std::isfinite(dot(at.f, at.f))) fail("the law has no finite values");
  const double least = program_rounding * std::ranges::max(scales);
  std::erase_if(scales, [&](double scale) { return scale < least; });
  at.scale = std::max(std::sqrt(dot(scales, scales) / static_cast<double>(scales.size())),
                      1e-13 * std::sqrt(squares / n));
  return at;
}

/// The system whose residuals are multiplied by these factors. It refers to both.
System weighted(const System& system, const std::vector<double>& factors) {
  return {system.runs, system.own, system.shared,
          [&](const std::vector<double>& theta, const TakeRows& take) {
    auto factor = factors.begin();
    system.evaluate(theta, [&](std::size_t run, std::span<double> f, std::span<double> J) {
      for (std::size_t i = 0; i < f.size(); ++i, ++factor) {
        f[i] *= *factor;
        for (std::size_t k = i; k < J.size(); k += f.size()) J[k] *= *factor;
      }
      take(run, f, J);
    });
          }};
}

/// Factors 1 of the half of the rows of each run that theta fits best, and 0 of the others.
std::vector<double> best_half(const System& system, const std::vector<double>& theta) {
  std::vector<double> factors;
  system.evaluate(theta, [&](std::size_t, std::span<double> f, std::span<double>) {
    for (double& x : f) x = std::abs(x);
    const std::size_t half = std::min(f.size(), (f.size() + system.columns() + 1) / 2);
    std::vector<double> sizes(f.begin(), f.end());
    const double most = nth_smallest(sizes, half - 1);
    for (const double size : f) factors.push_back(size <= most);
  });
  return factors;
}

/// Factors 1 of the first or the last half of the rows of each run.
std::vector<double> half_at_end(const System& system, bool last) {
  std::vector<double> factors;
  for (const std::size_t n : system.runs)
    for (std::size_t i = 0; i < n; ++i) factors.push_back((2 * i >= n) == last);
  return factors;
}

struct Trial {
  std::vector<double> theta;
  double scale = std::numeric_limits<double>::infinity();
};

/// Of infinite scale if theta is not allowed.
Trial trial_at(const System& system, std::vector<double> theta) try {
  const double scale = residuals_at(system, theta).scale;
  return {std::move(theta), scale};
} catch (const Error&) {
  return {};
}

/// Steps towards the fit of the best half of the rows of each run, halved where necessary, as long
/// as they lower the scale.
Trial concentrated(const System& system, Trial at) {
  for (int round = 0; round < 20 && std::isfinite(at.scale); ++round) {
    const std::vector<double> factors = best_half(system, at.theta);
    Trial next;
    for (double share = 1; share > 0.05 && !(next.scale < 0.99 * at.scale); share /= 2)
      next = trial_at(system, stepped(weighted(system, factors), at.theta, share));
    if (!(next.scale < 0.99 * at.scale)) break;
    at = std::move(next);
  }
  return at;
}

/// The theta of the smallest scale of all that least trimmed squares, of the half of the rows of
/// each run that they fit best (Rousseeuw and Van Driessen 2006, Data Min. Knowl. Discov. 12, 29),
/// lead to: from these starts, and from the fits of the first and of the last half of the rows,
/// without the outliers of the other end. Throws Error if the model has no finite values.
std::vector<double> least_trimmed(const System& system, std::vector<std::vector<double>> starts) {
  for (const bool last : {false, true})
    starts.push_back(attempt(weighted(system, half_at_end(system, last)), starts.front()).theta);
  Trial best;
  for (const auto& start : starts)
    if (Trial found = concentrated(system, trial_at(system, start)); found.scale < best.scale)
      best = std::move(found);
  if (best.theta.empty()) evaluated(system, starts.front());  // throws
  return best.theta;
}

/// psi(u)/u and psi'(u) of a loss with influence function psi.
struct Influence {
  double weight, slope;
};
Influence huber(double u) {
  constexpr double c = 1.345;
  return std::abs(u) <= c ? Influence{1, 1} : Influence{c / std::abs(u), 0};
}
Influence bisquare(double u) {
  constexpr double c = 4.685;
  const double rest = 1 - u * u / (c * c);
  return rest > 0 ? Influence{rest * rest, rest * (5 * rest - 4)} : Influence{0, 0};
}

/// The sizes of residuals in units of their scale.
std::vector<double> sizes_of(const Residuals& at) {
  std::vector<double> sizes;
  for (const double x : at.f) sizes.push_back(std::abs(x) / at.scale);
  return sizes;
}

}  // namespace

Minimum minimise_robust(const System& system, const std::vector<std::vector<double>>& starts) {
  constexpr std::size_t few = 1000, few_parameters = 12;
  const std::size_t p = system.parameters();
  const bool trimmed = system.residuals() <= few && p <= few_parameters;
  std::vector<double> theta = trimmed ? least_trimmed(system, starts) : starts.front();
  Residuals at = residuals_at(system, theta);
  std::vector<double> u = sizes_of(at), factors(u.size());
  std::vector<bool> outliers;
  for (const double size : u) outliers.push_back(trimmed && size > 30);
  for (const auto influence : {huber, bisquare}) {
    double change = influence == huber ? 1 : 0.01;
    for (int round = 0; change > 1e-8; ++round) {
      if (round == 200) fail("the robust fit does not converge");
      double squares = 0, slopes = 0;  // sums of the weights and of psi'
      for (std::size_t i = 0; i < u.size(); ++i) {
        const bool out = influence == huber && outliers[i];
        const Influence of = out ? Influence{0, 0} : influence(u[i]);
        factors[i] = std::sqrt(of.weight);
        squares += of.weight, slopes += of.slope;
      }
      const System weights = weighted(system, factors);
      // A step of reweighted squares is too short by the ratio of these sums: with it Newton's.
      const double longer = slopes > squares / 2 ? squares / slopes : 1;
      const auto next =
          change > 0.01 ? minimise(weights, theta).theta : stepped(weights, theta, longer);
      change = 0;
      for (std::size_t j = 0; j < p; ++j)
        change = std::max(change, std::abs(next[j] - theta[j]) / std::max(1.0, std::abs(next[j])));
      theta = next;
      Residuals now = residuals_at(system, theta);
      // The bisquare loss has a fixed scale, and so has Huber's after a while: it is made of
      // medians, which may go to and fro between two rows without end.
      if (influence == bisquare || round > 50) now.scale = at.scale;
      at = std::move(now);
      u = sizes_of(at);
    }
  }
  const double n = static_cast<double>(u.size());
  double mean = 0, squares = 0;
  for (const double size : u) {
    const double slope = bisquare(size).slope;
    mean += slope / n;
    squares += slope * slope / n;
  }
  if (!(mean > 0)) fail("too many outliers: no robust fit");
  const double correction =
      1 + static_cast<double>(p) / n * (squares - mean * mean) / (mean * mean);
  Minimum minimum = evaluated(system, theta);
  for (std::size_t i = 0; i < u.size(); ++i)
    minimum.f[i] *= bisquare(u[i]).weight * correction / mean;
  minimum.rss = dot(minimum.f, minimum.f);
  return minimum;
}

}  // namespace rolling
