// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/shift_rows.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "base/matrix.h"
#include "base/error.h"
#include "contact/contact.h"
#include "contact/law.h"
#include "fit/errors.h"
#include "fit/roll_fit.h"
#include "statistics/logarithm_of_noise.h"

namespace rolling {
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
void carry_noise(Fitted& line, const std::vector<FitRun>& runs, KnownRoll known,
                 const FitOptions& options) {
  const Fitted& roll = known.fit;
  Matrix Q = orthonormal(line);
  std::vector<Rows> rows;
  std::vector<std::size_t> sizes;  // 0 for a run that the line has not
  for (std::size_t r = 0; r < runs.size(); ++r) {
    rows.push_back(shift_rows(runs[r], options, true, known.stops[r]));
    sizes.push_back(rows.back().size());
  }
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
    solve_transposed(line.minimum.R.data(), gradient);
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
  const auto some = [](const Rows& readings) { return !readings.empty(); };
  if (runs.empty() && std::ranges::any_of(usable(Route::loglog, all), some))
    fail("no row has v > 0 and D > 0: there is no logarithm to fit");
  std::optional<KnownRoll> roll = known_roll(runs, options, std::move(theirs));
  std::vector<ObservedRun> rows =
      observed_shifts(runs, options, true, roll ? roll->stops : std::vector<double>());
  const Parameters q = parameters_of_shifts(rows, options);
  // The residuals are linear: any start will do.
  Fitted line = fit_from({q, {q.theta({1e-3, 0}, {}, {})}}, std::move(rows),
                         std::make_shared<const Noise>(), options);
  for (const FitRun& run : runs)
    if (!roll)
      line.negative +=
          shift_rows(run, options, false).size() - shift_rows(run, options, true).size();
  if (roll) carry_noise(line, runs, std::move(*roll), options);
  return line;
}

}  // namespace rolling
