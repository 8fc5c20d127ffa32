// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/first_guess.h"

#include "base/dot.h"
#include "base/error.h"
#include "base/median.h"
#include "contact/contact.h"
#include "least_squares/minimise.h"
#include "least_squares/triangles.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace rolling {
namespace {

/// The run whose rows are block means, from each edge to the next.
ObservedRun means(const ObservedRun& run, const std::vector<std::size_t>& edges) {
  ObservedRun thin{run.place,           run.body, run.geometry, run.way, run.origin,
                   run.raw_is_position, {},       {},           {}};
  for (auto edge = edges.begin(); edge + 1 != edges.end(); ++edge) {
    const auto mean = [&](const std::vector<double>& x) {
      return std::accumulate(x.begin() + static_cast<std::ptrdiff_t>(edge[0]),
                             x.begin() + static_cast<std::ptrdiff_t>(edge[1]), 0.0) /
             static_cast<double>(edge[1] - edge[0]);
    };
    thin.t.push_back(mean(run.t));
    thin.y.push_back(mean(run.y));
  }
  return thin;
}

/// The run after a moving median of five rows, which suppresses false echoes.
ObservedRun without_outliers(ObservedRun run) {
  const std::vector<double> y = run.y;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const std::size_t first = i < 2 ? 0 : i - 2, end = std::min(i + 3, y.size());
    std::vector<double> near(&y[first], &y[first] + (end - first));
    run.y[i] = median(near);
  }
  return run;
}

/// A run reduced to at most 64 block means, without a long rest at its end, and a rough estimate of
/// v0.
struct Thinned {
  ObservedRun run;
  double v0;
  double way;  ///< the largest distance from its beginning
  bool turns;  ///< it has come back
};

/// Estimates v0 from the time of half the distance. v0 times that time is 0.59 of the whole
/// distance for uniform deceleration to the stop (b = 0) and 0.69 for exponential decay (b = 1).
/// For larger b there is no such constant; v0 is then only the unit in which add_run() finds the
/// best value.
Thinned thinned(const ObservedRun& run, const FitOptions& options) {
  const std::size_t n = run.t.size();
  const bool position = run.raw_is_position;
  const double x0 = options.x0.value_or(position ? run.y[0] : 0);
  double most = 0, distance = 0;
  // The first row at which the distance has reached the goal. If none has, the result is n and
  // `most` is the largest distance.
  const auto reached = [&](double goal) {
    double way = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (position) way = run.way * (run.y[i] - x0);
      else if (i) way += run.way * (run.y[i] + run.y[i - 1]) / 2 * (run.t[i] - run.t[i - 1]);
      if (way >= goal) return i;
      most = std::max(most, way);
    }
    distance = way;
    return n;
  };
  reached(std::numeric_limits<double>::infinity());
  const std::size_t half = reached(0.5 * most), end = reached(0.95 * most);
  const double half_time =
      run.t[std::max<std::size_t>(half, n > 1)] - (position && options.x0 ? 0 : run.t[0]);
  const double v0 = options.v0 ? std::abs(*options.v0) : 0.6 * most / half_time;
  if (!(v0 > 0) || !std::isfinite(v0))
    fail("{}the body does not move: a and b cannot be determined", run.place);
  // The way back of a body that turns is used as well, and may be slow.
  const std::size_t used = options.fit_slope || distance < 0.8 * most
                               ? n
                               : std::min(n, end + std::max<std::size_t>(end / 3, 8)),
                    block = (used + 63) / 64;
  std::vector<std::size_t> edges;
  for (std::size_t i = 0; i < used; i += block) edges.push_back(i);
  edges.push_back(used);
  return {means(run, edges), v0, most, distance < 0.8 * most};
}

/// A law with the v0 and x0 of each run, and the sum of squares of the thinned runs.
struct Candidate {
  double rss;
  PowerLaw law;
  std::vector<double> v0, x0;
  double slope = 0;  ///< of the mat along growing x, where it is a parameter
};

/// The rolls of the runs on a level mat with A = 1 under an exponent b: those of any a are the same
/// with another unit of time and of distance, since the acceleration is proportional to a.
struct Shape {
  PowerLaw law;             // of the rolls
  std::vector<Roll> rolls;  // of each run, with its rough v0
};

