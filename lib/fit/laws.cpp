// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/laws.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/by_run.h"
#include "base/error.h"
#include "fit/errors.h"
#include "fit/first_guess.h"
#include "fit/roll_fit.h"
#include "fit/route.h"
#include "fit/shift_rows.h"
#include "statistics/residuals.h"

namespace rolling {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The rows and weights of a fit of a v^b, applied to other laws. theta holds the own parameters
/// of each run (v0, x0) as in that fit, then the coefficients of the law, then the slope if it is
/// fitted.
class FittedRows {
 public:
  explicit FittedRows(Fitted power)
      : power_(std::move(power)), law_{power_.a.value, power_.b.value} {
    if (power_.shifts) v_unit_ = std::ranges::max(power_.shifts->v);
    for (const auto& q : power_.v0) v_unit_ = std::max(v_unit_, std::abs(q.value));
  }

  const Fitted& power() const { return power_; }
  /// The parameters of a fit of another law, in units in which shifts and speeds are of order one.
  Parameters parameters(const LawForm& form) const {
    const Parameters q = power_.rolls ? power_.rolls->parameters() : Parameters({}, false, 1, 1);
    return q.with(form, law_(v_unit_), v_unit_);
  }

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

  System system(const LawForm& form) const {
    const Parameters q = parameters(form);
    if (!power_.rolls) return system_of(power_.shifts, q);
    return system_of(std::make_shared<const RollModel>(power_.rolls->runs(), q), power_.noise);
  }

 private:
  Fitted power_;
  PowerLaw law_;
  double v_unit_ = 0;
};

/// The fit of one law.
struct Candidate {
  const LawForm* law;
  Minimum minimum;
  std::vector<double> c;

  bool found() const { return std::isfinite(minimum.rss); }
};

/// The coefficients that bring a law closest to another one, by least squares over the speeds, from
/// each of its starting points. If the other law is a special case of this one, the result is
/// exact.
std::vector<std::vector<double>> closest(const LawForm& law, const Candidate& other) {
  constexpr std::size_t points = 20;
  const System curve{{points},
                     0,
                     law.coefficients.size(),
                     [&](const std::vector<double>& c, const TakeRows& take) {
    std::vector<double> f(points), J(points * c.size());
    for (std::size_t i = 0; i < points; ++i) {
      const double u = static_cast<double>(i + 1) / points;
      double by_c[LawForm::most], by_other[LawForm::most];
      f[i] = law.shift(c.data(), u, by_c).D - other.law->shift(other.c.data(), u, by_other).D;
      for (std::size_t j = 0; j < c.size(); ++j) J[j * points + i] = by_c[j];
    }
    take(0, f, J);
                     }};
  std::vector<std::vector<double>> all;
  for (const auto& start : law.starts) all.push_back(attempt(curve, start).theta);
  return all;
}

/// The smallest minimum of a law over several starting points. The search starts where the law is
/// closest to a v^b and to the laws fitted before, so that it never ends above a special case of
/// the law. If the law has several starts of its own, they are tried as well: close to a law
/// without a peak, a law with a peak has another minimum than at its peak.
Candidate fit_law(const FittedRows& rows, const LawForm& law,
                  const std::vector<Candidate>& before) {
  const System system = rows.system(law);
  std::vector<std::pair<double, std::vector<double>>> starts;
  for (const Candidate& other : before) {
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
  Candidate best{&law, {{}, {}, {}, infinity}, {}};
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

/// The number of independent rows, from the law that leaves the smallest autocorrelation.
double independent_rows(const std::vector<Candidate>& all, const std::vector<std::size_t>& runs) {
  const double n = static_cast<double>(all.front().minimum.f.size());
  double r = 1;
  for (const Candidate& law : all)
    if (const Minimum& m = law.minimum; m.rss > 0 && law.found())
      r = std::min(r, lagged(m.f, runs, 1) / m.rss);
  return r > 0 && r < 1 ? n * (1 - r) / (1 + r) : n;
}

/// Writes the coefficients with their standard errors, estimated as in fit(), and their
/// correlations.
void report_coefficients(LawFit& result, const FittedRows& rows, const Candidate& found) {
  Fitted fit = rows.power();
  std::vector<FittedNumber> values{fit.a, fit.b};
  if (found.law != &laws().front()) {
    values.clear();
    fit.system = rows.system(*found.law);
    fit.minimum = found.minimum;
    const Parameters q = rows.parameters(*found.law);
    const Law law = q.law(found.minimum.theta);
    for (std::size_t j = 0; j < law.size(); ++j) {
      FittedNumber number{0, std::vector<double>(fit.system.columns())};
      std::array<double, LawForm::most> by_c{};
      number.value = law.in_SI(j, by_c);
      q.chain(number.gradient.data(), 1, law.c(0), {by_c});
      values.push_back(std::move(number));
    }
  }
  const Uncertainty errors = uncertainty_of(fit);
  for (const FittedNumber& x : values)
    result.coefficients.push_back({x.value, std::sqrt(errors.covariance(x.gradient, x.gradient))});
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t j = 0; j < values.size(); ++j) {
      const double sigmas = result.coefficients[i].sigma * result.coefficients[j].sigma;
      result.correlations.push_back(
          sigmas == 0 ? 0 : errors.covariance(values[i].gradient, values[j].gradient) / sigmas);
    }
}

}  // namespace

double LawComparison::least() const { return std::ranges::min(fits, {}, &LawFit::aicc).aicc; }

const LawFit& LawComparison::best_other() const {
  return *std::ranges::min_element(
      fits, {}, [](const LawFit& fit) { return std::pair(fit.law->is_power, fit.aicc); });
}

double LawComparison::against_power() const {
  return possible() ? fits.front().aicc - best_other().aicc : 0;
}

bool LawComparison::possible() const {
  return std::isfinite(fits.front().aicc) && std::isfinite(best_other().aicc);
}

LawComparison compare_laws(Route route, const std::vector<FitRun>& runs,
                           const FitOptions& options) {
  if (options.robust) fail("laws are compared by squares only");
  // The mean of ln D is not the logarithm of the mean of D if D is noisy; other laws would fit the
  // difference.
  if (route == Route::loglog) route = Route::shift;
  const FittedRows rows(of_means(fit_route(route, runs, options), options));
  const Fitted& power = rows.power();
  std::vector<Candidate> all{{&laws().front(), power.minimum, {1, power.b.value}}};
  for (std::size_t i = 1; i < laws().size(); ++i) all.push_back(fit_law(rows, laws()[i], all));
  const double n = static_cast<double>(power.minimum.f.size()),
               independent = independent_rows(all, power.system.runs);
  LawComparison result;
  for (const Candidate& found : all) {
    const Minimum& m = found.minimum;
    const double k =
        static_cast<double>(m.theta.size()) + 1;  // the variance of the noise is a parameter, too
    const double aicc =
        independent * std::log(std::max(m.rss, std::numeric_limits<double>::min()) / n) + 2 * k +
        2 * k * (k + 1) / (independent - k - 1);
    LawFit& of_law = result.fits.emplace_back(
        LawFit{found.law, found.found() && independent > k + 1 ? aicc : infinity, {}, {}});
    if (found.found()) report_coefficients(of_law, rows, found);
  }
  return result;
}

}  // namespace rolling
