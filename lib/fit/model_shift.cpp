#include "fit/model_shift.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "contact/contact.h"
#include "contact/power_law.h"
#include "fit/dot.h"
#include "fit/errors.h"

namespace rolling {
namespace {

/// The records that the routes loglog and shift use, all runs in sequence. A body that rolls
/// towards falling x has v < 0 and D < 0; both are taken positive along its direction of motion.
struct ShiftRecords {
  std::vector<double> D;
  std::vector<double> log_u;      // ln v - log_v_ref
  std::vector<std::size_t> runs;  // number of records of each run
  std::vector<Rows> rows;
  std::size_t left_out = 0;
  double log_v_ref =
      0;  // ln of the geometric mean of v, where the estimates of ln D and b are uncorrelated
};

ShiftRecords shift_records(const std::vector<FitRun>& all, const FitOptions& options,
                           bool logarithms) {
  ShiftRecords records;
  std::size_t most = 0;
  for (const auto& run : all) most += run.v.size();
  records.D.reserve(most), records.log_u.reserve(most);
  for (const auto& run : all) {
    double sum = 0;
    for (double v : run.v)
      if (std::isfinite(v)) sum += v;
    const double way = sum < 0 ? -1 : 1;
    Rows rows;
    rows.reserve(run.v.size());
    for (std::size_t i = 0; i < run.v.size(); ++i) {
      const double v = way * run.v[i], D = way * run.D[i];
      if (!(std::isfinite(v) && std::isfinite(D) && v > 0 && v >= options.min_speed) ||
          (logarithms && D <= 0)) {
        ++records.left_out;
        continue;
      }
      records.log_u.push_back(std::log(v));
      records.D.push_back(D);
      rows.push_back(i);
    }
    records.runs.push_back(rows.size());
    records.rows.push_back(std::move(rows));
  }
  const std::size_t n = records.D.size();
  if (n == 0 && logarithms && records.left_out > 0)
    fail("no record has v > 0 and D > 0: there is no logarithm to fit");
  require_records(n, !options.a + !options.b);
  auto& log_u = records.log_u;
  if (!options.b &&
      std::all_of(log_u.begin(), log_u.end(), [&](double x) { return x == log_u[0]; }))
    fail("all speeds are equal: b cannot be determined");
  records.log_v_ref = std::accumulate(log_u.begin(), log_u.end(), 0.0) / static_cast<double>(n);
  for (double& x : log_u) x -= records.log_v_ref;
  return records;
}

/// The law in nearly uncorrelated parameters: the height and b. The height is D(v_ref) in some unit
/// for a power law and ln D(v_ref) for a line. Parameters that are held fixed have no element in
/// theta.
struct Height {
  std::optional<double> a, b;  // held
  double log_v_ref;

