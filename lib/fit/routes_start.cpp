// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/routes.h"

#include "base/error.h"
#include "contact/road.h"
#include "base/median.h"
#include "least_squares/minimise.h"
#include "least_squares/triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace rolling {
namespace {

/// The run whose rows are means of blocks of so many of the first n rows; the last may be shorter.
ObservedRun means(const ObservedRun& run, std::size_t n, std::size_t size) {
  ObservedRun thin{run.place, run.body, run.way, run.origin, run.column};
  thin.x0 = run.x0;
  for (std::size_t i = 0; i < n; i += size) {
    const std::size_t rows = std::min(size, n - i);
    const auto mean = [&](const std::vector<double>& x) {
      return std::accumulate(&x[i], &x[i] + rows, 0.0) / static_cast<double>(rows);
    };
    thin.t.push_back(mean(run.t));
    thin.y.push_back(mean(run.y));
  }
  return thin;
}

/// The speeds of a run along its motion: those of a polynomial in time through its rows, which is
/// stiff where outliers may be left. On a level mat a body rests from where they become 0.
std::vector<double> speeds_of(const ObservedRun& run, const FitOptions& options) {
  const bool level = run.body.slope == 0 && !options.fit_slope;
  const std::size_t n = run.t.size();
  const std::size_t terms = std::min<std::size_t>({n, 2 + n / 4, options.robust ? 3U : 7U});
  const double half = std::max(run.t.back() / 2, std::numeric_limits<double>::min());
  Triangles R(1, terms, 0);
  std::vector<double> powers(terms);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < terms; ++j) powers[j] = std::pow(run.t[i] / half - 1, j);
    double f = -run.y[i];
    R.add(0, {&f, 1}, powers);
  }
  const std::vector<double> c = R.solve();
  std::vector<double> speeds;
  bool rests = false;
  for (const double t : run.t) {
    double y = 0;
    double slope = 0;  // by u = t/half - 1
    for (std::size_t j = terms; j-- > 0;) {
      slope = slope * (t / half - 1) + y;
      y = y * (t / half - 1) + c[j];
    }
    const double v = run.way * (run.column == Quantity::x ? slope / half : y);
    rests |= level && v <= 0 && !speeds.empty() && speeds.back() > 0;
    speeds.push_back(rests || (level && v < 0) ? 0 : v);
  }
  return speeds;
}

/// The places of the rows; of speeds, which tell no place, those of a run that begins at 0.
std::vector<double> places_of(const ObservedRun& run) {
  if (run.column == Quantity::x) return run.y;
  std::vector<double> x(run.t.size());
  for (std::size_t i = 1; i < x.size(); ++i)
    x[i] = x[i - 1] + (run.y[i] + run.y[i - 1]) / 2 * (run.t[i] - run.t[i - 1]);
  return x;
}

/// A run reduced to at most 64 block means, without a long rest at its end.
struct Thinned {
  ObservedRun run;
  double way;                  ///< the largest distance from its beginning
  bool turns;                  ///< it has come back
  std::vector<double> speeds;  ///< see speeds_of()

  double fastest() const { return std::ranges::max(speeds); }
};

[[noreturn]] void refuse_way_back(const ObservedRun& run) {
  fail<WayBack>("{}the body comes back, which a level mat does not do", run.place);
}

Thinned thinned(const ObservedRun& run, const FitOptions& options) {
  const std::size_t n = run.t.size();
  const double x0 = run.column == Quantity::x ? options.x0.value_or(run.y[0]) : 0;
  std::vector<double> way = places_of(run);
  for (double& x : way) x = run.way * (x - x0);
  const double most = std::max(0.0, std::ranges::max(way));
  if (most == 0 && std::ranges::min(way) < 0) refuse_way_back(run);  // beyond its beginning
  // The way back of a body that turns is used as well, and may be slow.
  const bool level = run.body.slope == 0 && !options.fit_slope;
  const bool turns = way.back() < (level ? 0.8 : 0.98) * most;
  std::size_t used = n;
  if (!options.fit_slope && !turns) {
    const auto far = std::ranges::find_if(way, [&](double x) { return x >= 0.95 * most; });
    const auto end = static_cast<std::size_t>(far - way.begin());
    used = std::min(n, end + std::max<std::size_t>(end / 3, 8));
  }
  ObservedRun few = means(run, used, (used + 63) / 64);
  std::vector<double> speeds = speeds_of(few, options);
  Thinned thin{std::move(few), most, turns, std::move(speeds)};
  if (most == 0 || !(thin.fastest() > 0) || !std::isfinite(thin.fastest()))
    fail("{}the body does not move: a and b cannot be determined", run.place);
  return thin;
}

