#include "fit/model_roll.h"

#include "base/error.h"
#include "contact/contact.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rolling {
namespace {

const char* column_of(Route route) {
  return route == Route::position ? "x" : route == Route::velocity ? "v" : "D";
}

/// The rows of H for the fitted records, and for shifts one for the mean of their speeds: D alone
/// hardly depends on v0.
Noise::Matrix filters_of_rows(const Response& response, Route route, const Rows& rows) {
  const Noise::Matrix& all = response.of.at(column_of(route));
  const BandMatrix& of = *all;
  if (route != Route::shift && rows.size() == of.rows()) return all;
  std::size_t numbers = route == Route::shift ? response.t.size() : 0;
  for (std::size_t i : rows) numbers += of.row(i).size();
  BandMatrix H;
  H.reserve(rows.size() + 1, numbers);
  for (std::size_t i : rows) H.append(of.first(i), of.row(i));
  if (route == Route::shift) {
    std::vector<double> mean(response.t.size());
    const BandMatrix& of_v = *response.of.at("v");
    for (std::size_t i : rows)
      for (std::size_t k = 0; k < of_v.row(i).size(); ++k)
        mean[of_v.first(i) + k] += of_v.row(i)[k] / static_cast<double>(rows.size());
    H.append(0, mean);
  }
  return std::make_shared<const BandMatrix>(std::move(H));
}

/// +1 or -1: which way the body rolls; by all records, of which some may be false echoes.
double way_of(Route route, const FitRun& run, const Rows& rows, const FitOptions& options) {
  if (options.v0) return *options.v0 < 0 ? -1 : 1;
  double sum = 0, before = 0;  // of v; or of x in the later half less those in the earlier one
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (route != Route::position) sum += run.v[rows[k]];
    else if (options.x0) sum += run.x[rows[k]] - *options.x0;
    else if (2 * k + 1 < rows.size()) before += run.x[rows[k]];
    else if (2 * k + 1 > rows.size()) sum += run.x[rows[k]];
  return sum < before ? -1 : 1;
}

}  // namespace

double acceleration_of(const ShiftOf& by, double D) {
  const Body& body = by.body;
  if (by.geometry == Geometry::exact) return acceleration_from_shift(body, by.geometry, D);
  const auto [cos, sin] = incline(body);
  return -body.g * (D * cos + body.R * sin) / ((body.K + 1) * body.R);
}

Making making_of(Route route, const std::vector<FitRun>& all) {
  Making making;
  for (const FitRun& run : all) {
    if (run.filters.empty()) return {};
    try {
      making.responses.push_back(response_of(run.filters, run.t));
    } catch (const Error&) {  // a chain that does not go with the run
      return {};
    }
    const Response& r = making.responses.back();
    const bool roll = r.source == "x" || (r.source == "v" && route != Route::position);
    if (!roll || !r.of.contains(column_of(route)) ||
        (route == Route::shift && !(run.shift_of && r.of.contains("v"))))
      return {};
  }
  return making;
}

std::vector<ObservedRun> observe(Route route, const std::vector<FitRun>& all,
                                 const std::vector<Rows>& rows, const Making& making,
                                 const FitOptions& options) {
  std::vector<ObservedRun> runs;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const FitRun& run = all[r];
    if (rows[r].empty()) fail("run {} has no record that can be fitted", r + 1);
    const double first_fitted = run.t[rows[r].front()];
    const bool held = options.v0 || options.x0;
    ObservedRun seen;
    seen.body = run.body;
    seen.geometry = options.geometry;
    seen.way = way_of(route, run, rows[r], options);
    seen.origin = making.known() ? making.responses[r].t.front() : first_fitted;
    seen.start = held ? 0 : first_fitted - seen.origin;
    if (held && seen.origin < run.t[0])
      fail(
          "v0 and x0 cannot be held: filters have reached back to what was cut away before run {} "
          "begins",
          r + 1);
    const auto& column = route == Route::position   ? run.x
                         : route == Route::velocity ? run.v
                                                    : run.D;
    seen.y.reserve(rows[r].size() + 1);
    for (std::size_t i : rows[r]) seen.y.push_back(column[i]);
    if (route == Route::shift) {
      const ShiftOf& by = *run.shift_of;
      seen.body = by.body;
      seen.geometry = by.geometry;
      seen.unit = (by.body.K + 1) * by.body.R / by.body.g;
      double mean = 0;
      for (std::size_t i : rows[r]) mean += run.v[i] / static_cast<double>(rows[r].size());
      for (double& y : seen.y) y = acceleration_of(by, y);
      seen.y.push_back(mean);
      seen.with_mean_speed = true;
    }
    // With A = 1 on a level mat only g/((K + 1) R) matters (Eq. 12), and D may be larger than R:
    // the radius is taken so large that it never is.
    if (seen.geometry == Geometry::approximate && seen.body.slope == 0 && !options.fit_slope) {
      seen.body.R *= 1e6;
      seen.body.g *= 1e6;
    }
    seen.raw_is_position =
        making.known() ? making.responses[r].source == "x" : route == Route::position;
    if (making.known()) {
      seen.t = making.responses[r].t;
      seen.H = filters_of_rows(making.responses[r], route, rows[r]);
    } else {
      seen.t.reserve(rows[r].size());
      for (std::size_t i : rows[r]) seen.t.push_back(run.t[i]);
    }
    for (double& t : seen.t) t -= seen.origin;
    runs.push_back(std::move(seen));
  }
  return runs;
}

