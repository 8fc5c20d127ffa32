// Is D = a v^b the right law? The polynomials of coast-down tests on the same records, compared by
// AICc.
#include "base/error.h"
#include "fit/routes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rolling {
namespace {

/// The roll under v' = -(alpha + 2 h v + gamma v^2), a Riccati equation: with d^2 = h^2 - alpha
/// gamma, C = cosh(d t), S = sinh(d t)/d, v = (v0 C - (alpha + h v0) S) / (C + (h + gamma v0) S).
/// Where v reaches 0 the body stops.
class CoastDown {
 public:
  CoastDown(double alpha, double h, double gamma, double v0)
      : alpha_(alpha), h_(h), gamma_(gamma), v0_(v0), d2_(h * h - alpha * gamma) {
    const double d = std::sqrt(std::abs(d2_)), down = alpha + h * v0;
    if (d2_ < 0) stop_ = std::atan2(d * v0, down) / d;
    else if (down > d * v0) stop_ = d > 0 ? std::atanh(d * v0 / down) / d : v0 / down;
  }
  double stop_time() const { return stop_; }
  double v(double t) const {
    if (t >= stop_) return 0;
    const double d = std::sqrt(std::abs(d2_)), C = d2_ < 0 ? std::cos(d * t) : std::cosh(d * t);
    const double S = d * t < 1e-6 ? t : (d2_ < 0 ? std::sin(d * t) : std::sinh(d * t)) / d;
    const double below = C + (h_ + gamma_ * v0_) * S;
    if (!(below > 0) || !std::isfinite(below)) fail("the speed grows without bound");
    return (v0_ * C - (alpha_ + h_ * v0_) * S) / below;
  }
  /// The way from time s to t, by Gauss and Legendre with three points.
  double way(double s, double t) const {
    const double end = std::min(t, stop_), half = (end - s) / 2, middle = (end + s) / 2,
                 node = half * std::sqrt(0.6);
    return end > s ? half / 9 * (5 * v(middle - node) + 8 * v(middle) + 5 * v(middle + node)) : 0;
  }

