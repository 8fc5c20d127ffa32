// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/laws.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/matrix.h"
#include "base/error.h"
#include "fit/errors.h"
#include "fit/first_guess.h"
#include "fit/roll_fit.h"
#include "fit/fitted.h"
#include "fit/shift_rows.h"
#include "statistics/residuals.h"

namespace rolling {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The fit of one law: its minimum, and the coefficients that its `shift` takes.
struct LawMinimum {
  const LawForm* law;
  Minimum minimum;
  std::vector<double> c;

  bool found() const { return std::isfinite(minimum.rss); }
};

/// The rows and weights of a fit of a v^b, applied to other laws. theta holds the own parameters
/// of each run (v0, x0) as in that fit, then the coefficients of the law, then the slope if it is
/// fitted.
class FittedRows {
 public:
  explicit FittedRows(Fitted power)
      : power_(std::move(power)), law_(*power_.law().power()), v_unit_(power_.fastest()) {}

  const Fitted& power() const { return power_; }
  LawMinimum of_power() const { return {&laws().front(), power_.minimum, {1, law_.b}}; }

  /// theta with v0, x0 and the slope of the fitted a v^b, and with these coefficients.
  std::vector<double> theta(const std::vector<double>& c) const {
    const System& system = power_.system;
    std::vector<double> all = power_.minimum.theta;
    const double slope = all.back();
    all.resize(system.runs.size() * system.own);
    all.insert(all.end(), c.begin(), c.end());
    if (power_.slope) all.push_back(slope);
    return all;
  }

  /// The fit of another law before its minimum is found, in units in which shifts and speeds are of
  /// order one.
  Fitted unsolved(const LawForm& form) const {
    Fitted fit{};
    fit.noise = power_.noise, fit.shifts = power_.shifts;
    fit.rows = power_.rows;
    const Parameters q = power_.rolls ? power_.rolls->parameters() : Parameters({}, false, 1, 1);
    fit.parameters = q.with(form, law_(v_unit_), v_unit_);
    if (power_.rolls) {
      fit.rolls = std::make_shared<const RollModel>(power_.rolls->runs(), *fit.parameters);
      fit.system = system_of(fit.rolls, fit.noise);
    } else {
      fit.system = system_of(fit.shifts, *fit.parameters);
    }
    return fit;
  }

  /// The fit of a law that was found.
  Fitted solved(const LawMinimum& found) const {
    if (found.law == &laws().front()) return power_;
    Fitted fit = unsolved(*found.law);
    fit.minimum = found.minimum;
    fit.rolls ? report_roll(fit) : report_law(fit, *fit.parameters);
    return fit;
  }

