// Least squares between a measured run and the roll that the law itself makes: v(t) or x(t). No derivative of the data is
// taken, and no bias comes from smoothing: what the filters did to the data is done to the model as well.
#include "rolling/trajectory.h"

#include "base/error.h"
#include "fit/routes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace rolling {
namespace {

/// The law in the fit's own parameters, all of order one: of every run v0 in units of v_ref and x0 in units of x_ref; then, shared,
/// ln of the height D(v_ref) (ln a itself is nearly collinear with b), and b. What is held fixed has no place in theta.
struct Parameters {
  const FitOptions& options;
  bool position;
  std::size_t runs;
  double v_ref = 1, log_v_ref = 0, x_ref = 1;

  bool free_x0() const { return position && !options.x0; }
  std::size_t of_law() const { return !options.a + !options.b; }
  std::size_t per_run() const { return !options.v0 + free_x0(); }
  std::size_t columns() const { return per_run() + of_law(); }
  std::size_t count() const { return runs * per_run() + of_law(); }
  std::size_t v0_at(std::size_t r) const { return r * per_run(); }
  std::size_t x0_at(std::size_t r) const { return v0_at(r) + !options.v0; }
  std::size_t a_at() const { return runs * per_run(); }

  double b(const std::vector<double>& theta) const { return options.b ? *options.b : theta.back(); }
  double a(const std::vector<double>& theta) const { return options.a ? *options.a : std::exp(theta[a_at()] - b(theta) * log_v_ref); }
  double v0(const std::vector<double>& theta, std::size_t r) const { return options.v0 ? std::abs(*options.v0) : theta[v0_at(r)] * v_ref; }
  double x0(const std::vector<double>& theta, std::size_t r) const { return !position ? 0 : options.x0 ? *options.x0 : theta[x0_at(r)] * x_ref; }
  Trajectory trajectory(const FittedRun& roll, const std::vector<double>& theta, std::size_t r) const {
    return {roll.body, options.geometry, {a(theta), b(theta)}, v0(theta, r)};
  }

