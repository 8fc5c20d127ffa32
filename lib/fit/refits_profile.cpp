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

/// The raw columns of a fit at a few times of each run, and what they are if the model is linear
/// around the minimum.
struct FewRows {
  System columns;
  System linear;
  bool without_mean;  // the filters have taken the mean of positions away
};

FewRows few_rows(const Fitted& fit) {
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
  const System columns = system_of(Model(std::move(runs), fit.parameters()));
  return {columns, linearised(columns, fit.minimum.theta),
          means_taken(fit.model.runs(), fit.parameters()) > 0};
}

/// The size of what is not linear on this step from the minimum, relative to what is. Throws Error
/// if the model has no values there.
double bend(const FewRows& rows, const std::vector<double>& minimum,
            const std::vector<double>& step) {
  const std::vector<double> here = evaluated(rows.columns, minimum).f;
  const std::vector<double> ahead = evaluated(rows.linear, step).f;
  const std::vector<double> there = evaluated(rows.columns, moved(minimum, step)).f;
  const auto squares = [&](std::vector<double> to, const std::vector<double>& from) {
    std::ranges::transform(to, from, to.begin(), std::minus());
    for (const auto run : by_run(to, rows.columns.runs)) {
      double mean = 0;
      if (rows.without_mean)
        mean = std::accumulate(run.begin(), run.end(), 0.0) / static_cast<double>(run.size());
      for (double& x : run) x -= mean;
    }
    return dot(to, to);
  };
  return std::sqrt(squares(there, ahead) / squares(ahead, here));
}

/// The profile of one number of a fit: how the sum of squares rises if the number is held at
/// another value and all parameters are fitted again.
class Profile {
 public:
  /// `sigma` is the standard error of number j, `wall` the minimum_at_wall().
  Profile(const Fitted& fit, std::size_t j, double sigma, std::optional<Minimum> wall = {})
      : fit_(fit), j_(j), best_(fit.numbers()[j]), sigma_(sigma), wall_(std::move(wall)) {
    std::vector<double> g = best_.gradient;
    fit.minimum.R.solve_transposed(0, g);
    variance_ = dot(g, g);
  }
  double value() const { return best_.value; }
  double sigma() const { return sigma_; }

  /// A place of the profile.
  struct Visit {
    double to = 0;         ///< the change of the number that was asked for
    double change = 0;     ///< of the number
    double distance = 0;   ///< in standard errors, as the sum of squares shows it; infinite if no
                           ///< fit was found
    bool at_wall = false;  ///< there is no roll beyond
    Minimum minimum = {};
  };
  Visit start() const { return {0, 0, 0, false, fit_.minimum}; }
  /// The number at another theta.
  FittedNumber at(const std::vector<double>& theta) const {
    // In three statements: where memory fails in a later part of an aggregate, g++ 12 and 14
    // destroy a part twice.
    Fitted there;
    there.minimum.theta = theta;
    there.model = fit_.model;
    read_off(there);
    return there.numbers()[j_];
  }
  /// The step from a place to where the number would have changed by this if the model were linear.
  std::vector<double> ahead(const Visit& from, double change) const {
    return from.minimum.R.step_that_changes(at(from.minimum.theta).gradient, change - from.change);
  }
  /// Fits with the number changed by this, as far as it can. The search starts at a place nearby,
  /// and ahead of it, unless that is behind the wall.
  Visit visit(double to, const Visit& from) const {
    const double change = to * (1 + 1 / (pull * pull));  // as the other rows pull it back
    const std::vector<double> start = moved(from.minimum.theta, ahead(from, change));
    if (wall_ && fit_.parameters().law(start).power()->b < 0) {
      const double last = at(wall_->theta).value - best_.value;
      if (std::abs(last) < std::abs(to)) return {last, last, distance(wall_->rss), true, *wall_};
    }
    const System system = held(best_.value + change);
    Visit there{to, to, INFINITY};
    improve(there.minimum, system, start);
    improve(there.minimum, system, from.minimum.theta);
    if (!std::isfinite(there.minimum.rss)) return there;
    there.change = at(there.minimum.theta).value - best_.value;
    const double row = weight() * (there.change - change);
    there.distance = distance(there.minimum.rss - row * row);
    return there;
  }