/// D under which bodies slow down evenly as these do, and the slope of the mat if it is a
/// parameter: 0 where it is not determined or D would not be positive.
struct EvenRoll {
  double D, slope;
  double v, time;  ///< a speed between the first and the last one, and how long they roll
  std::vector<double> v0 = {};  ///< of each run, along the motion
  std::vector<double> x0 = {};
};

/// By linear least squares of their speeds.
EvenRoll even_roll(const std::vector<Thinned>& thin, bool fit_slope) {
  const Body& body = thin.front().run.body;
  const double time = thin.front().run.t.back();
  const double least =
      1e-3 * body.R *
      std::max(std::abs(body.slope), thin.front().fastest() * (body.K + 1) / body.g / time);
  Triangles all(1, 1 + fit_slope, 0);
  for (const auto& [run, way, turns, speeds] : thin) {
    const double rate = run.body.g / (run.body.K + 1);
    double rolled = 0;  // the time in which the body moved on, less that of its way back
    for (std::size_t i = 1; i < speeds.size(); ++i) {
      const double by_slope = -rate * run.way * (run.t[i] - run.t[0]);
      if (speeds[i] != 0) rolled += std::copysign(run.t[i] - run.t[i - 1], speeds[i]);
      double f = speeds[0] - speeds[i] + (fit_slope ? 0 : by_slope * run.body.slope);
      double J[] = {-rate / run.body.R * rolled, by_slope};
      all.add(0, {&f, 1}, std::span(J).first(1 + fit_slope));
    }
  }
  const std::vector<double> c = all.solve();
  if (fit_slope && !(all.smallest_sine() > 1e-9 && c[0] >= least)) return even_roll(thin, false);
  EvenRoll even{std::max(least, c[0]), fit_slope ? c[1] : 0, thin.front().fastest() / 2, time};
  for (const auto& [run, most, turns, speeds] : thin) {
    even.v0.push_back(std::max(speeds[0], 0.05 * std::ranges::max(speeds)));
    even.x0.push_back(run.y[0] - run.way * even.v0.back() * run.t[0]);
  }
  return even;
}

/// `rss` is the sum of squares of the best roll. Throws Error if a body at rest would fit as well,
/// as far as a rough search tells.
/// Throws Error, too, if the body of a run comes back on a level mat and the best roll is far from
/// the readings; a few false echoes do not bring it so far.
void require_near(const std::vector<Thinned>& thin, double rss, const FitOptions& options) {
  constexpr double far = 0.1;  // of the way or of the highest speed
  double square = 0;
  double at_rest = 0;
  double rows = 0;
  for (const Thinned& of : thin) {
    const ObservedRun& run = of.run;
    const double n = static_cast<double>(run.t.size());
    const double x = run.column == Quantity::x
                         ? options.x0.value_or(std::accumulate(run.y.begin(), run.y.end(), 0.0) / n)
                         : 0;
    square += std::pow(far * (run.column == Quantity::x ? of.way : of.fastest()), 2) * n;
    for (const double y : run.y) at_rest += (y - x) * (y - x);
    rows += n;
  }
  for (const auto& [run, way, turns, speeds] : thin)
    if (turns && run.body.slope == 0 && !options.fit_slope && !options.robust && rss > square)
      refuse_way_back(run);
  if (std::isfinite(rss) && rss >= at_rest * (1 - 1e-3 / rows))
    fail<NotOneRoll>("no law a v^b comes near the data");
}

}  // namespace

std::vector<ObservedRun> block_means(const std::vector<ObservedRun>& runs) {
  std::size_t rows = 0;
  for (const ObservedRun& run : runs) rows += run.y.size();
  std::vector<ObservedRun> few;
  if (rows <= long_run * runs.size()) return few;
  for (const ObservedRun& run : runs) {
    const std::size_t n = run.y.size();
    few.push_back(means(run, n, (n + long_run - 1) / long_run));
  }
  return few;
}

