#include "fit/least_squares.h"

#include "base/error.h"
#include "base/gsl.h"
#include "fit/dot.h"

#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rolling {
namespace {

constexpr double undetermined = 1e-10;  // sine between a column of J and those before it

double square(const std::vector<double>& f) { return dot(f.data(), f.data(), f.size()); }

Minimum nowhere(const System& system) { return {{}, std::vector<double>(system.n), std::vector<double>(system.n * system.p), {}, 0}; }

/// The residuals and derivatives of a Minimum at theta; whether theta is allowed.
bool evaluate_at(const System& system, Minimum& m, std::vector<double> theta) {
  m.theta = std::move(theta);
  try {
    system.evaluate(m.theta, m.f, m.J);
  } catch (const Error&) {
    return false;
  }
  m.rss = square(m.f);
  return std::isfinite(m.rss) && std::isfinite(square(m.J));
}

/// What GSL's callbacks share: f and J come from one evaluation, so J is kept until it is asked for.
struct Bridge {
  const System& system;
  Minimum at;
  bool allowed = false;

  void evaluate(const gsl_vector* x) {
    std::vector<double> theta(system.p);
    for (std::size_t j = 0; j < system.p; ++j) theta[j] = gsl_vector_get(x, j);
    if (theta != at.theta) allowed = evaluate_at(system, at, std::move(theta));
  }
  static int residuals(const gsl_vector* x, void* self, gsl_vector* f) {
    auto& b = *static_cast<Bridge*>(self);
    b.evaluate(x);
    if (b.allowed) std::copy(b.at.f.begin(), b.at.f.end(), f->data);
    else gsl_vector_set_all(f, 1e100);  // finite, and worse than any step from an allowed start: it is rejected
    return GSL_SUCCESS;
  }
  static int jacobian(const gsl_vector* x, void* self, gsl_matrix* J) {
    auto& b = *static_cast<Bridge*>(self);
    b.evaluate(x);
    if (!b.allowed) return GSL_EDOM;
    std::copy(b.at.J.begin(), b.at.J.end(), J->data);
    return GSL_SUCCESS;
  }
};

/// Levenberg-Marquardt from start to where it makes no further progress; whether that is a minimum is not its question.
std::vector<double> descend(const System& system, const std::vector<double>& start) {
  Bridge bridge{system, nowhere(system)};
  gsl_multifit_nlinear_fdf fdf{};
  fdf.f = Bridge::residuals;
  fdf.df = Bridge::jacobian;
  fdf.n = system.n;
  fdf.p = system.p;
  fdf.params = &bridge;
  auto parameters = gsl_multifit_nlinear_default_parameters();
  auto work = own(gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, system.n, system.p), gsl_multifit_nlinear_free);
  auto x = gsl_vector_const_view_array(start.data(), system.p);
  bridge.evaluate(&x.vector);
  if (!bridge.allowed) fail("the fit cannot start: the law has no finite values at the starting point");
  check_gsl(gsl_multifit_nlinear_init(&x.vector, &fdf, work.get()), "fit");
  for (int i = 0, info = 0; i < 300; ++i) {
    if (gsl_multifit_nlinear_iterate(work.get()) != GSL_SUCCESS) break;
    // GSL's gradient test is absolute, so it is off: the residuals may be micrometres.
    if (gsl_multifit_nlinear_test(1e-9, 0, 0, &info, work.get()) == GSL_SUCCESS) break;
  }
  const gsl_vector* at = gsl_multifit_nlinear_position(work.get());
  std::vector<double> theta(system.p);
  for (std::size_t j = 0; j < system.p; ++j) theta[j] = gsl_vector_get(at, j);
  return theta;
}

/// The triangle R of [J f] = Q R, row by row, with p + 1 columns: the last is Q^T f. Rows are folded in by blocks, each under the
/// triangle so far, by Householder reflections: no copy of J is made, and columns in which a block is 0 cost nothing.
std::vector<double> triangle(const System& system, const Minimum& at) {
  constexpr std::size_t rows = 256;
  const std::size_t p = system.p, columns = p + 1;
  std::vector<double> R(p * columns, 0), block(columns * rows);
  for (std::size_t first = 0; first < system.n; first += rows) {
    const std::size_t m = std::min(rows, system.n - first);
    for (std::size_t i = 0; i < m; ++i) {
      for (std::size_t j = 0; j < p; ++j) block[j * rows + i] = at.J[(first + i) * p + j];
      block[p * rows + i] = at.f[first + i];
    }
    for (std::size_t j = 0; j < p; ++j) {
      const double* const x = &block[j * rows];
      const double below = dot(x, x, m);
      if (below == 0) continue;
      double* const row = &R[j * columns];
      const double length = -std::copysign(std::sqrt(row[j] * row[j] + below), row[j]), head = row[j] - length;
      row[j] = length;
      for (std::size_t k = j + 1; k < columns; ++k) {
        double* const y = &block[k * rows];
        const double w = (head * row[k] + dot(x, y, m)) / (length * head);
        if (w == 0) continue;
        row[k] += w * head;
        for (std::size_t i = 0; i < m; ++i) y[i] += w * x[i];
      }
    }
  }
  return R;
}

