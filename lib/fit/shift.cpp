// Least squares on D = a v^b: of D itself, so that D <= 0 (noise) counts as it should.
#include "base/error.h"
#include "fit/routes.h"
#include "rolling/trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rolling {

ShiftRecords::ShiftRecords(const std::vector<FitRun>& all, const FitOptions& options, bool positive_D) : all_(all) {
  bool known = true;
  for (const auto& run : all) {
    Rows rows;
    for (std::size_t i = 0; i < run.v.size(); ++i) {
      const bool usable = std::isfinite(run.v[i]) && std::isfinite(run.D[i]) && run.v[i] > 0 && run.v[i] >= options.min_speed && !(positive_D && run.D[i] <= 0);
      if (!usable) {
        ++left_out;
        continue;
      }
      rows.push_back(i);
      v.push_back(run.v[i]);
      D.push_back(run.D[i]);
    }
    runs.push_back(rows.size());
    rows_.push_back(std::move(rows));
    response_.push_back(noise_response(run.filters, run.t));
    known = known && response_.back().of.contains("D");
  }
  if (!known) response_.clear();
  if (v.empty()) return;
  for (double x : v) log_v_ref += std::log(x);
  log_v_ref /= static_cast<double>(v.size());
}

// Full weight by the covariance would rest on directions that look all but free of noise (the zeros of a moving mean, the
// frequency zero of a difference), where the residuals are not noise but what smoothing did to the law.
constexpr double floor_share = 1;

KnownNoise ShiftRecords::noise(double b, const Smoothed& smooth, const std::vector<double>& scale) const {
  KnownNoise result;
  std::size_t at = 0;
  for (std::size_t r = 0; r < response_.size(); ++r) {
    const auto& of = response_[r].of;
    const BandMatrix& of_D = of.at("D");
    const BandMatrix& of_v = of.contains("v") ? of.at("v") : of_D;
    BandMatrix E;
    for (std::size_t i : rows_[r]) {
      const double slope = of.contains("v") ? b * smooth.law[at] / smooth.v[at] : 0;
      E.append(i, scale[at], of_D, -slope * scale[at], of_v);
      ++at;
    }
    result.append(std::move(E), floor_share);
  }
  return result;
}

namespace {

/// The roll under the law that comes closest to the filtered speeds: its raw column, as the filters know it; empty if there is none.
std::vector<double> closest_roll(const NoiseResponse& response, const FitRun& run, const Rows& rows, PowerLaw law) {
  const bool position = response.source == "x";
  const std::size_t n = run.t.size();
  std::vector<double> t, slowing, raw(n), by_v0(n);
  for (double x : run.t) t.push_back(x - run.t[0]);
  for (double x : t) slowing.push_back(position ? -x * x / 2 : -x);
  // D of unit deceleration is (1 + K) R / g: the filters tell which body this is. At a lost record a window is lopsided and
  // tells another; half of the records do not see one.
  std::vector<double> arms;
  for (std::size_t k : rows) arms.push_back(response.of.at("D").times(k, slowing));
  std::nth_element(arms.begin(), arms.begin() + static_cast<std::ptrdiff_t>(arms.size() / 2), arms.end());
  const double c = 1 / arms[arms.size() / 2];
  const Body body{.m = 1, .R = 1, .K = 0, .g = c};
  const BandMatrix& of_v = response.of.at("v");
  double v0 = *std::max_element(run.v.begin(), run.v.end());
  for (int i = 0; i < 8; ++i) {
    const Trajectory roll(body, Geometry::approximate, law, v0);
    for (std::size_t k = 0; k < n; ++k) {
      const auto at = roll.at(t[k]);
      raw[k] = position ? at.x : at.v;
      by_v0[k] = position ? at.x_v0 : at.v_v0;
    }
    double slope = 0, square = 0;
    for (std::size_t k : rows) {
      const double g = of_v.times(k, by_v0);
      slope += g * (run.v[k] - of_v.times(k, raw));
      square += g * g;
    }
    v0 += slope / square;
  }
  return raw;
}

}  // namespace

ShiftRecords::Smoothed ShiftRecords::smoothed(double a, double b) const {
  Smoothed result;
  std::size_t at = 0;
  for (std::size_t r = 0; r < response_.size(); ++r) {
    const auto& [source, of] = response_[r];
    std::vector<double> raw;
    if (of.contains("v") && (source == "x" || source == "v") && !rows_[r].empty()) try {
        raw = closest_roll(response_[r], all_[r], rows_[r], {a, b});
      } catch (const Error&) {  // no such roll: the law is fitted as it stands
      }
    for (std::size_t i : rows_[r]) {
      const double rolled = raw.empty() ? 0 : of.at("v").times(i, raw);
      result.v.push_back(rolled > 0 ? rolled : v[at]);
      result.law.push_back(a * std::pow(result.v.back(), b));
      result.D.push_back(rolled > 0 ? of.at("D").times(i, raw) : result.law.back());
      ++at;
    }
  }
  return result;
}

