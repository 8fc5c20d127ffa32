// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/model.h"

#include "base/chebyshev.h"
#include "base/error.h"
#include "base/grid.h"
#include "base/median.h"
#include "statistics/levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace rolling {
namespace {

/// The rows of the matrix of a column for the fitted rows.
Filters filters_of_rows(const Response& response, Quantity q, const Rows& rows) {
  const Filters& H = response.of[q];
  return rows.size() == H->rows() ? H : std::make_shared<const BandMatrix>(H->of_rows(rows));
}

std::vector<double> taken(const std::vector<double>& column, const Rows& rows) {
  std::vector<double> few;
  few.reserve(rows.size());
  for (std::size_t i : rows) few.push_back(column[i]);
  return few;
}

}  // namespace

Parameters::Parameters(const FitOptions& options, bool position, std::size_t runs, double v_ref,
                       double x_ref)
    : fixed_{options.v0, options.x0, options.fixed[0], options.fixed[1], 0}, unit_{v_ref, x_ref, 1,
                                                                                   1, 1},
      fit_wind_(options.fit_wind), position_(position), runs_(runs), v_unit_(v_ref) {
  if (options.v0) fixed_[0] = std::abs(*options.v0);
  if (!position && !options.fit_x0) fixed_[1] = 0;
  for (std::size_t i = 0; i < scene_numbers.size(); ++i) {
    unit_[first_of_scene + i] = scene_numbers[i].unit;
    if (i == place_of_wind || !(options.*scene_numbers[i].is_fitted))
      fixed_[first_of_scene + i] = 0;
  }
}

Parameters::Parameters(const FitOptions& options, double v_unit)
    : Parameters(options, false, 0, v_unit, 1) {
  fixed_[0] = 0;
  std::fill_n(&fixed_[first_of_scene], scene_numbers.size(), 0);
}

Parameters Parameters::with(const LawForm& form, double D_unit, double v_unit,
                            const FitOptions::Fixed& fixed) const {
  Parameters other = *this;
  other.form_ = &form;
  other.is_power_ = &form == &laws().front();
  other.D_unit_ = D_unit;
  other.v_unit_ = v_unit;
  other.as_written_ = fixed != FitOptions::Fixed{};
  std::fill_n(&other.fixed_[first_of_law], LawForm::most, 0);
  for (std::size_t j = 0; j < form.coefficients.size(); ++j) {
    const LawForm::Coefficient& c = form.coefficients[j];
    other.fixed_[first_of_law + j] = fixed[j];
    if (other.as_written_)
      other.unit_[first_of_law + j] = std::pow(D_unit, c.D) * std::pow(v_unit, c.v);
  }
  if (fit_wind_ && form.drag >= 0) other.fixed_[first_of_scene + place_of_wind].reset();
  return other;
}

Parameters Parameters::with(std::size_t number, double value) const {
  Parameters other = *this;
  other.fixed_[number] = value;
  return other;
}

Parameters Parameters::of_runs(std::size_t n) const {
  Parameters other = *this;
  other.runs_ = n;
  return other;
}

Parameters Parameters::of_one_run() const {
  Parameters one = of_runs(1);
  std::fill_n(&one.fixed_[first_of_scene], scene_numbers.size(), 0);
  return one;
}

std::size_t Parameters::free(std::size_t first, std::size_t end) const {
  std::size_t all = 0;
  for (std::size_t i = first; i < end; ++i) all += !fixed_[i];
  return all;
}

Parameters::Numbers Parameters::numbers(const std::vector<double>& theta, std::size_t run) const {
  Numbers all{};
  std::size_t next = run * own();
  for (std::size_t i = 0; i < most; ++i) {
    if (i == first_of_law) next = runs_ * own();
    all[i] = fixed_[i] ? *fixed_[i] : theta[next++] * unit_[i];
  }
  return all;
}

Law Parameters::law(const std::vector<double>& theta) const {
  const Numbers all = numbers(theta, 0);
  std::array<double, LawForm::most> c{};
  std::copy_n(&all[first_of_law], c.size(), c.begin());
  if (is_power_) c[0] = fixed(0) ? c[0] * std::pow(v_unit_, c[1]) / D_unit_ : std::exp(c[0]);
  if (as_written_) return {*form_, c};
  return Law::searched(*form_, c, D_unit_, v_unit_);
}

