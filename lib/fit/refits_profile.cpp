// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/refits.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/matrix.h"
#include "fit/fitted.h"
#include "fit/routes.h"
#include "least_squares/minimise.h"
#include "statistics/levels.h"

namespace rolling {
namespace {

/// The raw columns of a fit at a few times of each run.
System few_rows(const Fitted& fit) {
  constexpr std::size_t few = 24;
  std::vector<ObservedRun> runs = fit.model.runs();
  for (ObservedRun& run : runs) {
    std::vector<double> times;
    const std::size_t n = run.t.size();
    const std::size_t rows = std::min(n, few);
    for (std::size_t i = 0; i < rows; ++i)
      times.push_back(run.t[rows > 1 ? i * (n - 1) / (rows - 1) : 0]);
    run.t = std::move(times);
    run.y.assign(rows, 0);
    run.H = {};
  }
  return system_of({std::move(runs), fit.parameters()});
}

/// The size of what is not linear on this step from the minimum, relative to what is, in these
/// columns. Throws Error if the model has no values there.
double bend(const Fitted& fit, const System& columns, const std::vector<double>& step) {
  const std::vector<double>& minimum = fit.minimum.theta;
  const bool without_mean = fit.model.means_taken() > 0;  // filters took that of positions away
  const std::vector<double> here = evaluated(columns, minimum).f;
  const std::vector<double> ahead = evaluated(linearised(columns, minimum), step).f;
  const std::vector<double> there = evaluated(columns, moved(minimum, step)).f;
  const auto squares = [&](std::vector<double> to, const std::vector<double>& from) {
    std::ranges::transform(to, from, to.begin(), std::minus());
    for (const auto run : by_run(to, columns.runs)) {
      double mean = 0;
      if (without_mean)
        mean = std::accumulate(run.begin(), run.end(), 0.0) / static_cast<double>(run.size());
      for (double& x : run) x -= mean;
    }
    return dot(to, to);
  };
  return std::sqrt(squares(there, ahead) / squares(ahead, here));
}

/// The profile of one number of a fit: how the sum of squares rises if the number is held at
/// another value and all parameters are fitted again. Where they would go behind the wall of b = 0,
/// they go along it.
class Profile {
 public:
  /// `sigma` is the standard error of number j; `wall` is the fit with b = 0, if that is a wall.
  Profile(const Fitted& fit, std::size_t j, double sigma, const Fitted* wall = nullptr)
      : fit_(fit), wall_(wall), j_(j), best_(fit.numbers()[j]), sigma_(sigma) {
    std::vector<double> g = best_.gradient;
    fit.minimum.R.solve_transposed(0, g);
    variance_ = dot(g, g);
  }
  double value() const { return best_.value; }
  double sigma() const { return sigma_; }

  /// A place of the profile.
  struct Visit {
    const Fitted* fit;    ///< whose parameters those of the minimum are
    double to = 0;        ///< the change of the number that was asked for
    double change = 0;    ///< of the number
    double distance = 0;  ///< in standard errors, as the sum of squares shows it; infinite if no
                          ///< fit was found
    bool is_end = false;  ///< there is no roll beyond
    Minimum minimum = {};
  };
  Visit start() const { return {&fit_, 0, 0, 0, false, fit_.minimum}; }
  /// The number at another theta of one of the two fits.
  FittedNumber at(const Fitted& fit, const std::vector<double>& theta) const {
    // In three statements: where memory fails in a later part of an aggregate, g++ 12 and 14
    // destroy a part twice.
    Fitted there;
    there.minimum.theta = theta;
    there.model = fit.model;
    read_off(there);
    return there.numbers()[j_];
  }
  /// The step from a place to where the number would have changed by this if the model were linear.
  std::vector<double> ahead(const Visit& from, double change) const {
    return from.minimum.R.step_that_changes(at(*from.fit, from.minimum.theta).gradient,
                                            change - from.change);
  }
  /// Fits with the number changed by this, as far as it can: the better one of the fits on this
  /// side of the wall and on it. The search starts at a place nearby, and ahead of it.
  Visit visit(double to, const Visit& from) const {
    if (!wall_) return searched(to, from);
    Visit wall = at_wall();
    const bool is_b = j_ == 1;  // the coefficients a and b are the first numbers
    if (from.fit == wall_) return is_b ? wall : searched(to, from);
    const std::vector<double> theta = moved(from.minimum.theta, ahead(from, to));
    const bool behind = fit_.parameters().law(theta).power()->b < 0;
    if (is_b && behind && std::abs(wall.change) < std::abs(to)) return wall;
    if (is_b) return searched(to, from);
    Visit along = searched(to, wall);
    if (behind) return along;
    Visit before = searched(to, from);
    return along.minimum.rss < before.minimum.rss ? along : before;
  }

