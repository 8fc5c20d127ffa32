// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/first_guess.h"

#include "base/matrix.h"
#include "base/error.h"
#include "base/median.h"
#include "contact/contact.h"
#include "least_squares/minimise.h"
#include "least_squares/triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace rolling {
namespace {

/// Calls put(j, T_j, dT_j/dt) with each Chebyshev polynomial T_j below `end`; t is scaled from
/// 0 <= t <= 2 half.
void for_each_polynomial(double t, double half, std::size_t end, auto&& put) {
  const double u = t / half - 1;
  double T = 1, next = u, slope = 0, next_slope = 1;
  for (std::size_t j = 0; j < end; ++j) {
    put(j, T, slope / half);
    slope = std::exchange(next_slope, 2 * next + 2 * u * next_slope - slope);
    T = std::exchange(next, 2 * u * next - T);
  }
}

/// The polynomial in time whose filtered values have the least weighted sum of squares from the
/// rows of a run: a sum of Chebyshev polynomials from number `first` on.
class FilteredPolynomial {
 public:
  FilteredPolynomial(const ObservedRun& run, std::size_t terms, std::size_t first,
                     const Noise& noise, std::size_t number)
      : first_(first), half_(std::max(run.t.back() / 2, std::numeric_limits<double>::min())) {
    Triangles R(1, terms, 0);
    const auto raw = [&](double t, double* to, std::size_t stride) {
      for_each_polynomial(t, half_, first + terms, [&](std::size_t j, double T, double) {
        if (j >= first) to[(j - first) * stride] = T;
      });
      return 0.0;
    };
    evaluate(run, number, terms, noise, raw,
             [&](std::size_t, std::span<double> f, std::span<double> J) { R.add(0, f, J); });
    R.join();
    c_ = R.solve();
  }
  /// Its value and slope.
  std::array<double, 2> operator()(double t) const {
    std::array<double, 2> y{};
    for_each_polynomial(t, half_, first_ + c_.size(), [&](std::size_t j, double T, double slope) {
      if (j >= first_) y[0] += c_[j - first_] * T, y[1] += c_[j - first_] * slope;
    });
    return y;
  }