std::vector<double> Parameters::start(const std::vector<double>& c) const {
  if (!as_written_) return c;
  const Law law = Law::searched(*form_, c, D_unit_, v_unit_);
  std::vector<double> free;
  std::array<double, LawForm::most> unused;
  for (std::size_t j = 0; j < law.size(); ++j)
    if (!fixed(j)) free.push_back(law.in_SI(j, unused) / unit_[first_of_law + j]);
  return free;
}

Body Parameters::body(const std::vector<double>& theta, Body given) const {
  const Numbers all = numbers(theta, 0);
  for (std::size_t i = 0; i < scene_numbers.size(); ++i)
    if (fits(i)) given.*scene_numbers[i].value = all[first_of_scene + i];
  return given;
}

std::vector<double> Parameters::theta_of_runs(const std::vector<double>& theta,
                                              const std::vector<std::size_t>& runs) const {
  const auto at = [&](std::size_t i) { return theta.begin() + static_cast<std::ptrdiff_t>(i); };
  std::vector<double> few;
  for (const std::size_t run : runs) few.insert(few.end(), at(run * own()), at((run + 1) * own()));
  few.insert(few.end(), at(runs_ * own()), theta.end());
  return few;
}

std::vector<double> Parameters::theta(PowerLaw law, const std::vector<double>& v0,
                                      const std::vector<double>& x0, double slope) const {
  std::vector<double> all;
  const auto put = [&](std::size_t i, double value) {
    if (!fixed_[i]) all.push_back(value / unit_[i]);
  };
  for (std::size_t r = 0; r < runs_; ++r) {
    put(0, v0[r]);
    put(1, x0[r]);
  }
  put(first_of_law, std::log(law(v_unit_)));
  put(first_of_law + 1, law.b);
  put(first_of_scene, slope);
  put(first_of_scene + 1, 1);
  return all;
}

void Parameters::chain(double* to, std::size_t stride, double c0,
                       const Numbers& by) const noexcept {
  for (std::size_t i = 0; i < most; ++i) {
    if (fixed_[i]) continue;
    double by_theta = by[i] * unit_[i];
    if (is_power_ && i == first_of_law) by_theta *= c0;  // theta holds ln c0
    if (is_power_ && i == first_of_law + 1 && fixed(0))
      by_theta += c0 * std::log(v_unit_) * by[first_of_law];
    *std::exchange(to, to + stride) = by_theta;
  }
}

double way_before_turn(bool position, const std::vector<double>& t,
                       const std::vector<double>& rows) {
  constexpr std::size_t most = 2000;  // a direction needs no more
  std::vector<double> x;
  double way = 0;
  for (std::size_t i = 0, step = 1 + rows.size() / most; i < rows.size(); ++i) {
    if (!position && i > 0) way += (rows[i] + rows[i - 1]) / 2 * (t[i] - t[i - 1]);
    if (i % step == 0) x.push_back(position ? rows[i] : way);
  }
  const std::vector<double> smooth = medians_of_five(x);
  const auto [least, greatest] = std::ranges::minmax(smooth);
  const double begin = smooth.front();
  const double end = smooth.back();
  const double up = std::min(greatest - begin, greatest - end);
  const double down = std::min(begin - least, end - least);
  double limit = 0.002 * (greatest - least);
  if (position) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= smooth[i];
    limit += 2 * grid_of(rows) + 10 * deviation(std::move(x));  // at rest it may show two readings
  } else if (rows.size() > 2) {
    // The way is a sum over the rows, and so is its error: that of a speed is the root of a sixth
    // of the variance of the second differences.
    std::vector<double> bends;
    for (std::size_t i = 2; i < rows.size(); ++i)
      bends.push_back(rows[i] - 2 * rows[i - 1] + rows[i - 2]);
    const double n = static_cast<double>(rows.size());
    const double step = (t.back() - t.front()) / (n - 1);
    limit += 3 * std::sqrt(n / 6) * step * deviation(std::move(bends));
  }
  return std::max(up, down) > limit ? std::copysign(1.0, up - down) : 0;
}

