// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/routes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/grid.h"
#include "base/matrix.h"
#include "base/median.h"
#include "contact/contact.h"
#include "law/law.h"
#include "fit/uncertainty.h"
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
  std::vector<double> v;
  std::vector<double> D;
  double widest = 2;
  for (const ObservedRun& run : runs)
    for (std::size_t i = 0; i < run.y.size(); i += (n + most - 1) / most) {
      v.push_back(run.t[i]);
      D.push_back(run.y[i]);
      widest = std::max(widest, std::abs(std::log(v.back() / v_ref)));
    }
  std::vector<double> exponents;
  if (options.fixed[1]) exponents = {*options.fixed[1]};
  else
    for (double b = -4; b <= 8; b += 0.5 / widest) exponents.push_back(b);
  double least = INFINITY;
  PowerLaw best{0, 0};
  for (double b : exponents) {
    const PowerLaw unit{std::pow(v_ref, -b), b};
    double mm = 0;
    double mD = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double m = unit(v[i]);
      mm += m * m;
      mD += m * D[i];
    }
    const double height = options.fixed[0] ? *options.fixed[0] / unit.a : mD / mm;
    const double rss = height * (height * mm - 2 * mD);  // but for the squares of D
    if (height > 0 && rss < least) {
      least = rss;
      best = {unit.a * height, b};
    }
  }
  if (best.a == 0) fail("D is 0 or has the other sign than v, as if the mat drove the body on");
  return best;
}

/// The variance of white noise in a column at these times, by the differences of orders 3 to 6: a
/// difference of order k makes it (2k choose k) times as large, and leaves the less of a smooth
/// motion the higher k is. 0 where the times are not even or too few.
double variance_of_noise(const std::vector<double>& t, std::vector<double> column) {
  double least = INFINITY;
  for (std::size_t i = 2; i < t.size(); ++i)
    if (std::abs(t[i] - 2 * t[i - 1] + t[i - 2]) > 1e-3 * (t[i] - t[i - 1])) return 0;
  double grown = 1;
  for (std::size_t k = 1; k <= 6 && column.size() > 12; ++k) {
    for (std::size_t i = 0; i + 1 < column.size(); ++i) column[i] = column[i + 1] - column[i];
    column.pop_back();
    grown *= 2 * (2 * static_cast<double>(k) - 1) / static_cast<double>(k);
    if (k >= 3)
      least = std::min(least, dot(column, column) / (grown * static_cast<double>(column.size())));
  }
  return least < INFINITY ? least : 0;
}

/// The expected bias of the coefficients where the speeds have noise of their own, as those of an
/// encoder beside the accelerations of another sensor: least squares takes them as exact, and a
/// noisy abscissa makes a slope too small (Fuller 1987, Measurement Error Models, section 1.1). To
/// the second order in the noise u of v the bias of theta is (J^T J)^-1 sum E[J(v + u) (D(v) -
/// D(v + u))]; the expectation is that of two values of u.
std::vector<double> bias_by_speeds(const Fitted& fit, const std::vector<double>& variances) {
  const std::vector<double>& theta = fit.minimum.theta;
  const double c0 = fit.parameters().law(theta).c(0);
  std::vector<double> sum(theta.size());
  std::vector<double> slopes(theta.size());
  for (std::size_t r = 0; r < variances.size(); ++r) {
    const RawModel D = fit.model.raw(theta, r);
    Parameters::Numbers by{};
    for (const double v : fit.model.runs()[r].t) {
      const double u = std::min(std::sqrt(variances[r]), v / 2);
      const double truth = D(v, by);
      for (const double seen : {v - u, v + u}) {
        const double off = truth - D(seen, by);
        fit.parameters().chain(slopes.data(), 1, c0, by);
        for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += slopes[j] * off / 2;
      }
    }
  }
  fit.minimum.R.solve_transposed(0, sum);
  std::vector<double> bias;
  for (const FittedNumber& number : fit.coefficients) {
    std::vector<double> gradient = number.gradient;
    fit.minimum.R.solve_transposed(0, gradient);
    bias.push_back(dot(gradient, sum));
  }
  return bias;
}

}  // namespace

