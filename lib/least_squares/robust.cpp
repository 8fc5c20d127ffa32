// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_squares/robust.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <utility>

#include "base/error.h"
#include "base/grid.h"
#include "base/matrix.h"
#include "base/median.h"
#include "least_squares/minimise.h"
#include "least_squares/triangles.h"

namespace rolling {
namespace {

/// The median size of residuals, divided by that of a standard normal variable. The p smallest are
/// not counted: the p parameters may have made as many vanish.
double median_scale(std::vector<double> residuals, std::size_t p) {
  for (double& x : residuals) x = std::abs(x);
  const std::size_t first = std::min(p, residuals.size() - 1);
  return nth_smallest(residuals, first + (residuals.size() - first) / 2) / 0.6745;
}

}  // namespace

Residuals residuals_at(const System& system, const std::vector<double>& theta) {
  Residuals at;
  at.f.reserve(system.residuals());
  system.evaluate(theta, [&](std::size_t, std::span<double> f, std::span<double>) {
    at.f.insert(at.f.end(), f.begin(), f.end());
  });
  if (!std::isfinite(dot(at.f, at.f))) fail("the law has no finite values");
  std::vector<double> scales;
  for (const auto f : by_run(at.f, system.runs))
    scales.push_back(median_scale({f.begin(), f.end()}, system.columns()));
  const double least = program_rounding * std::ranges::max(scales);
  std::erase_if(scales, [&](double scale) { return scale < least; });
  at.scale = std::sqrt(dot(scales, scales) / static_cast<double>(scales.size()));
  return at;
}

namespace {

/// The residuals f + J delta of a model that is linear in delta. J is stored row by row.
class LinearModel {
 public:
  const System& system;

  LinearModel(const System& of, const std::vector<double>& theta)
      : system(of), p_(of.parameters()), J_(of.residuals() * p_) {
    system.evaluate(theta, [&](std::size_t run, std::span<double> f, std::span<double> J) {
      double* const row = &J_[f_.size() * p_];
      for (std::size_t k = 0; k < J.size(); ++k)
        row[k % f.size() * p_ + system.place(run, k / f.size())] = J[k];
      f_.insert(f_.end(), f.begin(), f.end());
    });
  }
  double residual(std::size_t i, const std::vector<double>& delta) const {
    return f_[i] + dot(&J_[i * p_], delta.data(), p_);
  }
  /// The delta of the least squares of these rows; not finite if they do not determine it.
  std::vector<double> fit(const std::vector<std::size_t>& rows) const {
    const std::size_t n = rows.size();
    std::vector<double> f, J(n * p_);
    for (std::size_t k = 0; k < n; ++k) {
      f.push_back(f_[rows[k]]);
      for (std::size_t j = 0; j < p_; ++j) J[j * n + k] = J_[rows[k] * p_ + j];
    }
    Triangles R(1, p_, 0);
    R.add(0, f, J);
    return R.solve();
  }