 private:
  double alpha_, h_, gamma_, v0_, d2_;
  double stop_ = std::numeric_limits<double>::infinity();
};

/// Residuals with derivatives by central differences: enough for a sum of squares, which is flat at
/// its minimum. Those by the own parameters of all runs are taken at once.
System differenced(
    const std::vector<std::size_t>& runs, std::size_t own, std::size_t shared,
    const KnownNoise& noise,
    const std::function<std::vector<double>(const std::vector<double>&)>& residuals) {
  const System shape{runs, own, shared, {}};
  return {runs, own, shared, [=, &noise](const std::vector<double>& theta, const TakeRows& take) {
            const auto step = [&](std::size_t run, std::size_t column) {
              return 1e-6 * std::max(1.0, std::abs(theta[shape.place(run, column)]));
            };
            const auto f = residuals(theta);
            std::vector<std::vector<double>> low, high;
            for (std::size_t j = 0; j < shape.columns(); ++j) {
              auto before = theta, after = theta;
              for (std::size_t r = 0; r < (j < own ? runs.size() : 1); ++r) {
                before[shape.place(r, j)] -= step(r, j);
                after[shape.place(r, j)] += step(r, j);
              }
              low.push_back(residuals(before));
              high.push_back(residuals(after));
            }
            hand_over_rows(runs, shape.columns(), !noise.empty(), noise, take,
                           [&](std::size_t r, std::size_t first, std::vector<double>& part,
                               std::vector<double>& J) {
      for (std::size_t i = 0; i < part.size(); ++i) {
        part[i] = f[first + i];
        for (std::size_t j = 0; j < shape.columns(); ++j)
          J[j * part.size() + i] = (high[j][first + i] - low[j][first + i]) / (2 * step(r, j));
      }
            });
          }};
}

double polynomial(std::span<const double> c, double u) {
  double sum = 0;
  for (std::size_t j = c.size(); j-- > 0;) sum = sum * u + c[j];
  return sum;
}

/// The least squares of D = polynomial of v with `terms` coefficients, in the route's own
/// residuals; it begins at the minimum with one coefficient less, if there is one, so that it never
/// ends above it.
Minimum fit_polynomial(Route route, const RouteFit& power, const FitOptions& options,
                       std::size_t terms, std::vector<double> simpler) {
  const double a = power.a.value, b = power.b.value;
  double v_ref = 0;
  for (double log_u : power.log_u) v_ref = std::max(v_ref, std::exp(log_u + power.log_v_ref));
  for (const auto& q : power.v0) v_ref = std::max(v_ref, std::abs(q.value));
  const double D_ref = a * std::pow(v_ref, b);

  // Without one: the polynomial that is closest to the power law over the speeds.
  const std::size_t points = 20;
  const KnownNoise none;
  std::vector<double> theta = minimise(differenced(
                                           {points}, 0, terms, none,
                                           [&](const std::vector<double>& c) {
    std::vector<double> f;
    for (std::size_t i = 1; i <= points; ++i) {
      const double u = static_cast<double>(i) / points;
      f.push_back(polynomial(c, u) - std::pow(u, b));
    }
    return f;
                                           }),
                                       std::vector<double>(terms, 1))
      .theta;

  if (!simpler.empty()) {
    theta = std::move(simpler);
    theta.push_back(0);
  }

  const auto& residuals = power.plain.empty() ? power.minimum.f : power.plain;
  if (power.rolls.empty())  // what smoothing does to the law is taken as it is under the power law
    return minimise(differenced(
                        power.runs, 0, terms, power.noise,
                        [&](const std::vector<double>& c) {
      std::vector<double> f;
      for (std::size_t i = 0; i < residuals.size(); ++i) {
        const double v = std::exp(power.log_u[i] + power.log_v_ref), law = a * std::pow(v, b),
                     D = D_ref * polynomial(c, v / v_ref);
        if (route == Route::loglog && !(D > 0)) fail("no logarithm");
        f.push_back((route == Route::loglog ? std::log(D / law) : D - law) + residuals[i]);
      }
      return f;
                        }),
                    theta);

  const bool position = route == Route::position, free_x0 = position && !options.x0;
  double x_ref = 1;
  for (const auto& roll : power.rolls)
    x_ref = std::max(x_ref, std::abs(roll.y.back() - roll.y.front()));
  const std::size_t own = !options.v0 + free_x0, runs = power.rolls.size();
  if (theta.size() == terms) {
    std::vector<double> of_runs;
    for (std::size_t r = 0; r < runs; ++r) {
      if (!options.v0) of_runs.push_back(std::abs(power.v0[r].value) / v_ref);
      if (free_x0) of_runs.push_back(power.x0[r].value / x_ref);
    }
    theta.insert(theta.begin(), of_runs.begin(), of_runs.end());
  }
  return minimise(differenced(
                      power.runs, own, terms, power.noise,
                      [&](const std::vector<double>& c) {
    std::vector<double> f;
    const auto law = std::span(c).last(terms);
    std::size_t next = 0;
    for (const auto& roll : power.rolls) {
      const double v0 = options.v0 ? std::abs(*options.v0) : c[next++] * v_ref,
                   x0 = free_x0 ? c[next++] * x_ref : options.x0.value_or(0);
      const double unit = roll.body.g / ((roll.body.K + 1) * roll.body.R) * D_ref;
      const CoastDown coast(unit * law[0], terms > 1 ? unit * law[1] / v_ref / 2 : 0,
                            terms > 2 ? unit * law[2] / (v_ref * v_ref) : 0, v0);
      std::vector<double> raw;
      double last = 0, x = 0;
      for (double t : roll.filters.rows() ? roll.raw_t : roll.t) {
        x += coast.way(last, t);
        last = t;
        raw.push_back(roll.raw_is_position ? x0 + roll.way * x : roll.way * coast.v(t));
      }
      for (std::size_t i = 0; i < roll.y.size(); ++i)
        f.push_back((roll.filters.rows() ? roll.filters.times(i, raw) : raw[i]) - roll.y[i]);
    }
    return f;
                      }),
                  theta);
}

}  // namespace

std::vector<LawScore> compare_laws(Route route, const std::vector<FitRun>& runs,
                                   const FitOptions& options) {
  if (options.robust) fail("laws are compared by squares only");
  const RouteFit power = fit_route(route, runs, options);
  std::vector<Minimum> minima{power.minimum};
  for (std::size_t terms = 1; terms <= 3; ++terms) try {
      minima.push_back(fit_polynomial(route, power, options, terms,
                                      terms > 1 ? minima.back().theta : std::vector<double>{}));
    } catch (const Error&) {  // it has no minimum on these records
      minima.emplace_back().rss = std::numeric_limits<double>::infinity();
    }
  const double n = static_cast<double>(power.minimum.f.size());
  double correlation = 1;
  for (const auto& m : minima)
    if (m.rss > 0 && std::isfinite(m.rss))
      correlation = std::min(correlation, lagged(m.f, power.runs, 1) / m.rss);
  const double independent =
      correlation > 0 && correlation < 1 ? n * (1 - correlation) / (1 + correlation) : n;
  std::vector<LawScore> scores;
  constexpr const char* names[] = {"a v^b", "d0", "d0 + d1 v", "d0 + d1 v + d2 v^2"};
  for (const auto& m : minima) {
    const double k = static_cast<double>(m.theta.size()) + 1;  // and the size of the noise
    const double aicc =
        independent * std::log(std::max(m.rss, std::numeric_limits<double>::min()) / n) + 2 * k +
        2 * k * (k + 1) / (independent - k - 1);
    scores.push_back({names[scores.size()],
                      independent > k + 1 ? aicc : std::numeric_limits<double>::infinity()});
  }
  return scores;
}

}  // namespace rolling