Rows shift_rows(const Run& run, const FitOptions& options, bool logarithms, double stop) {
  const auto rolls = [&](std::size_t i) { return stop == INFINITY || run.t[i] < stop; };
  double sum = 0;
  for (std::size_t i = 0; i < run.v.size(); ++i)
    if (std::isfinite(run.v[i]) && rolls(i)) sum += run.v[i];
  // What is left where the terms of a sum cancel is 0: a share of the median size, which no single
  // reading can shift.
  const double way = sum < 0 ? -1 : 1;
  const double least_v = program_rounding * typical_size(run.v);
  const double least_D = logarithms ? program_rounding * typical_size(run.D) : -INFINITY;
  Rows rows;
  for (std::size_t i = 0; i < run.v.size(); ++i) {
    const double v = way * run.v[i];
    const double D = way * run.D[i];
    if (v > least_v && v >= options.min_speed && std::isfinite(v) && std::isfinite(D) &&
        D > least_D && rolls(i))
      rows.push_back(i);
  }
  return rows;
}

Model model_of_shifts(const std::vector<Run>& all, const std::vector<Rows>& rows,
                      const FitOptions& options, bool logarithms) {
  std::vector<ObservedRun> runs;
  std::vector<double> speeds;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const Run& run = all[r];
    if (rows[r].empty()) continue;
    const double way = run.v[rows[r].front()] < 0 ? -1 : 1;
    ObservedRun& seen = runs.emplace_back();
    seen.column = Quantity::D;
    seen.logarithm = logarithms;
    for (const std::size_t i : rows[r]) {
      seen.t.push_back(way * run.v[i]);
      seen.y.push_back(logarithms ? std::log(way * run.D[i]) : way * run.D[i]);
    }
    speeds.insert(speeds.end(), seen.t.begin(), seen.t.end());
  }
  require_rows(speeds.size(), !options.fixed[0] + !options.fixed[1], speeds.size());
  if (!options.fixed[1] && std::ranges::all_of(speeds, [&](double v) { return v == speeds[0]; }))
    fail("all speeds are equal: b cannot be determined");
  double sum = 0;
  for (const double v : speeds) sum += std::log(v);
  return {std::move(runs), {options, std::exp(sum / static_cast<double>(speeds.size()))}};
}

Fitted fit_shift(const std::vector<Run>& all, const FitOptions& options) {
  std::vector<Rows> rows;
  for (const Run& run : all) rows.push_back(shift_rows(run, options, false));
  const Model model = model_of_shifts(all, rows, options, false);
  const Parameters& q = model.parameters();
  const PowerLaw start = power_start(model.runs(), q.speed_unit(), options);
  Fitted fit = fit_from(model, {q.theta(start, {}, {})}, options);
  std::vector<double> variances;
  for (std::size_t r = 0; r < all.size(); ++r)
    if (!rows[r].empty())
      variances.push_back(all[r].t.empty() ? 0 : variance_of_noise(all[r].t, all[r].v));
  if (std::ranges::any_of(variances, [](double variance) { return variance > 0; }))
    fit.bias = bias_by_speeds(fit, variances);
  return fit;
}

namespace {

/// The best-fitting roll that made the rows of a line, without its weights, which are large;
/// nothing if the filters are unknown, no roll fits, or the columns hold other noise, as that of
/// rounding. It is fitted to all rows; a selection of those with D > 0 would select by their noise.
std::optional<Fitted> known_roll(const std::vector<Run>& runs, const FitOptions& options,
                                 const std::vector<Response>& responses) {
  if (responses.empty()) return {};
  try {
    Fitted roll = fit_rolls(Route::shift, runs, usable(Route::shift, runs), responses, options);
    if (!roll.noise().from_sources_alone()) return {};
    roll.noise_of_roll = seen_noise(roll, orthonormal(roll.system(), roll.minimum));
    roll.model = roll.model.unweighted();
    return roll;
  } catch (const Error&) {
    return {};
  }
}

/// ln D - b ln v of the rows of one run under the roll that made them, as far as their noise goes:
/// its derivatives by the accelerations, with the sign of those by the speeds, and its bias.
struct Logarithms {
  std::vector<double> by_a, by_v, bias;
};

/// H_a and H_v are the filters of the accelerations and the speeds of these rows.
Logarithms logarithms_of(const Fitted& roll, std::size_t r, const Body& body, const BandMatrix& H_a,
                         const BandMatrix& H_v) {
  constexpr double step = 1e-4;  // of a difference quotient
  const PowerLaw law = *roll.law().power();
  const double way = roll.model.runs()[r].way;
  std::vector<double> raw = roll.model.raw_column(roll.minimum.theta, r);
  for (double& value : raw) value *= way;  // along the motion
  const std::vector<double> speeds = H_v.times(raw);
  const std::vector<double> accelerations = H_a.times(raw);
  const auto shift = [&](double a) { return way * shift_from_acceleration(body, way * a); };
  Logarithms all;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const double v = speeds[i];
    const double a = accelerations[i];
    const double D = shift(a);
    // If D of the roll is not positive, its relative noise is infinite; 1e100 stands for that.
    const double by_a = D > 0 ? (shift((1 - step) * a) / D - 1) / (step * a) : 1e100;
    const double by_v = v > 0 ? law.b / v : 0;
    const double squares = by_a * by_a * dot(H_a, i, H_a, i) +
                           2 * by_a * by_v * dot(H_a, i, H_v, i) +
                           by_v * by_v * dot(H_v, i, H_v, i);
    const double s = std::sqrt(roll.noise_of_roll->variance * squares);
    const Estimate log_noise = s > 0 && std::isfinite(s) ? logarithm_of_noise(s) : Estimate{};
    const double factor = log_noise.sigma > 0 ? log_noise.sigma / s : 0;
    all.by_a.push_back(factor * by_a);
    all.by_v.push_back(factor * by_v);
    all.bias.push_back(D > 0 ? log_noise.value : 0);
    if (D > 0 && v > 0) all.bias.back() += std::log(D / law(v));
  }
  return all;
}