  /// The derivatives by the parameters of a run and the shared ones, `stride` apart, of what has these by a, b, and by its v0 and x0.
  void chain(double* to, std::size_t stride, double a, double by_a, double by_b, double by_v0 = 0, double by_x0 = 0) const noexcept {
    const auto put = [&](double value) { *std::exchange(to, to + stride) = value; };
    if (!options.v0) put(by_v0 * v_ref);
    if (free_x0()) put(by_x0 * x_ref);
    if (!options.a) put(a * by_a);
    if (!options.b) put(by_b - (options.a ? 0 : log_v_ref * a * by_a));
  }
};

System system_of(const std::vector<FittedRun>& rolls, const Parameters& q, const KnownNoise& noise) {
  std::vector<std::size_t> runs;
  for (const auto& roll : rolls) runs.push_back(roll.t.size());
  return {runs, q.per_run(), q.of_law(), [runs, &rolls, &q, &noise](const std::vector<double>& theta, const TakeRows& take) {
    std::vector<Trajectory> trajectories;
    std::vector<std::size_t> begin;
    for (std::size_t r = 0; r < rolls.size(); ++r) {
      trajectories.push_back(q.trajectory(rolls[r], theta, r));
      begin.push_back(r ? begin.back() + runs[r - 1] : 0);
    }
    const double a = q.a(theta);
    hand_over_rows(runs, q.columns(), rolls.front().filters.rows() > 0, noise, take, [&](std::size_t r, std::size_t first, std::vector<double>& f, std::vector<double>& J) {
      const FittedRun& roll = rolls[r];
      const double x0 = q.x0(theta, r), way = roll.way;
      const auto model = [&](double t, double* slopes, std::size_t stride) {
        const auto s = roll.raw_is_position ? trajectories[r].at(t) : trajectories[r].speed_at(t);
        if (roll.raw_is_position) q.chain(slopes, stride, a, way * s.x_a, way * s.x_b, way * s.x_v0, 1);
        else q.chain(slopes, stride, a, way * s.v_a, way * s.v_b, way * s.v_v0);
        return roll.raw_is_position ? x0 + way * s.x : way * s.v;
      };
      const double *const t = &roll.t[first - begin[r]], *const y = &roll.y[first - begin[r]];
      const std::size_t n = f.size(), m = roll.raw_t.size();
      if (roll.filters.rows() == 0) {
        for (std::size_t i = 0; i < n; ++i) f[i] = model(t[i], &J[i], n) - y[i];
        return;
      }
      std::vector<double> raw(m), slopes(m * q.columns());
      for (std::size_t i = 0; i < m; ++i) raw[i] = model(roll.raw_t[i], &slopes[i], m);
      for (std::size_t i = 0; i < n; ++i) {
        f[i] = roll.filters.times(i, raw) - y[i];
        for (std::size_t j = 0; j < q.columns(); ++j) J[j * n + i] = roll.filters.times(i, std::span(slopes).subspan(j * m, m));
      }
    });
  }};
}

/// The run as means of the records from each edge to the next.
FittedRun means(const FittedRun& roll, bool position, const std::vector<std::size_t>& edges) {
  FittedRun thin{.body = roll.body, .way = roll.way, .origin = roll.origin, .start = roll.start, .t = {}, .y = {}, .raw_t = {}, .filters = {},
                 .raw_is_position = position, .v0 = roll.v0, .x0 = roll.x0};
  for (auto edge = edges.begin(); edge + 1 != edges.end(); ++edge) {
    const auto mean = [&](const std::vector<double>& x) {
      return std::accumulate(x.begin() + static_cast<std::ptrdiff_t>(edge[0]), x.begin() + static_cast<std::ptrdiff_t>(edge[1]), 0.0) / static_cast<double>(edge[1] - edge[0]);
    };
    thin.t.push_back(mean(roll.t));
    thin.y.push_back(mean(roll.y));
  }
  return thin;
}

/// The run thinned to at most 64 means, without a long rest at its end; and a coarse v0 and x0 from the way covered: v0 times the
/// time of half the way is 0.5 to 0.7 of the way, whatever the law.
FittedRun thinned(FittedRun& roll, bool position, const FitOptions& options) {
  const std::size_t n = roll.t.size();
  roll.x0 = options.x0.value_or(position ? roll.y[0] : 0);
  double most = 0;
  const auto reached = [&](double goal) {  // the first record with that way; n if none has it, and then `most` is the longest way
    double way = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (position) way = roll.way * (roll.y[i] - roll.x0);
      else if (i) way += roll.way * (roll.y[i] + roll.y[i - 1]) / 2 * (roll.t[i] - roll.t[i - 1]);
      if (way >= goal) return i;
      most = std::max(most, way);
    }
    return n;
  };
  reached(std::numeric_limits<double>::infinity());
  const std::size_t half = reached(0.5 * most), end = reached(0.95 * most);
  const double half_time = roll.t[std::max<std::size_t>(half, n > 1)] - (position && options.x0 ? 0 : roll.t[0]);
  roll.v0 = options.v0 ? std::abs(*options.v0) : 0.6 * most / half_time;
  if (!(roll.v0 > 0) || !std::isfinite(roll.v0)) fail("the body does not move: a and b cannot be determined");
  const std::size_t used = std::min(n, end + std::max<std::size_t>(end / 3, 8)), block = (used + 63) / 64;
  std::vector<std::size_t> edges;
  for (std::size_t i = 0; i < used; i += block) edges.push_back(i);
  edges.push_back(used);
  return means(roll, position, edges);
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
    const double lambda = trajectory.log_ratio(thin.t[i]);
    m.push_back(thin.way * (position ? trajectory.position(thin.t[i], lambda) : trajectory.velocity(lambda)));
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
      if (!options.a) here.theta[q.a_at()] = std::log(a) + b * q.log_v_ref;
      if (!options.b) here.theta.back() = b;
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

/// Means of so many stretches of a long run follow its roll closely: at their minimum its own is all but reached.
constexpr std::size_t longest = 4096;

/// The best of the minima of the thinned runs that are reached from the three best starts; the best start if none is.
std::vector<double> start(const std::vector<FittedRun>& thin, const Parameters& q) {
  auto candidates = starts(thin, q);
  if (candidates.size() > 3) candidates.resize(3);
  std::vector<double> best = candidates.front();
  if (candidates.size() == 1) return best;
  const KnownNoise none;
  const System system = system_of(thin, q, none);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& candidate : candidates) try {
      Minimum minimum = minimise(system, candidate);
      if (minimum.rss < least) least = minimum.rss, best = std::move(minimum.theta);
    } catch (const Error&) {  // the full data may do better
    }
  return best;
}