 private:
  std::size_t first_;
  double half_;
  std::vector<double> c_;
};

/// The run whose rows are means of blocks of so many of the first n rows; the last may be shorter.
ObservedRun means(const ObservedRun& run, std::size_t n, std::size_t size) {
  ObservedRun thin{run.place,           run.body, run.geometry, run.way, run.origin,
                   run.raw_is_position, {},       {},           {}};
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

/// The speeds of a run along its motion: those of a polynomial through its rows, which is stiff
/// where outliers may be left. On a level mat a body rests from where they become 0.
std::vector<double> speeds_of(const ObservedRun& run, const FitOptions& options) {
  const bool level = run.body.slope == 0 && !options.fit_slope;
  const std::size_t most = options.robust ? 4 : 7;
  const FilteredPolynomial motion(run, std::min(most, 2 + run.t.size() / 4), 0, Noise(), 0);
  std::vector<double> speeds;
  bool rests = false;
  for (const double t : run.t) {
    const double v = run.way * motion(t)[run.raw_is_position];
    rests |= level && v <= 0 && !speeds.empty() && speeds.back() > 0;
    speeds.push_back(rests || (level && v < 0) ? 0 : v);
  }
  return speeds;
}

/// A run reduced to at most 64 block means, without a long rest at its end, and a rough estimate of
/// v0.
struct Thinned {
  ObservedRun run;
  double v0;
  double way;                       ///< the largest distance from its beginning
  bool turns;                       ///< it has come back
  std::vector<double> speeds = {};  ///< see speeds_of()
};

[[noreturn]] void refuse_way_back(const ObservedRun& run) {
  fail(
      "{}the body comes back, which a level mat does not do: on a slope, --slope S or --slope "
      "fit; else the roll alone (smooth --coast, or --to)",
      run.place);
}

/// Estimates v0 from the time of half the distance. v0 times that time is 0.59 of the whole
/// distance for uniform deceleration to the stop (b = 0) and 0.69 for exponential decay (b = 1).
/// For larger b there is no such constant; v0 is then only a unit.
Thinned thinned(const ObservedRun& run, const FitOptions& options) {
  const std::size_t n = run.t.size();
  const bool position = run.raw_is_position;
  const double x0 = options.x0.value_or(position ? run.y[0] : 0);
  std::vector<double> way(n);
  for (std::size_t i = 0; i < n; ++i)
    if (position) way[i] = run.way * (run.y[i] - x0);
    else if (i)
      way[i] = way[i - 1] + run.way * (run.y[i] + run.y[i - 1]) / 2 * (run.t[i] - run.t[i - 1]);
  const double most = std::max(0.0, std::ranges::max(way));
  const auto reached = [&](double part) {  // the first row there
    return static_cast<std::size_t>(
        std::ranges::find_if(way, [&](double x) { return x >= part * most; }) - way.begin());
  };
  const double half_time =
      run.t[std::max<std::size_t>(reached(0.5), n > 1)] - (position && options.x0 ? 0 : run.t[0]);
  const double v0 = options.v0 ? std::abs(*options.v0) : 0.6 * most / half_time;
  if (most == 0 && std::ranges::min(way) < 0) refuse_way_back(run);  // beyond its beginning
  if (!(v0 > 0) || !std::isfinite(v0))
    fail("{}the body does not move: a and b cannot be determined", run.place);
  // The way back of a body that turns is used as well, and may be slow.
  const bool turns = way.back() < 0.8 * most;
  const std::size_t end = reached(0.95),
                    used = options.fit_slope || turns
                               ? n
                               : std::min(n, end + std::max<std::size_t>(end / 3, 8));
  ObservedRun few = means(run, used, (used + 63) / 64);
  std::vector<double> speeds = speeds_of(few, options);
  return {std::move(few), v0, most, turns, std::move(speeds)};
}

/// A law with the v0 and x0 of each run, and the sum of squares of the thinned runs.
struct StartingPoint {
  double rss = 0;
  PowerLaw law;
  std::vector<double> v0 = {}, x0 = {};
  double slope = 0;  ///< of the mat along growing x, where it is a parameter
};

/// What an exponent makes of speeds: v = v0 - g/((K + 1) R) int (a u^b + R S) dt is linear in v0, a
/// and the slope S, and so is x, where the speeds u of the law are those of the polynomials.
class LinearRoll {
 public:
  LinearRoll(const ObservedRun& run, double v_unit, double b)
      : position_(run.raw_is_position), k_(run.body.g / ((run.body.K + 1) * run.body.R)),
        R_(run.body.R), v_unit_(v_unit), b_(b) {}
  /// The derivatives of x, or of v, at the next row by v0, by a v_unit^b and by S.
  std::array<double, 3> next(double t, double speed) {
    constexpr double slowest = 0.02;  // b may be negative
    const double u = speed / v_unit_, h = t - t_,
                 law = u == 0 ? 0 : std::copysign(std::pow(std::max(std::abs(u), slowest), b_), u);
    if (t_ == 0) law_ = law;
    by_x_ += h * by_v_ + h * h * (2 * law_ + law) / 6;  // the law is a line in between
    by_v_ += h * (law_ + law) / 2;
    t_ = t, law_ = law;
    return position_ ? std::array{t, -k_ * by_x_, -k_ * R_ * t * t / 2}
                     : std::array{1., -k_ * by_v_, -k_ * R_ * t};
  }

 private:
  bool position_;
  double k_, R_, v_unit_, b_;
  double t_ = 0, law_ = 0, by_v_ = 0, by_x_ = 0;
};

/// The starting point for an exponent, by linear least squares. `slope`: S is a parameter. None if
/// these numbers are not determined, or if the law would not slow the body down while S might.
std::optional<StartingPoint> starting_point(const std::vector<Thinned>& thin, double b, bool slope,
                                            const FitOptions& options) {
  const ObservedRun& first = thin.front().run;
  const double v_unit = thin.front().v0;
  const bool x0 = first.raw_is_position && !options.x0;
  const auto a = options.given_a();
  const std::size_t own = !options.v0 + x0, q = own + !a + slope;
  const double unit = std::pow(v_unit, -b), fixed_v0 = std::abs(options.v0.value_or(0)),
               fixed_x0 = first.raw_is_position ? options.x0.value_or(0) : 0;
  Triangles all(thin.size(), own, q - own);
  double squares = 0;
  for (std::size_t r = 0; r < thin.size(); ++r) {
    const ObservedRun& run = thin[r].run;
    LinearRoll roll(run, v_unit, b);
    for (std::size_t i = 0; i < run.t.size(); ++i) {
      const auto [by_v0, by_a, by_S] = roll.next(run.t[i], thin[r].speeds[i]);
      double J[4], *next = J;
      if (!options.v0) *next++ = by_v0;
      if (x0) *next++ = run.way;
      if (!a) *next++ = by_a;
      if (slope) *next++ = by_S * run.way;
      double f = run.way * (fixed_x0 - run.y[i]) + by_v0 * fixed_v0 + by_a * a.value_or(0) / unit +
                 (slope ? 0 : by_S * run.way * run.body.slope);
      squares += f * f;
      all.add(r, {&f, 1}, std::span(J).first(q));
    }
  }
  all.join();
  if (q > 0 && !(all.smallest_sine() > 1e-9)) return {};
  const std::vector<double> c = all.solve();
  const Body& body = first.body;
  const double least =
                   1e-3 * unit * body.R *
                   std::max(std::abs(body.slope), v_unit * (body.K + 1) / body.g / first.t.back()),
               best = a ? *a : c[thin.size() * own] * unit;
  if (slope && best < least) return {};
  StartingPoint found{squares - all.reduction(), {std::max(best, least), b}};
  for (std::size_t r = 0; r < thin.size(); ++r) {
    const double* const of_run = c.data() + r * own;
    found.v0.push_back(options.v0 ? fixed_v0 : std::max(*of_run, 0.05 * thin[r].v0));
    found.x0.push_back(x0 ? of_run[!options.v0] : fixed_x0);
  }
  if (slope) found.slope = c.back();
  return found;
}

/// Starting points, best first: of each exponent of a grid.
std::vector<StartingPoint> starts(const std::vector<Thinned>& thin, const FitOptions& options) {
  std::vector<double> exponents{-0.5, 0, 0.1, 0.25, 0.5, 1, 1.5, 2, 3};
  if (const auto given = options.given_b()) exponents = {*given};
  std::vector<StartingPoint> all;
  for (const double b : exponents) {
    std::optional<StartingPoint> found;
    if (options.fit_slope) found = starting_point(thin, b, true, options);
    if (!found) found = starting_point(thin, b, false, options);
    if (found) all.push_back(std::move(*found));
  }
  std::ranges::sort(all, {}, &StartingPoint::rss);
  return all;
}

/// Throws Error if the best roll, of this sum of squares, is no nearer than rest, or if a run comes
/// back although its mat is level, and the roll is far from it, as false echoes alone do not make
/// it.
void require_near(const std::vector<Thinned>& thin, double rss, const FitOptions& options) {
  constexpr double far = 0.1;  // of the way or of v0
  double square = 0, at_rest = 0;
  for (const auto& [run, v0, way, turns, speeds] : thin) {
    const double n = static_cast<double>(run.t.size()),
                 x = run.raw_is_position
                         ? options.x0.value_or(std::accumulate(run.y.begin(), run.y.end(), 0.0) / n)
                         : 0;
    square += std::pow(far * (run.raw_is_position ? way : v0), 2) * n;
    for (const double y : run.y) at_rest += (y - x) * (y - x);
  }
  for (const auto& [run, v0, way, turns, speeds] : thin)
    if (turns && run.body.slope == 0 && !options.fit_slope && !options.robust && rss > square)
      refuse_way_back(run);
  if (std::isfinite(rss) && rss >= at_rest * (1 - 1e-9))
    fail("no law a v^b comes near the data: {}", choose_the_roll);
}

System unweighted(std::vector<ObservedRun> runs, const Parameters& q) {
  return system_of(std::make_shared<const RollModel>(std::move(runs), q),
                   std::make_shared<const Noise>());
}

ObservedRun smooth_motion(Route route, const ObservedRun& run, std::size_t number,
                          const Noise& noise, const FitOptions& options) {
  const bool position = route == Route::position;
  // Filters that turn positions into speeds do not see a constant.
  const bool slopes = run.raw_is_position && !position;
  const std::size_t n = run.y.size();
  std::size_t informative = 0;
  for (std::size_t i = 0; i < n; ++i) informative += noise.whitener(number).informative(i);
  const std::size_t terms = std::min<std::size_t>(1 + informative / (slopes ? 3 : 2), 7);
  const FilteredPolynomial motion(run, terms, slopes, noise, number);
  ObservedRun smooth{run.place, run.body, run.geometry, 1, run.origin, position, {}, {}, {}};
  const std::size_t begin = run.H->first(0), end = run.H->end(n - 1);
  for (std::size_t i = begin; i < end; i += (end - begin + 255) / 256) {
    smooth.t.push_back(run.t[i]);
    smooth.y.push_back(motion(run.t[i])[slopes]);
  }
  constexpr double bends = 0.05;  // so much of the way by itself
  smooth.way = way_of(position, smooth.t, smooth.y, run.body.slope, options, bends);
  return smooth;
}

}  // namespace

std::vector<ObservedRun> smooth_motion(Route route, const std::vector<ObservedRun>& runs,
                                       const Noise& noise, const FitOptions& options) {
  std::vector<ObservedRun> smooth;
  for (const ObservedRun& run : runs)
    smooth.push_back(smooth_motion(route, run, smooth.size(), noise, options));
  return smooth;
}

std::vector<ObservedRun> means_of_many(const std::vector<ObservedRun>& runs) {
  constexpr std::size_t longest = 4096;
  std::size_t n = 0;
  for (const ObservedRun& run : runs) n += run.t.size();
  if (n <= longest * runs.size()) return {};
  std::vector<ObservedRun> few;
  for (const ObservedRun& run : runs) {
    const std::size_t rows = run.t.size(), size = (rows + longest - 1) / longest;
    few.push_back(means(run, rows, size));  // of equal size: the means have equal weights
  }
  return few;
}

FirstGuess first_guess(const std::vector<ObservedRun>& runs, const FitOptions& options) {
  std::vector<Thinned> thin;
  std::vector<ObservedRun> thin_runs,
      few = options.robust ? std::vector<ObservedRun>() : means_of_many(runs);
  for (ObservedRun run : few.empty() ? runs : few) {
    if (options.robust) run.y = medians_of_five(run.y);  // suppresses false echoes
    thin.push_back(thinned(run, options));
    thin_runs.push_back(thin.back().run);
  }
  const bool position = runs.front().raw_is_position;
  const double v0 = thin.front().v0, duration = thin.front().run.t.back(),
               x_ref = position ? v0 * std::max(duration, std::numeric_limits<double>::min()) : 1;
  const Parameters q(options, position, runs.size(), v0 / 2, x_ref);

  // The three best starting points lead to minima of the thinned runs; the best of these is taken.
  auto candidates = starts(thin, options);
  if (candidates.empty()) fail("no law a v^b comes near the data: {}", choose_the_roll);
  const auto theta_of = [&](const StartingPoint& c) { return q.theta(c.law, c.v0, c.x0, c.slope); };
  std::vector<std::vector<double>> others;
  if (options.robust) std::ranges::transform(candidates, std::back_inserter(others), theta_of);
  if (candidates.size() > 3) candidates.resize(3);
  std::vector<double> theta = theta_of(candidates.front());
  const System system = unweighted(std::move(thin_runs), q);
  double least = std::numeric_limits<double>::infinity();
  for (const StartingPoint& candidate : candidates)
    if (Minimum minimum = attempt(system, theta_of(candidate)); minimum.rss < least)
      least = minimum.rss, theta = std::move(minimum.theta);
  require_near(thin, least, options);
  if (!few.empty()) theta = attempt(unweighted(std::move(few), q), theta).theta;
  return {q, std::move(theta), std::move(others)};
}

}  // namespace rolling
