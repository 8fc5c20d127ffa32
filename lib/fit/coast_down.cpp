// Is D = a v^b the right law? The polynomials of coast-down tests on the same records, compared by AICc.
#include "base/error.h"
#include "fit/routes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rolling {
namespace {

/// The roll under v' = -(alpha + 2 h v + gamma v^2), a Riccati equation: with d^2 = h^2 - alpha gamma, C = cosh(d t), S = sinh(d t)/d,
/// v = (v0 C - (alpha + h v0) S) / (C + (h + gamma v0) S). Where v reaches 0 the body stops.
class CoastDown {
 public:
  CoastDown(double alpha, double h, double gamma, double v0) : alpha_(alpha), h_(h), gamma_(gamma), v0_(v0), d2_(h * h - alpha * gamma) {
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
    const double end = std::min(t, stop_), half = (end - s) / 2, middle = (end + s) / 2, node = half * std::sqrt(0.6);
    return end > s ? half / 9 * (5 * v(middle - node) + 8 * v(middle) + 5 * v(middle + node)) : 0;
  }

 private:
  double alpha_, h_, gamma_, v0_, d2_;
  double stop_ = std::numeric_limits<double>::infinity();
};

/// Residuals with derivatives by central differences: enough for a sum of squares, which is flat at its minimum.
System differenced(std::size_t n, std::size_t p, const KnownNoise& noise,
                   const std::function<std::vector<double>(const std::vector<double>&)>& residuals) {
  return {n, p, [=, &noise](const std::vector<double>& theta, std::vector<double>& f, std::vector<double>& J) {
    f = residuals(theta);
    for (std::size_t j = 0; j < p; ++j) {
      const double step = 1e-6 * std::max(1.0, std::abs(theta[j]));
      auto before = theta, after = theta;
      before[j] -= step;
      after[j] += step;
      const auto low = residuals(before), high = residuals(after);
      for (std::size_t i = 0; i < n; ++i) J[i * p + j] = (high[i] - low[i]) / (2 * step);
    }
    noise.weight(f, J);
  }};
}

double polynomial(const std::vector<double>& c, std::size_t terms, double u) {
  double sum = 0;
  for (std::size_t j = terms; j-- > 0;) sum = sum * u + c[j];
  return sum;
}

/// The least squares of D = polynomial of v with `terms` coefficients, in the route's own residuals; it begins at the minimum with one
/// coefficient less, if there is one, so that it never ends above it.
Minimum fit_polynomial(Route route, const RouteFit& power, const FitOptions& options, std::size_t terms, std::vector<double> simpler) {
  const double a = power.a.value, b = power.b.value;
  double v_ref = 0;
  for (double v : power.v) v_ref = std::max(v_ref, v);
  for (const auto& q : power.v0) v_ref = std::max(v_ref, std::abs(q.value));
  const double D_ref = a * std::pow(v_ref, b);

  // Without one: the polynomial that is closest to the power law over the speeds.
  const std::size_t points = 20;
  const KnownNoise none;
  std::vector<double> theta = minimise(differenced(points, terms, none, [&](const std::vector<double>& c) {
    std::vector<double> f;
    for (std::size_t i = 1; i <= points; ++i) {
      const double u = static_cast<double>(i) / points;
      f.push_back(polynomial(c, terms, u) - std::pow(u, b));
    }
    return f;
  }), std::vector<double>(terms, 1)).theta;

  if (!simpler.empty()) {
    theta = std::move(simpler);
    theta.insert(theta.begin() + static_cast<std::ptrdiff_t>(terms) - 1, 0);
  }

  const std::size_t n = power.residuals.size();
  if (power.rolls.empty())  // what smoothing does to the law is taken as it is under the power law
    return minimise(differenced(n, terms, power.noise, [&](const std::vector<double>& c) {
      std::vector<double> f;
      for (std::size_t i = 0; i < n; ++i) {
        const double law = a * std::pow(power.v[i], b), D = D_ref * polynomial(c, terms, power.v[i] / v_ref);
        if (route == Route::loglog && !(D > 0)) fail("no logarithm");
        f.push_back((route == Route::loglog ? std::log(D / law) : D - law) + power.residuals[i]);
      }
      return f;
    }), theta);

  const bool position = route == Route::position, free_x0 = position && !options.x0;
  double x_ref = 1;
  for (const auto& roll : power.rolls) x_ref = std::max(x_ref, std::abs(roll.y.back() - roll.y.front()));
  const bool alone = theta.size() == terms;
  for (std::size_t r = 0; alone && r < power.rolls.size(); ++r) {
    if (!options.v0) theta.push_back(std::abs(power.v0[r].value) / v_ref);
    if (free_x0) theta.push_back(power.x0[r].value / x_ref);
  }
  return minimise(differenced(n, theta.size(), power.noise, [&](const std::vector<double>& c) {
    std::vector<double> f;
    std::size_t next = terms;
    for (const auto& roll : power.rolls) {
      const double v0 = options.v0 ? std::abs(*options.v0) : c[next++] * v_ref, x0 = free_x0 ? c[next++] * x_ref : options.x0.value_or(0);
      const double unit = roll.body.g / ((roll.body.K + 1) * roll.body.R) * D_ref;
      const CoastDown coast(unit * c[0], terms > 1 ? unit * c[1] / v_ref / 2 : 0, terms > 2 ? unit * c[2] / (v_ref * v_ref) : 0, v0);
      std::vector<double> raw;
      double last = 0, x = 0;
      for (double t : roll.model_t) {
        x += coast.way(last, t);
        last = t;
        raw.push_back(roll.raw_is_position ? x0 + roll.way * x : roll.way * coast.v(t));
      }
      for (std::size_t i = 0; i < roll.y.size(); ++i) f.push_back((roll.filters.rows() ? roll.filters.times(i, raw) : raw[i]) - roll.y[i]);
    }
    return f;
  }), theta);
}

}  // namespace

std::vector<LawScore> compare_laws(Route route, const std::vector<FitRun>& runs, const FitOptions& options) {
  if (options.robust) fail("laws are compared by squares only");
  const RouteFit power = fit_route(route, runs, options);
  std::vector<Minimum> minima{power.minimum};
  for (std::size_t terms = 1; terms <= 3; ++terms) try {
      minima.push_back(fit_polynomial(route, power, options, terms, terms > 1 ? minima.back().theta : std::vector<double>{}));
    } catch (const Error&) {  // it has no minimum on these records
      minima.emplace_back().rss = std::numeric_limits<double>::infinity();
    }
  const double n = static_cast<double>(power.residuals.size());
  double correlation = 1;
  for (const auto& m : minima)
    if (m.rss > 0 && std::isfinite(m.rss)) correlation = std::min(correlation, lagged(m.f, power.runs, 1) / m.rss);
  const double independent = correlation > 0 && correlation < 1 ? n * (1 - correlation) / (1 + correlation) : n;
  std::vector<LawScore> scores;
  constexpr const char* names[] = {"a v^b", "d0", "d0 + d1 v", "d0 + d1 v + d2 v^2"};
  for (const auto& m : minima) {
    const double k = static_cast<double>(m.theta.size()) + 1;  // and the size of the noise
    const double aicc = independent * std::log(std::max(m.rss, std::numeric_limits<double>::min()) / n) + 2 * k + 2 * k * (k + 1) / (independent - k - 1);
    scores.push_back({names[scores.size()], independent > k + 1 ? aicc : std::numeric_limits<double>::infinity()});
  }
  return scores;
}

}  // namespace rolling