/// Adds the noise and the bias of ln D - b ln v to a line: those of the roll, observed through the
/// known filters. The bias of a point has two causes: smoothing bends the curve D(v), and the
/// logarithm of a noisy number is too low on average. Its noise is also smaller than the relative
/// noise of D.
void carry_noise(Fitted& line, const std::vector<Run>& runs, const std::vector<Rows>& rows,
                 const std::vector<Response>& responses, Fitted roll) {
  const Matrix Q = orthonormal(line.system(), line.minimum);
  std::vector<std::size_t> sizes;
  for (const Rows& of_run : rows) sizes.push_back(of_run.size());
  const auto Q_of = rows_by_run(Q, sizes);
  Matrix B(Q.size());
  std::vector<double> along(Q.size());  // Q^T bias
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const BandMatrix H_a = responses[r].of[Quantity::D]->of_rows(rows[r]);
    const BandMatrix H_v = responses[r].of[Quantity::v]->of_rows(rows[r]);
    const Logarithms logarithms = logarithms_of(roll, r, *runs[r].shift_of, H_a, H_v);
    for (std::size_t j = 0; j < Q.size(); ++j) {
      const auto weighted = [&](std::vector<double> x) {
        std::ranges::transform(x, Q_of[r][j], x.begin(), std::multiplies());
        return x;
      };
      along[j] += dot(Q_of[r][j], logarithms.bias);
      std::vector<double> by_noise = H_a.transposed_times(weighted(logarithms.by_a));
      by_noise = moved(by_noise, H_v.transposed_times(weighted(logarithms.by_v)));
      B[j].insert(B[j].end(), by_noise.begin(), by_noise.end());
    }
  }
  line.noise_of_roll = std::move(roll.noise_of_roll);
  line.noise_of_roll->B = std::move(B);
  // The bias of theta is R^-1 Q^T bias.
  for (const FittedNumber& number : line.coefficients) {
    std::vector<double> gradient = number.gradient;
    line.minimum.R.solve_transposed(0, gradient);
    line.bias.push_back(dot(gradient, along));
  }
}

}  // namespace

Fitted fit_log_log(const std::vector<Run>& all, const FitOptions& options,
                   std::vector<Response> responses) {
  std::vector<Run> runs;  // that have a logarithm
  std::vector<Response> theirs;
  for (std::size_t r = 0; r < all.size(); ++r) {
    if (shift_rows(all[r], options, true).empty()) continue;
    runs.push_back(all[r]);
    if (!responses.empty()) theirs.push_back(std::move(responses[r]));
  }
  if (runs.empty() && !std::ranges::all_of(usable(Route::loglog, all), &Rows::empty))
    fail("no row has v > 0 and D > 0: there is no logarithm to fit");
  std::optional<Fitted> roll = known_roll(runs, options, theirs);
  std::vector<Rows> rows;
  std::size_t all_rows = 0;
  std::size_t positive = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    // Behind the stop v and D are noise alone, and where both happen to be positive their
    // logarithms are far from the line.
    const double stop = roll ? roll->model.runs()[r].origin + roll->roll(r).stop_time() : INFINITY;
    rows.push_back(shift_rows(runs[r], options, true, stop));
    all_rows += shift_rows(runs[r], options, false).size();
    positive += rows.back().size();
  }
  const Model logarithms = model_of_shifts(runs, rows, options, true);
  // The residuals are linear: any start will do.
  const std::vector<double> start = logarithms.parameters().theta({1e-3, 0}, {}, {});
  Fitted line = fit_from(logarithms, {start}, options);
  if (roll) carry_noise(line, runs, rows, theirs, std::move(*roll));
  else line.negative = all_rows - positive;
  return line;
}

}  // namespace rolling