 private:
  double distance(double squares) const {
    return std::sqrt(std::max(squares - fit_.minimum.rss, 0.0) * variance_) / sigma_;
  }
  static constexpr double pull = 5;
  double weight() const { return pull / std::sqrt(variance_); }

  /// The system with one more row of the first run, which pulls the number to a value. A larger
  /// weight would make a narrow valley of it, in which a search is slow.
  System held(double value) const {
    System system = fit_.system();
    ++system.runs.front();
    system.rough = true;
    system.evaluate = [this, value, rows = fit_.system()](const std::vector<double>& theta,
                                                          const TakeRows& take) {
      rows.evaluate(theta, [&](std::size_t run, std::span<double> f, std::span<double> J) {
        take(run, f, J);
        if (run > 0) return;
        FittedNumber number = at(theta);
        double off = weight() * (number.value - value);
        for (double& by : number.gradient) by *= weight();
        take(run, {&off, 1}, number.gradient);
      });
    };
    return system;
  }

  const Fitted& fit_;
  std::size_t j_;
  FittedNumber best_;
  double sigma_;
  std::optional<Minimum> wall_;
  double variance_;  // of the number, for residuals of variance one
};

constexpr double normal = 1.96;  // the 95 % of a normal distribution lie within so many sigma

/// True if the number or the model is so far from linear over its interval that only fits can tell
/// what the interval covers.
bool in_doubt(const FewRows& rows, const Profile& profile) {
  constexpr double rounding = 1e-7;  // a step in theta whose bend is not seen
  const Profile::Visit start = profile.start();
  const std::vector<double>& theta = start.minimum.theta;
  for (const double change : {-normal * profile.sigma(), normal * profile.sigma()}) try {
      const std::vector<double> step = profile.ahead(start, change);
      if (relative_size(step, theta) < rounding) continue;
      const double off = (profile.at(moved(theta, step)).value - profile.value()) / change - 1;
      if (!(std::abs(off) < levels::bent && bend(rows, theta, step) < levels::bent)) return true;
    } catch (const Error&) {  // there is no roll
      return true;
    }
  return false;
}

/// True if the number can change so far, and the sum of squares has risen as it should.
bool as_expected(const Profile& profile, const Profile::Visit& at) {
  if (at.at_wall) return false;
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
    if (far.distance < normal && (far.at_wall || hardly_moves)) return far.change;
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

/// The minimum_at_wall(), unless the body rolls alike just behind it: a mat that holds it at rest
/// holds it for b < 0 as well.
std::optional<Minimum> end_at_wall(const Fitted& fit) {
  auto wall = minimum_at_wall(fit.model, fit.noise, fit.minimum.theta);
  if (!wall) return wall;
  const Parameters& q = fit.parameters();
  std::vector<double> behind = wall->theta;
  behind[q.count() - q.scene() - 1] = -1e-6;
  const double variance = fit.minimum.rss / static_cast<double>(fit.degrees_left());
  if (tried(fit.system(), std::move(behind)).rss < wall->rss + variance) return {};
  return wall;
}

}  // namespace

std::vector<Interval> intervals_not_visited(const Fitted& of_all, const Uncertainty& noise,
                                            const FitOptions& options) {
  std::vector<Interval> found;
  const std::size_t shared = of_all.coefficients.size() + of_all.scene.size();
  const FewRows few = few_rows(of_all);
  std::vector<std::size_t> doubtful;
  for (std::size_t j = 0; j < shared; ++j) {
    const double sigma = std::sqrt(noise.covariance[j][j]);
    if (sigma > 0 && in_doubt(few, Profile(of_all, j, sigma))) doubtful.push_back(j);
  }
  if (doubtful.empty()) return found;
  const Fitted fit = of_means(of_all, options);
  const auto wall = end_at_wall(fit);
  for (const std::size_t j : doubtful) {
    const Profile profile(fit, j, std::sqrt(noise.covariance[j][j]), wall);
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
