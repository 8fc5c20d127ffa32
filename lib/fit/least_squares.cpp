#include "fit/least_squares.h"

#include "base/error.h"
#include "base/large_pages.h"
#include "fit/dot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rolling {

std::size_t System::residuals() const {
  return std::accumulate(runs.begin(), runs.end(), std::size_t{0});
}

namespace {

constexpr double undetermined = 1e-10;  // sine between a column of J and those before it
constexpr double round_off = 1e-15;     // a smaller step, relatively, and
constexpr double unseen = 1e-10;  // one that moves the residuals by no more than this share of
                                  // them, are taken without another evaluation

/// Folds m rows of [J f], column by column, into the triangle R of J's q columns and one for f, row
/// by row, by Householder reflections: R becomes that of [R; J f]. Columns that are 0 cost nothing.
void fold(double* R, std::size_t q, double* J, double* f, std::size_t m) {
  for (std::size_t j = 0; j < q; ++j) {
    const double* const x = J + j * m;
    const double below = dot(x, x, m);
    if (below == 0) continue;
    double* const row = R + j * (q + 1);
    const double length = -std::copysign(std::sqrt(row[j] * row[j] + below), row[j]),
                 head = row[j] - length;
    row[j] = length;
    for (std::size_t k = j + 1; k <= q; ++k) {
      double* const y = k < q ? J + k * m : f;
      const double w = (head * row[k] + dot(x, y, m)) / (length * head);
      row[k] += w * head;
      if (w != 0)
        for (std::size_t i = 0; i < m; ++i) y[i] += w * x[i];
    }
  }
}

/// The triangles of [J f] = Q R, one for the columns of each run: what is left of them beside the
/// own parameters is folded together (block elimination), so that the work grows with the runs as
/// their records do.
class Triangles {
 public:
  explicit Triangles(const System& system)
      : system_(&system), R_(system.runs.size() * triangle()) {}
  void add(std::size_t run, std::span<double> f, std::span<double> J) {
    fold(of(run), q(), J.data(), f.data(), f.size());
  }

  /// After the last row: the shared part, from this one of other rows, in all of the triangles.
  void join(std::vector<double> common) {
    const std::size_t own = system_->own, shared = system_->shared;
    std::vector<double> J(shared * shared), f(shared);
    for (std::size_t r = 0; r < system_->runs.size(); ++r) {
      for (std::size_t i = 0; i < shared; ++i) {
        const double* const row = of(r) + (own + i) * (q() + 1) + own;
        for (std::size_t j = 0; j < shared; ++j) J[j * shared + i] = row[j];
        f[i] = row[shared];
      }
      fold(common.data(), shared, J.data(), f.data(), shared);
    }
    for (std::size_t r = 0; r < system_->runs.size(); ++r)
      for (std::size_t i = 0; i < shared; ++i)
        std::copy_n(&common[i * (shared + 1)], shared + 1, of(r) + (own + i) * (q() + 1) + own);
  }
  void join() { join(std::vector<double>(system_->shared * (system_->shared + 1))); }

  /// Those of J with sqrt(mu) D below it, D diagonal, and of f with 0.
  Triangles damped(const std::vector<double>& D, double mu) const {
    const std::size_t own = system_->own, shared = system_->shared;
    Triangles all = *this;
    std::vector<double> common;
    for (std::size_t i = 0; i < shared; ++i)
      common.insert(common.end(), of(0) + (own + i) * (q() + 1) + own,
                    of(0) + (own + i + 1) * (q() + 1));
    const auto diagonal =
        [&](std::size_t run, std::size_t first, std::size_t count, std::size_t columns, double* R) {
      std::vector<double> J(count * columns), f(count);
      for (std::size_t i = 0; i < count; ++i)
        J[i * count + i] = std::sqrt(mu) * D[system_->place(run, first + i)];
      fold(R, columns, J.data(), f.data(), count);
    };
    diagonal(0, own, shared, shared, common.data());
    for (std::size_t r = 0; r < system_->runs.size(); ++r) {
      std::fill(all.of(r) + own * (q() + 1), all.of(r) + triangle(), 0.0);
      diagonal(r, 0, own, q(), all.of(r));
    }
    all.join(std::move(common));
    return all;
  }