Shape shape_of(const std::vector<Thinned>& thin, double b) {
  const ObservedRun& first = thin.front().run;
  const double v0 = thin.front().v0;
  Shape shape{
      {std::pow(v0, 1 - b) * (first.body.K + 1) * first.body.R / first.body.g / first.t.back(), b},
      {}};
  for (const auto& [run, scale, way, turns] : thin) {
    Body level = run.body;
    level.slope = 0;
    shape.rolls.emplace_back(level, Geometry::approximate, shape.law, scale);
  }
  return shape;
}

/// Adds a run to a candidate, with v0 (a factor) and x0 at their least-squares values.
void add_run(Candidate& candidate, const Thinned& of, const Shape& shape, Roll& roll,
             const FitOptions& options) {
  const ObservedRun& thin = of.run;
  const bool position = thin.raw_is_position;
  const double faster = candidate.law.a / shape.law.a;
  double mm = 0, my = 0, m_mean = 0, y_mean = 0;
  std::vector<double> m, y;
  for (std::size_t i = 0; i < thin.t.size(); ++i) {
    const Roll::Point p = roll.at(thin.t[i] * faster);
    m.push_back(thin.way * (position ? p.x / faster : p.v));
    y.push_back(thin.y[i] - (position ? options.x0.value_or(0) : 0));
  }
  const double n = static_cast<double>(m.size());
  if (position && !options.x0) {
    m_mean = std::accumulate(m.begin(), m.end(), 0.0) / n;
    y_mean = std::accumulate(y.begin(), y.end(), 0.0) / n;
  }
  for (std::size_t i = 0; i < m.size(); ++i)
    mm += (m[i] - m_mean) * (m[i] - m_mean), my += (m[i] - m_mean) * (y[i] - y_mean);
  const double factor = options.v0 ? 1 : my / mm;
  if (!(factor > 0)) fail("rolls the wrong way");
  double rss = 0;
  for (std::size_t i = 0; i < m.size(); ++i) {
    const double f = factor * (m[i] - m_mean) - (y[i] - y_mean);
    rss += f * f;
  }
  candidate.rss += rss;
  candidate.v0.push_back(factor * of.v0);
  candidate.x0.push_back(options.x0.value_or(y_mean - factor * m_mean));
}

/// Throws Error if a run comes back although its mat is level, and the nearest roll is far from it,
/// as false echoes alone do not make it.
void require_level(const std::vector<Thinned>& thin, const Candidate& nearest,
                   const FitOptions& options) {
  constexpr double far = 0.1;  // of the way or of v0
  double square = 0;
  for (const Thinned& of : thin)
    square += std::pow(far * (of.run.raw_is_position ? of.way : of.v0), 2) *
              static_cast<double>(of.run.t.size());
  for (const auto& [run, scale, way, turns] : thin)
    if (turns && run.body.slope == 0 && !options.fit_slope && !options.robust &&
        nearest.rss > square)
      fail(
          "{}the body comes back, which a level mat does not do: on a slope, --slope S or --slope "
          "fit; else the roll alone (smooth --coast, or --to)",
          run.place);
}

/// Starting points, best first: for each b of a grid, the best a of a grid. The grid of a is
/// uniform in the logarithm of the first run's duration divided by its initial time scale
/// v/|dv/dt|.
std::vector<Candidate> starts(const std::vector<Thinned>& thin, const FitOptions& options) {
  std::vector<double> exponents{-0.5, 0, 0.25, 0.5, 1, 1.5, 2, 3};
  if (const auto given = options.given_b()) exponents = {*given};
  std::vector<Candidate> best;
  for (double b : exponents) {
    Shape shape = shape_of(thin, b);
    std::vector<double> as;
    if (const auto given = options.given_a()) as = {*given};
    else
      for (double x = 0.01; x < 1000; x *= 1.3) as.push_back(x * shape.law.a);
    Candidate nearest{std::numeric_limits<double>::infinity(), {}, {}, {}};
    for (double a : as) try {
        Candidate candidate{0, {a, b}, {}, {}};
        for (std::size_t r = 0; r < thin.size(); ++r)
          add_run(candidate, thin[r], shape, shape.rolls[r], options);
        if (candidate.rss < nearest.rss) nearest = std::move(candidate);
      } catch (const Error&) {  // no roll has this law and these data
      }
    if (std::isfinite(nearest.rss)) best.push_back(std::move(nearest));
  }
  std::ranges::sort(best, {}, &Candidate::rss);
  return best;
}