Fitted of_means(Fitted fit, const FitOptions& options) {
  if (!fit.is_roll() || fit.noise().known()) return fit;
  std::vector<ObservedRun> few = block_means(fit.model.runs());
  if (few.empty()) return fit;
  return fit_from({std::move(few), fit.parameters()}, {fit.minimum.theta}, options);
}

namespace {

/// Place and speed at an end of a run, by a parabola through its rows there. `x` are their places.
std::pair<double, double> end_of(const ObservedRun& run, const std::vector<double>& x, bool first) {
  const std::size_t n = run.t.size();
  const std::size_t rows = std::min<std::size_t>(n, 9);
  const std::size_t from = first ? 0 : n - rows;
  const double t0 = first ? run.t.front() : run.t.back();
  Triangles R(1, std::min<std::size_t>(rows, 3), 0);
  for (std::size_t i = from; i < from + rows; ++i) {
    const double t = run.t[i] - t0;
    double powers[]{1, t, t * t};
    double f = -run.y[i];
    R.add(0, {&f, 1}, std::span(powers).first(std::min<std::size_t>(rows, 3)));
  }
  const std::vector<double> c = R.solve();
  if (run.column != Quantity::x) return {first ? x.front() : x.back(), c[0]};
  return {c[0], c.size() > 1 ? c[1] : 0};
}

/// How far the energy of these speeds is from that under a law d0 + d2 v^2, if they begin at x0:
/// the sum of squares of E/(m g) + h, less a linear function of the integrals of |dx| and v^2 |dx|.
double unevenness(const ObservedRun& run, const std::vector<double>& way, double x0) {
  const std::size_t step = 1 + way.size() / 500;  // so many rows are enough
  Triangles R(1, 3, 0);
  double squares = 0;
  double rolled = 0;
  double blown = 0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const double dx = i > 0 ? std::abs(way[i] - way[i - 1]) : 0;
    const double v2 = run.y[i] * run.y[i];
    rolled += dx;
    blown += v2 * dx;
    if (i % step != 0) continue;
    double f = (1 + run.body.K) / 2 * v2 / run.body.g + run.body.road->at(x0 + way[i]).h;
    squares += f * f;
    double J[] = {1, rolled, blown};
    R.add(0, {&f, 1}, J);
  }
  return squares - R.reduction();
}

/// Where speeds begin on their road, by their energy. Throws Error if other places are as likely.
double likely_begin(const ObservedRun& run) {
  const std::vector<double> way = places_of(run);
  const auto [least, greatest] = std::ranges::minmax(way);
  const std::vector<double>& points = run.body.road->points();
  const double room = points.back() - points.front() - (greatest - least);
  if (!(room > 0))
    fail("{}the way of {:.4g} m is longer than the table of heights", run.place, greatest - least);
  std::vector<double> off(201 + 2 * points.size());
  const auto place = [&, first = points.front() - least](auto at) {
    return first +
           room * static_cast<double>(at - off.begin()) / static_cast<double>(off.size() - 1);
  };
  for (auto at = off.begin(); at != off.end(); ++at) *at = unevenness(run, way, place(at));
  const auto best = std::ranges::min_element(off);
  const double noise = *best / static_cast<double>(way.size());
  const double limit = *best + 4 * noise;
  const auto likely = [&](double x) { return x <= limit; };
  const auto first = std::ranges::find_if(off, likely);
  auto last = off.end() - 1;
  while (!likely(*last)) --last;
  if (*std::max_element(first, last) > limit + 36 * noise || last - first + 1 == std::ssize(off))
    fail("{}the speeds do not show where the run begins: x = {:.4g} m is as likely as {:.4g} m",
         run.place, place(first), place(last));
  return place(best);
}

/// The same on a road: D by the energy that is lost between the ends of the runs.
EvenRoll even_roll_on_road(const std::vector<ObservedRun>& runs) {
  const bool position = runs.front().column == Quantity::x;
  EvenRoll even{};
  double lost = 0;
  double all = 0;  // the way, in units of R
  for (const ObservedRun& run : runs) {
    std::vector<double> x = places_of(run);
    for (double& place : x) place += position ? 0 : run.x0;
    const auto [x_begin, v_begin] = end_of(run, x, true);
    const auto [x_end, v_end] = end_of(run, x, false);
    even.v0.push_back(run.way * v_begin);
    even.x0.push_back(x_begin);
    const auto energy = [&](double place, double v) {
      return (1 + run.body.K) / 2 * v * v / run.body.g + run.body.road->at(place).h;
    };
    lost += energy(x_begin, v_begin) - energy(x_end, v_end);
    for (std::size_t i = 1; i < x.size(); ++i) all += std::abs(x[i] - x[i - 1]) / run.body.R;
    even.time += run.t.back();
  }
  even.v = all * runs.front().body.R / even.time;
  if (!(even.v > 0)) fail("{}the body does not move: a and b cannot be determined", runs[0].place);
  even.D = std::max(lost / all, 1e-3 * runs.front().body.R);
  return even;
}