  /// Calls row(run, j, its elements) for each row of the one triangle of all parameters, once.
  template <typename Row>
  void rows(Row&& row) const {
    for (std::size_t r = 0; r < system_->runs.size(); ++r)
      for (std::size_t j = 0; j < (r ? system_->own : q()); ++j) row(r, j, of(r) + j * (q() + 1));
  }

  /// The theta that makes |R theta + Q^T f| smallest.
  std::vector<double> solve() const {
    std::vector<double> theta(system_->parameters());
    for (std::size_t r = 0; r < system_->runs.size(); ++r)
      for (std::size_t j = q(); j-- > 0;) {
        const double* const row = of(r) + j * (q() + 1);
        double sum = -row[q()];
        for (std::size_t k = j + 1; k < q(); ++k) sum -= row[k] * theta[system_->place(r, k)];
        theta[system_->place(r, j)] = sum / row[j];
      }
    return theta;
  }
  /// By how much the sum of squares is smaller there than at 0.
  double reduction() const {
    double sum = 0;
    rows([&](std::size_t, std::size_t, const double* row) { sum += row[q()] * row[q()]; });
    return sum;
  }
  /// Of the columns of J.
  std::vector<double> lengths() const {
    std::vector<double> all(system_->parameters());
    rows([&](std::size_t r, std::size_t j, const double* row) {
      for (std::size_t k = j; k < q(); ++k)
        all[system_->place(r, k)] = std::hypot(all[system_->place(r, k)], row[k]);
    });
    return all;
  }
  double log_determinant() const {
    double sum = 0;
    rows([&](std::size_t, std::size_t j, const double* row) { sum += std::log(std::abs(row[j])); });
    return sum;
  }
  std::vector<double> without_f() const {
    std::vector<double> all;
    for (std::size_t i = 0; i < R_.size(); ++i)
      if (i % (q() + 1) != q()) all.push_back(R_[i]);
    return all;
  }

 private:
  std::size_t q() const { return system_->columns(); }
  std::size_t triangle() const { return q() * (q() + 1); }
  double* of(std::size_t run) { return R_.data() + run * triangle(); }
  const double* of(std::size_t run) const { return R_.data() + run * triangle(); }

  const System* system_;
  std::vector<double> R_;
};

double square(const std::vector<double>& f) { return dot(f.data(), f.data(), f.size()); }

/// What an evaluation leaves, and the Gauss-Newton step from there: from the QR of J, not from the
/// normal equations, whose condition is the square of J's.
struct Point {
  explicit Point(const System& system) : R(system) { reserve_large(f, system.residuals()); }

  std::vector<double> theta, f;
  Triangles R;
  double rss = 0;
  std::vector<double> step, lengths;  // of the columns of J
  double size = 0;                    // largest relative change of a parameter
  double reduction = 0;               // of the sum of squares, that the step promises
  double angle = 1;  // smallest sine between a column of J and the columns before it
};

/// Whether theta is allowed.
bool evaluate_at(const System& system, Point& at, std::vector<double> theta) {
  at.theta = std::move(theta);
  at.f.clear();
  at.R = Triangles(system);
  at.rss = 0;
  try {
    system.evaluate(at.theta, [&at](std::size_t run, std::span<double> f, std::span<double> J) {
      at.f.insert(at.f.end(), f.begin(), f.end());
      at.rss += dot(f.data(), f.data(), f.size());
      at.R.add(run, f, J);
    });
  } catch (const Error&) {
    return false;
  }
  at.R.join();
  at.lengths = at.R.lengths();
  at.step = at.R.solve();
  at.reduction = at.R.reduction();
  at.angle = 1;
  at.R.rows([&](std::size_t r, std::size_t j, const double* row) {
    const double length = at.lengths[system.place(r, j)];
    at.angle = std::min(at.angle, length > 0 ? std::abs(row[j]) / length : 0);
  });
  at.size = 0;
  for (std::size_t j = 0; j < at.theta.size(); ++j)
    at.size = std::max(at.size, std::abs(at.step[j]) / std::max(1.0, std::abs(at.theta[j])));
  return std::isfinite(at.rss) && std::isfinite(square(at.lengths));
}

std::vector<double> moved(std::vector<double> theta, const std::vector<double>& step) {
  std::transform(theta.begin(), theta.end(), step.begin(), theta.begin(), std::plus());
  return theta;
}

/// Levenberg-Marquardt, scaled after More (1978, Lecture Notes in Mathematics 630, 105) and damped
/// after Nielsen (1999, IMM-REP-1999-05), to where it makes no further progress; whether that is a
/// minimum is not its question.
std::vector<double> descend(const System& system, Point at) {
  Point next(system);
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
    bool still = true;
    for (std::size_t j = 0; j < D.size(); ++j) {
      D[j] = std::max(D[j], at.lengths[j]);
      still = still && std::abs(step[j]) < 1e-9 * (std::abs(at.theta[j]) + 1e-9);
    }
    if (still) break;
  }
  return at.theta;
}