// The model goes through the same filters as the data, so the residuals are noise in every direction; the floor only covers rounding.
constexpr double rounding_share = 1e-6;

/// What made the fitted column of each run, and how much of its noise is white; no responses if that is not known.
struct Making {
  std::vector<NoiseResponse> responses;
  double white_share = rounding_share;
};

/// The runs as they are fitted, and the noise that ties their records together.
struct Rolls {
  std::vector<FittedRun> of;
  KnownNoise noise;
};
Rolls make_rolls(const std::vector<FitRun>& all, const std::vector<Rows>& rows, bool position, const Making& making, const FitOptions& options) {
  Rolls rolls;
  const bool known = !making.responses.empty();
  for (std::size_t r = 0; r < all.size(); ++r) {
    const FitRun& run = all[r];
    if (rows[r].empty()) fail("run {} has no record that can be fitted", r + 1);
    const auto& y = position ? run.x : run.v;
    FittedRun roll{};
    roll.body = run.body;
    const double first = known ? making.responses[r].t.front() : run.t[rows[r].front()];
    roll.origin = options.origin.value_or(first);
    if (roll.origin > first) fail("run {} begins before the time {} at which v0 and x0 are to hold", r + 1, roll.origin);
    roll.start = options.origin || options.v0 || options.x0 ? roll.origin : run.t[rows[r].front()];
    if (known && first < run.t[0] && roll.start == roll.origin) fail("v0 and x0 cannot be held: filters have reached back to what was cut away before run {} begins", r + 1);
    roll.t.reserve(rows[r].size());
    roll.y.reserve(rows[r].size());
    for (std::size_t i : rows[r]) roll.t.push_back(run.t[i] - roll.origin), roll.y.push_back(y[i]);
    const double sign = options.v0 ? *options.v0 : position ? roll.y.back() - options.x0.value_or(roll.y.front()) : std::accumulate(roll.y.begin(), roll.y.end(), 0.0);
    roll.way = sign < 0 ? -1 : 1;
    roll.raw_is_position = known ? making.responses[r].source == "x" : position;
    if (known) {
      const BandMatrix& of = making.responses[r].of.at(position ? "x" : "v");
      for (std::size_t i : rows[r]) roll.filters.append(of.first(i), of.row(i));
      rolls.noise.append(roll.filters, making.white_share);
      for (double t : making.responses[r].t) roll.raw_t.push_back(t - roll.origin);
    }
    rolls.of.push_back(std::move(roll));
  }
  return rolls;
}

/// The minimum for as many means of neighbouring records as `longest` allows, most of the way to that for all; `theta` if there is none.
std::vector<double> fit_means(const std::vector<FittedRun>& rolls, const Parameters& q, std::vector<double> theta) {
  std::vector<FittedRun> few;
  for (const FittedRun& roll : rolls) {
    const std::size_t records = roll.t.size(), most = std::min(records, longest);
    std::vector<std::size_t> edges;  // of all but the same number of records: the means count the same
    for (std::size_t k = 0; k <= most; ++k) edges.push_back(k * records / most);
    few.push_back(means(roll, q.position, edges));
  }
  const KnownNoise none;
  return approach(system_of(few, q, none), std::move(theta));
}

