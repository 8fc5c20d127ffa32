#include "fit/shift_records.h"

#include <cmath>
#include <utility>

#include "base/error.h"

namespace rolling {

namespace {

/// The sign of the velocities of a run.
double way_of(const FitRun& run) {
  double sum = 0;
  for (double v : run.v)
    if (std::isfinite(v)) sum += v;
  return sum < 0 ? -1 : 1;
}

/// True if a record can be fitted; v and D are positive along the motion.
bool is_used(double v, double D, const FitOptions& options, bool logarithms) {
  return v > 0 && v >= options.min_speed && std::isfinite(v) && std::isfinite(D) &&
         (D > 0 || !logarithms);
}

}  // namespace

Rows shift_rows(const FitRun& run, const FitOptions& options, bool logarithms) {
  const double way = way_of(run);
  Rows rows;
  for (std::size_t i = 0; i < run.v.size(); ++i)
    if (is_used(way * run.v[i], way * run.D[i], options, logarithms)) rows.push_back(i);
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
    for (std::size_t i = 0; i < run.v.size(); ++i) {
      const double v = way * run.v[i], D = way * run.D[i];
      if (!is_used(v, D, options, logarithms)) {
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