namespace {

/// The best height for the exponent b, and what is left of the sum of squares; u = v / v_ref.
struct Height {
  double value, rss;
};
Height best_height(const std::vector<double>& log_u, const std::vector<double>& D, double b) {
  double mm = 0, mD = 0, rss = 0;
  for (std::size_t i = 0; i < D.size(); ++i) {
    const double m = std::exp(b * log_u[i]);
    mm += m * m;
    mD += m * D[i];
  }
  const double height = mD / mm;
  for (std::size_t i = 0; i < D.size(); ++i) {
    const double r = height * std::exp(b * log_u[i]) - D[i];
    rss += r * r;
  }
  return {height, rss};
}

}  // namespace

RouteFit fit_shift(const std::vector<FitRun>& all, const FitOptions& options) {
  const ShiftRecords records(all, options, false);
  const auto &v = records.v, &D = records.D;
  const double L = records.log_v_ref;
  const std::size_t n = v.size(), p = !options.a + !options.b;
  require_records(n, p);
  if (!options.b && std::all_of(v.begin(), v.end(), [&](double x) { return x == v[0]; })) fail("all speeds are equal: b cannot be determined");

  // Parameters: the height D(v_ref) in units of the largest |D|, and b; ln a and b themselves are nearly collinear.
  double unit = 0;
  for (double d : D) unit = std::max(unit, std::abs(d));
  if (unit == 0) fail("all shifts are 0: b cannot be determined");
  std::vector<double> log_u;
  for (double x : v) log_u.push_back(std::log(x) - L);
  const auto exponent = [&](const std::vector<double>& theta) { return options.b ? *options.b : theta[p - 1]; };
  const auto height = [&](const std::vector<double>& theta) { return options.a ? *options.a * std::exp(exponent(theta) * L) : theta[0] * unit; };
  KnownNoise noise;
  WeakTerm bias(n, p);
  const System system{n, p, [&](const std::vector<double>& theta, std::vector<double>& f, std::vector<double>& J) {
    const double b = exponent(theta), h = height(theta);
    for (std::size_t i = 0; i < n; ++i) {
      const double power = std::exp(b * log_u[i]);
      f[i] = h * power + bias.value(i, theta) - D[i];
      for (std::size_t j = 0; j < p; ++j) J[i * p + j] = bias.slope(i, j);
      if (!options.a) J[i * p] += unit * power;
      if (!options.b) J[i * p + p - 1] += h * power * (log_u[i] + (options.a ? L : 0));  // at fixed a, the height moves with b
    }
    noise.weight(f, J);
  }};

  // A start: the exponent of a coarse grid that fits best (for each, the height is linear), unless the user knows one.
  std::vector<double> theta;
  double b = options.b ? *options.b : options.start_b.value_or(0);
  if (!options.b && !options.start_b) {
    double least = std::numeric_limits<double>::infinity();
    for (double candidate = -4; candidate <= 8; candidate += 0.25) {
      const double rss = options.a ? [&] {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += std::pow(*options.a * std::exp(candidate * (log_u[i] + L)) - D[i], 2);
        return sum;
      }() : best_height(log_u, D, candidate).rss;
      if (rss < least) least = rss, b = candidate;
    }
  }
  if (!options.a) theta.push_back((options.start_a ? *options.start_a * std::exp(b * L) : best_height(log_u, D, b).value) / unit);
  if (!options.b) theta.push_back(b);

  Minimum minimum = minimise(system, theta);
  if (records.filters_known())
    for (int round = 0; round < rounds; ++round) {  // the noise that v brings in, and the bias of smoothing, hang on a and b
      b = exponent(minimum.theta);
      const double a = height(minimum.theta) * std::exp(-b * L);
      noise = records.noise(b, records.smoothed(a, b), std::vector<double>(n, 1));
      bias = WeakTerm(minimum.theta, [&](const std::vector<double>& point) {
        auto smooth = records.smoothed(height(point) * std::exp(-exponent(point) * L), exponent(point));
        for (std::size_t i = 0; i < n; ++i) smooth.D[i] -= smooth.law[i];
        return std::move(smooth.D);
      });
      minimum = minimise(system, minimum.theta);
    }

  b = exponent(minimum.theta);
  const double a = options.a ? *options.a : height(minimum.theta) * std::exp(-b * L);
  std::vector<double> residuals(n), by_a(p, 0), by_b(p, 0);
  for (std::size_t i = 0; i < n; ++i) residuals[i] = height(minimum.theta) * std::exp(b * log_u[i]) + bias.value(i, minimum.theta) - D[i];
  if (!options.a) by_a[0] = unit * std::exp(-b * L);
  if (!options.a && !options.b) by_a[1] = -a * L;
  if (!options.b) by_b[p - 1] = 1;
  return {.minimum = std::move(minimum), .runs = records.runs, .residuals = std::move(residuals), .noise = std::move(noise),
          .left_out = records.left_out, .a = {a, by_a}, .b = {b, by_b}, .v0 = {}, .x0 = {}};
}

}  // namespace rolling
