// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/shift_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/median.h"
#include "base/rounding.h"

namespace rolling {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The sign of the velocities of a run up to a stop or a turning point.
double way_of(const FitRun& run, double stop) {
  double sum = 0;
  for (std::size_t i = 0; i < run.v.size(); ++i)
    if (std::isfinite(run.v[i]) && (stop == never || run.t[i] < stop)) sum += run.v[i];
  return sum < 0 ? -1 : 1;
}

/// Which rows of a run are fitted. v and D along the motion must exceed what is left where the
/// terms of a sum cancel: rounding, whose logarithm is far from those of the others.
class Used {
 public:
  Used(const FitRun& run, const FitOptions& options, bool logarithms, double stop)
      : t_(run.t), v_(rounding_of(run.v)),
        D_(logarithms ? rounding_of(run.D) : -std::numeric_limits<double>::infinity()),
        min_speed_(options.min_speed), stop_(stop) {}
  bool allows(std::size_t i, double v, double D) const {
    return v > v_ && v >= min_speed_ && std::isfinite(v) && std::isfinite(D) && D > D_ &&
           (stop_ == never || t_[i] < stop_);
  }

 private:
  /// A share of the median, which no single reading can shift, of about a thousand readings.
  static double rounding_of(const std::vector<double>& column) {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < column.size(); i += 1 + column.size() / 1000)
      if (std::isfinite(column[i])) sizes.push_back(std::abs(column[i]));
    return sizes.empty() ? 0 : program_rounding * median(sizes);
  }

  const std::vector<double>& t_;
  double v_, D_, min_speed_, stop_;
};

}  // namespace

Rows shift_rows(const FitRun& run, const FitOptions& options, bool logarithms, double stop) {
  const double way = way_of(run, stop);
  const Used used(run, options, logarithms, stop);
  Rows rows;
  for (std::size_t i = 0; i < run.v.size(); ++i)
    if (used.allows(i, way * run.v[i], way * run.D[i])) rows.push_back(i);
  return rows;
}

bool has_logarithm(const FitRun& run, const FitOptions& options) {
  const double way = way_of(run, never);
  const Used used(run, options, true, never);
  for (std::size_t i = 0; i < run.v.size(); ++i)
    if (used.allows(i, way * run.v[i], way * run.D[i])) return true;
  return false;
}

ShiftRows shift_rows(const std::vector<FitRun>& all, const FitOptions& options, bool logarithms,
                     const std::vector<double>& stops) {
  ShiftRows rows;
  rows.logarithms = logarithms;
  auto &y = rows.y, &speeds = rows.v;
  std::size_t most = 0;
  for (const auto& run : all) most += run.v.size();
  y.reserve(most), speeds.reserve(most);
  double sum = 0;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const FitRun& run = all[r];
    const std::size_t before = y.size();
    const double stop = stops.empty() ? never : stops[r], way = way_of(run, stop);
    const Used used(run, options, logarithms, stop), of_any_sign(run, options, false, stop);
    for (std::size_t i = 0; i < run.v.size(); ++i) {
      const double v = way * run.v[i], D = way * run.D[i];
      if (!used.allows(i, v, D)) {
        rows.left_out += std::isfinite(v) && std::isfinite(D);
        rows.negative += of_any_sign.allows(i, v, D);
        continue;
      }
      speeds.push_back(v);
      sum += std::log(v);
      y.push_back(logarithms ? std::log(D) : D);
    }
    rows.runs.push_back(y.size() - before);
  }
  const std::size_t n = y.size();
  if (n == 0 && logarithms && rows.left_out > 0)
    fail("no row has v > 0 and D > 0: there is no logarithm to fit");
  require_rows(n, !options.a + !options.b, n);
  if (!options.b && std::ranges::all_of(speeds, [&](double v) { return v == speeds[0]; }))
    fail("all speeds are equal: b cannot be determined");
  rows.v_ref = std::exp(sum / static_cast<double>(n));
  return rows;
}

System system_of(std::shared_ptr<const ShiftRows> rows, const Parameters& q) {
  const std::size_t p = q.columns();
  const std::vector<std::size_t>& runs = rows->runs;
  return {runs, 0, p,
          [rows = std::move(rows), q, p](const std::vector<double>& theta, const TakeRows& take) {
    const Law law = q.law(theta);
    std::vector<double> f, J;
    std::size_t i = 0;
    for (std::size_t r = 0; r < rows->runs.size(); ++r)
      for (const std::size_t end = i + rows->runs[r]; i < end; take(r, f, J)) {
        f.resize(std::min<std::size_t>(end - i, 256));
        J.resize(f.size() * p);
        for (std::size_t k = 0; k < f.size(); ++k, ++i) {
          std::array<double, LawForm::most> by_c{};
          const double D = law.at(rows->v[i], by_c.data()).D;
          f[k] = (rows->logarithms ? std::log(D) : D) - rows->y[i];
          if (rows->logarithms)
            for (double& by : by_c) by /= D;
          q.chain(&J[k], f.size(), law.c(0), {by_c});
        }
      }
          }};
}

}  // namespace rolling
