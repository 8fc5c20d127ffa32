// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/grid.h"
#include "report/fit_runs.h"
#include "selection/readings.h"

namespace rolling {
namespace {

/// True if the residuals are rounding errors, to which no test of noise applies: rms is negligible
/// beside D at 1 m/s, the initial speed or the radius. (sigma_a is 0 for an a that is fixed.)
bool exact(const FitOfRuns& fit) {
  const FitResult& r = *fit.result;
  double scale = 1;  // of ln D
  if (fit.route == Route::shift) scale = r.coefficients.front().value;
  if (fit.route == Route::velocity) scale = std::abs(r.v0.front().value);
  if (fit.route == Route::position) scale = fit.runs.front().body.R;
  return r.rms < 1e-9 * scale;
}

/// The remarks on one fit. Causes come first, then what a cause would bring with it.
class Remarks {
 public:
  Remarks(Tool& tool, const FitOfRuns& fit, const FitOptions& options, std::size_t fits)
      : tool_(tool), fit_(fit), options_(options), r_(*fit.result),
        fits_(static_cast<double>(fits)), noisy_(!exact(fit)) {}

  void make() {
    geometry();
    comes_back();
    if (r_.agreement) {
      const std::string found = disagreement(*r_.agreement, fit_.runs, tool_.checks);
      spoilt_ |= !found.empty();
      if (!found.empty())
        tool_.object("", found + ways_to_agree(), fit_.runs[r_.agreement->run].name);
    }
    if (noisy_) causes();
    negative_b();
    const LawForm& law = r_.law.form();
    const bool other_law = fit_.laws && fit_.laws->against >= levels::another_law;
    if (noisy_ && !spoilt_) intervals();
    if (!spoilt_ && !other_law) {
      if (!noisy_ || r_.not_visited.empty()) uncertain_a();
      if (noisy_) residuals();
    }
    if (noisy_ && r_.scene[0] && r_.scene[0]->sigma > 0 && fit_.runs.size() == 2)
      tool_.warn("",
                 "the slope rests on two rolls: any other difference between them counts as slope, "
                 "and is not in its standard uncertainty; add rolls in both directions");
    if (!tool_.checks) return;
    if (other_law && fit_.laws->against >= levels::another_law + 2 * std::log(fits_))
      object(run_, fmt::format("D = {} is better than {} by {:.1f} in AICc; see --report",
                               fit_.laws->other->formula, law.formula, fit_.laws->against));
    check();
  }

 private:
  /// All runs are trajectories that begin in one direction.
  bool go_one_way() const {
    return r_.v0.size() > 1 && std::ranges::all_of(r_.v0, [&](const Estimate& v0) {
             return v0.value * r_.v0.front().value > 0;
           });
  }
  /// What may make runs disagree and is not taken into account yet.
  std::string ways_to_agree() const {
    std::string ways;
    if (!options_.fit_slope && go_one_way())
      ways += fmt::format("; if some rolled back, make their {}, and say --slope fit",
                          fit_.route == Route::position ? "x fall" : "v negative");
    else if (!options_.fit_slope) ways += "; if they rolled in both directions, --slope fit";
    if (options_.law->drag >= 0 && !options_.fit_wind) ways += "; if there was wind, --wind fit";
    const double K = fit_.runs.front().body.K;
    const auto differs = [&](const Run& run) { return std::abs(run.body.K - K) > 0; };
    ways += std::ranges::any_of(fit_.runs, differs) ? "; the order of K is that of the files"
                                                    : "; if bodies differ, a K and an R for each";
    return ways + "; for a law of each run, --each";
  }

  /// What spoils the fit.
  void object(const std::string& run, const std::string& text) {
    spoilt_ = true;
    tool_.object(run, text);
  }

  void geometry() {
    const std::string_view fitted =
        is_trajectory(fit_.route) ? rolling::name_of(fitted_column(fit_.route)) : "a";
    for (std::size_t i = 0; i < fit_.runs.size(); ++i) {
      const Run& run = fit_.runs[i];
      const double v = i < r_.v0.size() ? std::abs(r_.v0[i].value) : fastest(run);
      const double D = r_.law(v);
      const double R = body_of(fit_.route, run).R;
      const bool beyond = R > 0 && D > R;  // D of a table alone has no R
      if (!beyond && !(std::abs(D) < levels::least_D_over_R * R)) continue;
      spoilt_ |= beyond;  // steel on steel is not far from the other limit
      tool_.object(
          run.name,
          fmt::format(
              "D is {:.3g} m at the first speed, {:.3g} m/s: {} the radius {} m; the unit of t or "
              "{} is probably wrong: --use gives another one, as 't=COLUMN[UNIT]'",
              D, v, beyond ? "beyond" : "less than a ten-thousandth of", R, fitted));
      break;
    }
  }