/// The Gauss-Newton step from the QR of J, not from the normal equations: their condition is the square of J's.
struct Step {
  std::vector<double> R, delta;
  double size = 0;       ///< largest relative change of a parameter
  double reduction = 0;  ///< of the sum of squares, that the step promises
  double angle = 1;      ///< smallest sine between a column of J and the columns before it
};

Step gauss_newton(const System& system, const Minimum& at) {
  const std::size_t p = system.p, columns = p + 1;
  const std::vector<double> QR = triangle(system, at);
  Step step{std::vector<double>(p * p), std::vector<double>(p)};
  for (std::size_t j = 0; j < p; ++j) {
    double column = 0;
    for (std::size_t i = 0; i <= j; ++i) column = std::hypot(column, step.R[i * p + j] = QR[i * columns + j]);
    step.angle = std::min(step.angle, column > 0 ? std::abs(step.R[j * p + j]) / column : 0);
    step.reduction += QR[j * columns + p] * QR[j * columns + p];
  }
  for (std::size_t j = p; j-- > 0;) {
    double sum = -QR[j * columns + p];
    for (std::size_t k = j + 1; k < p; ++k) sum -= step.R[j * p + k] * step.delta[k];
    step.delta[j] = sum / step.R[j * p + j];
    step.size = std::max(step.size, std::abs(step.delta[j]) / std::max(1.0, std::abs(at.theta[j])));
  }
  return step;
}

/// Gauss-Newton steps, down to round-off, as long as each takes off the sum of squares at least this share of what it promises;
/// `step` is the one that was not taken.
Minimum polish(const System& system, std::vector<double> theta, double share, Step& step) {
  Minimum best = nowhere(system), next = nowhere(system);
  if (!evaluate_at(system, best, std::move(theta))) fail("the fit cannot start: the law has no finite values at the starting point");
  step = gauss_newton(system, best);
  for (int i = 0; i < 100 && step.angle > undetermined && step.size > std::numeric_limits<double>::epsilon(); ++i) {
    std::vector<double> there = best.theta;
    for (std::size_t j = 0; j < system.p; ++j) there[j] += step.delta[j];
    if (!evaluate_at(system, next, std::move(there)) || !(next.rss <= best.rss * (1 + 1e-10) - share * step.reduction)) break;
    Step after = gauss_newton(system, next);
    if (step.size < 1e-9 && !(after.size < step.size)) break;  // round-off
    std::swap(best, next);
    step = std::move(after);
  }
  return best;
}

}  // namespace

Minimum minimise(const System& system, const std::vector<double>& start) {
  silence_gsl();
  Step step;
  // Where the residuals are linear, or all but so between the start and the minimum, Gauss-Newton steps do all.
  Minimum best = polish(system, start, 0.9, step);
  // Bates & Watts (1981), Technometrics 23, 179: converged when the residuals' part in the tangent plane is small
  // against the part orthogonal to it. An exact fit has nothing orthogonal; there the step itself must vanish.
  const double freedom = system.n > system.p ? static_cast<double>(system.n - system.p) : 0;
  const auto offset = [&] {
    return std::sqrt(step.reduction / static_cast<double>(system.p) * freedom / std::max(best.rss - step.reduction, 0.0));
  };
  const auto determined = [&] { return step.angle > undetermined; };
  const auto converged = [&] { return determined() && (step.size < 1e-7 || offset() < 1e-3); };
  for (int round = 0; !converged() && (round == 0 || determined()); ++round) {
    const double before = best.rss;
    best = polish(system, descend(system, best.theta), 0, step);
    // The minimum of a trajectory fit may lie on a kink, where the stop meets a record: hardly a step goes down, but the slope of
    // either side remains. It is worth a fraction of a standard deviation, never more.
    if (best.rss > before * (1 - std::max(1e-8, 1e-3 / freedom)) && offset() < 1) break;
    if (round == 20) fail("the fit does not converge");
  }
  if (!determined()) fail("the data do not determine the parameters: they cannot be told apart");
  best.R = step.R;
  return best;
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

/// The median absolute residual over that of a standard normal; the p smallest, which the fit has made small, are not counted.
double median_scale(std::vector<double> f, std::size_t p) {
  for (double& x : f) x = std::abs(x);
  std::sort(f.begin(), f.end());
  const std::size_t first = std::min(p, f.size() - 1);
  return f[first + (f.size() - first) / 2] / 0.6745;
}

}  // namespace

