// Least squares between a measured run and the roll that the law itself makes: v(t) or x(t). No
// derivative of the data is taken, and no bias comes from smoothing: what the filters did to the
// data is done to the model as well.
#include "fit/trajectory.h"

#include "base/error.h"
#include "base/large_pages.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace rolling {

System system_of(const std::vector<FittedRun>& rolls, const Parameters& q,
                 const KnownNoise& noise) {
  std::vector<std::size_t> runs;
  for (const auto& roll : rolls) runs.push_back(roll.t.size());
  return {runs, q.per_run(), q.of_law(),
          [runs, &rolls, &q, &noise](const std::vector<double>& theta, const TakeRows& take) {
    std::vector<Trajectory> trajectories;
    std::vector<std::size_t> begin;
    for (std::size_t r = 0; r < rolls.size(); ++r) {
      trajectories.push_back(q.trajectory(rolls[r], theta, r));
      begin.push_back(r ? begin.back() + runs[r - 1] : 0);
    }
    const double a = q.a(theta);
    hand_over_rows(
        runs, q.columns(), rolls.front().filters.rows() > 0, noise, take,
        [&](std::size_t r, std::size_t first, std::vector<double>& f, std::vector<double>& J) {
      const FittedRun& roll = rolls[r];
      const double x0 = q.x0(theta, r), way = roll.way;
      const auto model = [&](double t, double* slopes, std::size_t stride) {
        const auto s = roll.raw_is_position ? trajectories[r].at(t) : trajectories[r].speed_at(t);
        if (roll.raw_is_position)
          q.chain(slopes, stride, a, way * s.x_a, way * s.x_b, way * s.x_v0, 1);
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
        for (std::size_t j = 0; j < q.columns(); ++j)
          J[j * n + i] = roll.filters.times(i, std::span(slopes).subspan(j * m, m));
      }
        });
          }};
}

Rolls make_rolls(const std::vector<FitRun>& all, const std::vector<Rows>& rows, bool position,
                 const Making& making, const FitOptions& options) {
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
    if (roll.origin > first)
      fail("run {} begins before the time {} at which v0 and x0 are to hold", r + 1, roll.origin);
    roll.start = options.origin || options.v0 || options.x0 ? roll.origin : run.t[rows[r].front()];
    if (known && first < run.t[0] && roll.start == roll.origin)
      fail(
          "v0 and x0 cannot be held: filters have reached back to what was cut away before run {} "
          "begins",
          r + 1);
    reserve_large(roll.t, rows[r].size());
    reserve_large(roll.y, rows[r].size());
    for (std::size_t i : rows[r]) roll.t.push_back(run.t[i] - roll.origin), roll.y.push_back(y[i]);
    const double sign = options.v0 ? *options.v0
                        : position ? roll.y.back() - options.x0.value_or(roll.y.front())
                                   : std::accumulate(roll.y.begin(), roll.y.end(), 0.0);
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

RouteFit fit_rolls(const std::vector<FitRun>& all, std::vector<Rows>& rows, Parameters& q,
                   const Making& making, std::vector<double> theta) {
  const FitOptions& options = q.options;
  RouteFit result{};
  Rolls rolls;
  // The position route knows speeds only from its own fit: slow records leave after it, and the fit
  // is repeated without them.
  for (int round = 0; round < 4; ++round) {
    std::size_t n = 0;
    for (const auto& r : rows) n += r.size();
    require_records(n, q.count());
    rolls = make_rolls(all, rows, q.position, making, options);
    if (theta.empty()) theta = first_guess(rolls.of, q);
    result.minimum =
        solve(system_of(rolls.of, q, rolls.noise), theta, options, !rolls.noise.empty());
    theta = result.minimum.theta;
    if (!q.position || options.min_speed <= 0) break;
    std::size_t slow = 0;
    for (std::size_t r = 0; r < all.size(); ++r) {
      const Trajectory fitted = q.trajectory(rolls.of[r], theta, r);
      slow += std::erase_if(rows[r], [&](std::size_t i) {
        return fitted.velocity(fitted.log_ratio(all[r].t[i] - rolls.of[r].origin)) <
               options.min_speed;
      });
    }
    if (slow == 0) break;
  }

  const double a = q.a(theta);
  const auto quantity =
      [&](double value, double by_a, double by_b, double by_v0 = 0, double by_x0 = 0) {
    Quantity here{value, std::vector<double>(q.columns())};
    q.chain(here.gradient.data(), 1, a, by_a, by_b, by_v0, by_x0);
    return here;
  };
  result.a = quantity(a, 1, 0);
  result.b = quantity(q.b(theta), 0, 1);
  for (std::size_t r = 0; r < all.size(); ++r) {
    const FittedRun& roll = rolls.of[r];
    const auto s = q.trajectory(roll, theta, r).at(roll.start - roll.origin);
    result.v0.push_back(
        quantity(roll.way * s.v, roll.way * s.v_a, roll.way * s.v_b, roll.way * s.v_v0));
    if (q.position)
      result.x0.push_back(quantity(q.x0(theta, r) + roll.way * s.x, roll.way * s.x_a,
                                   roll.way * s.x_b, roll.way * s.x_v0, 1));
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

RouteFit fit_trajectory(Route route, const std::vector<FitRun>& all, const FitOptions& options) {
  const bool position = route == Route::position;
  const char* const column = position ? "x" : "v";
  Making making;
  for (const auto& run : all) making.responses.push_back(noise_response(run.filters, run.t));
  const bool known =
      std::all_of(making.responses.begin(), making.responses.end(), [&](const NoiseResponse& r) {
        return r.of.contains(column) && (r.source == "x" || (r.source == "v" && !position));
      });
  if (!known) making.responses.clear();

  std::vector<Rows> rows;
  for (const auto& run : all) {
    const auto& y = position ? run.x : run.v;
    Rows usable;
    reserve_large(usable, y.size());
    double way = 0;
    for (std::size_t i = 0; i < y.size(); ++i)
      if (std::isfinite(y[i])) usable.push_back(i), way += y[i];
    if (!position && options.min_speed > 0)
      std::erase_if(usable, [&](std::size_t i) {
        return std::copysign(y[i], y[i] * way) < options.min_speed;
      });
    rows.push_back(std::move(usable));
  }

  Parameters q{options, position, all.size()};
  RouteFit fitted = fit_rolls(all, rows, q, making);
  const bool may_be_differences = !known && !position && !options.robust &&
                                  !options.possible_filters.empty() &&
                                  fitted.minimum.f.size() >= 30;
  if (may_be_differences)
    if (auto differences = fit_differences(all, rows, q, fitted.minimum.theta))
      return *std::move(differences);
  assess(system_of(fitted.rolls, q, fitted.noise), fitted);
  return fitted;
}

}  // namespace rolling
