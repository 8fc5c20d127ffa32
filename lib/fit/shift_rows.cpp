// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/shift_rows.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/grid.h"
#include "base/matrix.h"
#include "base/median.h"
#include "contact/contact.h"
#include "contact/law.h"
#include "fit/errors.h"
#include "fit/roll_fit.h"
#include "statistics/logarithm_of_noise.h"

namespace rolling {
namespace {

/// A starting point: the exponent of a coarse grid with the smallest sum of squares (the height
/// follows by linear least squares), or the values that are fixed; of a few thousand of the rows.
/// From one exponent of the grid to the next no D changes by more than a factor e^(1/2) relative to
/// D at the mean of ln v.
PowerLaw power_start(const std::vector<ObservedRun>& runs, double v_ref,
                     const FitOptions& options) {
  constexpr std::size_t most = 4096;
  std::size_t n = 0;
  for (const ObservedRun& run : runs) n += run.y.size();
  std::vector<double> v, D;
  double widest = 2;
  for (const ObservedRun& run : runs)
    for (std::size_t i = 0; i < run.y.size(); i += (n + most - 1) / most) {
      v.push_back(run.t[i]), D.push_back(run.y[i]);
      widest = std::max(widest, std::abs(std::log(v.back() / v_ref)));
    }
  std::vector<double> exponents;
  if (options.b) exponents = {*options.b};
  else
    for (double b = -4; b <= 8; b += 0.5 / widest) exponents.push_back(b);
  double least = std::numeric_limits<double>::infinity();
  PowerLaw best{0, 0};
  for (double b : exponents) {
    const PowerLaw unit{std::pow(v_ref, -b), b};
    double mm = 0, mD = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double m = unit(v[i]);
      mm += m * m, mD += m * D[i];
    }
    const double height = options.a ? *options.a / unit.a : mD / mm,
                 rss = height * (height * mm - 2 * mD);  // but for the squares of D
    if (height > 0 && rss < least) least = rss, best = {unit.a * height, b};
  }
  if (best.a == 0) fail("D is 0 or has the other sign than v, as if the mat drove the body on");
  return best;
}

}  // namespace

Rows shift_rows(const FitRun& run, const FitOptions& options, bool logarithms, double stop) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto rolls = [&](std::size_t i) { return stop == infinity || run.t[i] < stop; };
  double sum = 0;
  for (std::size_t i = 0; i < run.v.size(); ++i)
    if (std::isfinite(run.v[i]) && rolls(i)) sum += run.v[i];
  // What is left where the terms of a sum cancel is 0: a share of the median size, which no single
  // reading can shift.
  const double way = sum < 0 ? -1 : 1, least_v = program_rounding * typical_size(run.v),
               least_D = logarithms ? program_rounding * typical_size(run.D) : -infinity;
  Rows rows;
  for (std::size_t i = 0; i < run.v.size(); ++i) {
    const double v = way * run.v[i], D = way * run.D[i];
    if (v > least_v && v >= options.min_speed && std::isfinite(v) && std::isfinite(D) &&
        D > least_D && rolls(i))
      rows.push_back(i);
  }
  return rows;
}

std::vector<ObservedRun> observed_shifts(const std::vector<FitRun>& all,
                                         const std::vector<Rows>& rows, const FitOptions& options,
                                         bool logarithms) {
  std::vector<ObservedRun> runs;
  std::vector<double> speeds;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const FitRun& run = all[r];
    if (rows[r].empty()) continue;
    const double way = run.v[rows[r].front()] < 0 ? -1 : 1;
    ObservedRun& seen = runs.emplace_back();
    seen.column = logarithms ? RawColumn::ln_D : RawColumn::D;
    for (const std::size_t i : rows[r]) {
      seen.t.push_back(way * run.v[i]);
      seen.y.push_back(logarithms ? std::log(way * run.D[i]) : way * run.D[i]);
    }
    speeds.insert(speeds.end(), seen.t.begin(), seen.t.end());
  }
  require_rows(speeds.size(), !options.a + !options.b, speeds.size());
  if (!options.b && std::ranges::all_of(speeds, [&](double v) { return v == speeds[0]; }))
    fail("all speeds are equal: b cannot be determined");
  return runs;
}