/// theta of the best roll on a road. As on a slope, b is held until the other parameters are right:
/// a search from a start may go behind the wall of b = 0.
std::vector<double> rough_on_road(const Model& model, const System& system,
                                  const std::vector<std::vector<double>>& starts,
                                  const FitOptions& options) {
  Minimum best;
  for (const std::vector<double>& start : starts)
    if (Minimum here = tried(system, start); here.rss < best.rss) best = std::move(here);
  for (std::size_t r = 0; r < model.runs().size() && !std::isfinite(best.rss); ++r)  // says why
    model.roll(starts.front(), r).at(model.runs()[r].t.back());
  if (!std::isfinite(best.rss)) fail("no roll on this road comes near the readings");
  const std::vector<double> start = best.theta;
  improve(best, system, start);
  if (!options.fixed[1]) improve(best, system, with_exponent_held(model, start, 0.25).theta);
  return best.theta;
}

}  // namespace

FirstGuess first_guess(const std::vector<ObservedRun>& runs, const FitOptions& options) {
  const bool on_road = runs.front().body.road != nullptr;
  std::vector<Thinned> thin;
  std::vector<ObservedRun> seen = runs;
  for (std::size_t r = 0; r < runs.size() && !on_road; ++r) {
    if (options.robust) seen[r].y = medians_of_five(seen[r].y);  // suppresses false echoes
    thin.push_back(thinned(seen[r], options));
    seen[r] = thin.back().run;
  }
  for (ObservedRun& run : seen)
    if (options.fit_x0) run.x0 = likely_begin(run);
  const EvenRoll even = on_road ? even_roll_on_road(seen) : even_roll(thin, options.fit_slope);
  const bool position = runs.front().column == Quantity::x;
  const Parameters q(options, position, runs.size(), even.v, even.v * even.time);
  // For a grid of laws: the shift at that speed is that of an even deceleration.
  std::vector<double> exponents{0.25, 0, 1, -0.5};
  if (on_road) exponents = {0.03, 0.5};
  if (options.fixed[1]) exponents = {*options.fixed[1]};
  std::vector<std::vector<double>> all;
  for (const double part : on_road ? std::vector{1.0, 0.4, 2.5} : std::vector{1.0})
    for (const double b : exponents) {
      const double a = options.fixed[0].value_or(part * even.D * std::pow(even.v, -b));
      all.push_back(q.theta({a, b}, even.v0, even.x0, even.slope));
    }
  const Model model(std::move(seen), q);
  System system = system_of(model);
  system.rough = true;
  Minimum best;
  if (on_road) {
    all.insert(all.begin(), rough_on_road(model, system, all, options));
    return {q, std::move(all)};
  }
  best.theta = all[0];
  for (const std::vector<double>& start : all) improve(best, system, start);
  system.rough = false;
  if (!std::isfinite(best.rss))
    for (const std::vector<double>& start : all) improve(best, system, start);
  // A body that turns on a slope would be held there by a law with b < 0, so that the sum of
  // squares has a wall at b = 0. A search that comes to the wall before the other parameters are
  // right does not leave it; with b held the other parameters come first.
  if (std::ranges::any_of(thin, &Thinned::turns) && !options.fixed[1])
    for (std::size_t k = 0; k < exponents.size(); ++k) {
      all.push_back(with_exponent_held(model, all[k], exponents[k]).theta);
      improve(best, system, all.back());
      Minimum at_wall = tried(system, all.back());
      if (at_wall.rss < best.rss) best = std::move(at_wall);
    }
  require_near(thin, best.rss, options);
  all.insert(all.begin(), std::move(best.theta));
  return {q, std::move(all)};
}

}  // namespace rolling
