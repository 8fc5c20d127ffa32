// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/fit_report.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "base/grid.h"
#include "base/median.h"
#include "cli/fit_runs.h"
#include "fit/fit.h"
#include "signal/repeats.h"

namespace rolling {

namespace {

/// True if the residuals are rounding errors, to which no test of noise applies: rms is negligible
/// beside D at 1 m/s, the initial speed or the radius. (sigma_a is 0 for an a that is fixed.)
bool exact(Route route, const FitResult& r, const std::vector<FitRun>& runs) {
  const double scale = route == Route::loglog     ? 1
                       : route == Route::shift    ? r.coefficients.front().value
                       : route == Route::velocity ? std::abs(r.v0.front().value)
                                                  : runs.front().body.R;
  return r.rms < 1e-9 * scale;
}

const std::map<Errors, const char*> kinds{{Errors::none, "none"},
                                          {Errors::classical, "classical"},
                                          {Errors::filters, "of the filters"},
                                          {Errors::differences, "of differences of positions"},
                                          {Errors::uneven, "of noise of uneven size"},
                                          {Errors::autocorrelation, "of the autocorrelation"}};

/// "sigma_a 1.9e-05: noise 1.2e-05, K 6.2e-06; sigma_b 0.0086: noise 0.0086, K 0"
std::string budget(const FitResult& r) {
  std::string all;
  for (std::size_t j = 0; j < r.coefficients.size(); ++j) {
    const double sigma = r.coefficients[j].sigma;
    all += fmt::format("{}sigma_{} {:.2g}{} of:", j == 0 ? "" : "; ",
                       r.law.form().coefficients[j].name, sigma,
                       j == 0 ? " is the root of the sum of squares" : ",");
    for (const ErrorShare& share : r.shares) {
      // A contribution of the size of the rounding error is shown as 0.
      const double part = share.sigma(j);
      all += fmt::format("{} {} {:.2g}", &share == &r.shares.front() ? "" : ",", share.of,
                         part < 1e-9 * sigma ? 0 : part);
    }
  }
  return all;
}

/// The text with the value; nothing for NaN, as where there are as many parameters as rows.
std::string known(const char* text, double value) {
  return std::isnan(value) ? "" : fmt::format(fmt::runtime(text), value);
}

void report_route(Tool& tool, const RouteWords& words, const std::vector<FitRun>& runs,
                  const FitOptions& options) {
  const Route route = words.route;
  for (const FitRun& run : runs)
    for (const std::string& needed : words.columns)
      if ((run.*column_of(needed)).empty()) fail("there is no column {}", needed);
  if (is_trajectory(route) && std::isnan(runs.front().body.R)) fail("--radius is not given");
  if (is_trajectory(route) && std::isnan(runs.front().body.K)) fail("--shape-factor is not given");
  const auto begin = std::chrono::steady_clock::now();
  const FitResult r = fit(route, runs, options);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
  std::string law;
  for (std::size_t j = 0; j < r.coefficients.size(); ++j)
    law += fmt::format("{} {:.5g}{}, ", r.law.form().coefficients[j].name, r.coefficients[j].value,
                       known(" +- {:.2g}", r.coefficients[j].sigma));
  tool.say(fmt::format("{}: {}{}n {} ({} degree{} of freedom), errors {}{}, {:.2g} ms", words.name,
                       law, known("rms {:.3g}, ", r.rms), r.n, r.freedom, r.freedom == 1 ? "" : "s",
                       kinds.at(r.errors), known(" (Ljung and Box: p = {:.2g})", r.whiteness),
                       time.count()));
  if (r.shares.size() > 1 && r.errors != Errors::none) tool.say(budget(r));
}

/// "D = d0 + d1 v: d0 = 0.0012 +- 1e-05, d1 = 0.0005 +- 3e-05; corr d0 d1 -0.93; AICc 1.2"
std::string described(const LawFit& fit, double least) {
  const auto& names = fit.law->coefficients;
  const auto finite = [](const Estimate& c) { return std::isfinite(c.value); };
  if (fit.coefficients.empty() || !std::ranges::all_of(fit.coefficients, finite))
    return fmt::format("D = {}: not determined", fit.law->formula);
  std::string line = fmt::format("D = {}:", fit.law->formula), corr;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Estimate& c = fit.coefficients[i];
    line += fmt::format(" {} = {:.6g}{}{}", names[i].name, c.value, known(" +- {:.2g}", c.sigma),
                        i + 1 < names.size() ? "," : ";");
    for (std::size_t j = 0; j < i; ++j)
      corr += fmt::format("{} {} {} {:.3f}", corr.empty() ? " corr" : ",", names[j].name,
                          names[i].name, fit.correlations[i][j]);
  }
  return line + (corr.empty() ? "" : corr + ";") +
         (std::isfinite(fit.aicc) ? fmt::format(" AICc {:.1f} above the least", fit.aicc - least)
                                  : " too few rows for its AICc");
}

std::string p_of(double p) { return p < 1e-300 ? "p < 1e-300" : fmt::format("p = {:.1g}", p); }

std::string disagreement(const FitResult& r, const std::vector<FitRun>& runs) {
  std::string given;
  for (const ErrorShare& share : r.shares)
    if (share.of != "noise" && share.of != "bias") add_item(given, share.of);
  return disagreement(*r.agreement, runs, given) +
         "; where they rolled in both directions, --slope fit; where bodies differ, a K for each";
}

/// The run that a message about the fit names: none of several.
std::string of_run(const std::vector<FitRun>& runs) { return runs.size() == 1 ? runs[0].name : ""; }

/// Takes a remark on a run: a warning, or with --check a reason why the check does not hold.
using Tell = std::function<void(const std::string& run, const std::string& text)>;

/// Tells what a reader of the row alone would not know and what speaks against it, first what no
/// other of these causes. Returns true if there is any of it.
bool tell_against(const FitResult& r, const std::vector<FitRun>& runs, bool noisy,
                  const Tell& tell) {
  const bool disagree = r.agreement && !r.agreement->agree(), off = r.off && noisy,
             steep = r.b + levels::below_least_b * r.sigma_b < levels::least_b && noisy;
  if (disagree) tell("", disagreement(r, runs));
  if (off)
    tell(runs[r.off->run].name,
         fmt::format(
             "the reading at t = {:.12g} s is {:.2g} standard deviations off the roll{}: look at "
             "it, and leave it out (smooth --outliers), or fit the raw column with --robust",
             r.off->time, r.off->distance,
             r.off->count > 1 ? fmt::format(", and {} more are off", r.off->count - 1) : ""));
  if (steep)
    tell(of_run(runs),
         fmt::format("b is {:.3g} +- {:.2g}: no mat resists so much more as the body slows down, "
                     "but a hand, a wall, an incline or a magnet at the end of the roll does; cut "
                     "it off",
                     r.b, r.sigma_b));
  return disagree || off || steep;
}

/// Warns of readings that repeat since they are rounded to steps that the body hardly makes, or
/// that have hardly any other noise: rounding errors are correlated then, which residuals of few
/// rows do not show. Returns true if it does, or read_runs() has.
bool warn_of_rounding(Tool& tool, Route route, const FitResult& r,
                      const std::vector<FitRun>& runs) {
  for (const FitRun& run : runs) {
    const std::vector<double>& y = route == Route::position ? run.x : run.v;
    if (rows_held(y) > 1) return true;
    if (!run.filters.empty()) continue;
    std::size_t rows = 0, repeats = 0, waiting = 0;
    for (std::size_t i = 1; i < y.size(); ++i) {  // without the rest at the end
      ++waiting;
      if (y[i] != y[i - 1]) rows += waiting, repeats += std::exchange(waiting, 0) - 1;
    }
    const bool differences = r.errors == Errors::differences;  // of two readings
    const double grid = grid_of(y),
                 of_grid = r.rms / grid / (differences ? std::numbers::sqrt2 : 1),
                 share = static_cast<double>(repeats) / static_cast<double>(rows);
    const bool bare = of_grid > levels::gates_of_grid && of_grid < levels::rounding_of_grid,
               repeat = repeats >= 10 && of_grid < levels::grid_of_rms &&
                        share > levels::repeats_of_grid;
    if (!bare && !repeat) continue;
    const bool positions = route == Route::position;
    const std::string readings = positions ? "positions" : "speeds",
                      step = fmt::format("{:.3g} {}", grid, positions ? "m" : "m/s");
    const auto warn = [&](const std::string& seen, const char* way_out) {
      tool.warn(run.name, fmt::format("{}: rounding errors are then correlated, and sigma_a and "
                                      "sigma_b may be too small; {}",
                                      seen, way_out));
    };
    if (repeat)
      warn(
          fmt::format("{:.0f} % of the {} repeat, on a grid of {} that is coarser than their noise",
                      100 * share, readings, step),
          "keep only the rows in which a new one comes");
    else
      warn(fmt::format("the {} have hardly any noise beside their rounding to {}", readings, step),
           "the scatter of several runs shows by how much");
    return true;
  }
  return false;
}

/// Warns of what spoils a fit: of a shift that no body has, and of what speaks against the row,
/// which `tell` takes. Returns true if there is any of it.
bool warn_of_causes(Tool& tool, Route route, const FitResult& r, const std::vector<FitRun>& runs,
                    bool noisy, const Tell& tell) {
  bool beyond = false, below = false;
  for (std::size_t i = 0; i < r.v0.size() && !beyond && !below; ++i) {
    const double v0 = r.v0[i].value, D = r.law(std::abs(v0)), R = runs[i].body.R;
    beyond = D > R, below = std::abs(D) < levels::least_D_over_R * R;
    if (beyond || below)
      tool.warn(runs[i].name,
                fmt::format("no body rolls so: at its first speed, {:.3g} m/s, D is {:.3g} m, {} "
                            "the radius {} m: the units of a column are hardly right",
                            v0, D, beyond ? "beyond" : "not a ten-thousandth of", R));
  }
  const bool reasons = tell_against(r, runs, noisy, tell);
  const bool repeats = noisy && is_trajectory(route) && warn_of_rounding(tool, route, r, runs);
  return beyond || reasons || repeats;
}

/// Warns of what the residuals show. A body out of balance makes the rest of it.
void warn_of_residuals(Tool& tool, Route route, const FitResult& r,
                       const std::vector<FitRun>& runs) {
  const std::string run = of_run(runs);
  if (r.a > 0 && r.sigma_a > levels::uncertain_a * r.a)
    tool.warn(run, fmt::format("sigma_a is {:.2g} times a: this ratio is the standard uncertainty "
                               "of ln a, and a is too uncertain for the interval a +- sigma_a",
                               r.sigma_a / r.a));
  if (const auto& found = r.eccentricity)
    return tool.warn(
        runs[found->run].name,
        fmt::format("the speed changes once a turn ({}; one good run in a hundred is told so too), "
                    "as if the centre of mass lay {:.2g} +- {:.1g} mm off the axis, most ahead of "
                    "it at {:.0f} degrees: the law is further off than its uncertainties say; "
                    "balance the body, unless --report shows a better law",
                    p_of(found->p), 1e3 * found->e, 1e3 * found->sigma,
                    std::fmod(found->phase * 180 / std::numbers::pi + 360, 360)));
  if (noise_is_correlated(r))
    tool.warn(run, fmt::format("the noise is correlated from row to row ({}), or the law is not "
                               "the right one: {}look at the residuals, and see --report",
                               p_of(r.whiteness),
                               route == Route::velocity ? "fit the positions, if the file has them "
                                                          "(--route position), or "
                                                        : ""));
  else if (r.reversals <= levels::few_reversals)
    tool.warn(
        run,
        "fewer readings turn back against the motion than their noise would make: they look like "
        "medians or means of others, whose noise is correlated, and sigma_a and sigma_b may be too "
        "small; fit what the sensor read");
  if (r.errors == Errors::uneven)
    tool.warn(run,
              "the noise is not of one size along the run, which its uncertainties take "
              "into account: look at the residuals");
}

/// Tells why the check of a fit does not hold, but for what tell_against() tells.
void tell_of_check(Route route, const FitResult& r, const std::vector<FitRun>& runs,
                   const FitOptions& options, const std::optional<LawComparison>& laws, bool noisy,
                   const Tell& tell) {
  const std::string run = of_run(runs);
  if (r.errors == Errors::none || (r.sigma_a == 0 && r.sigma_b == 0 && !(options.a && options.b)))
    tell(run, "nothing is left to tell standard uncertainties from: fit more readings");
  if (const auto beginning = disturbed_beginning(route, runs, options); noisy && beginning)
    tell(runs[beginning->run].name,
         fmt::format("the first {} rows do not go on as the others ({}), as if a hand were still "
                     "on: cut off {:.2g} s",
                     beginning->rows, p_of(beginning->p), beginning->time));
  const LawForm& law = r.law.form();
  if (laws && laws->against(law) >= levels::another_law)
    tell(run, fmt::format("D = {} is better than {} by {:.1f} in AICc; see --report",
                          laws->best_other(law).law->formula, law.formula, laws->against(law)));
  if (noisy && r.whiteness <= levels::not_white)
    tell(run, fmt::format("the residuals are not white ({}): the law, or what is known of the "
                          "noise, is not right",
                          p_of(r.whiteness)));
}

}  // namespace