Parameters parameters_of_shifts(const std::vector<ObservedRun>& runs, const FitOptions& options) {
  double sum = 0, n = 0;
  for (const ObservedRun& run : runs)
    for (const double v : run.t) sum += std::log(v), ++n;
  return {options, std::exp(sum / n)};
}

Fitted fit_shift(const std::vector<FitRun>& all, const FitOptions& options) {
  std::vector<Rows> rows;
  for (const FitRun& run : all) rows.push_back(shift_rows(run, options, false));
  std::vector<ObservedRun> runs = observed_shifts(all, rows, options, false);
  const Parameters q = parameters_of_shifts(runs, options);
  const PowerLaw start = power_start(runs, q.speed_unit(), options);
  return fit_from({q, {q.theta(start, {}, {})}}, std::move(runs), std::make_shared<const Noise>(),
                  options);
}

namespace {

/// The noise and the bias of the points (ln v, ln D) of a run. The noise of ln D - b ln v is
/// by_D D e + by_v v e for each point, with raw noise e of variance one and the rows of D and v.
struct Points {
  std::vector<double> by_D, by_v;
  std::vector<double> bias;  ///< expectation of ln D - b ln v minus ln a
};

/// The noise and bias of the logarithms for a roll under the law. D and v are the matrices that
/// compute the accelerations and speeds of the points from the raw column (along the direction of
/// motion), shift() converts an acceleration to D, and sigma is the standard deviation of the raw
/// noise. The bias has two causes: smoothing bends the curve D(v), and the logarithm of a noisy
/// number is too low on average. Its noise is also smaller than the relative noise of D.
Points points_of(const BandMatrix& D, const BandMatrix& v, std::span<const double> raw,
                 PowerLaw law, const std::function<double(double)>& shift, double sigma) {
  const std::vector<double> accelerations = D.times(raw), speeds = v.times(raw);
  Points points;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    constexpr double step = 1e-4;
    const double a_i = accelerations[i], v_i = speeds[i], D_i = shift(a_i);
    // Minus the derivative of ln D - b ln v by the raw column; that of ln D is a difference
    // quotient. Where D of the roll is not positive, its relative noise is infinite; 1e100 stands
    // for that.
    const double by_D = D_i > 0 ? (shift((1 - step) * a_i) / D_i - 1) / (step * a_i) : 1e100,
                 by_v = v_i > 0 ? law.b / v_i : 0,
                 s = sigma *
                     std::sqrt(by_D * by_D * dot(D, i, D, i) + 2 * by_D * by_v * dot(D, i, v, i) +
                               by_v * by_v * dot(v, i, v, i));
    const Estimate log_noise = s > 0 && std::isfinite(s) ? logarithm_of_noise(s) : Estimate{};
    const double factor = log_noise.sigma > 0 ? log_noise.sigma / s : 0;
    points.by_D.push_back(by_D * factor);
    points.by_v.push_back(by_v * factor);
    points.bias.push_back(D_i > 0 && v_i > 0 ? std::log(D_i / law(v_i)) : 0);
    if (D_i > 0) points.bias.back() += log_noise.value;
  }
  return points;
}

/// Adds H^T (x factors) to `to`, where x factors is the product element by element.
void add_transposed(const BandMatrix& H, std::span<const double> x,
                    const std::vector<double>& factors, std::span<double> to) {
  std::vector<double> scaled(x.begin(), x.end());
  std::ranges::transform(scaled, factors, scaled.begin(), std::multiplies());
  std::ranges::transform(H.transposed_times(scaled), to, to.begin(), std::plus());
}

/// The roll that made the rows of a line, for known filters.
struct KnownRoll {
  std::vector<Response> responses;
  Fitted fit;  ///< without its system and weights, which are large
  SeenNoise noise;
  /// When it stops, for each run. Behind the stop v and D are noise alone, and where both happen to
  /// be positive their logarithms are far from the line.
  std::vector<double> stops;
};

