// Where the search of the trajectory routes begins.
#include "fit/trajectory.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace rolling {
namespace {

/// The run as means of the records from each edge to the next.
FittedRun means(const FittedRun& roll, bool position, const std::vector<std::size_t>& edges) {
  FittedRun thin{.body = roll.body,
                 .way = roll.way,
                 .origin = roll.origin,
                 .start = roll.start,
                 .t = {},
                 .y = {},
                 .raw_t = {},
                 .filters = {},
                 .raw_is_position = position,
                 .v0 = roll.v0,
                 .x0 = roll.x0};
  for (auto edge = edges.begin(); edge + 1 != edges.end(); ++edge) {
    const auto mean = [&](const std::vector<double>& x) {
      return std::accumulate(x.begin() + static_cast<std::ptrdiff_t>(edge[0]),
                             x.begin() + static_cast<std::ptrdiff_t>(edge[1]), 0.0) /
             static_cast<double>(edge[1] - edge[0]);
    };
    thin.t.push_back(mean(roll.t));
    thin.y.push_back(mean(roll.y));
  }
  return thin;
}

/// The run thinned to at most 64 means, without a long rest at its end; and a coarse v0 and x0 from
/// the way covered: v0 times the time of half the way is 0.5 to 0.7 of the way, whatever the law.
FittedRun thinned(FittedRun& roll, bool position, const FitOptions& options) {
  const std::size_t n = roll.t.size();
  roll.x0 = options.x0.value_or(position ? roll.y[0] : 0);
  double most = 0;
  const auto reached = [&](double goal) {  // the first record with that way; n if none has it, and
                                           // then `most` is the longest way
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
  const double half_time =
      roll.t[std::max<std::size_t>(half, n > 1)] - (position && options.x0 ? 0 : roll.t[0]);
  roll.v0 = options.v0 ? std::abs(*options.v0) : 0.6 * most / half_time;
  if (!(roll.v0 > 0) || !std::isfinite(roll.v0))
    fail("the body does not move: a and b cannot be determined");
  const std::size_t used = std::min(n, end + std::max<std::size_t>(end / 3, 8)),
                    block = (used + 63) / 64;
  std::vector<std::size_t> edges;
  for (std::size_t i = 0; i < used; i += block) edges.push_back(i);
  edges.push_back(used);
  return means(roll, position, edges);
}

/// How well the thinned run follows the shape of (a, b) when v0 (as a factor) and x0 are taken as
/// they fit best.
struct Trial {
  double rss, factor, x0;
};
Trial try_shape(const FittedRun& thin, const FitOptions& options, bool position, PowerLaw law) {
  const Trajectory trajectory(thin.body, options.geometry, law, thin.v0);
  double mm = 0, my = 0, m_mean = 0, y_mean = 0;
  std::vector<double> m, y;
  for (std::size_t i = 0; i < thin.t.size(); ++i) {
    const double lambda = trajectory.log_ratio(thin.t[i]);
    m.push_back(thin.way *
                (position ? trajectory.position(thin.t[i], lambda) : trajectory.velocity(lambda)));
    y.push_back(thin.y[i] - (position ? options.x0.value_or(0) : 0));
  }
  const double n = static_cast<double>(m.size());
  if (position && !options.x0) {
    m_mean = std::accumulate(m.begin(), m.end(), 0.0) / n;
    y_mean = std::accumulate(y.begin(), y.end(), 0.0) / n;
  }
  for (std::size_t i = 0; i < m.size(); ++i)
    mm += (m[i] - m_mean) * (m[i] - m_mean), my += (m[i] - m_mean) * (y[i] - y_mean);
  Trial trial{0, options.v0 ? 1 : my / mm, 0};
  trial.x0 = options.x0.value_or(y_mean - trial.factor * m_mean);
  for (std::size_t i = 0; i < m.size(); ++i) {
    const double f = trial.factor * (m[i] - m_mean) - (y[i] - y_mean);
    trial.rss += f * f;
  }
  return trial;
}

/// Starting points from the data alone, best first: over a grid of b and of the time scale
/// v/|dv/dt| at the start.
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
      for (double x = 0.01; x < 1000;
           x *= 1.3) {  // x: the first run's duration in units of its time scale
        const auto& [first, K] = std::tie(thin.front(), thin.front().body.K);
        as.push_back(x / first.t.back() * std::pow(first.v0, 1 - b) * (K + 1) * first.body.R /
                     first.body.g);
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
  std::sort(best.begin(), best.end(),
            [](const Candidate& x, const Candidate& y) { return x.rss < y.rss; });
  std::vector<std::vector<double>> result;
  for (auto& candidate : best) result.push_back(std::move(candidate.theta));
  return result;
}

/// Means of so many stretches of a long run follow its roll closely: at their minimum its own is
/// all but reached.
constexpr std::size_t longest = 4096;

/// The best of the minima of the thinned runs that are reached from the three best starts; the best
/// start if none is.
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

/// The minimum for as many means of neighbouring records as `longest` allows, most of the way to
/// that for all; `theta` if there is none.
std::vector<double> fit_means(const std::vector<FittedRun>& rolls, const Parameters& q,
                              std::vector<double> theta) {
  std::vector<FittedRun> few;
  for (const FittedRun& roll : rolls) {
    const std::size_t records = roll.t.size(), most = std::min(records, longest);
    std::vector<std::size_t>
        edges;  // of all but the same number of records: the means count the same
    for (std::size_t k = 0; k <= most; ++k) edges.push_back(k * records / most);
    few.push_back(means(roll, q.position, edges));
  }
  const KnownNoise none;
  return approach(system_of(few, q, none), std::move(theta));
}

}  // namespace

std::vector<double> first_guess(std::vector<FittedRun>& rolls, Parameters& q) {
  std::vector<FittedRun> thin;
  std::size_t n = 0;
  for (auto& roll : rolls) thin.push_back(thinned(roll, q.position, q.options)), n += roll.t.size();
  q.v_ref = thin.front().v0 / 2;
  q.log_v_ref = std::log(q.v_ref);
  if (q.position)
    q.x_ref = thin.front().v0 * std::max(thin.front().t.back(), std::numeric_limits<double>::min());
  std::vector<double> theta = start(thin, q);
  return n > longest * rolls.size() && !q.options.robust ? fit_means(rolls, q, std::move(theta))
                                                         : theta;
}

}  // namespace rolling