RouteFit fit_rolls(const std::vector<FitRun>& all, std::vector<Rows>& rows, Parameters& q, const Making& making, std::vector<double> theta = {}) {
  const FitOptions& options = q.options;
  RouteFit result{};
  Rolls rolls;
  // The position route knows speeds only from its own fit: slow records leave after it, and the fit is repeated without them.
  for (int round = 0; round < 4; ++round) {
    std::size_t n = 0;
    for (const auto& r : rows) n += r.size();
    require_records(n, q.count());
    rolls = make_rolls(all, rows, q.position, making, options);
    if (theta.empty()) {
      std::vector<FittedRun> thin;
      for (auto& roll : rolls.of) thin.push_back(thinned(roll, q.position, options));
      q.v_ref = thin.front().v0 / 2;
      q.log_v_ref = std::log(q.v_ref);
      if (q.position) q.x_ref = thin.front().v0 * std::max(thin.front().t.back(), std::numeric_limits<double>::min());
      theta = start(thin, q);
      if (n > longest * all.size() && !options.robust) theta = fit_means(rolls.of, q, std::move(theta));
    }
    result.minimum = solve(system_of(rolls.of, q, rolls.noise), theta, options, !rolls.noise.empty());
    theta = result.minimum.theta;
    if (!q.position || options.min_speed <= 0) break;
    std::size_t slow = 0;
    for (std::size_t r = 0; r < all.size(); ++r) {
      const Trajectory fitted = q.trajectory(rolls.of[r], theta, r);
      slow += std::erase_if(rows[r], [&](std::size_t i) { return fitted.velocity(fitted.log_ratio(all[r].t[i] - rolls.of[r].origin)) < options.min_speed; });
    }
    if (slow == 0) break;
  }

  const double a = q.a(theta);
  const auto quantity = [&](double value, double by_a, double by_b, double by_v0 = 0, double by_x0 = 0) {
    Quantity here{value, std::vector<double>(q.columns())};
    q.chain(here.gradient.data(), 1, a, by_a, by_b, by_v0, by_x0);
    return here;
  };
  result.a = quantity(a, 1, 0);
  result.b = quantity(q.b(theta), 0, 1);
  for (std::size_t r = 0; r < all.size(); ++r) {
    const FittedRun& roll = rolls.of[r];
    const auto s = q.trajectory(roll, theta, r).at(roll.start - roll.origin);
    result.v0.push_back(quantity(roll.way * s.v, roll.way * s.v_a, roll.way * s.v_b, roll.way * s.v_v0));
    if (q.position) result.x0.push_back(quantity(q.x0(theta, r) + roll.way * s.x, roll.way * s.x_a, roll.way * s.x_b, roll.way * s.x_v0, 1));
    result.runs.push_back(rows[r].size());
    result.left_out += all[r].t.size() - rows[r].size();
  }
  if (!rolls.noise.empty()) {
    const KnownNoise none;
    result.plain = residuals_at(system_of(rolls.of, q, none), theta);
  }
  result.noise = std::move(rolls.noise);
  result.rolls = std::move(rolls.of);
  return result;
}

/// What may have made the speeds of all runs, and how much of their noise is white.
struct Maker {
  const LinearFilter* filter = nullptr;
  double white_share = rounding_share;
};

Making making_by(const Maker& maker, const std::vector<FitRun>& all) {
  Making making{{}, maker.white_share};
  for (const auto& run : all) making.responses.push_back(noise_response({*maker.filter}, run.t));
  return making;
}

/// The filter, and the white noise added to what it makes, under which the residuals of speeds are most likely (the fit is linear
/// around theta); none if white noise alone is nearly as likely.
Maker most_likely(const std::vector<FitRun>& all, const std::vector<Rows>& rows, const std::vector<LinearFilter>& filters, const Parameters& q,
                  const std::vector<double>& theta) {
  Maker best;
  double most = 0;
  for (const LinearFilter& filter : filters) {
    const Rolls rolls = make_rolls(all, rows, false, making_by({&filter}, all), q.options);
    const KnownNoise none;  // the system refers to it
    System system = system_of(rolls.of, q, none);
    struct Linear {
      std::vector<double> f, J;
    };
    std::vector<Linear> of(rolls.of.size());
    system.evaluate(theta, [&](std::size_t r, std::span<double> f, std::span<double> J) { of[r] = {{f.begin(), f.end()}, {J.begin(), J.end()}}; });
    KnownNoise noise;
    system.evaluate = [&](const std::vector<double>&, const TakeRows& take) {
      for (std::size_t r = 0; r < of.size(); ++r) {
        auto [f, J] = of[r];
        noise.weight(r, f, J);
        take(r, f, J);
      }
    };
    const auto likelihood = [&](double log_share) {
      noise = {};
      for (const auto& roll : rolls.of) noise.append(roll.filters, std::exp(log_share));
      return restricted_likelihood(system, theta) - noise.log_size();
    };
    constexpr double decisive = 3;  // in white noise exceeded once in a hundred
    double low = -12, high = 4;     // golden section
    const double white = likelihood(high) + decisive;
    constexpr double golden = 0.6180339887498949;
    double left = high - golden * (high - low), right = low + golden * (high - low), at_left = likelihood(left), at_right = likelihood(right);
    while (high - low > 0.1) {
      if (at_left > at_right) {
        high = std::exchange(right, left);
        at_right = at_left;
        at_left = likelihood(left = high - golden * (high - low));
      } else {
        low = std::exchange(left, right);
        at_left = at_right;
        at_right = likelihood(right = low + golden * (high - low));
      }
    }
    const double gain = std::max(at_left, at_right) - white;
    if (gain <= most) continue;
    most = gain;
    best = {&filter, std::exp(at_left > at_right ? left : right)};
  }
  return best;
}