Minimum minimise_robust(const System& system, const std::vector<double>& start) {
  Minimum at = nowhere(system);
  at.theta = start;
  double scale = 0;
  for (const auto influence : {huber, bisquare}) {
    double change = 1;
    for (int round = 0; change > 1e-9; ++round) {
      if (round == 100) fail("the robust fit does not converge");
      system.evaluate(at.theta, at.f, at.J);
      if (influence == huber) scale = median_scale(at.f, system.p);  // bisquare keeps the last one
      if (!(scale > 0)) return minimise(system, at.theta);
      std::vector<double> roots;
      for (double r : at.f) roots.push_back(std::sqrt(influence(r / scale).weight));
      const System weighted{system.n, system.p, [&](const std::vector<double>& theta, std::vector<double>& f, std::vector<double>& J) {
        system.evaluate(theta, f, J);
        for (std::size_t i = 0; i < system.n; ++i) {
          f[i] *= roots[i];
          for (std::size_t j = 0; j < system.p; ++j) J[i * system.p + j] *= roots[i];
        }
      }};
      const auto next = minimise(weighted, at.theta).theta;
      change = 0;
      for (std::size_t j = 0; j < system.p; ++j) change = std::max(change, std::abs(next[j] - at.theta[j]) / std::max(1.0, std::abs(next[j])));
      at.theta = next;
      if (influence == huber && change < 1e-3) break;  // only a place to start from
    }
  }
  system.evaluate(at.theta, at.f, at.J);
  at.R = gauss_newton(system, at).R;
  const double n = static_cast<double>(system.n);
  double mean = 0, squares = 0;
  for (double r : at.f) {
    const double slope = bisquare(r / scale).slope;
    mean += slope / n;
    squares += slope * slope / n;
  }
  if (!(mean > 0)) fail("too many outliers: no robust fit");
  const double correction = 1 + static_cast<double>(system.p) / n * (squares - mean * mean) / (mean * mean);
  for (double& r : at.f) r *= bisquare(r / scale).weight * correction / mean;
  at.rss = square(at.f);
  return at;
}

double restricted_likelihood(const System& system, const std::vector<double>& theta) {
  const std::size_t n = system.n, p = system.p;
  Minimum at = nowhere(system);
  at.theta = theta;
  system.evaluate(at.theta, at.f, at.J);
  const Step step = gauss_newton(system, at);
  double log_det = 0;
  for (std::size_t j = 0; j < p; ++j) log_det += std::log(std::abs(step.R[j * p + j]));
  return -0.5 * static_cast<double>(n - p) * std::log(square(at.f) - step.reduction) - log_det;
}

std::vector<double> orthonormal(const Minimum& m) {
  const std::size_t p = m.theta.size(), n = m.f.size();
  std::vector<double> u = m.J;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < p; ++j) {
      double& x = u[i * p + j];
      for (std::size_t k = 0; k < j; ++k) x -= u[i * p + k] * m.R[k * p + j];
      x /= m.R[j * p + j];
    }
  return u;
}

std::vector<double> Spread::solve_transposed(std::vector<double> g) const {
  for (std::size_t j = 0; j < p_; ++j) {
    for (std::size_t k = 0; k < j; ++k) g[j] -= R_[k * p_ + j] * g[k];
    g[j] /= R_[j * p_ + j];
  }
  return g;
}

double Spread::operator()(const std::vector<double>& g, const std::vector<double>& h) const {
  const auto left = solve_transposed(g), right = solve_transposed(h);
  double sum = 0;
  for (std::size_t i = 0; i < p_; ++i)
    for (std::size_t j = 0; j < p_; ++j) sum += left[i] * M_[i * p_ + j] * right[j];
  return sum;
}

}  // namespace rolling