  /// A body that comes back on a mat that is taken for level.
  void comes_back() {
    if (!is_trajectory(fit_.route) || options_.fit_slope) return;
    for (const Run& run : fit_.runs) {
      if (run.body.slope != 0 || run.body.road) continue;
      const std::vector<double>& readings = run[fitted_column(fit_.route)];
      std::vector<double> t;
      std::vector<double> y;
      for (std::size_t i = 0; i < readings.size(); ++i) {
        if (!std::isfinite(readings[i])) continue;
        t.push_back(run.t[i]);
        y.push_back(readings[i]);
      }
      if (way_before_turn(fit_.route == Route::position, t, y) != 0)
        object(run.name,
               "the body comes back, so the mat is not level: give --slope, or fit it with "
               "--slope fit");
    }
  }

  void negative_b() {
    if (r_.b + levels::below_least_b * r_.sigma_b < levels::least_b)
      object(run_,
             fmt::format("b is {:.3g} +- {:.2g}: no mat does this, but a hand, a wall, an incline "
                         "or a magnet at the end of the roll does; cut it off",
                         r_.b, r_.sigma_b));
  }

  void beginning() {
    const auto found = disturbed_beginning(fit_.route, fit_.runs, options_);
    if (found && found->p <= levels::beginning / fits_)
      object(
          fit_.runs[found->run].name,
          fmt::format("the first {} rows follow another motion than the others ({}): if a hand was "
                      "still on, cut off {:.2g} s; else something changed within the roll",
                      found->rows, p_of(found->p), found->time));
  }

  void causes() {
    if (tool_.checks) beginning();
    if (fit_.route == Route::loglog && logarithms_biased(r_))
      tool_.warn(run_,
                 "the noise of D biases its logarithms by more than the uncertainty of the line: "
                 "use --route shift");
    if (r_.off.count > 0)
      object(fit_.runs[r_.off.run].name,
             fmt::format(
                 "the reading at t = {:.12g} s is {:.2g} standard deviations off the roll"
                 "{}: look at it, and leave it out (smooth --outliers), or fit the raw "
                 "column with --robust",
                 r_.off.time, r_.off.distance,
                 r_.off.count > 1 ? fmt::format(", and {} more are off", r_.off.count - 1) : ""));
    if (const auto& jump = r_.clock_jump)
      object(run_, fmt::format(
                       "from t = {:.12g} s on the times are {:.2g} s too {} ({}), as if frames or "
                       "readings were {}, or the law is not the right one: fit the rows before or "
                       "after that",
                       jump->time, std::abs(jump->by), jump->by > 0 ? "small" : "large",
                       p_of(jump->p), jump->by > 0 ? "lost" : "there twice"));
    spoilt_ |= std::ranges::any_of(fit_.runs, [&](const Run& run) { return rounding(run); });
  }

  /// Warns of readings that repeat since a logger held them or rounded them to steps that the body
  /// hardly makes, or that have hardly any noise but their rounding: their errors are correlated
  /// then, which residuals of few rows do not show. True if it does.
  bool rounding(const Run& run) {
    const bool positions = fit_.route == Route::position;
    const Quantity fitted = fitted_column(fit_.route);
    const std::vector<double>& y = run[fitted];
    if (std::ranges::count(run.filters, fitted, &LinearFilter::to) > 0) return false;
    std::size_t rows = 0;
    std::size_t repeats = 0;
    std::size_t waiting = 0;  // rows since the last new reading: those at the end do not count
    for (std::size_t i = 1; i < y.size(); ++i) {
      ++waiting;
      if (y[i] == y[i - 1]) continue;
      rows += waiting;
      repeats += std::exchange(waiting, 0) - 1;
    }
    const bool differences = r_.errors == Errors::differences;  // of two readings
    const double grid = grid_of(y);
    const double of_grid = r_.rms / grid / (differences ? std::numbers::sqrt2 : 1);
    const double share = static_cast<double>(repeats) / static_cast<double>(rows);
    const bool bare = of_grid > levels::gates_of_grid && of_grid < levels::rounding_of_grid;
    const bool repeat =
        repeats >= 10 && of_grid < levels::grid_of_rms && share > levels::repeats_of_grid;
    if (!are_held(y) && (!is_trajectory(fit_.route) || (!bare && !repeat))) return false;
    tool_.warn(run.name,
               fmt::format("the {} repeat, or have hardly any noise but their rounding: "
                           "these errors are correlated, and {} may be too small; keep "
                           "only rows with a new reading, or see how several runs scatter",
                           positions ? "positions" : "speeds", sigmas_));
    return true;
  }

  /// An a whose interval a +- sigma_a does not hold what it says, also of rows without noise.
  void uncertain_a() {
    if (r_.a > 0 && r_.sigma_a > levels::uncertain_a * r_.a)
      tool_.object(run_, fmt::format("sigma_a is {:.2g} times a: too much for the interval a +- "
                                     "sigma_a; this ratio is the standard uncertainty of ln a",
                                     r_.sigma_a / r_.a));
  }

