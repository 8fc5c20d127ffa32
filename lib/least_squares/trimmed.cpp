#include "least_squares/trimmed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "base/dot.h"
#include "base/error.h"
#include "base/median.h"
#include "least_squares/minimise.h"
#include "least_squares/triangles.h"

namespace rolling {

double median_scale(std::vector<double> residuals, std::size_t p) {
  for (double& x : residuals) x = std::abs(x);
  const std::size_t first = std::min(p, residuals.size() - 1);
  return nth_smallest(residuals, first + (residuals.size() - first) / 2) / 0.6745;
}

namespace {

/// The residuals f + J delta of a model that is linear in delta. J is stored row by row.
class Linear {
 public:
  Linear(const System& system, const std::vector<double>& theta)
      : p_(system.parameters()), J_(system.residuals() * p_) {
    system.evaluate(theta, [&](std::size_t run, std::span<double> f, std::span<double> J) {
      double* const row = &J_[f_.size() * p_];
      for (std::size_t k = 0; k < J.size(); ++k)
        row[k % f.size() * p_ + system.place(run, k / f.size())] = J[k];
      f_.insert(f_.end(), f.begin(), f.end());
    });
  }
  std::size_t rows() const { return f_.size(); }
  std::size_t columns() const { return p_; }
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
    Triangles R({{n}, p_, 0, {}});
    R.add(0, f, J);
    return R.solve();
  }

 private:
  std::size_t p_;
  std::vector<double> f_, J_;
};

/// The half of the rows that a delta fits best, and the sum of their squares.
struct Half {
  std::vector<double> delta;
  double squares = 0;
  std::vector<std::size_t> rows = {};
};

Half best_half(const Linear& model, std::vector<double> delta) {
  const std::size_t n = model.rows(), half = (n + model.columns() + 1) / 2;
  std::vector<std::pair<double, std::size_t>> squares;
  for (std::size_t i = 0; i < n; ++i) {
    const double r = model.residual(i, delta);
    squares.emplace_back(std::isfinite(r) ? r * r : std::numeric_limits<double>::infinity(), i);
  }
  std::ranges::sort(squares);
  Half found{std::move(delta)};
  for (const auto& [square, row] : std::span(squares).first(std::min(n, half))) {
    found.squares += square;
    found.rows.push_back(row);
  }
  return found;
}

/// The least trimmed squares, as far as exact fits of random rows and the fits of their best halves
/// lead to them (Rousseeuw and Van Driessen 2006, Data Min. Knowl. Discov. 12, 29).
std::vector<double> trimmed_step(const Linear& model) {
  constexpr int draws = 100;
  const std::size_t n = model.rows(), p = model.columns();
  std::mt19937 random;  // with the seed of the standard: the same draws in each run
  Half best = best_half(model, std::vector<double>(p));
  for (int draw = 0; draw < draws; ++draw) {
    std::vector<std::size_t> rows;
    for (std::size_t j = 0; j < p; ++j) {  // one row of each p-th of the record: far apart
      const std::size_t first = j * n / p, end = (j + 1) * n / p;
      rows.push_back(first + random() % (end - first));
    }
    Half found = best_half(model, model.fit(rows));
    for (int step = 0; step < 2; ++step) found = best_half(model, model.fit(found.rows));
    if (found.squares < best.squares) best = std::move(found);
  }
  for (;;) {
    Half next = best_half(model, model.fit(best.rows));
    if (!(next.squares < best.squares)) return best.delta;
    best = std::move(next);
  }
}

struct Point {
  std::vector<double> theta;
  double scale;
};

/// An infinite scale if theta is not allowed.
Point point_at(const System& system, std::vector<double> theta) try {
  const double scale = median_scale(evaluated(system, theta).f, system.parameters());
  return {std::move(theta), scale};
} catch (const Error&) {
  return {{}, std::numeric_limits<double>::infinity()};
}

/// Steps of least trimmed squares, halved where necessary, as long as they lower the scale.
Point descend(const System& system, Point at) {
  constexpr int rounds = 20, halvings = 5;
  for (int round = 0; round < rounds && std::isfinite(at.scale); ++round) {
    const std::vector<double> step = trimmed_step({system, at.theta});
    Point next = at;
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
  Point best = point_at(system, starts.front());
  for (const auto& start : starts)
    if (Point found = descend(system, point_at(system, start)); found.scale < best.scale)
      best = std::move(found);
  if (best.theta.empty()) evaluated(system, starts.front());  // throws
  return best.theta;
}

}  // namespace rolling