double way_of(bool position, const std::vector<double>& t, const std::vector<double>& rows,
              double slope, const FitOptions& options) {
  if (slope != 0 || options.fit_slope)
    if (const double way = way_before_turn(position, t, rows); way != 0) return way;
  // A false echo counts as ten standard deviations.
  const std::vector<double> smooth = medians_of_five(rows);
  std::vector<double> off(rows.size());
  std::ranges::transform(rows, smooth, off.begin(), std::minus());
  const double most = 10 * deviation(off);
  double along = 0;  // the sum of speeds; of positions that of the later half less the earlier one
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool is_early = 2 * i + 2 <= rows.size();
    const bool is_late = 2 * i >= rows.size();
    const int sign = position ? is_late - is_early : 1;
    along += sign * (smooth[i] + std::clamp(off[i], -most, most));
  }
  return along < 0 ? -1 : 1;
}

std::vector<Response> responses_of(const std::vector<Run>& all) {
  std::vector<Response> responses;
  for (const Run& run : all) {
    if (run.filters.empty()) return {};
    responses.push_back(response_of(run.filters, run.t));
  }
  return responses;
}

std::vector<ObservedRun> observe(Route route, const std::vector<Run>& all,
                                 const std::vector<Rows>& rows,
                                 const std::vector<Response>& responses,
                                 const FitOptions& options) {
  const bool known = !responses.empty();
  std::vector<ObservedRun> runs;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const Run& run = all[r];
    ObservedRun seen;
    if (all.size() > 1) seen.place = fmt::format("run {}: ", run.name);
    if (rows[r].empty()) fail("{}no row can be fitted", seen.place);
    seen.body = body_of(route, run);
    seen.x0 = run.x0;
    seen.origin = run.t.front();
    seen.y = taken(run[fitted_column(route)], rows[r]);
    if (route == Route::shift && known) {
      for (std::size_t i : rows[r])
        seen.accelerations.push_back(acceleration_of(*run.shift_of, run.D[i]));
      seen.H_of_accelerations = filters_of_rows(responses[r], Quantity::D, rows[r]);
    }
    seen.column = known ? responses[r].source : fitted_column(route);
    if (known) {
      seen.t = run.t;
      seen.H = filters_of_rows(responses[r], fitted_column(route), rows[r]);
    } else {
      seen.t = taken(run.t, rows[r]);
    }
    for (double& t : seen.t) t -= seen.origin;
    seen.way =
        way_of(route == Route::position, taken(run.t, rows[r]), seen.y, seen.body.slope, options);
    runs.push_back(std::move(seen));
  }
  return runs;
}

Roll Model::roll(const std::vector<double>& theta, std::size_t run) const {
  const double way = runs()[run].way;
  const Body body = seen_along(parameters_.body(theta, runs()[run].body), way);
  const Law law = parameters_.law(theta);
  const double v0 = parameters_.v0(theta, run);
  if (law.in_wind(body.wind).at(std::abs(v0)).D < 0) fail("the mat does not slow the body down");
  // In the exact geometry a roll under b = -400 takes a second, and no mat has such a b.
  const auto power = law.power();
  if (body.exact && power && std::abs(power->b) > levels::largest_b)
    fail("no mat has such an exponent");
  if (!body.road) return {body, law, v0};
  // A search may come to such laws, under which a body in a hollow creeps: this takes seconds.
  if (law.at(parameters_.speed_unit()).D > body.R) fail("D is beyond the radius");
  const double x0 = parameters_.has_x0() ? parameters_.x0(theta, run) : runs()[run].x0;
  constexpr double tolerance = 1e-9;  // of a step on a road: far below the noise of any sensor
  return {body, law, v0, way * x0, tolerance};
}

