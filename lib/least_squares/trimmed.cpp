// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_squares/trimmed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "base/by_run.h"
#include "base/dot.h"
#include "base/error.h"
#include "base/grid.h"
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
Trial point_at(const System& system, std::vector<double> theta) try {
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
      next = point_at(system, std::move(theta));
    }
    if (!(next.scale < 0.99 * at.scale)) break;
    at = std::move(next);
  }
  return at;
}

}  // namespace

std::vector<double> least_trimmed(const System& system,
                                  const std::vector<std::vector<double>>& starts) {
  Trial best = point_at(system, starts.front());
  for (const auto& start : starts)
    if (Trial found = descend(system, point_at(system, start)); found.scale < best.scale)
      best = std::move(found);
  if (best.theta.empty()) evaluated(system, starts.front());  // throws
  return best.theta;
}

}  // namespace rolling