/// What programs do at the ends of a run and at a lost record differs; elsewhere they are known. Leaves out the records of which an
/// end or a gap is within reach; false if a run is too short to tell.
bool leave_out_irregular(const std::vector<FitRun>& all, std::vector<Rows>& rows, std::size_t reach) {
  for (std::size_t r = 0; r < all.size(); ++r) {
    const auto& t = all[r].t;
    std::vector<double> spans;  // of the windows
    for (std::size_t i = 2 * reach; i < t.size(); ++i) spans.push_back(t[i] - t[i - 2 * reach]);
    if (spans.empty()) return false;
    auto sorted = spans;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double most = *middle * (1 + 0.25 / static_cast<double>(reach));  // half a record more than is usual
    std::erase_if(rows[r], [&](std::size_t i) { return i < reach || i + reach >= t.size() || spans[i - reach] > most; });
  }
  return true;
}

/// How many records at the beginning of a run are asked what made its speeds: the factor e^3 of likelihood shows in a hundred.
constexpr std::size_t telling = 2000;

/// The fit through the positions of which the speeds are most likely differences; none if they are not, or if it leaves residuals that
/// do not look white.
std::optional<RouteFit> fit_differences(const std::vector<FitRun>& all, std::vector<Rows> rows, Parameters& q, const std::vector<double>& theta) {
  std::size_t reach = 0;
  for (const auto& filter : q.options.possible_filters) reach = std::max(reach, filter.reach);
  std::vector<FitRun> heads;
  std::vector<Rows> head_rows;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const std::size_t n = std::min(all[r].t.size(), telling);
    const auto head = [n](const std::vector<double>& x) { return std::vector(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n)); };
    heads.push_back({.t = head(all[r].t), .x = {}, .v = head(all[r].v), .D = {}, .body = all[r].body, .filters = {}});
    head_rows.emplace_back(rows[r].begin(), std::lower_bound(rows[r].begin(), rows[r].end(), n));
  }
  try {
    if (!leave_out_irregular(heads, head_rows, reach)) return {};
    const Maker maker = most_likely(heads, head_rows, q.options.possible_filters, q, theta);
    if (!maker.filter || maker.filter->from == "v" || !leave_out_irregular(all, rows, reach)) return {};
    RouteFit fitted = fit_rolls(all, rows, q, making_by(maker, all), theta);
    fitted.judged = true;
    if (assess(system_of(fitted.rolls, q, fitted.noise), fitted)) return fitted;
  } catch (const Error&) {  // too few records, or no minimum
  }
  return {};
}

}  // namespace

RouteFit fit_trajectory(Route route, const std::vector<FitRun>& all, const FitOptions& options) {
  const bool position = route == Route::position;
  const char* const column = position ? "x" : "v";
  Making making;
  for (const auto& run : all) making.responses.push_back(noise_response(run.filters, run.t));
  const bool known = std::all_of(making.responses.begin(), making.responses.end(), [&](const NoiseResponse& r) {
    return r.of.contains(column) && (r.source == "x" || (r.source == "v" && !position));
  });
  if (!known) making.responses.clear();

  std::vector<Rows> rows;
  for (const auto& run : all) {
    const auto& y = position ? run.x : run.v;
    Rows usable;
    usable.reserve(y.size());
    double way = 0;
    for (std::size_t i = 0; i < y.size(); ++i)
      if (std::isfinite(y[i])) usable.push_back(i), way += y[i];
    if (!position && options.min_speed > 0) std::erase_if(usable, [&](std::size_t i) { return std::copysign(y[i], y[i] * way) < options.min_speed; });
    rows.push_back(std::move(usable));
  }

  Parameters q{options, position, all.size()};
  RouteFit fitted = fit_rolls(all, rows, q, making);
  const bool may_be_differences = !known && !position && !options.robust && !options.possible_filters.empty() && fitted.minimum.f.size() >= 30;
  if (may_be_differences)
    if (auto differences = fit_differences(all, rows, q, fitted.minimum.theta)) return *std::move(differences);
  assess(system_of(fitted.rolls, q, fitted.noise), fitted);
  return fitted;
}

}  // namespace rolling