namespace {

/// The raw column of a roll, as a Chebyshev series where the times are dense, with its derivatives
/// by the first numbers: those of a given scene are not wanted, and would make it slower.
template <std::size_t columns>
RawModel rolled(const ObservedRun& run, Roll roll, double x0) {
  using Q = Parameters;
  const double last = run.t.back();
  const std::array corners{roll.stop_until(last), roll.radius_time(last)};
  const auto direct = [x0, way = run.way, position = run.column == Quantity::x,
                       roll = std::move(roll)](double t) mutable {
    const Roll::Point p = roll.at(t);
    const Roll::Derivatives& by_c = position ? p.x_c : p.v_c;
    const std::size_t slope = roll.law().size();  // then wind and steepness; way^2 is 1
    std::array<double, 1 + columns> values{position ? x0 + way * p.x : way * p.v,
                                           way * (position ? p.x_v0 : p.v_v0),
                                           position ? p.x_x0 : p.v_x0};
    double* const by = &values[1];
    for (std::size_t j = 0; j < slope; ++j) by[Q::first_of_law + j] = way * by_c[j];
    if constexpr (columns > Q::first_of_scene) {
      by[Q::first_of_scene] = by_c[slope];
      by[Q::first_of_scene + 1] = way * by_c[slope + 2];
      by[Q::first_of_scene + place_of_wind] = by_c[slope + 1];
    }
    return values;
  };
  const auto written = [](auto at) {
    return [at = std::move(at)](double t, Q::Numbers& by) mutable {
      const auto values = at(t);
      std::copy(values.begin() + 1, values.end(), by.begin());
      return values[0];
    };
  };
  if (run.body.road) return written(direct);  // it is not smooth from point to point
  return written(ChebyshevPanels(run.t, corners, direct));
}

}  // namespace

RawModel Model::raw(const std::vector<double>& theta, std::size_t r) const {
  const ObservedRun& run = runs()[r];
  if (is_roll()) {
    using Q = Parameters;
    const auto of = parameters_.scene() > 0 ? rolled<Q::most> : rolled<Q::first_of_scene>;
    return of(run, roll(theta, r), parameters_.x0(theta, r));
  }
  return
      [law = parameters_.law(theta), logarithm = run.logarithm](double v, Parameters::Numbers& by) {
    double* const by_c = &by[Parameters::first_of_law];
    const double D = law.at(v, by_c).D;
    for (std::size_t j = 0; j < law.size() && logarithm; ++j) by_c[j] /= D;
    return logarithm ? std::log(D) : D;
      };
}

std::vector<double> Model::raw_column(const std::vector<double>& theta, std::size_t r) const {
  const RawModel at = raw(theta, r);
  std::vector<double> column;
  Parameters::Numbers unused{};
  column.reserve(runs()[r].t.size());
  for (double t : runs()[r].t) column.push_back(at(t, unused));
  return column;
}

std::vector<std::size_t> Model::rows() const {
  std::vector<std::size_t> rows;
  for (const ObservedRun& run : runs()) rows.push_back(run.y.size());
  return rows;
}

Model Model::weighted(AddedNoise added) const {
  Model other = *this;
  std::vector<Filters> all;
  for (const ObservedRun& run : runs())
    if (run.H) all.push_back(run.H);
  other.noise_ = std::make_shared<const Noise>(std::move(all), added);
  return other;
}

std::size_t Model::informative_rows() const {
  if (noise_->from_sources_alone()) return noise_->informative();
  std::size_t n = 0;
  for (const ObservedRun& run : runs()) n += run.y.size();
  return n - means_taken();
}

std::size_t Model::means_taken() const {
  if (parameters_.of_positions()) return 0;
  return static_cast<std::size_t>(std::ranges::count(runs(), Quantity::x, &ObservedRun::column));
}

System system_of(const Model& model) {
  const Parameters& q = model.parameters();
  return {model.rows(), q.own(), q.shared(),
          [model, columns = q.columns()](const std::vector<double>& theta, const TakeRows& take) {
    const double c0 = model.parameters().law(theta).c(0);
    Parameters::Numbers by{};
    for (std::size_t r = 0; r < model.runs().size(); ++r) {
      const ObservedRun& run = model.runs()[r];
      const RawModel raw = model.raw(theta, r);
      const std::size_t n = run.t.size();
      const std::size_t rows = run.y.size();
      std::vector<double> all(n * (1 + columns));  // the residuals, then the columns of J
      for (std::size_t i = 0; i < n; ++i) {
        all[i] = raw(run.t[i], by);
        if (columns > 0) model.parameters().chain(&all[n + i], n, c0, by);
      }
      if (run.H) all = run.H->times(all);
      for (std::size_t i = 0; i < rows; ++i) all[i] -= run.y[i];
      if (model.noise().known()) model.noise().whitener(r).apply(all);
      take(r, std::span(all).first(rows), std::span(all).subspan(rows));
    }
          }};
}

}  // namespace rolling
