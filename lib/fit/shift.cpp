// Least squares on D = a v^b: of D itself, so that D <= 0 (noise) counts as it should.
#include "base/error.h"
#include "base/large_pages.h"
#include "fit/routes.h"
#include "motion/trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace rolling {

ShiftRecords::ShiftRecords(const std::vector<FitRun>& all, const FitOptions& options,
                           bool positive_D)
    : all_(all), options_(options) {
  std::size_t most = 0;
  for (const auto& run : all)
    response_.push_back(noise_response(run.filters, run.t)), most += run.v.size();
  if (!std::all_of(response_.begin(), response_.end(),
                   [](const NoiseResponse& r) { return r.of.contains("D"); }))
    response_.clear();
  reserve_large(log_u, most);
  reserve_large(D, most);
  for (const auto& run : all) {
    const std::size_t before = D.size();
    Rows rows;
    for (std::size_t i = 0; i < run.v.size(); ++i) {
      const bool usable = std::isfinite(run.v[i]) && std::isfinite(run.D[i]) && run.v[i] > 0 &&
                          run.v[i] >= options.min_speed && !(positive_D && run.D[i] <= 0);
      if (!usable) {
        ++left_out;
        continue;
      }
      log_u.push_back(std::log(run.v[i]));
      D.push_back(run.D[i]);
      if (filters_known()) rows.push_back(i), v_.push_back(run.v[i]);
    }
    runs.push_back(D.size() - before);
    rows_.push_back(std::move(rows));
  }
  refer();
}

void ShiftRecords::refer() {
  log_v_ref = std::accumulate(log_u.begin(), log_u.end(), 0.0) /
              static_cast<double>(std::max<std::size_t>(log_u.size(), 1));
  for (double& x : log_u) x -= log_v_ref;
}

void ShiftRecords::leave_out(const std::vector<bool>& lost) {
  std::vector<double> old_v = std::exchange(v_, {}), old_D = std::exchange(D, {});
  log_u.clear();
  std::size_t at = 0;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    std::erase_if(rows_[r], [&](std::size_t) {
      if (!lost[at])
        v_.push_back(old_v[at]), D.push_back(old_D[at]), log_u.push_back(std::log(old_v[at]));
      return lost[at++];
    });
    runs[r] = rows_[r].size();
  }
  left_out += old_v.size() - v_.size();
  refer();
}

RouteFit ShiftRecords::hand_over(const System& system, Minimum minimum, KnownNoise& noise, double a,
                                 double a_slope, double b) && {
  const std::size_t p = system.shared;
  std::vector<double> by_a(p, 0), by_b(p, 0);
  if (!options_.a) by_a[0] = a_slope;
  if (!options_.a && !options_.b) by_a[1] = -a * log_v_ref;
  if (!options_.b) by_b[p - 1] = 1;
  RouteFit result{.minimum = std::move(minimum),
                  .runs = runs,
                  .noise = noise,
                  .left_out = left_out,
                  .a = {a, by_a},
                  .b = {b, by_b},
                  .v0 = {},
                  .x0 = {}};
  assess(system, result);
  noise = {};
  if (!result.noise.empty()) result.plain = residuals_at(system, result.minimum.theta);
  result.log_u = std::move(log_u);
  result.log_v_ref = log_v_ref;
  return result;
}

// Full weight by the covariance would rest on directions that look all but free of noise (the zeros
// of a moving mean, the frequency zero of a difference), where the residuals are not noise but what
// smoothing did to the law.
constexpr double floor_share = 1;

KnownNoise ShiftRecords::noise(double b, const Smoothed& smooth, const std::vector<double>& scale,
                               std::vector<double> own) const {
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
  result.own = std::move(own);
  return result;
}

