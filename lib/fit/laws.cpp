#include "fit/laws.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "contact/contact.h"
#include "fit/errors.h"

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

using Residuals = std::function<std::vector<double>(const std::vector<double>&)>;

/// Residuals with derivatives by central differences: enough for a sum of squares, which is flat at
/// its minimum. Those by the own parameters of all runs are taken at once.
System differenced(const System& shape, std::shared_ptr<const Noise> noise, Residuals residuals) {
  System system = shape;
  system.evaluate = [=](const std::vector<double>& theta, const TakeRows& take) {
    const auto step = [&](std::size_t run, std::size_t column) {
      return 1e-6 * std::max(1.0, std::abs(theta[shape.place(run, column)]));
    };
    const auto f = residuals(theta);
    std::vector<std::vector<double>> low, high;
    for (std::size_t j = 0; j < shape.columns(); ++j) {
      auto before = theta, after = theta;
      for (std::size_t r = 0; r < (j < shape.own ? shape.runs.size() : 1); ++r) {
        before[shape.place(r, j)] -= step(r, j);
        after[shape.place(r, j)] += step(r, j);
      }
      low.push_back(residuals(before));
      high.push_back(residuals(after));
    }
    std::size_t first = 0;
    for (std::size_t r = 0; r < shape.runs.size(); ++r) {
      const std::size_t n = shape.runs[r];
      std::vector<double> part(&f[first], &f[first] + n), J(n * shape.columns());
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < shape.columns(); ++j)
          J[j * n + i] = (high[j][first + i] - low[j][first + i]) / (2 * step(r, j));
      if (noise->weighted()) noise->weight(r, part, J);
      take(r, part, J);
      first += n;
    }
  };
  return system;
}

double polynomial(std::span<const double> c, double u) {
  double sum = 0;
  for (std::size_t j = c.size(); j-- > 0;) sum = sum * u + c[j];
  return sum;
}

/// A polynomial D(v) = D_ref p(v / v_ref), on the records and with the weights of a power law that
/// has been fitted.
class Polynomial {
 public:
  Polynomial(Route route, Fitted power, const FitOptions& options)
      : route_(route), power_(std::move(power)), options_(options) {
    for (double v : power_.v) v_ref_ = std::max(v_ref_, v);
    for (const auto& q : power_.v0) v_ref_ = std::max(v_ref_, std::abs(q.value));
    D_ref_ = PowerLaw{power_.a.value, power_.b.value}(v_ref_);
    if (power_.rolls)
      for (const auto& run : power_.rolls->runs())
        x_ref_ = std::max(x_ref_, std::abs(run.y.back() - run.y.front()));
  }

  /// The minimum with so many coefficients. The search begins at the one with a coefficient less,
  /// if there is one, so that it never ends above it.
  Minimum fit(std::size_t terms, std::vector<double> simpler) const {
    System shape = power_.system;
    const bool of_rolls = power_.rolls != nullptr;
    shape.own = of_rolls ? !options_.v0 + free_x0() : 0;
    shape.shared = terms;
    std::vector<double> theta = simpler.empty() ? start(terms) : std::move(simpler);
    if (theta.size() < shape.parameters()) theta.push_back(0);
    return minimise(
        differenced(
            shape, power_.noise,
            [&](const std::vector<double>& c) { return of_rolls ? of_roll(c, terms) : of_law(c); }),
        theta);
  }

 private:
  bool free_x0() const { return route_ == Route::position && !options_.x0; }

  /// The polynomial that is closest to the power law over the speeds.
  std::vector<double> start(std::size_t terms) const {
    constexpr std::size_t points = 20;
    const double b = power_.b.value;
    const System shape{{points}, 0, terms, {}};
    const auto c = minimise(differenced(
                                shape, std::make_shared<const Noise>(),
                                [=](const std::vector<double>& trial) {
      std::vector<double> f;
      for (std::size_t i = 1; i <= points; ++i) {
        const double u = static_cast<double>(i) / points;
        f.push_back(polynomial(trial, u) - std::pow(u, b));
      }
      return f;
                                }),
                            std::vector<double>(terms, 1))
        .theta;
    std::vector<double> theta;
    for (std::size_t r = 0; r < power_.v0.size(); ++r) {
      if (!options_.v0) theta.push_back(std::abs(power_.v0[r].value) / v_ref_);
      if (free_x0())
        theta.push_back(power_.rolls->parameters().x0(power_.minimum.theta, r) / x_ref_);
    }
    theta.insert(theta.end(), c.begin(), c.end());
    return theta;
  }