 private:
  Visit at_wall() const {
    const double last = wall_->numbers()[j_].value - best_.value;
    return {wall_, last, last, distance(wall_->minimum.rss), true, wall_->minimum};
  }
  Visit searched(double to, const Visit& from) const {
    const double change = to * (1 + 1 / (pull * pull));  // as the other rows pull it back
    const System system = held(*from.fit, best_.value + change);
    Visit there{from.fit, to, to, INFINITY};
    improve(there.minimum, system, moved(from.minimum.theta, ahead(from, change)));
    improve(there.minimum, system, from.minimum.theta);
    if (!std::isfinite(there.minimum.rss)) return there;
    there.change = at(*from.fit, there.minimum.theta).value - best_.value;
    const double row = weight() * (there.change - change);
    there.distance = distance(there.minimum.rss - row * row);
    return there;
  }
  double distance(double squares) const {
    return std::sqrt(std::max(squares - fit_.minimum.rss, 0.0) * variance_) / sigma_;
  }
  static constexpr double pull = 5;
  double weight() const { return pull / std::sqrt(variance_); }

  /// The system with one more row of the first run, which pulls the number to a value. A larger
  /// weight would make a narrow valley of it, in which a search is slow.
  System held(const Fitted& fit, double value) const {
    System system = fit.system();
    ++system.runs.front();
    system.rough = true;
    system.evaluate = [this, value, of = &fit, rows = fit.system()](
                          const std::vector<double>& theta, const TakeRows& take) {
      rows.evaluate(theta, [&](std::size_t run, std::span<double> f, std::span<double> J) {
        take(run, f, J);
        if (run > 0) return;
        FittedNumber number = at(*of, theta);
        double off = weight() * (number.value - value);
        for (double& by : number.gradient) by *= weight();
        take(run, {&off, 1}, number.gradient);
      });
    };
    return system;
  }

