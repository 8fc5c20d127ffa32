// Least squares between a measured run and the roll that the law itself makes: v(t) or x(t). No derivative of the data is
// taken, and no bias comes from smoothing: what the filters did to the data is done to the model as well.
#include "rolling/trajectory.h"

#include "base/error.h"
#include "fit/routes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rolling {
namespace {

/// The law in the fit's own parameters, all of order one: ln of the height D(v_ref) (ln a itself is nearly collinear with b),
/// b, and of every run v0 in units of v_ref and x0 in units of x_ref. What is held fixed has no place in theta.
struct Parameters {
  const FitOptions& options;
  bool position;
  std::size_t runs;
  double v_ref = 1, x_ref = 1;

  bool free_x0() const { return position && !options.x0; }
  std::size_t of_law() const { return !options.a + !options.b; }
  std::size_t per_run() const { return !options.v0 + free_x0(); }
  std::size_t count() const { return of_law() + runs * per_run(); }
  std::size_t v0_at(std::size_t r) const { return of_law() + r * per_run(); }
  std::size_t x0_at(std::size_t r) const { return v0_at(r) + !options.v0; }

  double b(const std::vector<double>& theta) const { return options.b ? *options.b : theta[of_law() - 1]; }
  double a(const std::vector<double>& theta) const { return options.a ? *options.a : std::exp(theta[0] - b(theta) * std::log(v_ref)); }
  double v0(const std::vector<double>& theta, std::size_t r) const { return options.v0 ? std::abs(*options.v0) : theta[v0_at(r)] * v_ref; }
  double x0(const std::vector<double>& theta, std::size_t r) const { return !position ? 0 : options.x0 ? *options.x0 : theta[x0_at(r)] * x_ref; }
};

/// Model minus data and derivatives of one run, into f[i] and J[i * p + ...], i from `at`.
void evaluate(const FittedRun& roll, std::size_t r, const Parameters& q, Geometry geometry, const std::vector<double>& theta,
              std::size_t at, std::vector<double>& f, std::vector<double>& J) {
  const std::size_t p = q.count(), m = roll.model_t.size();
  const double a = q.a(theta), L = std::log(q.v_ref);
  const Trajectory trajectory(roll.body, geometry, {a, q.b(theta)}, q.v0(theta, r));
  const bool filtered = roll.filters.rows() > 0;
  enum { value, by_height, by_b, by_v0, kinds };
  std::vector<double> raw[kinds];
  if (filtered) for (auto& column : raw) column.reserve(m);
  const auto store = [&](std::size_t i, const double (&g)[kinds], double by_x0) {
    double* const row = &J[(at + i) * p];
    std::fill_n(row, p, 0.0);
    f[at + i] = g[value] - roll.y[i];
    if (!q.options.a) row[0] = g[by_height];
    if (!q.options.b) row[q.of_law() - 1] = g[by_b];
    if (!q.options.v0) row[q.v0_at(r)] = g[by_v0];
    if (q.free_x0()) row[q.x0_at(r)] = by_x0;
  };
  for (std::size_t i = 0; i < m; ++i) {
    const auto s = trajectory.at(roll.model_t[i]);
    const bool x = roll.raw_is_position;
    const double y = x ? s.x : s.v, y_a = x ? s.x_a : s.v_a, y_b = x ? s.x_b : s.v_b, y_v0 = x ? s.x_v0 : s.v_v0;
    const double g[kinds] = {(x ? q.x0(theta, r) : 0) + roll.way * y, roll.way * a * y_a,
                             roll.way * (y_b - (q.options.a ? 0 : L * a * y_a)), roll.way * y_v0 * q.v_ref};
    if (!filtered) store(i, g, q.x_ref);
    else for (int k = 0; k < kinds; ++k) raw[k].push_back(g[k]);
  }
  if (!filtered) return;
  for (std::size_t i = 0; i < roll.t.size(); ++i) {
    const auto weights = roll.filters.row(i);
    const double g[kinds] = {roll.filters.times(i, raw[value]), roll.filters.times(i, raw[by_height]), roll.filters.times(i, raw[by_b]),
                             roll.filters.times(i, raw[by_v0])};
    store(i, g, q.x_ref * std::accumulate(weights.begin(), weights.end(), 0.0));
  }
}

System system_of(const std::vector<FittedRun>& rolls, const Parameters& q, Geometry geometry, const KnownNoise& noise) {
  std::size_t n = 0;
  std::vector<std::size_t> runs;
  for (const auto& roll : rolls) n += roll.t.size(), runs.push_back(roll.t.size());
  return {n, q.count(), [&rolls, &q, &noise, geometry, runs](const std::vector<double>& theta, std::vector<double>& f, std::vector<double>& J) {
    std::size_t at = 0;
    for (std::size_t r = 0; r < rolls.size(); at += runs[r], ++r) evaluate(rolls[r], r, q, geometry, theta, at, f, J);
    noise.weight(f, J);
  }};
}

/// The run thinned to at most 64 means, without a long rest at its end; and a coarse v0 and x0 from the way covered: v0 times the
/// time of half the way is 0.5 to 0.7 of the way, whatever the law.
FittedRun thinned(FittedRun& roll, bool position, const FitOptions& options) {
  const std::size_t n = roll.t.size();
  std::vector<double> way(n, 0);
  roll.x0 = options.x0.value_or(position ? roll.y[0] : 0);
  for (std::size_t i = 0; i < n; ++i)
    way[i] = position ? roll.way * (roll.y[i] - roll.x0) : i ? way[i - 1] + roll.way * (roll.y[i] + roll.y[i - 1]) / 2 * (roll.t[i] - roll.t[i - 1]) : 0;
  const double most = *std::max_element(way.begin(), way.end());
  const auto reached = [&](double share) {
    return static_cast<std::size_t>(std::find_if(way.begin(), way.end(), [&](double x) { return x >= share * most; }) - way.begin());
  };
  const double half_time = roll.t[std::max<std::size_t>(reached(0.5), n > 1)] - (position && options.x0 ? 0 : roll.t[0]);
  roll.v0 = options.v0 ? std::abs(*options.v0) : 0.6 * most / half_time;
  if (!(roll.v0 > 0) || !std::isfinite(roll.v0)) fail("the body does not move: a and b cannot be determined");

  const std::size_t used = std::min(n, reached(0.95) + std::max<std::size_t>(reached(0.95) / 3, 8)), block = (used + 63) / 64;
  FittedRun thin = roll;
  thin.filters = {};
  thin.raw_is_position = position;
  thin.t.clear();
  thin.y.clear();
  for (std::size_t i = 0; i < used; i += block) {
    const std::size_t end = std::min(used, i + block);
    const auto mean = [&](const std::vector<double>& x) {
      return std::accumulate(x.begin() + static_cast<std::ptrdiff_t>(i), x.begin() + static_cast<std::ptrdiff_t>(end), 0.0) / static_cast<double>(end - i);
    };
    thin.t.push_back(mean(roll.t));
    thin.y.push_back(mean(roll.y));
  }
  thin.model_t = thin.t;
  return thin;
}

/// How well the thinned run follows the shape of (a, b) when v0 (as a factor) and x0 are taken as they fit best.
struct Trial {
  double rss, factor, x0;
};
Trial try_shape(const FittedRun& thin, const FitOptions& options, bool position, PowerLaw law) {
  const Trajectory trajectory(thin.body, options.geometry, law, thin.v0);
  double mm = 0, my = 0, m_mean = 0, y_mean = 0;
  std::vector<double> m, y;
  for (std::size_t i = 0; i < thin.t.size(); ++i) {
    const auto s = trajectory.at(thin.t[i]);
    m.push_back(thin.way * (position ? s.x : s.v));
    y.push_back(thin.y[i] - (position ? options.x0.value_or(0) : 0));
  }
  const double n = static_cast<double>(m.size());
  if (position && !options.x0) {
    m_mean = std::accumulate(m.begin(), m.end(), 0.0) / n;
    y_mean = std::accumulate(y.begin(), y.end(), 0.0) / n;
  }
  for (std::size_t i = 0; i < m.size(); ++i) mm += (m[i] - m_mean) * (m[i] - m_mean), my += (m[i] - m_mean) * (y[i] - y_mean);
  Trial trial{0, options.v0 ? 1 : my / mm, 0};
  trial.x0 = options.x0.value_or(y_mean - trial.factor * m_mean);
  for (std::size_t i = 0; i < m.size(); ++i) {
    const double f = trial.factor * (m[i] - m_mean) - (y[i] - y_mean);
    trial.rss += f * f;
  }
  return trial;
}

/// Starting points from the data alone, best first: over a grid of b and of the time scale v/|dv/dt| at the start.
std::vector<std::vector<double>> starts(const std::vector<FittedRun>& thin, const Parameters& q) {
  const FitOptions& options = q.options;
  std::vector<double> exponents{-0.5, 0, 0.25, 0.5, 1, 1.5, 2, 3};
  if (options.b || options.start_b) exponents = {options.b ? *options.b : *options.start_b};
  struct Candidate {
    double rss;
    std::vector<double> theta;
  };
  std::vector<Candidate> best;
  for (double b : exponents) {
    std::vector<double> as;
    if (options.a || options.start_a) as = {options.a ? *options.a : *options.start_a};
    else
      for (double x = 0.01; x < 1000; x *= 1.3) {  // x: the first run's duration in units of its time scale
        const auto& [first, K] = std::tie(thin.front(), thin.front().body.K);
        as.push_back(x / first.t.back() * std::pow(first.v0, 1 - b) * (K + 1) * first.body.R / first.body.g);
      }
    Candidate candidate{std::numeric_limits<double>::infinity(), {}};
    for (double a : as) {
      Candidate here{0, std::vector<double>(q.count())};
      if (!options.a) here.theta[0] = std::log(a) + b * std::log(q.v_ref);
      if (!options.b) here.theta[q.of_law() - 1] = b;
      try {
        for (std::size_t r = 0; r < thin.size(); ++r) {
          const Trial trial = try_shape(thin[r], options, q.position, {a, b});
          if (!(trial.factor > 0)) fail("rolls the wrong way");
          here.rss += trial.rss;
          if (!options.v0) here.theta[q.v0_at(r)] = trial.factor * thin[r].v0 / q.v_ref;
          if (q.free_x0()) here.theta[q.x0_at(r)] = trial.x0 / q.x_ref;
        }
      } catch (const Error&) {  // D > R somewhere on the way: no start
        continue;
      }
      if (here.rss < candidate.rss) candidate = std::move(here);
    }
    if (std::isfinite(candidate.rss)) best.push_back(std::move(candidate));
  }
  if (best.empty()) fail("no law a v^b comes near the data: a and b cannot be determined");
  std::sort(best.begin(), best.end(), [](const Candidate& x, const Candidate& y) { return x.rss < y.rss; });
  std::vector<std::vector<double>> result;
  for (auto& candidate : best) result.push_back(std::move(candidate.theta));
  return result;
}

/// The best of the minima of the thinned runs that are reached from the three best starts; the best start if none is.
std::vector<double> start(const std::vector<FittedRun>& thin, const Parameters& q) {
  auto candidates = starts(thin, q);
  if (candidates.size() > 3) candidates.resize(3);
  std::vector<double> best = candidates.front();
  if (candidates.size() == 1) return best;
  const KnownNoise none;
  const System system = system_of(thin, q, q.options.geometry, none);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& candidate : candidates) try {
      Minimum minimum = minimise(system, candidate);
      if (minimum.rss < least) least = minimum.rss, best = std::move(minimum.theta);
    } catch (const Error&) {  // the full data may do better
    }
  return best;
}