  /// The residuals of the law itself: by how much it differs from the power law, and those of that.
  std::vector<double> of_law(const std::vector<double>& c) const {
    std::vector<double> f;
    for (std::size_t i = 0; i < power_.v.size(); ++i) {
      const double v = power_.v[i], law = PowerLaw{power_.a.value, power_.b.value}(v),
                   D = D_ref_ * polynomial(c, v / v_ref_);
      if (route_ == Route::loglog && !(D > 0)) fail("no logarithm");
      f.push_back((route_ == Route::loglog ? std::log(D / law) : D - law) + power_.minimum.f[i]);
    }
    return f;
  }

  std::vector<double> of_roll(const std::vector<double>& c, std::size_t terms) const {
    std::vector<double> f;
    const auto law = std::span(c).last(terms);
    std::size_t next = 0, r = 0;
    for (const auto& run : power_.rolls->runs()) {
      const double v0 = options_.v0 ? std::abs(*options_.v0) : c[next++] * v_ref_,
                   x0 = free_x0() ? c[next++] * x_ref_ : options_.x0.value_or(0);
      Body body = run.body;
      body.slope = power_.rolls->slope(power_.minimum.theta, r++);  // that of the power law
      const auto [cos, sin] = incline(body);
      const double unit = body.g * cos / ((body.K + 1) * body.R) * D_ref_;
      const CoastDown coast(unit * law[0] + body.g * sin / (body.K + 1),
                            terms > 1 ? unit * law[1] / v_ref_ / 2 : 0,
                            terms > 2 ? unit * law[2] / (v_ref_ * v_ref_) : 0, v0);
      std::vector<double> raw;
      double last = 0, x = 0;
      for (double t : run.t) {
        x += coast.way(last, t);
        last = t;
        raw.push_back(run.raw_is_position ? x0 + run.way * x : run.way * coast.v(t));
      }
      for (std::size_t i = 0; i < run.y.size(); ++i)
        f.push_back((run.H ? run.H->times(i, raw) : raw[i]) - run.y[i]);
    }
    return f;
  }

  Route route_;
  Fitted power_;
  FitOptions options_;
  double v_ref_ = 0, D_ref_ = 1, x_ref_ = 1;
};

/// How many independent records there are, by the law that leaves the least correlation.
double independent_records(const std::vector<Minimum>& minima,
                           const std::vector<std::size_t>& runs) {
  const double n = static_cast<double>(minima.front().f.size());
  double r = 1;
  for (const auto& m : minima)
    if (m.rss > 0 && std::isfinite(m.rss)) r = std::min(r, lagged(m.f, runs, 1) / m.rss);
  return r > 0 && r < 1 ? n * (1 - r) / (1 + r) : n;
}

}  // namespace

std::vector<LawScore> compare_laws(Route route, const std::vector<FitRun>& runs,
                                   const FitOptions& options) {
  if (options.robust) fail("laws are compared by squares only");
  const Fitted power = fit_route(route, runs, options);
  const Polynomial polynomials(route, power, options);
  std::vector<Minimum> minima{power.minimum};
  for (std::size_t terms = 1; terms <= 3; ++terms) try {
      minima.push_back(
          polynomials.fit(terms, terms > 1 ? minima.back().theta : std::vector<double>{}));
    } catch (const Error&) {  // it has no minimum on these records
      minima.emplace_back().rss = std::numeric_limits<double>::infinity();
    }
  const double n = static_cast<double>(power.minimum.f.size()),
               independent = independent_records(minima, power.system.runs);
  std::vector<LawScore> scores;
  constexpr const char* names[] = {"a v^b", "d0", "d0 + d1 v", "d0 + d1 v + d2 v^2"};
  for (const auto& m : minima) {
    const double k = static_cast<double>(m.theta.size()) + 1;  // and the size of the noise
    const double aicc =
        independent * std::log(std::max(m.rss, std::numeric_limits<double>::min()) / n) + 2 * k +
        2 * k * (k + 1) / (independent - k - 1);
    scores.push_back({names[scores.size()],
                      independent > k + 1 ? aicc : std::numeric_limits<double>::infinity(),
                      scores.size() < 2});
  }
  return scores;
}

}  // namespace rolling