/// The best-fitting roll; nothing if the filters are unknown, no roll fits, or the columns hold
/// other noise, as that of rounding. It is fitted to all rows; a selection of those with D > 0
/// would select by their noise.
std::optional<KnownRoll> known_roll(const std::vector<FitRun>& runs, const FitOptions& options,
                                    std::vector<Response> responses) {
  if (responses.empty()) return {};
  KnownRoll roll;
  try {
    roll.fit = fit_rolls(Route::shift, runs, usable(Route::shift, runs), responses, options);
  } catch (const Error&) {
    return {};
  }
  if (!roll.fit.noise->from_sources_alone()) return {};
  roll.noise = seen_noise(roll.fit);
  roll.fit.system = {}, roll.fit.noise = {};
  roll.responses = std::move(responses);
  for (std::size_t r = 0; r < runs.size(); ++r)
    roll.stops.push_back(roll.fit.model->runs()[r].origin +
                         roll.fit.model->roll(roll.fit.minimum.theta, r).stop_time());
  return roll;
}

/// Adds the noise and the bias of ln D - b ln v to a line: those of the roll, observed through the
/// known filters.
void carry_noise(Fitted& line, const std::vector<FitRun>& runs, const std::vector<Rows>& rows,
                 KnownRoll known) {
  const Fitted& roll = known.fit;
  Matrix Q = orthonormal(line);
  std::vector<std::size_t> sizes;  // 0 for a run that the line has not
  for (const Rows& of_run : rows) sizes.push_back(of_run.size());
  const auto Q_of = rows_by_run(Q, sizes);
  Matrix& B = known.noise.B;
  B.assign(Q.size(), {});
  std::vector<double> along(Q.size());  // Q^T bias
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const ObservedRun& run = roll.model->runs()[r];
    std::vector<double> raw = roll.model->raw_column(roll.minimum.theta, r);
    for (double& value : raw) value *= run.way;  // along the motion
    const auto shift = [&, by = *runs[r].shift_of](double a) {
      return run.way * shift_from_acceleration(by.body, by.geometry, run.way * a);
    };
    const BandMatrix D_of = known.responses[r].of.at("D")->of_rows(rows[r]),
                     v_of = known.responses[r].of.at("v")->of_rows(rows[r]);
    const Points points =
        points_of(D_of, v_of, raw, *roll.law().power(), shift, std::sqrt(known.noise.variance));
    for (std::size_t j = 0; j < Q.size(); ++j) {
      const std::size_t first = B[j].size();
      B[j].resize(first + D_of.columns());
      const std::span of_run = std::span(B[j]).subspan(first);
      add_transposed(D_of, Q_of[r][j], points.by_D, of_run);
      add_transposed(v_of, Q_of[r][j], points.by_v, of_run);
      along[j] += dot(Q_of[r][j], points.bias);
    }
  }
  line.noise_of_roll = std::move(known.noise);
  // The bias of theta is R^-1 Q^T bias.
  const auto bias_of = [&](std::vector<double> gradient) {
    line.minimum.R.solve_transposed(0, gradient);
    return dot(gradient, along);
  };
  for (const FittedNumber& number : line.coefficients)
    line.bias.push_back(bias_of(number.gradient));
}

}  // namespace

Fitted fit_log_log(const std::vector<FitRun>& all, const FitOptions& options,
                   std::vector<Response> responses) {
  std::vector<FitRun> runs;  // that have a logarithm
  std::vector<Response> theirs;
  for (std::size_t r = 0; r < all.size(); ++r) {
    if (shift_rows(all[r], options, true).empty()) continue;
    runs.push_back(all[r]);
    if (!responses.empty()) theirs.push_back(std::move(responses[r]));
  }
  if (runs.empty() && !std::ranges::all_of(usable(Route::loglog, all), &Rows::empty))
    fail("no row has v > 0 and D > 0: there is no logarithm to fit");
  std::optional<KnownRoll> roll = known_roll(runs, options, std::move(theirs));
  std::vector<Rows> rows;
  std::size_t all_rows = 0, positive = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    rows.push_back(roll ? shift_rows(runs[r], options, true, roll->stops[r])
                        : shift_rows(runs[r], options, true));
    all_rows += shift_rows(runs[r], options, false).size(), positive += rows.back().size();
  }
  std::vector<ObservedRun> logarithms = observed_shifts(runs, rows, options, true);
  const Parameters q = parameters_of_shifts(logarithms, options);
  // The residuals are linear: any start will do.
  Fitted line = fit_from({q, {q.theta({1e-3, 0}, {}, {})}}, std::move(logarithms),
                         std::make_shared<const Noise>(), options);
  if (roll) carry_noise(line, runs, rows, std::move(*roll));
  else line.negative = all_rows - positive;
  return line;
}

}  // namespace rolling
