// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_squares/minimise.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "base/error.h"
#include "base/grid.h"
#include "base/matrix.h"
#include "base/median.h"

namespace rolling {
namespace {

/// The median size of residuals, divided by that of a standard normal variable. The p smallest are
/// not counted: the p parameters may have made as many vanish.
double median_scale(std::vector<double> residuals, std::size_t p) {
  for (double& x : residuals) x = std::abs(x);
  const std::size_t first = std::min(p, residuals.size() - 1);
  return nth_smallest(residuals, first + (residuals.size() - first) / 2) / 0.6745;
}

/// The root of the mean square of the scales of the runs: of the median size of the residuals of a
/// run, divided by that of a standard normal variable (0.6745). So a run of much noise is no
/// outlier as a whole. A scale of its own would be known to a fifth for a run of 30 rows, and few
/// rows that outliers have drawn away would take them for their noise. Runs without noise, as at
/// rest, do not count. Where most rows lie on the model, the scale is above rounding, as theta is
/// of order one. Infinite where the model has no finite values.
double scale_of(const System& system, const Minimum& at) {
  if (!std::isfinite(at.rss)) return INFINITY;
  std::vector<double> scales;
  for (const auto f : by_run(at.f, system.runs))
    scales.push_back(median_scale({f.begin(), f.end()}, system.columns()));
  const double least = program_rounding * std::ranges::max(scales);
  std::erase_if(scales, [&](double scale) { return scale < least; });
  const std::vector<double> J = at.R.lengths();
  return std::max(std::sqrt(dot(scales, scales) / static_cast<double>(scales.size())),
                  1e-13 * std::sqrt(dot(J, J) / static_cast<double>(at.f.size())));
}

/// The half of the rows of each run that a delta fits best, as factors 1 and 0 of all rows, and
/// the sum of their squares.
struct Half {
  std::vector<double> delta;
  double squares = 0;
  std::vector<double> factors = {};
};

Half best_half(const System& linear, std::vector<double> delta) {
  Half found{std::move(delta)};
  linear.evaluate(found.delta, [&](std::size_t, std::span<double> f, std::span<double>) {
    for (double& x : f) x = std::isfinite(x) ? x * x : INFINITY;
    std::vector<double> squares(f.begin(), f.end());
    const std::size_t half = std::min(f.size(), (f.size() + linear.columns() + 1) / 2);
    const double most = nth_smallest(squares, half - 1);
    found.squares = std::accumulate(&squares[0], &squares[0] + half, found.squares);
    for (const double square : f) found.factors.push_back(square <= most);
  });
  return found;
}

/// The factor 1 for as many rows as there are parameters, far apart: of each run those of its own
/// parameters, and of the longest those of the shared ones as well, one of each of as many equal
/// parts of the run.
std::vector<double> drawn(const System& system, std::mt19937& random) {
  const auto& runs = system.runs;
  const auto longest = static_cast<std::size_t>(std::ranges::max_element(runs) - runs.begin());
  std::vector<double> factors(system.residuals());
  std::size_t of_run = 0;
  for (std::size_t r = 0; r < runs.size(); of_run += runs[r++]) {
    const std::size_t n = runs[r];
    const std::size_t few = std::min(n, system.own + (r == longest ? system.shared : 0));
    for (std::size_t j = 0; j < few; ++j) {
      const std::size_t first = j * n / few;
      const std::size_t end = (j + 1) * n / few;
      factors[of_run + first + random() % (end - first)] = 1;
    }
  }
  return factors;
}

/// The least trimmed squares, as far as exact fits of random rows and the fits of their best halves
/// lead to them (Rousseeuw and Van Driessen 2006, Data Min. Knowl. Discov. 12, 29).
std::vector<double> trimmed_step(const System& system, const std::vector<double>& theta) {
  constexpr int draws = 100;
  const System linear = linearised(system, theta);
  const std::vector<double> start(system.parameters());
  const auto half_of_fit = [&](const std::vector<double>& factors) {
    return best_half(linear, evaluated(weighted(linear, factors), start).R.solve());
  };
  std::mt19937 random;  // with the seed of the standard: the same draws in each run
  Half best = best_half(linear, start);
  for (int draw = 0; draw < draws; ++draw) {
    Half found = half_of_fit(drawn(system, random));
    for (int step = 0; step < 2; ++step) found = half_of_fit(found.factors);
    if (found.squares < best.squares) best = std::move(found);
  }
  return best.delta;
}

/// Steps of least trimmed squares, halved where necessary, as long as they lower the scale.
Minimum descend_by_halves(const System& system, Minimum at) {
  constexpr int rounds = 20;
  constexpr int halvings = 5;
  for (int round = 0; round < rounds && std::isfinite(at.rss); ++round) {
    std::vector<double> step = trimmed_step(system, at.theta);
    const double enough = 0.99 * scale_of(system, at);
    Minimum next;
    for (int k = 0; k < halvings && !(scale_of(system, next) < enough); ++k) {
      next = tried(system, moved(at.theta, step));
      for (double& x : step) x /= 2;
    }
    if (!(scale_of(system, next) < enough)) break;
    at = std::move(next);
  }
  return at;
}

/// The place of the smallest scale of all that steps of least trimmed squares reach from these
/// starts. Least trimmed squares fit half of the rows of each run, those that they fit best
/// (Rousseeuw 1984, J. Am. Stat. Assoc. 79, 871). The cost grows with the cube of the number of
/// parameters. Throws Error if the model has no finite values at any of the starts.
Minimum least_trimmed(const System& system, const std::vector<std::vector<double>>& starts) {
  Minimum best;
  for (const auto& start : starts)
    if (Minimum found = descend_by_halves(system, tried(system, start));
        scale_of(system, found) < scale_of(system, best))
      best = std::move(found);
  return std::isfinite(best.rss) ? best : evaluated(system, starts.front());
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
std::vector<double> sizes_of(const std::vector<double>& f, double scale) {
  std::vector<double> sizes;
  for (const double x : f) sizes.push_back(std::abs(x) / scale);
  return sizes;
}

}  // namespace

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

Minimum minimise_robust(const System& system, const std::vector<std::vector<double>>& starts) {
  const std::size_t p = system.parameters();
  const bool trimmed = system.residuals() <= 1000 && p <= 12;
  Minimum at = trimmed ? least_trimmed(system, starts) : evaluated(system, starts.front());
  double scale = scale_of(system, at);
  std::vector<double> u = sizes_of(at.f, scale);
  std::vector<double> factors(u.size());
  std::vector<bool> outliers(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) outliers[i] = trimmed && u[i] > 30;
  for (const auto influence : {huber, bisquare}) {
    double change = influence == huber ? 1 : 0.01;
    for (int round = 0; change > 1e-8; ++round) {
      if (round == 200) fail("the robust fit does not converge");
      double squares = 0;
      double slopes = 0;  // sums of the weights and of psi'
      for (std::size_t i = 0; i < u.size(); ++i) {
        const bool out = influence == huber && outliers[i];
        const Influence of = out ? Influence{0, 0} : influence(u[i]);
        factors[i] = std::sqrt(of.weight);
        squares += of.weight;
        slopes += of.slope;
      }
      const System weights = weighted(system, factors);
      // A step of reweighted squares is too short by the ratio of these sums: with it Newton's.
      const double longer = slopes > squares / 2 ? squares / slopes : 1;
      std::vector<double> step;
      if (change > 0.01) {
        step = minimise(weights, at.theta).theta;
        std::ranges::transform(step, at.theta, step.begin(), std::minus());
      } else {
        step = evaluated(weights, at.theta).R.solve();
        for (double& x : step) x *= longer;
      }
      std::vector<double> next = moved(at.theta, step);
      change = relative_size(step, next);
      at = evaluated(system, std::move(next));
      // The bisquare loss has a fixed scale, and so has Huber's after a while: it is made of
      // medians, which may go to and fro between two rows without end.
      if (influence == huber && round <= 50) scale = scale_of(system, at);
      u = sizes_of(at.f, scale);
    }
  }
  const double n = static_cast<double>(u.size());
  double mean = 0;
  double squares = 0;
  for (const double size : u) {
    const double slope = bisquare(size).slope;
    mean += slope / n;
    squares += slope * slope / n;
  }
  if (!(mean > 0)) fail("too many outliers: no robust fit");
  const double correction =
      1 + static_cast<double>(p) / n * (squares - mean * mean) / (mean * mean);
  for (std::size_t i = 0; i < u.size(); ++i) at.f[i] *= bisquare(u[i]).weight * correction / mean;
  at.rss = dot(at.f, at.f);
  return at;
}

}  // namespace rolling