// The model goes through the same filters as the data, so the residuals are noise in every direction; the floor only covers rounding.
constexpr double floor_share = 1e-6;

}  // namespace

RouteFit fit_trajectory(Route route, const std::vector<FitRun>& all, const FitOptions& options) {
  const bool position = route == Route::position;
  const char* const column = position ? "x" : "v";

  std::vector<NoiseResponse> responses;
  for (const auto& run : all) responses.push_back(noise_response(run.filters, run.t));
  const bool known = std::all_of(responses.begin(), responses.end(), [&](const NoiseResponse& r) {
    return r.of.contains(column) && (r.source == "x" || r.source == "v") && (position ? r.source == "x" : true);
  });

  std::vector<Rows> rows;
  std::size_t left_out = 0;
  for (const auto& run : all) {
    const auto& y = position ? run.x : run.v;
    Rows usable;
    double way = 0;
    for (std::size_t i = 0; i < y.size(); ++i)
      if (std::isfinite(y[i])) usable.push_back(i), way += y[i];
    if (!position && options.min_speed > 0) std::erase_if(usable, [&](std::size_t i) { return std::copysign(y[i], y[i] * way) < options.min_speed; });
    left_out += y.size() - usable.size();
    rows.push_back(std::move(usable));
  }

  Parameters q{options, position, all.size()};
  RouteFit result{};
  std::vector<double> theta;
  std::vector<FittedRun> rolls;
  // The position route knows speeds only from its own fit: slow records leave after it, and the fit is repeated without them.
  for (int round = 0; round < 4; ++round) {
    std::size_t n = 0;
    for (const auto& r : rows) n += r.size();
    require_records(n, q.count());
    rolls.clear();
    result.noise = {};
    for (std::size_t r = 0; r < all.size(); ++r) {
      const FitRun& run = all[r];
      if (rows[r].empty()) fail("run {} has no record that can be fitted", r + 1);
      FittedRun roll{};
      roll.body = run.body;
      roll.origin = options.origin.value_or(run.t[known ? 0 : rows[r].front()]);
      if (roll.origin > run.t[known ? 0 : rows[r].front()]) fail("run {} begins before the time {} at which v0 and x0 are to hold", r + 1, roll.origin);
      const auto& y = position ? run.x : run.v;
      for (std::size_t i : rows[r]) roll.t.push_back(run.t[i] - roll.origin), roll.y.push_back(y[i]);
      const double sign = options.v0 ? *options.v0 : position ? roll.y.back() - options.x0.value_or(roll.y.front()) : std::accumulate(roll.y.begin(), roll.y.end(), 0.0);
      roll.way = sign < 0 ? -1 : 1;
      roll.raw_is_position = known ? responses[r].source == "x" : position;
      if (known) {
        BandMatrix E;
        const BandMatrix& of = responses[r].of.at(column);
        for (std::size_t i : rows[r]) E.append(of.first(i), of.row(i));
        roll.filters = E;
        result.noise.append(std::move(E), floor_share);
        for (double t : run.t) roll.model_t.push_back(t - roll.origin);
      } else {
        roll.model_t = roll.t;
      }
      rolls.push_back(std::move(roll));
    }
    if (round == 0) {
      std::vector<FittedRun> thin;
      for (auto& roll : rolls) thin.push_back(thinned(roll, position, options));
      q.v_ref = thin.front().v0 / 2;
      if (position) q.x_ref = thin.front().v0 * std::max(thin.front().t.back(), std::numeric_limits<double>::min());
      theta = start(thin, q);
    }
    result.minimum = solve(system_of(rolls, q, options.geometry, result.noise), theta, options, known);
    theta = result.minimum.theta;
    if (!position || options.min_speed <= 0) break;
    std::size_t slow = 0;
    for (std::size_t r = 0; r < all.size(); ++r) {
      const Trajectory fitted(rolls[r].body, options.geometry, {q.a(theta), q.b(theta)}, q.v0(theta, r));
      slow += std::erase_if(rows[r], [&](std::size_t i) { return fitted.at(all[r].t[i] - rolls[r].origin).v < options.min_speed; });
    }
    left_out += slow;
    if (slow == 0) break;
  }

  result.rolls = rolls;
  const std::size_t p = q.count();
  const Quantity zero{0, std::vector<double>(p, 0)};
  const double a = q.a(theta), b = q.b(theta);
  result.left_out = left_out;
  result.a = result.b = zero;
  result.a.value = a;
  result.b.value = b;
  if (!options.a) result.a.gradient[0] = a;
  if (!options.a && !options.b) result.a.gradient[1] = -a * std::log(q.v_ref);
  if (!options.b) result.b.gradient[q.of_law() - 1] = 1;
  for (std::size_t r = 0; r < rolls.size(); ++r) {
    result.runs.push_back(rolls[r].t.size());
    result.v0.push_back(zero);
    result.v0.back().value = rolls[r].way * q.v0(theta, r);
    if (!options.v0) result.v0.back().gradient[q.v0_at(r)] = q.v_ref;
    if (!position) continue;
    result.x0.push_back(zero);
    result.x0.back().value = q.x0(theta, r);
    if (q.free_x0()) result.x0.back().gradient[q.x0_at(r)] = q.x_ref;
  }
  if (known) {  // the plain residuals, for rms
    Minimum plain = result.minimum;
    system_of(rolls, q, options.geometry, KnownNoise{}).evaluate(theta, plain.f, plain.J);
    result.residuals = std::move(plain.f);
  } else {
    result.residuals = result.minimum.f;
  }
  return result;
}

}  // namespace rolling