/// The start where a body speeds up on its slope, which no roll on a level mat resembles: the
/// constant acceleration between the means of the thirds of each run, and so b = 0.
std::optional<Candidate> of_constant_acceleration(const std::vector<Thinned>& thin) {
  Candidate start{0, {0, 0}, {}, {}};
  bool speeds_up = false;
  for (const auto& [run, v0_scale, way, turns] : thin) {
    const std::size_t n = run.t.size();
    if (n < 6 || run.body.slope == 0) return {};
    const ObservedRun third = means(run, {0, n / 3, 2 * n / 3, n});
    const auto& t = third.t;
    const auto& y = third.y;
    const bool position = run.raw_is_position;
    const double rise = run.way * (y[1] - y[0]) / (t[1] - t[0]),
                 next = run.way * (y[2] - y[1]) / (t[2] - t[1]),
                 a = position ? 2 * (next - rise) / (t[2] - t[0]) : (rise + next) / 2,
                 v0 = position ? rise - a * (t[0] + t[1]) / 2 : run.way * y[0] - a * t[0];
    Body body = run.body;
    body.slope *= run.way;
    const double least = 1e-3 * body.R * std::abs(body.slope),
                 D = shift_from_acceleration(body, Geometry::approximate, a);
    start.law.a += std::max(D, least) / static_cast<double>(thin.size());
    start.v0.push_back(std::max(v0, 0.05 * v0_scale));
    start.x0.push_back(position ? y[0] - run.way * (v0 + a * t[0] / 2) * t[0] : 0);
    speeds_up |= a > 0;
  }
  return speeds_up ? std::optional(std::move(start)) : std::nullopt;
}

/// A roll of constant decelerations up to the time T and back from there.
struct BothWays {
  double rss, T, up, back, x_turn;
};

/// The closest such roll to a run, over a grid of T.
BothWays closest_both_ways(const ObservedRun& run) {
  const std::size_t terms = run.raw_is_position ? 3 : 2, n = run.t.size();
  BothWays best{std::numeric_limits<double>::infinity(), 0, 0, 0, 0};
  for (std::size_t k = 1; k < 2 * n; ++k) {
    const double T = run.t.back() * static_cast<double>(k) / static_cast<double>(n);
    Triangles all(1, terms, 0);
    const auto row = [&](std::size_t i, double* J) {
      const double t = run.t[i] - T, part = run.raw_is_position ? -t * t / 2 : -t;
      J[0] = t < 0 ? part : 0, J[1] = t < 0 ? 0 : part, J[2] = 1;
    };
    double J[3];
    for (std::size_t i = 0; i < n; ++i) {
      row(i, J);
      double f = -run.way * run.y[i];  // solve() makes f + J c least
      all.add(0, {&f, 1}, std::span(J).first(terms));
    }
    all.join();
    std::vector<double> c = all.solve();
    c.resize(3);
    double rss = 0;
    for (std::size_t i = 0; i < n; ++i) {
      row(i, J);
      const double off =
          run.way * run.y[i] - dot(std::span(J).first(terms), std::span(c).first(terms));
      rss += off * off;
    }
    if (rss < best.rss) best = {rss, T, c[0], c[1], c[2]};
  }
  return best;
}