/// Gauss-Newton steps, down to round-off, as long as each takes off the sum of squares at least
/// this share of what it promises.
Point polish(const System& system, std::vector<double> theta, double share) {
  Point best(system), next(system);
  if (!evaluate_at(system, best, std::move(theta)))
    fail("the fit cannot start: the law has no finite values at the starting point");
  for (int i = 0; i < 100 && best.angle > undetermined; ++i) {
    if (best.size < round_off ||
        (best.size < unseen / 100 && best.reduction < unseen * unseen * best.rss)) {
      best.theta = moved(best.theta, best.step);
      break;
    }
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
  // Where the residuals are linear, or all but so between the start and the minimum, Gauss-Newton
  // steps do all.
  Point best = polish(system, start, 0.9);
  // Bates & Watts (1981), Technometrics 23, 179: converged when the residuals' part in the tangent
  // plane is small against the part orthogonal to it. An exact fit has nothing orthogonal; there
  // the step itself must vanish.
  const std::size_t n = system.residuals(), p = system.parameters();
  const double freedom = n > p ? static_cast<double>(n - p) : 0;
  const auto offset = [&] {
    return std::sqrt(best.reduction / static_cast<double>(p) * freedom /
                     std::max(best.rss - best.reduction, 0.0));
  };
  const auto determined = [&] { return best.angle > undetermined; };
  const auto converged = [&] { return determined() && (best.size < 1e-7 || offset() < 1e-3); };
  for (int round = 0; !converged() && (round == 0 || determined()); ++round) {
    const double before = best.rss;
    best = polish(system, descend(system, best), 0);
    // The minimum of a trajectory fit may lie on a kink, where the stop meets a record: hardly a
    // step goes down, but the slope of either side remains. It is worth a fraction of a standard
    // deviation, never more.
    if (best.rss > before * (1 - std::max(1e-8, 1e-3 / freedom)) && offset() < 1) break;
    if (round == 20) fail("the fit does not converge");
  }
  if (!determined()) fail("the data do not determine the parameters: they cannot be told apart");
  return {std::move(best.theta), std::move(best.f), best.R.without_f(), best.rss};
}

std::vector<double> approach(const System& system, std::vector<double> start) {
  try {
    return minimise(system, start).theta;
  } catch (const Error&) {
    return start;
  }
}

namespace {

/// psi(u)/u and psi'(u) of a loss.
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

/// The median absolute residual over that of a standard normal; the p smallest, which the fit has
/// made small, are not counted.
double median_scale(std::vector<double> f, std::size_t p) {
  for (double& x : f) x = std::abs(x);
  const std::size_t first = std::min(p, f.size() - 1);
  const auto middle = f.begin() + static_cast<std::ptrdiff_t>(first + (f.size() - first) / 2);
  std::nth_element(f.begin(), middle, f.end());
  return *middle / 0.6745;
}

}  // namespace

Minimum minimise_robust(const System& system, const std::vector<double>& start) {
  Point at(system);
  const auto evaluate = [&](const std::vector<double>& theta) {
    if (!evaluate_at(system, at, theta))
      fail("the fit cannot start: the law has no finite values at the starting point");
  };
  evaluate(start);
  const std::size_t p = system.parameters();
  double scale = 0;
  for (const auto influence : {huber, bisquare}) {
    double change = 1;
    for (int round = 0; change > 1e-9; ++round) {
      if (round == 100) fail("the robust fit does not converge");
      if (influence == huber) scale = median_scale(at.f, p);  // bisquare keeps the last one
      if (!(scale > 0)) return minimise(system, at.theta);
      std::vector<double> roots;
      for (double r : at.f) roots.push_back(std::sqrt(influence(r / scale).weight));
      const System weighted{system.runs, system.own, system.shared,
                            [&](const std::vector<double>& theta, const TakeRows& take) {
        auto root = roots.begin();
        system.evaluate(theta, [&](std::size_t run, std::span<double> f, std::span<double> J) {
          for (std::size_t i = 0; i < f.size(); ++i, ++root) {
            f[i] *= *root;
            for (std::size_t k = i; k < J.size(); k += f.size()) J[k] *= *root;
          }
          take(run, f, J);
        });
                            }};
      const auto next = minimise(weighted, at.theta).theta;
      change = 0;
      for (std::size_t j = 0; j < p; ++j)
        change =
            std::max(change, std::abs(next[j] - at.theta[j]) / std::max(1.0, std::abs(next[j])));
      evaluate(next);
      if (influence == huber && change < 1e-3) break;  // only a place to start from
    }
  }
  const double n = static_cast<double>(system.residuals());
  double mean = 0, squares = 0;
  for (double r : at.f) {
    const double slope = bisquare(r / scale).slope;
    mean += slope / n;
    squares += slope * slope / n;
  }
  if (!(mean > 0)) fail("too many outliers: no robust fit");
  const double correction =
      1 + static_cast<double>(p) / n * (squares - mean * mean) / (mean * mean);
  for (double& r : at.f) r *= bisquare(r / scale).weight * correction / mean;
  const double rss = square(at.f);
  return {std::move(at.theta), std::move(at.f), at.R.without_f(), rss};
}

double restricted_likelihood(const System& system, const std::vector<double>& theta) {
  Point at(system);
  evaluate_at(system, at, theta);
  const double freedom =
      static_cast<double>(system.residuals()) - static_cast<double>(system.parameters());
  return -0.5 * freedom * std::log(at.rss - at.reduction) - at.R.log_determinant();
}

std::vector<double> residuals_at(const System& system, const std::vector<double>& theta) {
  std::vector<double> all;
  system.evaluate(theta, [&](std::size_t, std::span<double> f, std::span<double>) {
    all.insert(all.end(), f.begin(), f.end());
  });
  return all;
}

std::vector<double> orthonormal(const System& system, const Minimum& m) {
  const std::size_t q = system.columns();
  std::vector<double> Q;
  Q.reserve(m.f.size() * q);
  system.evaluate(m.theta, [&](std::size_t run, std::span<double> f, std::span<double> J) {
    const double* const R = &m.R[run * q * q];
    for (std::size_t i = 0; i < f.size(); ++i)
      for (std::size_t j = 0; j < q; ++j) {
        double x = J[j * f.size() + i];
        for (std::size_t k = 0; k < j; ++k) x -= Q[Q.size() - j + k] * R[k * q + j];
        Q.push_back(x / R[j * q + j]);
      }
  });
  return Q;
}

void add_shared(std::vector<double>& M, std::size_t columns, std::size_t shared) {
  const std::size_t square = columns * columns;
  for (std::size_t i = columns - shared; i < columns; ++i)
    for (std::size_t j = columns - shared; j < columns; ++j) {
      double sum = 0;
      for (std::size_t at = i * columns + j; at < M.size(); at += square) sum += M[at];
      for (std::size_t at = i * columns + j; at < M.size(); at += square) M[at] = sum;
    }
}

std::vector<double> Spread::solve_transposed(std::vector<double> g, std::size_t run) const {
  const double* const R = &R_[run * q_ * q_];
  for (std::size_t j = 0; j < q_; ++j) {
    for (std::size_t k = 0; k < j; ++k) g[j] -= R[k * q_ + j] * g[k];
    g[j] /= R[j * q_ + j];
  }
  return g;
}

double Spread::operator()(const std::vector<double>& g, const std::vector<double>& h,
                          std::size_t run) const {
  const auto left = solve_transposed(g, run), right = solve_transposed(h, run);
  double sum = 0;
  for (std::size_t i = 0; i < q_; ++i)
    for (std::size_t j = 0; j < q_; ++j) sum += left[i] * M_[(run * q_ + i) * q_ + j] * right[j];
  return sum;
}

}  // namespace rolling