  /// Warns of what the residuals show. A body out of balance makes the rest of it.
  void residuals() {
    if (const auto& found = r_.eccentricity)
      return tool_.warn(
          fit_.runs[found->run].name,
          fmt::format(
              "the speed changes once a turn ({}; 1 % of good runs get this warning), as "
              "if the centre of mass lay {:.2g} +- {:.1g} mm off the axis, most ahead of it "
              "at {:.0f} degrees: {} are too small; balance the body, unless --report shows a "
              "better law",
              p_of(found->p), 1e3 * found->e, 1e3 * found->sigma,
              std::fmod(found->phase * 180 / std::numbers::pi + 360, 360), sigmas_));
    if (fit_.route == Route::velocity && r_.n < levels::least_tested &&
        r_.errors == Errors::classical)
      tool_.warn(
          run_, fmt::format("{} speeds do not show whether a program smoothed them: if one did, {} "
                            "are too small",
                            r_.n, sigmas_));
    if (noise_is_correlated(r_) && !tool_.checks) tell_not_white();
    else if (r_.reversals <= levels::few_reversals && r_.errors != Errors::uneven)
      tool_.warn(run_,
                 fmt::format("the readings look like medians or means of others: too few turn "
                             "back against the motion; their noise is correlated, and {} may "
                             "be too small; fit what the sensor read",
                             sigmas_));
    if (r_.errors == Errors::uneven)
      tool_.warn(run_,
                 r_.clock_noise > 0
                     ? fmt::format("the noise grows with the speed, as by times that are off "
                                   "by {:.2g} s; {} allow for it",
                                   r_.clock_noise, sigmas_)
                     : fmt::format("the size of the noise changes along the run; {} allow for "
                                   "it: look at the residuals",
                                   sigmas_));
  }

  /// The name of a coefficient or, behind them, of a number of the scene.
  std::string name_of(std::size_t number) const {
    std::vector<std::string> names;
    for (const auto& c : r_.law.form().coefficients) names.push_back(c.name);
    for (std::size_t i = 0; i < scene_numbers.size(); ++i)
      if (r_.scene[i]) names.push_back(scene_numbers[i].name);
    return names[number];
  }

  /// Both ends with three digits of their distance, or more.
  static std::string range(double lower, double upper) {
    const double size = std::max(std::abs(lower), std::abs(upper)) / (upper - lower);
    const int digits = 3 + static_cast<int>(std::log10(std::clamp(size, 1.0, 1e14)));
    return fmt::format("{:.{}g} to {:.{}g}", lower, digits, upper, digits);
  }

  /// Tells the intervals that are not those of 1.96 standard errors.
  void intervals() {
    std::string all;
    for (const Interval& of : r_.not_visited) {
      const std::string name = name_of(of.number);
      if (std::isinf(of.lower) && std::isinf(of.upper)) add_item(all, name + " not bounded");
      else if (std::isinf(of.lower)) add_item(all, fmt::format("{} below {:.3g}", name, of.upper));
      else if (std::isinf(of.upper)) add_item(all, fmt::format("{} above {:.3g}", name, of.lower));
      else add_item(all, name + " " + range(of.lower, of.upper));
    }
    if (!all.empty())
      tool_.object(run_, "+- 1.96 sigma is no 95 % interval here; the sum of squares gives " + all);
  }

  void tell_not_white() {
    std::string way_out = "look at the residuals, and see --report";
    if (fit_.route == Route::velocity)
      way_out = "fit the positions, if the file has them (--route position), or " + way_out;
    for (const Run& run : fit_.runs)
      if (const auto rounded = rounded_times(run.t); rounded && is_trajectory(fit_.route))
        way_out = fmt::format(
            "the times are rounded to {:.2g} s, where a row comes every {:.2g} s: give them with "
            "more digits",
            rounded->place, rounded->step);
    object(run_, fmt::format("the noise is correlated from row to row ({}), or the law is not the "
                             "right one: {}",
                             p_of(r_.whiteness), way_out));
  }

  /// What a check alone looks at.
  void check() {
    bool without = r_.errors == Errors::none;
    for (std::size_t j = 0; j < r_.coefficients.size(); ++j)
      without |= r_.coefficients[j].sigma == 0 && !options_.fixed[j];
    if (without) object(run_, "too few readings for standard uncertainties: fit more");
    if (!noisy_) return;
    if (r_.whiteness <= levels::not_white / fits_ && !r_.clock_jump) tell_not_white();
  }

  Tool& tool_;
  const FitOfRuns& fit_;
  const FitOptions& options_;
  const FitResult& r_;
  double fits_;
  std::string run_ = fit_.runs.size() == 1 ? fit_.runs[0].name : "";  ///< none of several
  const char* sigmas_ = r_.law.power() ? "sigma_a and sigma_b" : "the standard uncertainties";
  bool noisy_;
  bool spoilt_ = false;
};

}  // namespace

void remark(Tool& tool, const FitOfRuns& fit, const FitOptions& options, std::size_t fits) {
  Remarks(tool, fit, options, fits).make();
}

}  // namespace rolling