/// The starts where bodies turn and roll back, which no roll on a level mat resembles: constant
/// decelerations on both ways, which an exponent and the mean speeds make a law and a slope.
std::vector<Candidate> of_both_ways(const std::vector<Thinned>& thin, const FitOptions& options) {
  if (!options.fit_slope && std::ranges::none_of(thin, &Thinned::turns)) return {};
  // Under b < 0 no slope brings a body back: the starts are not at that edge.
  std::vector<Candidate> all;
  for (const double b : {0.1, 0.3, 0.6, 1.0}) {
    all.push_back({0, {0, options.given_b().value_or(b)}, {}, {}, 0});
  }
  double turned = 0;
  for (const auto& [run, scale, way, turns] : thin) {
    if (run.t.size() < 8 || (run.body.slope == 0 && !options.fit_slope)) return {};
    const BothWays roll = closest_both_ways(run);
    for (Candidate& start : all) {
      start.v0.push_back(std::max(roll.up * roll.T, 0.05 * scale));
      start.x0.push_back(run.way * (roll.x_turn - roll.up * roll.T * roll.T / 2));
    }
    const double left = run.t.back() - roll.T;
    if (!(left > 0 && roll.up > 0 && roll.back > 0)) continue;
    // Up g (D + R S)/((K + 1) R), back g (R S - D)/((K + 1) R).
    const Body& body = run.body;
    const double unit = (body.K + 1) / body.g, v_up = roll.up * roll.T / 2,
                 v_back = roll.back * left / 2, least = 1e-3 * roll.up;
    for (Candidate& start : all) {
      const double D = std::pow(v_up, start.law.b), D_back = std::pow(v_back, start.law.b);
      const double a = options.fit_slope
                           ? std::max(roll.up - roll.back, least) / (D + D_back)
                           : std::max(roll.up - std::abs(body.slope) / unit, least) / D;
      start.law.a += a * unit * body.R;
      start.slope += run.way * (roll.up - a * D) * unit;
    }
    ++turned;
  }
  if (turned == 0) return {};
  for (Candidate& start : all) start.law.a /= turned, start.slope /= turned;
  return all;
}

System unweighted(std::vector<ObservedRun> runs, const Parameters& q) {
  return system_of(std::make_shared<const RollModel>(std::move(runs), q),
                   std::make_shared<const Noise>());
}

}  // namespace

std::vector<ObservedRun> means_of_many(const std::vector<ObservedRun>& runs) {
  constexpr std::size_t longest = 4096;
  std::size_t n = 0;
  for (const ObservedRun& run : runs) n += run.t.size();
  if (n <= longest * runs.size()) return {};
  std::vector<ObservedRun> few;
  for (const ObservedRun& run : runs) {
    const std::size_t rows = run.t.size(), size = (rows + longest - 1) / longest;
    std::vector<std::size_t> edges;  // blocks of equal size: the means have equal weights
    for (std::size_t i = 0; i < rows; i += size) edges.push_back(i);
    edges.push_back(rows);
    few.push_back(means(run, edges));
  }
  return few;
}

FirstGuess first_guess(const std::vector<ObservedRun>& runs, const FitOptions& options) {
  std::vector<Thinned> thin;
  std::vector<ObservedRun> thin_runs,
      few = options.robust ? std::vector<ObservedRun>() : means_of_many(runs);
  for (const ObservedRun& run : few.empty() ? runs : few) {
    thin.push_back(options.robust ? thinned(without_outliers(run), options)
                                  : thinned(run, options));
    thin_runs.push_back(thin.back().run);
  }
  const bool position = runs.front().raw_is_position;
  const double v0 = thin.front().v0, duration = thin.front().run.t.back(),
               x_ref = position ? v0 * std::max(duration, std::numeric_limits<double>::min()) : 1;
  const Parameters q(options, position, runs.size(), v0 / 2, x_ref);

  // The three best starting points lead to minima of the thinned runs; the best of these is taken.
  auto candidates = starts(thin, options);
  if (!candidates.empty()) require_level(thin, candidates.front(), options);
  const auto theta_of = [&](const Candidate& c) { return q.theta(c.law, c.v0, c.x0, c.slope); };
  std::vector<std::vector<double>> others;
  if (options.robust) std::ranges::transform(candidates, std::back_inserter(others), theta_of);
  if (candidates.size() > 3) candidates.resize(3);
  if (auto start = of_constant_acceleration(thin)) candidates.push_back(std::move(*start));
  auto turning = of_both_ways(thin, options);
  if (std::ranges::all_of(thin, &Thinned::turns) && !turning.empty()) candidates.clear();
  std::ranges::move(turning, std::back_inserter(candidates));
  if (candidates.empty()) fail("no law a v^b comes near the data: {}", choose_the_roll);
  std::vector<double> theta = theta_of(candidates.front());
  if (candidates.size() > 1) {
    const System system = unweighted(std::move(thin_runs), q);
    double least = std::numeric_limits<double>::infinity();
    for (const Candidate& candidate : candidates)
      if (Minimum minimum = attempt(system, theta_of(candidate)); minimum.rss < least)
        least = minimum.rss, theta = std::move(minimum.theta);
  }
  if (!few.empty()) theta = attempt(unweighted(std::move(few), q), theta).theta;
  return {q, std::move(theta), std::move(others)};
}

}  // namespace rolling
