#include "fit/shift_records.h"

#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/median.h"
#include "base/rounding.h"

namespace rolling {

namespace {

/// The sign of the velocities of a run.
double way_of(const FitRun& run) {
  double sum = 0;
  for (double v : run.v)
    if (std::isfinite(v)) sum += v;
  return sum < 0 ? -1 : 1;
}

/// What v and D along the motion must exceed in a record that is fitted. Where the terms of a sum
/// cancel, what is left is its rounding, whose logarithm is far from those of the others.
struct Least {
  double v, D;

  Least(const FitRun& run, bool logarithms)
      : v(rounding_of(run.v)),
        D(logarithms ? rounding_of(run.D) : -std::numeric_limits<double>::infinity()) {}
  bool allows(double of_v, double of_D, double min_speed) const {
    return of_v > v && of_v >= min_speed && std::isfinite(of_v) && std::isfinite(of_D) && of_D > D;
  }

 private:
  /// A share of the median, which no single reading can shift, of about a thousand readings.
  static double rounding_of(const std::vector<double>& column) {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < column.size(); i += 1 + column.size() / 1000)
      if (std::isfinite(column[i])) sizes.push_back(std::abs(column[i]));
    return sizes.empty() ? 0 : program_rounding * median(sizes);
  }
};

}  // namespace

Rows shift_rows(const FitRun& run, const FitOptions& options, bool logarithms) {
  const double way = way_of(run);
  const Least least(run, logarithms);
  Rows rows;
  for (std::size_t i = 0; i < run.v.size(); ++i)
    if (least.allows(way * run.v[i], way * run.D[i], options.min_speed)) rows.push_back(i);
  return rows;
}

ShiftRecords shift_records(const std::vector<FitRun>& all, const FitOptions& options,
                           bool logarithms) {
  ShiftRecords records;
  auto &y = records.y, &log_u = records.log_u;
  std::size_t most = 0;
  for (const auto& run : all) most += run.v.size();
  y.reserve(most), log_u.reserve(most);
  double sum = 0;
  for (const auto& run : all) {
    const std::size_t before = y.size();
    const double way = way_of(run);
    const Least least(run, logarithms);
    for (std::size_t i = 0; i < run.v.size(); ++i) {
      const double v = way * run.v[i], D = way * run.D[i];
      if (!least.allows(v, D, options.min_speed)) {
        records.left_out += std::isfinite(v) && std::isfinite(D);
        continue;
      }
      log_u.push_back(std::log(v));
      sum += log_u.back();
      y.push_back(logarithms ? std::log(D) : D);
    }
    records.runs.push_back(y.size() - before);
  }
  const std::size_t n = y.size();
  if (n == 0 && logarithms && records.left_out > 0)
    fail("no record has v > 0 and D > 0: there is no logarithm to fit");
  require_records(n, !options.a + !options.b);
  if (!options.b &&
      std::all_of(log_u.begin(), log_u.end(), [&](double x) { return x == log_u[0]; }))
    fail("all speeds are equal: b cannot be determined");
  records.log_v_ref = sum / static_cast<double>(n);
  for (double& x : log_u) x -= records.log_v_ref;
  return records;
}

}  // namespace rolling