 private:
  Fitted power_;
  PowerLaw law_;
  double v_unit_;
};

/// The coefficients that bring a law closest to another one, by least squares over the speeds, from
/// each of its starting points. If the other law is a special case of this one, the result is
/// exact.
std::vector<std::vector<double>> closest(const LawForm& law, const LawMinimum& other) {
  ShiftRows curve;
  for (int i = 1; i <= 20; ++i) {
    double by_c[LawForm::most];
    curve.v.push_back(i / 20.);
    curve.y.push_back(other.law->shift(other.c.data(), curve.v.back(), by_c).D);
  }
  curve.runs = {curve.v.size()};
  const System system = system_of(std::make_shared<const ShiftRows>(std::move(curve)),
                                  Parameters({}, false, 1, 1).with(law, 1, 1));
  std::vector<std::vector<double>> all;
  for (const auto& start : law.starts) all.push_back(attempt(system, start).theta);
  return all;
}

/// The smallest minimum of a law over several starting points. The search starts where the law is
/// closest to a v^b and to the laws fitted before, so that it never ends above a special case of
/// the law. If the law has several starts of its own, they are tried as well: close to a law
/// without a peak, a law with a peak has another minimum than at its peak.
LawMinimum fit_law(const FittedRows& rows, const LawForm& law,
                   const std::vector<LawMinimum>& before) {
  const System system = rows.unsolved(law).system;
  std::vector<std::pair<double, std::vector<double>>> starts;
  for (const LawMinimum& other : before) {
    if (!other.found()) continue;
    for (const auto& c : closest(law, other)) {
      // v0 and x0 come from the fit of the law that is approximated.
      std::vector<double> theta = rows.theta(c);
      if (&other != &before.front())
        std::copy_n(other.minimum.theta.begin(), system.runs.size() * system.own, theta.begin());
      double rss = 0;
      try {
        system.evaluate(theta, [&](std::size_t, std::span<double> f, std::span<double>) {
          for (double x : f) rss += x * x;
        });
      } catch (const Error&) {
        continue;
      }
      if (std::isfinite(rss)) starts.emplace_back(rss, std::move(theta));
    }
  }
  std::ranges::sort(starts);
  const auto same = [](const auto& x, const auto& y) {
    return y.first - x.first <= 1e-9 * x.first;
  };
  starts.erase(std::unique(starts.begin(), starts.end(), same), starts.end());
  LawMinimum best{&law, {{}, {}, {}, infinity}, {}};
  const auto try_from = [&](const std::vector<double>& theta) {
    if (Minimum m = attempt(system, theta); m.rss < best.minimum.rss) best.minimum = std::move(m);
  };
  for (auto start = starts.begin(); start != starts.end() && !best.found(); ++start)
    try_from(start->second);
  if (law.starts.size() > 1)
    for (const auto& start : law.starts) try_from(rows.theta(start));
  if (!best.found()) return best;
  const auto shared = best.minimum.theta.end() - static_cast<std::ptrdiff_t>(system.shared);
  best.c.assign(shared, shared + static_cast<std::ptrdiff_t>(law.coefficients.size()));
  return best;
}

/// The fits of the laws before this one in the table, each of which the next begins from, and of
/// this one.
std::vector<LawMinimum> fits_up_to(const FittedRows& rows, const LawForm& last) {
  std::vector<LawMinimum> all{rows.of_power()};
  while (all.back().law != &last) all.push_back(fit_law(rows, laws()[all.size()], all));
  return all;
}

/// The number of independent rows, from the law that leaves the smallest autocorrelation.
double independent_rows(const std::vector<LawMinimum>& all, const std::vector<std::size_t>& runs) {
  const double n = static_cast<double>(all.front().minimum.f.size());
  double r = 1;
  for (const LawMinimum& law : all)
    if (const Minimum& m = law.minimum; m.rss > 0 && law.found())
      r = std::min(r, lagged(m.f, runs, 1) / m.rss);
  return r > 0 && r < 1 ? n * (1 - r) / (1 + r) : n;
}

/// Writes the coefficients with their standard errors, estimated as in fit(), and their
/// correlations.
void report_coefficients(LawFit& result, const Fitted& fit) {
  const Matrix covariance = uncertainty_of(fit).covariance;
  for (std::size_t j = 0; j < fit.coefficients.size(); ++j)
    result.coefficients.push_back({fit.coefficients[j].value, std::sqrt(covariance[j][j])});
  result.correlations = correlations_of(covariance, fit.coefficients.size());
}

}  // namespace

double LawComparison::least() const { return std::ranges::min(fits, {}, &LawFit::aicc).aicc; }

const LawFit& LawComparison::best_other(const LawForm& law) const {
  return *std::ranges::min_element(fits, {}, [&](const LawFit& fit) {
    return std::pair(fit.law == &law || (fit.law->is_power && law.is_power), fit.aicc);
  });
}

double LawComparison::against(const LawForm& law) const {
  return possible(law) ? std::ranges::find(fits, &law, &LawFit::law)->aicc - best_other(law).aicc
                       : 0;
}

bool LawComparison::possible(const LawForm& law) const {
  return std::isfinite(std::ranges::find(fits, &law, &LawFit::law)->aicc) &&
         std::isfinite(best_other(law).aicc);
}

Fitted fit_of_law(Fitted power, const LawForm& law) {
  const char* const slope =
      power.slope ? " and the slope of the mat: add runs in the other direction" : "";
  const FittedRows rows(std::move(power));
  const LawMinimum found = fits_up_to(rows, law).back();
  if (!found.found()) fail("the rows do not determine D = {}{}", law.formula, slope);
  return rows.solved(found);
}

LawComparison compare_laws(Route route, const std::vector<FitRun>& runs, FitOptions options) {
  if (options.robust) fail("laws are compared by squares only");
  // The mean of ln D is not the logarithm of the mean of D if D is noisy; other laws would fit the
  // difference.
  if (route == Route::loglog) route = Route::shift;
  options.law = &laws().front();
  const FittedRows rows(of_means(fit_route(route, runs, options), options));
  const Fitted& power = rows.power();
  const std::vector<LawMinimum> all = fits_up_to(rows, laws().back());
  const double n = static_cast<double>(power.minimum.f.size()),
               independent = independent_rows(all, power.system.runs),
               least = std::max(variance_of_rounding(power), std::numeric_limits<double>::min());
  LawComparison result;
  for (const LawMinimum& found : all) {
    const Minimum& m = found.minimum;
    const double k =
        static_cast<double>(m.theta.size()) + 1;  // the variance of the noise is a parameter, too
    const double aicc = independent * std::log(std::max(m.rss / n, least)) + 2 * k +
                        2 * k * (k + 1) / (independent - k - 1);
    LawFit& of_law = result.fits.emplace_back(
        LawFit{found.law, found.found() && independent > k + 1 ? aicc : infinity, {}, {}});
    if (found.found()) report_coefficients(of_law, rows.solved(found));
  }
  return result;
}

}  // namespace rolling