std::string disagreement(const Agreement& found, const std::vector<FitRun>& runs,
                         const std::string& given) {
  const auto more = [](double x) { return x < 0 ? "less" : "more"; };
  std::string line = fmt::format(
      "the runs disagree by more than their noise (chi2 {:.4g} of {} degrees of freedom, {}): run "
      "{} {}",
      found.ratio, found.dof, p_of(found.p), runs[found.run].name,
      found.runs > 2 ? "stands out" : "is not like the other");
  if (found.log_D.sigma > 0) {
    const double percent = 100 * std::abs(std::expm1(found.log_D.value));
    line += fmt::format(
        ", its D({:.2g} m/s) is {} +- {:.1g} % {} than that of the other{}", found.speed,
        percent < 100 ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent),
        100 * found.log_D.sigma, more(found.log_D.value), found.runs > 2 ? "s" : "");
  }
  if (found.b.sigma > 0)
    line += fmt::format(", its b {:.2g} +- {:.1g} {}", std::abs(found.b.value), found.b.sigma,
                        more(found.b.value));
  if (!given.empty()) line += fmt::format("; this test takes {} as exact", given);
  return line + "; the row is their mean, with their scatter in its uncertainties";
}

std::string why_left_out(Route route, const FitOptions& options) {
  std::string reason = words_of(route).why_left_out;
  if (options.min_speed <= 0) return reason;
  return (reason.empty() ? "" : reason + ", or ") + "slower than --min-speed";
}

