// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/refits.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/matrix.h"
#include "fit/fitted.h"
#include "least_squares/minimise.h"
#include "statistics/levels.h"

namespace rolling {
namespace {

/// The numbers of a fit at another theta.
std::vector<FittedNumber> numbers_at(const Fitted& fit, const std::vector<double>& theta) {
  // In two statements: where memory fails in the second part of an aggregate, g++ 12 destroys the
  // first part twice.
  Fitted there{.minimum = {theta}};
  there.model = fit.model;
  read_off(there);
  return there.numbers();
}

/// The raw columns of a fit at a few times of each run, with their derivatives: they show how far a
/// model is linear.
class FewRows {
 public:
  explicit FewRows(const Fitted& fit) : theta_(fit.minimum.theta) {
    constexpr std::size_t few = 24;
    std::vector<ObservedRun> runs = fit.model.runs();
    for (ObservedRun& run : runs) {
      std::vector<double> times;
      const std::size_t n = run.t.size();
      const std::size_t rows = std::min(n, few);
      for (std::size_t i = 0; i < rows; ++i)
        times.push_back(run.t[rows > 1 ? i * (n - 1) / (rows - 1) : 0]);
      run.t = std::move(times);
      run.H = {};
    }
    model_ = Model(std::move(runs), fit.parameters());
    for (std::size_t r = 0; r < model_.runs().size(); ++r) rows_.push_back(rows_at(theta_, r));
  }

  /// The size of what is not linear on the step to this theta, relative to what is. Throws Error if
  /// the model has no values there.
  double bend(const std::vector<double>& to) const {
    const std::size_t q = model_.parameters().columns();
    const std::size_t own = model_.parameters().own();
    double bent = 0;
    double straight = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const Rows there = rows_at(to, r);
      std::vector<double> by_step(there.values.size());
      std::vector<double> off(there.values.size());
      for (std::size_t i = 0; i < off.size(); ++i) {
        for (std::size_t j = 0; j < q; ++j) {
          const std::size_t place = j < own ? r * own + j : (rows_.size() - 1) * own + j;
          by_step[i] += rows_[r].slopes[i * q + j] * (to[place] - theta_[place]);
        }
        off[i] = there.values[i] - rows_[r].values[i] - by_step[i];
      }
      bent += spread(off);
      straight += spread(by_step);
    }
    return std::sqrt(bent / straight);
  }

 private:
  struct Rows {
    std::vector<double> values;
    std::vector<double> slopes;
  };
  Rows rows_at(const std::vector<double>& theta, std::size_t r) const {
    const RawModel at = model_.raw(theta, r);
    const std::vector<double>& t = model_.runs()[r].t;
    const std::size_t q = model_.parameters().columns();
    Rows rows{{}, std::vector<double>(t.size() * q)};
    for (std::size_t i = 0; i < t.size(); ++i)
      rows.values.push_back(at(t[i], &rows.slopes[i * q], 1));
    return rows;
  }
  /// The sum of squares. Without an x0 the filters have taken the mean of positions away.
  double spread(std::vector<double> x) const {
    if (model_.is_roll() && model_.runs().front().column == Quantity::x &&
        !model_.parameters().has_x0()) {
      double mean = 0;
      for (const double value : x) mean += value / static_cast<double>(x.size());
      for (double& value : x) value -= mean;
    }
    return dot(x, x);
  }

  std::vector<double> theta_;
  Model model_;
  std::vector<Rows> rows_;
};

/// The profile of one number of a fit: how the sum of squares rises if the number is held at
/// another value and all parameters are fitted again.
class Profile {
 public:
  /// `sigma` is the standard error of number j.
  Profile(const Fitted& fit, std::size_t j, double sigma)
      : fit_(fit), j_(j), best_(fit.numbers()[j]), sigma_(sigma) {
    std::vector<double> g = best_.gradient;
    fit.minimum.R.solve_transposed(0, g);
    variance_ = dot(g, g);
  }
  double value() const { return best_.value; }
  double sigma() const { return sigma_; }

  /// A place of the profile.
  struct Visit {
    double to = 0;        ///< the change of the number that was asked for
    double change = 0;    ///< of the number
    double distance = 0;  ///< in standard errors, as the sum of squares shows it; infinite if no
                          ///< fit was found
    Minimum minimum = {};
  };
  Visit start() const { return {0, 0, 0, fit_.minimum}; }
  /// theta where the number would have changed by this if the model were linear around a place.
  std::vector<double> ahead(const Visit& from, double change) const {
    const std::vector<double>& theta = from.minimum.theta;
    const std::vector<double> g = numbers_at(fit_, theta)[j_].gradient;
    return moved(theta, from.minimum.R.step_that_changes(g, change - from.change));
  }
  /// Fits with the number changed by this, as far as it can. The search starts at a place nearby,
  /// and ahead of it.
  Visit visit(double to, const Visit& from) const {
    const double change = to * (1 + 1 / (pull * pull));  // as the other rows pull it back
    const System system = held(best_.value + change);
    Visit there{to, to, INFINITY};
    improve(there.minimum, system, ahead(from, change));
    improve(there.minimum, system, from.minimum.theta);
    if (!std::isfinite(there.minimum.rss)) return there;
    there.change = numbers_at(fit_, there.minimum.theta)[j_].value - best_.value;
    const double row = weight() * (there.change - change);
    const double rise = std::max(there.minimum.rss - row * row - fit_.minimum.rss, 0.0);
    there.distance = std::sqrt(rise * variance_) / sigma_;
    return there;
  }