  std::size_t count() const { return !a + !b; }
  double exponent(const std::vector<double>& theta) const { return b ? *b : theta.back(); }
  /// Writes the derivatives of residual k of n: by the height, and by b at constant height. If a is
  /// held, the height depends on b; its part log_v_ref * by_log_height is added.
  void put(std::span<double> J, std::size_t k, std::size_t n, double by_height, double by_b,
           double by_log_height) const {
    if (!a) J[k] = by_height;
    if (!b) J[J.size() - n + k] = by_b + (a ? log_v_ref * by_log_height : 0);
  }
  /// Writes a and b at the minimum with their gradients; a_slope is the derivative of a with
  /// respect to the height.
  void report(Fitted& fit, double a_fitted, double a_slope) const {
    const double a_value = a.value_or(a_fitted);
    fit.a = {a_value, std::vector<double>(count(), 0)};
    fit.b = {exponent(fit.minimum.theta), std::vector<double>(count(), 0)};
    if (!a) fit.a.gradient[0] = a_slope;
    if (!a && !b) fit.a.gradient[1] = -a_value * log_v_ref;
    if (!b) fit.b.gradient.back() = 1;
  }
};

/// Passes the residuals fill(record, J, row, rows of the block) to the callback, in blocks of at
/// most 256 records, which fit into the cache.
template <typename Fill>
void hand_over(const std::vector<std::size_t>& runs, std::size_t columns, const TakeRows& take,
               Fill&& fill) {
  std::vector<double> f, J;
  std::size_t first = 0;
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (const std::size_t end = first + runs[r]; first < end; first += f.size()) {
      f.resize(std::min<std::size_t>(end - first, 256));
      J.resize(f.size() * columns);
      for (std::size_t k = 0; k < f.size(); ++k) f[k] = fill(first + k, std::span(J), k, f.size());
      take(r, f, J);
    }
}

System power_system(ShiftRecords records, Height height, double unit) {
  const std::size_t p = height.count();
  std::vector<std::size_t> runs = records.runs;
  return {std::move(runs), 0, p,
          [records = std::make_shared<const ShiftRecords>(std::move(records)), height, unit, p](
              const std::vector<double>& theta, const TakeRows& take) {
    const double b = height.exponent(theta),
                 h = height.a ? *height.a * std::exp(b * height.log_v_ref) : theta[0] * unit;
    hand_over(records->runs, p, take,
              [&](std::size_t i, std::span<double> J, std::size_t k, std::size_t n) {
      const double power = std::exp(b * records->log_u[i]);
      height.put(J, k, n, unit * power, h * power * records->log_u[i], h * power);
      return h * power - records->D[i];
    });
          }};
}

/// Every k-th record, with k the smallest that leaves at most `most` records.
ShiftRecords thinned(const ShiftRecords& records, std::size_t most) {
  ShiftRecords few;
  few.log_v_ref = records.log_v_ref;
  const std::size_t n = records.D.size();
  for (std::size_t i = 0, step = (n + most - 1) / most; i < n; i += step) {
    few.D.push_back(records.D[i]);
    few.log_u.push_back(records.log_u[i]);
  }
  few.runs = {few.D.size()};
  return few;
}

/// A starting point: the exponent of a coarse grid with the smallest sum of squares (the height
/// follows by linear least squares), or the values that the user gives.
std::vector<double> power_start(const ShiftRecords& few, const FitOptions& options, double unit) {
  const auto held = options.a ? options.a : options.start_a;
  std::vector<double> exponents;
  if (options.b || options.start_b) exponents = {options.b ? *options.b : *options.start_b};
  else
    for (double b = -4; b <= 8; b += 0.25) exponents.push_back(b);
  double least = std::numeric_limits<double>::infinity(), best_b = exponents.front(), best_h = 0;
  for (double b : exponents) {
    double mm = 0, mD = 0, rss = 0;
    for (std::size_t i = 0; i < few.D.size(); ++i) {
      const double m = std::exp(b * few.log_u[i]);
      mm += m * m;
      mD += m * few.D[i];
    }
    const double h = held ? *held * std::exp(b * few.log_v_ref) : mD / mm;
    for (std::size_t i = 0; i < few.D.size(); ++i) {
      const double f = h * std::exp(b * few.log_u[i]) - few.D[i];
      rss += f * f;
    }
    if (rss < least || exponents.size() == 1) least = rss, best_b = b, best_h = h;
  }
  std::vector<double> theta;
  if (!options.a) theta.push_back(best_h / unit);
  if (!options.b) theta.push_back(best_b);
  return theta;
}

}  // namespace

Fitted fit_shift(const std::vector<FitRun>& all, const FitOptions& options) {
  const ShiftRecords records = shift_records(all, options, false);
  const Height height{options.a, options.b, records.log_v_ref};
  double unit = 0;
  for (double D : records.D) unit = std::max(unit, std::abs(D));
  if (unit == 0) fail("all shifts are 0: b cannot be determined");
  // For many records, a few thousand of them give a starting point close to the minimum.
  constexpr std::size_t most = 4096;
  const std::size_t n = records.D.size();
  const ShiftRecords few = thinned(records, options.robust ? n : most);
  std::vector<double> theta = power_start(few, options, unit);
  if (few.D.size() < n) theta = approach(power_system(few, height, unit), std::move(theta));

  const System system = power_system(records, height, unit);
  Minimum minimum = solve(system, theta, options, false);
  const double b = height.exponent(minimum.theta), scale = std::exp(-b * records.log_v_ref),
               a = options.a ? *options.a : minimum.theta[0] * unit * scale;
  Fitted result{.system = system, .minimum = std::move(minimum)};
  result.rss = result.minimum.rss;
  result.records = n;
  result.left_out = records.left_out;
  height.report(result, a, unit * scale);
  for (double x : records.log_u) result.v.push_back(std::exp(x + records.log_v_ref));
  return result;
}

namespace {

System line_system(ShiftRecords records, Height height) {
  for (double& D : records.D) D = std::log(D);
  const std::size_t p = height.count();
  std::vector<std::size_t> runs = records.runs;
  return {std::move(runs), 0, p,
          [records = std::make_shared<const ShiftRecords>(std::move(records)), height, p](
              const std::vector<double>& theta, const TakeRows& take) {
    const double b = height.exponent(theta),
                 h = height.a ? std::log(*height.a) + b * height.log_v_ref : theta[0];
    hand_over(records->runs, p, take,
              [&](std::size_t i, std::span<double> J, std::size_t k, std::size_t n) {
      height.put(J, k, n, 1, records->log_u[i], 1);
      return h + b * records->log_u[i] - records->D[i];
    });
          }};
}

/// The mean and the standard deviation of ln(1 + e) for normal e of standard deviation s,
/// conditional on 1 + e > 0, where the logarithm exists. For small s they are -s^2/2 and s; for
/// large s the standard deviation tends to a constant and the mean grows like ln s.
Estimate logarithm_of_noise(double s) {
  // The substitution z = u^2 + least makes the integrands smooth at the pole of the logarithm. The
  // midpoint rule with this number of steps then has an error below 5e-4.
  constexpr int steps = 200;
  constexpr double range = 6;
  const double least = std::max(-range, -1 / s), length = std::sqrt(range - least);
  double weight = 0, sum = 0, squares = 0;
  for (int i = 0; i < steps; ++i) {
    const double u = (i + 0.5) / steps * length, z = least + u * u, w = u * std::exp(-z * z / 2);
    const double log = least > -range ? std::log(s * u * u) : std::log1p(s * z);
    weight += w;
    sum += w * log;
    squares += w * log * log;
  }
  const double mean = sum / weight;
  return {mean, std::sqrt(squares / weight - mean * mean)};
}

/// The same by linear interpolation in a table over ln s, whose entries are computed on demand.
class LogarithmOfNoise {
 public:
  Estimate operator()(double s) {
    const double place = (std::log(s) - least) * places;
    if (!(place >= 0 && place + 1 < static_cast<double>(table_.size())))
      return logarithm_of_noise(s);
    const auto i = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(i);
    const Estimate low = at(i), high = at(i + 1);
    return {std::lerp(low.value, high.value, share), std::lerp(low.sigma, high.sigma, share)};
  }