void remark(Tool& tool, Route route, const FitResult& r, const std::vector<FitRun>& runs,
            const FitOptions& options, const std::optional<LawComparison>& laws, bool with_check) {
  const bool noisy = !exact(route, r, runs),
             other_law = laws && laws->against(r.law.form()) >= levels::another_law;
  if (noisy && route == Route::loglog && logarithms_biased(r))
    tool.warn(of_run(runs),
              "the noise of D biases its logarithms by more than the uncertainty of "
              "the line: use --route shift");
  const Tell tell = [&](const std::string& run, const std::string& text) {
    with_check ? tool.check_failed(run, text) : tool.warn(run, text);
  };
  if (!warn_of_causes(tool, route, r, runs, noisy, tell) && noisy && !other_law)
    warn_of_residuals(tool, route, r, runs);
  if (noisy && r.sigma_slope > 0 && runs.size() == 2)
    tool.warn("",
              "two rolls alone tell the slope: what their laws differ by counts as slope, and "
              "its standard uncertainty does not hold that; add rolls in both directions");
  if (with_check) tell_of_check(route, r, runs, options, laws, noisy, tell);
}

void report(Tool& tool, const std::vector<FitRun>& runs, const FitOptions& options,
            const std::optional<LawComparison>& laws) {
  for (const RouteWords& words : all_routes()) try {
      report_route(tool, words, runs, options);
    } catch (const Error& error) {
      tool.say(fmt::format("{}: {}", words.name, error.what()));
    }
  if (!laws) return;
  const LawForm& law = *options.law;
  if (!laws->possible(law))
    return tool.say(
        fmt::format("too few independent readings to compare {} with other laws", law.formula));
  for (const LawFit& fit : laws->fits) tool.say(described(fit, laws->least()));
  tool.say(fmt::format(
      "{} better than D = {}",
      laws->against(law) <= levels::no_better_law ? "no law that was tried is" : "another law is",
      law.formula));
}

}  // namespace rolling