 private:
  static constexpr double pull = 5;
  double weight() const { return pull / std::sqrt(variance_); }

  /// The system with one more row, which pulls the number to a value. A larger weight would make a
  /// narrow valley of it, in which a search is slow.
  System held(double value) const {
    System system = fit_.system();
    ++system.runs.front();
    system.evaluate = [this, value, rows = fit_.system()](const std::vector<double>& theta,
                                                          const TakeRows& take) {
      const FittedNumber number = numbers_at(fit_, theta)[j_];
      rows.evaluate(theta, [&](std::size_t run, std::span<double> f, std::span<double> J) {
        if (run > 0) return take(run, f, J);
        std::vector<double> longer_f(f.begin(), f.end());
        longer_f.push_back(weight() * (number.value - value));
        std::vector<double> longer_J;
        for (std::size_t j = 0; j < number.gradient.size(); ++j) {
          const auto column = J.subspan(j * f.size(), f.size());
          longer_J.insert(longer_J.end(), column.begin(), column.end());
          longer_J.push_back(weight() * number.gradient[j]);
        }
        take(run, longer_f, longer_J);
      });
    };
    return system;
  }

  const Fitted& fit_;
  std::size_t j_;
  FittedNumber best_;
  double sigma_;
  double variance_;  // of the number, for residuals of variance one
};

constexpr double normal = 1.96;  // the 95 % of a normal distribution lie within so many sigma

/// True if the number or the model is so far from linear over its interval that only fits can tell
/// what the interval covers.
bool in_doubt(const Fitted& fit, const FewRows& rows, const Profile& profile, std::size_t j) {
  constexpr double rounding = 1e-7;  // a step in theta whose bend is not seen
  const std::vector<double>& theta = fit.minimum.theta;
  for (const double change : {-normal * profile.sigma(), normal * profile.sigma()}) try {
      const std::vector<double> there = profile.ahead(profile.start(), change);
      double step = 0;
      for (std::size_t i = 0; i < theta.size(); ++i)
        step = std::max(step, std::abs(there[i] - theta[i]) / std::max(1.0, std::abs(theta[i])));
      if (step < rounding) continue;
      const double off = (numbers_at(fit, there)[j].value - profile.value()) / change - 1;
      if (!(std::abs(off) < levels::bent && rows.bend(there) < levels::bent)) return true;
    } catch (const Error&) {  // there is no roll
      return true;
    }
  return false;
}

/// True if the sum of squares has risen as it should where the number has changed so far.
bool as_expected(const Profile& profile, const Profile::Visit& at) {
  const double rise = std::pow(at.distance * profile.sigma() / at.change, 2);
  return rise < levels::rise && rise > 1 / levels::rise;
}

/// The change of the number, in the direction of this first visit, at which the sum of squares has
/// risen by that of 95 %; infinite if it does not rise so far.
double end_of_interval(const Profile& profile, Profile::Visit far) {
  constexpr int most = 10;
  const auto is_end = [](const Profile::Visit& at) {
    return std::abs(at.distance - normal) < 0.05;
  };
  Profile::Visit near = profile.start();
  for (int i = 0; i < most && !is_end(far); ++i) {
    double to = near.to == 0 ? far.to / 8 : (near.to + far.to) / 2;
    const bool beyond = far.distance > normal;
    if (!beyond) {
      to = far.to * std::clamp(normal / far.distance, 1.2, 4.0);
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

}  // namespace

std::vector<Interval> intervals_not_visited(const Fitted& of_all, const Uncertainty& noise,
                                            const FitOptions& options) {
  std::vector<Interval> found;
  const std::size_t shared = of_all.coefficients.size() + of_all.scene.size();
  const FewRows few(of_all);
  std::vector<std::size_t> doubtful;
  for (std::size_t j = 0; j < shared; ++j) {
    const double sigma = std::sqrt(noise.covariance[j][j]);
    if (sigma > 0 && in_doubt(of_all, few, Profile(of_all, j, sigma), j)) doubtful.push_back(j);
  }
  if (doubtful.empty()) return found;
  const Fitted fit = of_means(of_all, options);
  for (const std::size_t j : doubtful) {
    const Profile profile(fit, j, std::sqrt(noise.covariance[j][j]));
    const double change = normal * profile.sigma();
    Profile::Visit below = profile.visit(-change, profile.start());
    Profile::Visit above = profile.visit(change, profile.start());
    if (as_expected(profile, below) && as_expected(profile, above)) continue;
    found.push_back({j, profile.value() - std::abs(end_of_interval(profile, std::move(below))),
                     profile.value() + end_of_interval(profile, std::move(above))});
  }
  return found;
}

}  // namespace rolling