 private:
  std::size_t p_;
  std::vector<double> f_, J_;
};

/// The half of the rows of each run that a delta fits best, and the sum of their squares.
struct Half {
  std::vector<double> delta;
  double squares = 0;
  std::vector<std::size_t> rows = {};
};

Half best_half(const LinearModel& model, std::vector<double> delta) {
  Half found{std::move(delta)};
  std::size_t first = 0;
  for (const std::size_t n : model.system.runs) {
    std::vector<std::pair<double, std::size_t>> squares;
    for (std::size_t i = first; i < first + n; ++i) {
      const double r = model.residual(i, found.delta);
      squares.emplace_back(std::isfinite(r) ? r * r : std::numeric_limits<double>::infinity(), i);
    }
    std::ranges::sort(squares);
    const std::size_t half = (n + model.system.columns() + 1) / 2;
    for (const auto& [square, row] : std::span(squares).first(std::min(n, half))) {
      found.squares += square;
      found.rows.push_back(row);
    }
    first += n;
  }
  return found;
}

/// As many rows as there are parameters, far apart: of each run those of its own parameters, and of
/// the longest those of the shared ones as well, one of each of as many equal parts of the run.
std::vector<std::size_t> drawn(const LinearModel& model, std::mt19937& random) {
  const auto& runs = model.system.runs;
  const auto longest = static_cast<std::size_t>(std::ranges::max_element(runs) - runs.begin());
  std::vector<std::size_t> rows;
  std::size_t of_run = 0;
  for (std::size_t r = 0; r < runs.size(); of_run += runs[r++]) {
    const std::size_t n = runs[r], few = std::min(n, model.system.own +
                                                         (r == longest ? model.system.shared : 0));
    for (std::size_t j = 0; j < few; ++j) {
      const std::size_t first = j * n / few, end = (j + 1) * n / few;
      rows.push_back(of_run + first + random() % (end - first));
    }
  }
  return rows;
}

/// The least trimmed squares, as far as exact fits of random rows and the fits of their best halves
/// lead to them (Rousseeuw and Van Driessen 2006, Data Min. Knowl. Discov. 12, 29).
std::vector<double> trimmed_step(const LinearModel& model) {
  constexpr int draws = 100;
  std::mt19937 random;  // with the seed of the standard: the same draws in each run
  Half best = best_half(model, std::vector<double>(model.system.parameters()));
  for (int draw = 0; draw < draws; ++draw) {
    Half found = best_half(model, model.fit(drawn(model, random)));
    for (int step = 0; step < 2; ++step) found = best_half(model, model.fit(found.rows));
    if (found.squares < best.squares) best = std::move(found);
  }
  return best.delta;
}

struct Trial {
  std::vector<double> theta;
  double scale;
};

/// An infinite scale if theta is not allowed.
Trial trial_at(const System& system, std::vector<double> theta) try {
  const double scale = residuals_at(system, theta).scale;
  return {std::move(theta), scale};
} catch (const Error&) {
  return {{}, std::numeric_limits<double>::infinity()};
}

/// Steps of least trimmed squares, halved where necessary, as long as they lower the scale.
Trial descend(const System& system, Trial at) {
  constexpr int rounds = 20, halvings = 5;
  for (int round = 0; round < rounds && std::isfinite(at.scale); ++round) {
    const std::vector<double> step = trimmed_step({system, at.theta});
    Trial next = at;
    double share = 1;
    for (int k = 0; k < halvings && !(next.scale < 0.99 * at.scale); ++k, share /= 2) {
      std::vector<double> theta = at.theta;
      for (std::size_t j = 0; j < step.size(); ++j) theta[j] += share * step[j];
      next = trial_at(system, std::move(theta));
    }
    if (!(next.scale < 0.99 * at.scale)) break;
    at = std::move(next);
  }
  return at;
}

}  // namespace

std::vector<double> least_trimmed(const System& system,
                                  const std::vector<std::vector<double>>& starts) {
  Trial best = trial_at(system, starts.front());
  for (const auto& start : starts)
    if (Trial found = descend(system, trial_at(system, start)); found.scale < best.scale)
      best = std::move(found);
  if (best.theta.empty()) evaluated(system, starts.front());  // throws
  return best.theta;
}

namespace {

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

/// The fit from a theta that fits most rows exactly: of those alone that it fits to rounding,
/// since theta is of order one.
Minimum exact_fit(const System& system, const std::vector<double>& theta) {
  std::vector<double> kept;
  system.evaluate(theta, [&](std::size_t, std::span<double> f, std::span<double> J) {
    for (std::size_t i = 0; i < f.size(); ++i) {
      double size = 0;
      for (std::size_t k = i; k < J.size(); k += f.size()) size += std::abs(J[k]);
      kept.push_back(std::abs(f[i]) <= 1e-13 * size);
    }
  });
  Minimum minimum = evaluated(system, minimise(weighted(system, kept), theta).theta);
  std::ranges::transform(minimum.f, kept, minimum.f.begin(), std::multiplies());
  minimum.rss = dot(minimum.f, minimum.f);
  return minimum;
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
      if (!(at.scale > 0)) return exact_fit(system, theta);
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
