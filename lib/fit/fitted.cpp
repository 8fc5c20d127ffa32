// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/fitted.h"

#include <algorithm>
#include <array>

#include "base/enumeration.h"
#include "base/error.h"
#include "fit/inferred_noise.h"
#include "fit/laws.h"
#include "fit/roll_fit.h"
#include "fit/shift_rows.h"

namespace rolling {

void require_rows(std::size_t n, std::size_t p, std::size_t independent) {
  if (n == 0) fail("no row can be fitted");
  if (p == 0) fail("a and b are both fixed: nothing is left to fit");
  if (independent < p)
    fail("{} cannot determine {} parameters{}", counted(n, "row"), p,
         independent < n
             ? fmt::format(", for their filters leave {} of them independent", independent)
             : "");
}

std::size_t Fitted::degrees_left() const {
  const std::size_t n = informative_rows(model->runs(), parameters(), *noise),
                    p = minimum.theta.size(), left = n > p ? n - p : 0;
  return noise_of_roll ? std::min(left, noise_of_roll->freedom) : left;
}

namespace {

void report_rolls(Fitted& fit) {
  const std::vector<double>& theta = fit.minimum.theta;
  const Parameters& q = fit.parameters();
  const std::array<double, LawForm::most> none{};
  const auto quantity = [&](double value, double v0, double x0, double slope) {
    FittedNumber result{value, std::vector<double>(q.columns())};
    q.chain(result.gradient.data(), 1, 0, {none, v0, x0, slope});
    return result;
  };
  fit.v0.clear(), fit.x0.clear();
  if (q.fits_slope()) fit.slope = quantity(q.slope(theta, 0), 0, 0, 1);
  const auto& runs = fit.model->runs();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const double way = runs[r].way;
    fit.v0.push_back(quantity(way * q.v0(theta, r), way, 0, 0));
    if (q.has_x0()) fit.x0.push_back(quantity(q.x0(theta, r), 0, 1, 0));
  }
}

}  // namespace

void report(Fitted& fit) {
  const Parameters& q = fit.parameters();
  const Law law = q.law(fit.minimum.theta);
  fit.coefficients.clear();
  for (std::size_t j = 0; j < law.size(); ++j) {
    std::array<double, LawForm::most> by_c{};
    FittedNumber& number = fit.coefficients.emplace_back(
        FittedNumber{law.in_SI(j, by_c), std::vector<double>(q.columns())});
    if (const auto fixed = q.fixed(j)) number.value = *fixed;
    else q.chain(number.gradient.data(), 1, law.c(0), {by_c});
  }
  if (fit.is_roll()) report_rolls(fit);
}

Law Fitted::law() const {
  std::array<double, LawForm::most> written{};
  for (std::size_t j = 0; j < coefficients.size(); ++j) written[j] = coefficients[j].value;
  return Law::as_written(parameters().form(), std::span(written).first(coefficients.size()));
}

std::vector<FittedNumber> Fitted::numbers() const {
  std::vector<FittedNumber> all = coefficients;
  if (slope) all.push_back(*slope);
  if (!v0.empty()) all.push_back(v0.front());
  if (!x0.empty()) all.push_back(x0.front());
  return all;
}

double Fitted::fastest() const {
  double speed = 0;
  for (const FittedNumber& number : v0) speed = std::max(speed, std::abs(number.value));
  for (const ObservedRun& run : model->runs())  // of shifts, t are the speeds
    if (!is_roll()) speed = std::max(speed, std::ranges::max(run.t));
  return speed;
}

namespace {

/// Fits a v^b.
Fitted fit_power(Route route, const std::vector<FitRun>& runs, const FitOptions& options) {
  if (options.a && !(*options.a > 0))
    fail("a = {} cannot be fixed: it must be positive", *options.a);
  std::vector<Response> responses = responses_of(runs);
  const bool known = !responses.empty();
  if (options.fit_slope && route == Route::loglog)
    fail("the slope shows in a roll alone, not in a line through ln D: --route shift");
  if (options.fit_slope && route == Route::shift && !known)
    fail("the slope shows in a roll alone: on this route `##` lines must tell how D was made");
  if (options.robust && known)
    fail(
        "--robust judges single readings, and a filter spreads an outlier over many: fit the "
        "column that was not smoothed");
  if (route == Route::loglog) return fit_log_log(runs, options, std::move(responses));
  if (!known && route == Route::shift) return fit_shift(runs, options);
  Fitted fit = fit_rolls(route, runs, usable(route, runs), std::move(responses), options);
  if (route == Route::velocity && !known && !options.robust && !options.possible_filters.empty() &&
      fit.minimum.f.size() >= 30)
    if (auto differences = fit_differences(runs, options, fit)) return *std::move(differences);
  return fit;
}

}  // namespace

Fitted fit_route(Route route, const std::vector<FitRun>& runs, const FitOptions& options) {
  if (options.fits_power()) return fit_power(route, runs, options);
  if (route == Route::loglog)
    fail("a straight line of logarithms is a law a v^b: fit D = {} with --route shift",
         options.law->formula);
  if (options.robust)
    fail("D = {} is fitted by squares only, not with --robust", options.law->formula);
  if (options.a || options.b)
    fail("a and b are fixed in a law a v^b alone, not in D = {}", options.law->formula);
  return fit_of_law(fit_power(route, runs, options), *options.law);
}

}  // namespace rolling