namespace {

/// The roll under the law that has the mean of the filtered speeds: its raw column, as the filters
/// know it, and how that hangs on a and b when v0 follows.
struct ClosestRoll {
  std::vector<double> raw, by_a, by_b;
};
ClosestRoll closest_roll(const NoiseResponse& response, const FitRun& run, const Rows& rows,
                         PowerLaw law) {
  const bool position = response.source == "x";
  const std::size_t n = response.t.size();
  std::vector<double> t, slowing, by_v0(n);
  for (double x : response.t) t.push_back(x - response.t[0]);
  for (double x : t) slowing.push_back(position ? -x * x / 2 : -x);
  // D of unit deceleration is (1 + K) R / g: the filters tell which body this is. At a lost record
  // a window is lopsided and tells another; half of the records do not see one.
  std::vector<double> arms;
  for (std::size_t k : rows) arms.push_back(response.of.at("D").times(k, slowing));
  std::nth_element(arms.begin(), arms.begin() + static_cast<std::ptrdiff_t>(arms.size() / 2),
                   arms.end());
  const double c = 1 / arms[arms.size() / 2];
  const Body body{.m = 1, .R = 1, .K = 0, .g = c};
  const BandMatrix& of_v = response.of.at("v");
  ClosestRoll closest{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
  double v0 = *std::max_element(run.v.begin(), run.v.end()), step = v0;
  for (int i = 0; i < 20 && std::abs(step) > 1e-12 * v0; ++i) {
    const Trajectory roll(body, Geometry::approximate, law, v0);
    for (std::size_t k = 0; k < n; ++k) {
      const auto at = position ? roll.at(t[k]) : roll.speed_at(t[k]);
      closest.raw[k] = position ? at.x : at.v;
      closest.by_a[k] = position ? at.x_a : at.v_a;
      closest.by_b[k] = position ? at.x_b : at.v_b;
      by_v0[k] = position ? at.x_v0 : at.v_v0;
    }
    double short_of = 0, slope = 0, a = 0, b = 0;
    for (std::size_t k : rows) {
      short_of += run.v[k] - of_v.times(k, closest.raw);
      slope += of_v.times(k, by_v0);
      a -= of_v.times(k, closest.by_a);
      b -= of_v.times(k, closest.by_b);
    }
    v0 += step = short_of / slope;
    for (std::size_t k = 0; k < n; ++k) {
      closest.by_a[k] += a / slope * by_v0[k];
      closest.by_b[k] += b / slope * by_v0[k];
    }
  }
  return closest;
}

}  // namespace

ShiftRecords::Smoothed ShiftRecords::smoothed(double a, double b) const {
  Smoothed result;
  for (std::size_t r = 0; r < response_.size(); ++r) {
    const auto& [source, raw_t, of] = response_[r];
    ClosestRoll roll;
    if (of.contains("v") && (source == "x" || source == "v") && !rows_[r].empty()) try {
        roll = closest_roll(response_[r], all_[r], rows_[r], {a, b});
      } catch (const Error&) {  // no such roll: the law is fitted as it stands
      }
    // Within a record of the stop v^b is steeper than differences can tell: below that speed the
    // law counts as if at it, with a smooth passage, u^4 = rolled^4 + slowest^4.
    const double slowest = rows_[r].empty()
                               ? 0
                               : *std::max_element(all_[r].v.begin(), all_[r].v.end()) /
                                     static_cast<double>(all_[r].v.size());
    for (std::size_t i : rows_[r]) {
      if (roll.raw.empty()) {
        const double u = v_[result.v.size()];
        result.v.push_back(u);
        result.law.push_back(a * std::pow(u, b));
        result.D.push_back(result.law.back());
        for (auto* slopes : {&result.law_a, &result.law_b, &result.D_a, &result.D_b})
          slopes->push_back(0);
        continue;
      }
      const BandMatrix &of_v = of.at("v"), &of_D = of.at("D");
      const double rolled = std::max(of_v.times(i, roll.raw), 0.0),
                   u = std::pow(std::pow(rolled, 4) + std::pow(slowest, 4), 0.25);
      const double law = a * std::pow(u, b), slope = b / u * std::pow(rolled / u, 3);
      result.v.push_back(u);
      result.law.push_back(law);
      result.law_a.push_back(law * (1 / a + slope * of_v.times(i, roll.by_a)));
      result.law_b.push_back(law * (std::log(u) + slope * of_v.times(i, roll.by_b)));
      result.D.push_back(of_D.times(i, roll.raw));
      result.D_a.push_back(of_D.times(i, roll.by_a));
      result.D_b.push_back(of_D.times(i, roll.by_b));
    }
  }
  return result;
}

namespace {

std::vector<double> weighted(std::vector<double> all, const std::vector<std::size_t>& runs,
                             const KnownNoise& noise) {
  std::size_t first = 0;
  for (std::size_t r = 0; !noise.empty() && r < runs.size(); first += runs[r++])
    noise.weight(r, std::span(all).subspan(first, runs[r]), {});
  return all;
}

/// The height that fits best for the exponent b (or the one that is held) to the weighted D, and
/// the weighted sum of squares that is left; u = v / v_ref.
struct Height {
  double value, rss;
};
Height best_height(const std::vector<double>& log_u, const std::vector<double>& D, double b,
                   const std::vector<std::size_t>& runs, const KnownNoise& noise,
                   std::optional<double> held) {
  std::vector<double> m;
  m.reserve(log_u.size());
  for (double x : log_u) m.push_back(std::exp(b * x));
  m = weighted(std::move(m), runs, noise);
  const double height = held.value_or(std::inner_product(m.begin(), m.end(), D.begin(), 0.0) /
                                      std::inner_product(m.begin(), m.end(), m.begin(), 0.0));
  double rss = 0;
  for (std::size_t i = 0; i < D.size(); ++i) rss += (height * m[i] - D[i]) * (height * m[i] - D[i]);
  return {height, rss};
}

/// At most so many values, evenly spread.
std::vector<double> some(const std::vector<double>& x, std::size_t most) {
  std::vector<double> few;
  for (std::size_t i = 0, step = (x.size() + most - 1) / most; i < x.size(); i += step)
    few.push_back(x[i]);
  return few;
}

/// Whether the minimum has moved by less than a thousandth of its standard deviations, as
/// minimise() knows it, or by rounding alone.
bool all_but_equal(const Minimum& from, const Minimum& to) {
  const std::size_t n = to.f.size(), p = to.theta.size();
  double largest = 0, squares = 0;
  for (std::size_t i = 0; i < p; ++i) {
    double along = 0;
    for (std::size_t j = i; j < p; ++j) along += to.R[i * p + j] * (to.theta[j] - from.theta[j]);
    squares += along * along;
    largest = std::max(
        largest, std::abs(to.theta[i] - from.theta[i]) / std::max(1.0, std::abs(to.theta[i])));
  }
  return largest < 1e-8 || squares * static_cast<double>(n - p) < 1e-6 * to.rss;
}

}  // namespace

RouteFit fit_shift(const std::vector<FitRun>& all, const FitOptions& options) {
  ShiftRecords records(all, options, false);
  const auto &log_u = records.log_u, &D = records.D;
  const double L = records.log_v_ref;
  const std::size_t n = D.size(), p = !options.a + !options.b;
  require_records(n, p);
  if (!options.b &&
      std::all_of(log_u.begin(), log_u.end(), [&](double x) { return x == log_u[0]; }))
    fail("all speeds are equal: b cannot be determined");

  // Parameters: the height D(v_ref) in units of the largest |D|, and b; ln a and b themselves are
  // nearly collinear.
  double unit = 0;
  for (double d : D) unit = std::max(unit, std::abs(d));
  if (unit == 0) fail("all shifts are 0: b cannot be determined");
  const auto exponent = [&](const std::vector<double>& theta) {
    return options.b ? *options.b : theta[p - 1];
  };
  const auto height = [&](const std::vector<double>& theta) {
    return options.a ? *options.a * std::exp(exponent(theta) * L) : theta[0] * unit;
  };
  KnownNoise noise;
  bool smoothed = false;  // whether what smoothing does to the law is part of the model
  // (The runs are copied so because g++ 14 warns of a memmove beyond the one run that is there if
  // they are copied whole.)
  const auto system_of = [&](const std::vector<std::size_t>& runs,
                             const std::vector<double>& log_of, const std::vector<double>& D_of) {
    return System{{runs.begin(), runs.end()},
                  0,
                  p,
                  [&](const std::vector<double>& theta, const TakeRows& take) {
      const double b = exponent(theta), h = height(theta), a = h * std::exp(-b * L);
      const auto s = smoothed ? records.smoothed(a, b) : ShiftRecords::Smoothed{};
      hand_over_rows(
          runs, p, !noise.empty(), noise, take,
          [&](std::size_t, std::size_t first, std::vector<double>& f, std::vector<double>& J) {
        for (std::size_t k = 0; k < f.size(); ++k) {
          const std::size_t i = first + k;
          const double power = std::exp(b * log_of[i]);
          f[k] = h * power - D_of[i];
          if (!options.a) J[k] = unit * power;
          if (!options.b)
            J[J.size() - f.size() + k] =
                h * power *
                (log_of[i] + (options.a ? L : 0));  // at fixed a, the height moves with b
          if (!smoothed) continue;
          f[k] += s.D[i] - s.law[i];
          const double by_a = s.D_a[i] - s.law_a[i], by_b = s.D_b[i] - s.law_b[i];
          if (!options.a) J[k] += by_a * unit * std::exp(-b * L);
          if (!options.b) J[J.size() - f.size() + k] += by_b - (options.a ? 0 : by_a * a * L);
        }
          });
                  }};
  };

  // A start: the exponent of a coarse grid that fits best (for each, the height is linear), unless
  // the user knows one. Known noise counts from the start, as far as it comes by D: one wild record
  // near the stop would send an unweighted fit to a wrong minimum.
  if (records.filters_known())
    noise = records.noise(0,
                          {.v = std::vector<double>(n, 1),
                           .D = D,
                           .law = D,
                           .D_a = {},
                           .D_b = {},
                           .law_a = {},
                           .law_b = {}},
                          std::vector<double>(n, 1));
  const std::size_t most = noise.empty() && !options.robust ? 4096 : n;
  const std::vector<double> some_log_u = some(log_u, most), some_D = some(D, most),
                            weighted_D = weighted(some_D, records.runs, noise);
  const auto best_at = [&](double b) {
    const auto held = options.a ? options.a : options.start_a;
    return best_height(some_log_u, weighted_D, b, records.runs, noise,
                       held ? std::optional(*held * std::exp(b * L)) : std::nullopt);
  };
  double b = options.b ? *options.b : options.start_b.value_or(0);
  if (!options.b && !options.start_b) {
    double least = std::numeric_limits<double>::infinity();
    for (double candidate = -4; candidate <= 8; candidate += 0.25)
      if (const double rss = best_at(candidate).rss; rss < least) least = rss, b = candidate;
  }
  std::vector<double> theta;
  if (!options.a) theta.push_back(best_at(b).value / unit);
  if (!options.b) theta.push_back(b);
  const std::vector<std::size_t> few{some_D.size()};
  if (some_D.size() < n)
    theta = approach(system_of(few, some_log_u, some_D),
                     std::move(theta));  // most of the way on few of many records

  const System system = system_of(records.runs, log_u, D);
  Minimum minimum = solve(system, theta, options, records.filters_known());
  smoothed = records.filters_known();
  for (int round = 0; smoothed; ++round) {  // the noise that v brings in hangs on a and b
    if (round == 20) fail("the fit does not converge: are all of these records of the free roll?");
    b = exponent(minimum.theta);
    noise = records.noise(b, records.smoothed(height(minimum.theta) * std::exp(-b * L), b),
                          std::vector<double>(n, 1));
    Minimum next = minimise(system, minimum.theta);
    std::swap(minimum, next);
    if (all_but_equal(next, minimum)) break;
  }

  b = exponent(minimum.theta);
  const double a = options.a.value_or(height(minimum.theta) * std::exp(-b * L));
  return std::move(records).hand_over(system, std::move(minimum), noise, a, unit * std::exp(-b * L),
                                      b);
}

}  // namespace rolling