  const Fitted& fit_;
  const Fitted* wall_;
  std::size_t j_;
  FittedNumber best_;
  double sigma_;
  double variance_;  // of the number, for residuals of variance one
};

constexpr double normal = 1.96;  // the 95 % of a normal distribution lie within so many sigma

/// True if the number or the model is so far from linear over its interval that only fits can tell
/// what the interval covers.
bool in_doubt(const System& columns, const Profile& profile) {
  constexpr double rounding = 1e-7;  // a step in theta whose bend is not seen
  const Profile::Visit start = profile.start();
  const std::vector<double>& theta = start.minimum.theta;
  for (const double change : {-normal * profile.sigma(), normal * profile.sigma()}) try {
      const std::vector<double> step = profile.ahead(start, change);
      if (relative_size(step, theta) < rounding) continue;
      const double there = profile.at(*start.fit, moved(theta, step)).value;
      const double off = (there - profile.value()) / change - 1;
      if (!(std::abs(off) < levels::bent && bend(*start.fit, columns, step) < levels::bent))
        return true;
    } catch (const Error&) {  // there is no roll
      return true;
    }
  return false;
}

/// True if the number can change so far, and the sum of squares has risen as it should.
bool as_expected(const Profile& profile, const Profile::Visit& at) {
  if (at.is_end) return false;
  const double rise = std::pow(at.distance * profile.sigma() / at.change, 2);
  return rise < levels::rise && rise > 1 / levels::rise;
}

/// The change of the number, in the direction of this first visit, at which the sum of squares has
/// risen by that of 95 %; infinite if it does not rise so far within ten times the linear interval.
/// A wall is an end too, also one that only shows by a number that hardly moves.
double end_of_interval(const Profile& profile, Profile::Visit far) {
  constexpr int most = 10;
  const auto is_end = [](const Profile::Visit& at) {
    return std::abs(at.distance - normal) < 0.05;
  };
  Profile::Visit near = profile.start();
  const double widest = 10 * normal * profile.sigma();
  for (int i = 0; i < most && !is_end(far); ++i) {
    const bool hardly_moves = std::abs(far.change) < std::abs(far.to) / 10;
    if (far.distance < normal && (far.is_end || hardly_moves)) return far.change;
    if (far.distance < normal && std::abs(far.to) > widest) break;
    double to = near.to == 0 ? far.to / 8 : (near.to + far.to) / 2;
    const bool beyond = far.distance > normal;
    if (!beyond) {
      to = far.to * std::clamp(normal / far.distance, 1.2, 4.0);
      if (far.distance < normal / 4) to = std::copysign(1.01 * widest, far.to);
      near = far;
    } else if (std::isfinite(far.distance)) {
      const double share = (normal - near.distance) / (far.distance - near.distance);
      to = near.to + std::clamp(share, 0.1, 0.9) * (far.to - near.to);
    }
    Profile::Visit next = profile.visit(to, near);
    if (is_end(next) || !beyond || next.distance > normal) far = std::move(next);
    else near = std::move(next);
  }
  if (is_end(far)) return far.change;
  return far.distance < normal ? INFINITY : near.change;
}

/// The fit with b = 0, if this is a wall. It is none where the body rolls alike just behind it: a
/// mat that holds it at rest holds it for b < 0 as well.
std::optional<Fitted> fit_at_wall(const Fitted& fit) {
  const auto wall = minimum_at_wall(fit.model, fit.minimum.theta);
  if (!wall) return {};
  const Parameters& q = fit.parameters();
  const std::size_t exponent = q.count() - q.scene() - 1;
  std::vector<double> theta = wall->theta;
  theta[exponent] = -1e-6;
  const double variance = fit.minimum.rss / static_cast<double>(fit.degrees_left());
  if (tried(fit.system(), theta).rss < wall->rss + variance) return {};
  Fitted held = fit;
  held.model = fit.model.with(q.with(q.first_of_law + 1, 0));
  theta.erase(theta.begin() + static_cast<std::ptrdiff_t>(exponent));
  held.minimum = evaluated(held.system(), std::move(theta));
  read_off(held);
  return held;
}

}  // namespace

std::vector<Interval> intervals_not_visited(const Fitted& of_all, const Uncertainty& noise,
                                            const FitOptions& options) {
  std::vector<Interval> found;
  const std::size_t shared = of_all.coefficients.size() + of_all.scene.size();
  const System few = few_rows(of_all);
  std::vector<std::size_t> doubtful;
  for (std::size_t j = 0; j < shared; ++j) {
    const double sigma = std::sqrt(noise.covariance[j][j]);
    if (sigma > 0 && in_doubt(few, Profile(of_all, j, sigma))) doubtful.push_back(j);
  }
  if (doubtful.empty()) return found;
  const Fitted fit = of_means(of_all, options);
  const auto wall = fit_at_wall(fit);
  for (const std::size_t j : doubtful) {
    const Profile profile(fit, j, std::sqrt(noise.covariance[j][j]), wall ? &*wall : nullptr);
    const double change = normal * profile.sigma();
    Profile::Visit below = profile.visit(-change, profile.start());
    Profile::Visit above = profile.visit(change, profile.start());
    if (as_expected(profile, below) && as_expected(profile, above)) continue;
    found.push_back({j, profile.value() - std::abs(end_of_interval(profile, std::move(below))),
                     profile.value() + end_of_interval(profile, std::move(above))});
    if (std::isinf(found.back().lower) && std::isinf(found.back().upper)) break;  // refused
  }
  return found;
}

}  // namespace rolling