std::shared_ptr<const Noise> noise_of(const std::vector<ObservedRun>& runs, double share) {
  if (!runs.front().H) return std::make_shared<const Noise>();
  std::vector<Noise::Matrix> all;
  for (const ObservedRun& run : runs) all.push_back(run.H);
  return std::make_shared<const Noise>(std::move(all), share, runs.front().with_mean_speed);
}

Trajectory RollModel::trajectory(const std::vector<double>& theta, std::size_t run) const {
  Body body = runs_[run].body;
  body.slope = slope(theta, run);
  return {body, runs_[run].geometry, parameters_.law(theta), parameters_.v0(theta, run),
          parameters_.fits_slope() ? Trajectory::Derivatives::of_law_and_slope
                                   : Trajectory::Derivatives::of_law};
}

double RollModel::slope(const std::vector<double>& theta, std::size_t run) const {
  return runs_[run].way * parameters_.slope(theta, runs_[run].body.slope);
}

RawModel::RawModel(const ObservedRun& run, const Parameters& parameters,
                   const std::vector<double>& theta, std::size_t r, Trajectory roll)
    : run_(run), parameters_(parameters), a_(parameters.law(theta).a), x0_(parameters.x0(theta, r)),
      roll_(std::move(roll)) {}

double RawModel::operator()(double t, double* slopes, std::size_t stride) const {
  const double way = run_.way;
  if (run_.raw_is_position) {
    const auto s = roll_.at(t);
    parameters_.chain(slopes, stride, a_, {way * s.x_a, way * s.x_b, way * s.x_v0, 1, s.x_S});
    return x0_ + way * s.x;
  }
  const auto s = roll_.speed_at(t);
  parameters_.chain(slopes, stride, a_, {way * s.v_a, way * s.v_b, way * s.v_v0, 0, s.v_S});
  return way * s.v;
}

void RollModel::evaluate(const std::vector<double>& theta, const Noise& noise,
                         const TakeRows& take) const {
  const std::size_t q = parameters_.columns();
  std::vector<double> column, slopes;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const ObservedRun& run = runs_[r];
    const RawModel model = raw(theta, r);
    // Without filters few records at a time, which stay in the cache; else the whole run.
    const std::size_t n = run.t.size(), block = run.H ? n : 256;
    for (std::size_t first = 0; first < n; first += block) {
      const std::size_t m = std::min(block, n - first);
      column.resize(m);
      slopes.resize(m * q);
      for (std::size_t i = 0; i < m; ++i) column[i] = model(run.t[first + i], &slopes[i], m);
      if (!run.H) {
        for (std::size_t i = 0; i < m; ++i) column[i] -= run.y[first + i];
        take(r, column, slopes);
        continue;
      }
      hand_over_filtered(run, r, column, slopes, noise, take);
    }
  }
}

void hand_over_filtered(const ObservedRun& run, std::size_t r, std::span<const double> raw,
                        std::span<const double> slopes, const Noise& noise, const TakeRows& take) {
  const std::size_t rows = run.y.size(), m = raw.size(), q = slopes.size() / m;
  std::vector<double> f(rows), J(rows * q);
  for (std::size_t i = 0; i < rows; ++i) {
    f[i] = run.H->times(i, raw) - run.y[i];
    for (std::size_t j = 0; j < q; ++j) J[j * rows + i] = run.H->times(i, slopes.subspan(j * m, m));
  }
  if (noise.weighted()) noise.weight(r, f, J);
  take(r, f, J);
}

System system_of(std::shared_ptr<const RollModel> model, std::shared_ptr<const Noise> noise) {
  std::vector<std::size_t> runs;
  for (const ObservedRun& run : model->runs()) runs.push_back(run.y.size());
  const Parameters& q = model->parameters();
  return {std::move(runs), q.own(), q.shared(),
          [model, noise](const std::vector<double>& theta, const TakeRows& take) {
    model->evaluate(theta, *noise, take);
          }};
}

}  // namespace rolling