 private:
  static constexpr double least = -7, most = 7,
                          places = 32;  // range of ln s, and entries per unit of ln s
  Estimate at(std::size_t i) {
    if (table_[i].sigma == 0)
      table_[i] = logarithm_of_noise(std::exp(least + static_cast<double>(i) / places));
    return table_[i];
  }
  std::vector<Estimate> table_ =
      std::vector<Estimate>(static_cast<std::size_t>((most - least) * places) + 1);
};

/// The noise and the bias of the points (ln v, ln D) of a run.
struct Logarithms {
  FilterMatrix noise;  ///< matrix that maps raw noise of variance one to the noise of ln D - b ln v
  std::vector<double> bias;  ///< expectation of ln D - b ln v minus ln a, for each point
};

/// Writes x X + y Y to `sum`.
void add(double x, const FilterMatrix::Row& X, double y, const FilterMatrix::Row& Y,
         FilterMatrix::Row& sum) {
  sum.first = std::min(X.first, Y.first);
  sum.values.assign(std::max(X.end(), Y.end()) - sum.first, 0);
  for (std::size_t j = X.first; j < X.end(); ++j)
    sum.values[j - sum.first] += x * X.values[j - X.first];
  for (std::size_t j = Y.first; j < Y.end(); ++j)
    sum.values[j - sum.first] += y * Y.values[j - Y.first];
}

/// The noise and bias of the logarithms for a roll under the law. D and v are the matrices that
/// compute the accelerations and speeds from the raw column (along the direction of motion),
/// shift() converts an acceleration to D, and sigma is the standard deviation of the raw noise. The
/// bias has two causes: smoothing bends the curve D(v), and the logarithm of a noisy number is too
/// low on average. Its noise is also smaller than the relative noise of D.
Logarithms logarithms_of(const FilterMatrix& D, const FilterMatrix& v,
                         const std::vector<double>& raw, const Rows& rows, PowerLaw law,
                         const std::function<double(double)>& shift, double sigma) {
  const auto as = D.times(raw), vs = v.times(raw);
  FilterMatrix::Row of_D, of_v, row;
  if (!rows.empty()) D.row(rows[rows.size() / 2], of_D);
  BandMatrix E;
  E.reserve(rows.size(), rows.size() * of_D.values.size());
  std::vector<double> bias;
  bias.reserve(rows.size());
  LogarithmOfNoise logarithm;
  for (std::size_t i : rows) {
    constexpr double step = 1e-4;
    const double a_i = as[i], v_i = vs[i], here = shift(a_i);
    D.row(i, of_D), v.row(i, of_v);
    add(here > 0 ? (shift((1 - step) * a_i) / here - 1) / (step * a_i) : 1e100, of_D,
        v_i > 0 ? law.b / v_i : 0, of_v, row);
    const double s =
        sigma * std::sqrt(dot(row.values.data(), row.values.data(), row.values.size()));
    const Estimate of_noise = s > 0 && std::isfinite(s) ? logarithm(s) : Estimate{};
    for (double& x : row.values) x *= of_noise.sigma > 0 ? of_noise.sigma / s : 0;
    E.append(row.first, row.values);
    bias.push_back(here > 0 && v_i > 0 ? std::log(here / law(v_i)) : 0);
    if (here > 0) bias.back() += of_noise.value;
  }
  return {FilterMatrix::identity(raw.size()).then(std::move(E)), std::move(bias)};
}

/// The bias of a and b of the line that follows from the biases of its points: theta = R^-1 Q^T
/// bias.
void bias_line(Fitted& line, const std::vector<double>& bias) {
  const std::size_t p = line.system.columns();
  const std::vector<double> Q = orthonormal(line.system, line.minimum), &R = line.minimum.R;
  std::vector<double> theta(p, 0.0);
  for (std::size_t i = 0; i < Q.size(); ++i) theta[i % p] += Q[i] * bias[i / p];
  for (std::size_t j = p; j-- > 0; theta[j] /= R[j * p + j])
    for (std::size_t k = j + 1; k < p; ++k) theta[j] -= R[j * p + k] * theta[k];
  line.bias_a = dot(line.a.gradient.data(), theta.data(), p);
  line.bias_b = dot(line.b.gradient.data(), theta.data(), p);
}

/// Adds the noise and the bias of ln D - b ln v to a line if the filters are known: those of the
/// best-fitting roll, observed through the filters.
void carry_noise(Fitted& line, const std::vector<Rows>& rows, const std::vector<FitRun>& all,
                 const FitOptions& options) {
  Making making = making_of(Route::shift, all);
  if (!making.known()) return;
  std::vector<FilterMatrix> D, v;
  for (const Response& response : making.responses)
    D.push_back(response.of.at("D")), v.push_back(response.of.at("v"));
  Fitted roll;
  try {
    // The roll is fitted to all records; a selection of those with D > 0 would select by their
    // noise.
    roll = fit_rolls(Route::shift, all, usable(Route::shift, all), std::move(making), options);
  } catch (const Error&) {  // no roll fits: the line keeps its classical errors
    return;
  }
  RawNoise& of_roll = line.raw_noise.emplace();
  of_roll.variance = noise_variance(roll);
  of_roll.sources = roll.noise->explain(roll.minimum.f);
  of_roll.source_runs = roll.noise->sources();
  of_roll.innovations = roll.noise->innovations(roll.minimum.f, of_roll.innovation_runs);
  of_roll.means_taken = roll.rolls->means_taken();
  roll.system = {}, roll.noise = {};  // frees memory: the weights are large
  std::vector<FilterMatrix> noise;
  std::vector<double> bias;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const ObservedRun& run = roll.rolls->runs()[r];
    const Trajectory trajectory = roll.rolls->trajectory(roll.minimum.theta, r);
    std::vector<double> raw;
    for (double t : run.t)
      raw.push_back(run.raw_is_position ? trajectory.at(t).x : trajectory.speed_at(t).v);
    const auto shift = [&, by = *all[r].shift_of](double a) {
      return run.way * shift_from_acceleration(by.body, by.geometry, run.way * a);
    };
    Logarithms of_run = logarithms_of(D[r], v[r], raw, rows[r], {roll.a.value, roll.b.value}, shift,
                                      std::sqrt(of_roll.variance));
    noise.push_back(std::move(of_run.noise));
    bias.insert(bias.end(), of_run.bias.begin(), of_run.bias.end());
  }
  line.noise = std::make_shared<const Noise>(std::move(noise), std::nullopt);
  bias_line(line, bias);
}

}  // namespace

Fitted fit_log_log(const std::vector<FitRun>& all, const FitOptions& options) {
  ShiftRecords records = shift_records(all, options, true);
  const Height height{options.a, options.b, records.log_v_ref};
  const std::vector<Rows> rows = std::move(records.rows);
  Fitted line{.system = {}, .minimum = {}};
  line.records = records.D.size();
  line.left_out = records.left_out;
  line.system = line_system(std::move(records), height);
  line.minimum = solve(line.system, std::vector<double>(height.count(), 0), options,
                       options.robust && making_of(Route::shift, all).known());
  line.rss = line.minimum.rss;
  const double b = height.exponent(line.minimum.theta),
               a = options.a ? *options.a : std::exp(line.minimum.theta[0] - b * height.log_v_ref);
  height.report(line, a, a);
  if (!options.robust) carry_noise(line, rows, all, options);
  return line;
}

}  // namespace rolling
