#include "fit/shift_records.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "base/error.h"

namespace rolling {

ShiftRecords shift_records(const std::vector<FitRun>& all, const FitOptions& options,
                           bool logarithms) {
  ShiftRecords records;
  std::size_t most = 0;
  for (const auto& run : all) most += run.v.size();
  records.D.reserve(most), records.log_u.reserve(most);
  for (const auto& run : all) {
    double sum = 0;
    for (double v : run.v)
      if (std::isfinite(v)) sum += v;
    const double way = sum < 0 ? -1 : 1;
    Rows rows;
    rows.reserve(run.v.size());
    for (std::size_t i = 0; i < run.v.size(); ++i) {
      const double v = way * run.v[i], D = way * run.D[i];
      if (!(std::isfinite(v) && std::isfinite(D) && v > 0 && v >= options.min_speed) ||
          (logarithms && D <= 0)) {
        ++records.left_out;
        continue;
      }
      records.log_u.push_back(std::log(v));
      records.D.push_back(D);
      rows.push_back(i);
    }
    records.runs.push_back(rows.size());
    records.rows.push_back(std::move(rows));
  }
  const std::size_t n = records.D.size();
  if (n == 0 && logarithms && records.left_out > 0)
    fail("no record has v > 0 and D > 0: there is no logarithm to fit");
  require_records(n, !options.a + !options.b);
  auto& log_u = records.log_u;
  if (!options.b &&
      std::all_of(log_u.begin(), log_u.end(), [&](double x) { return x == log_u[0]; }))
    fail("all speeds are equal: b cannot be determined");
  records.log_v_ref = std::accumulate(log_u.begin(), log_u.end(), 0.0) / static_cast<double>(n);
  for (double& x : log_u) x -= records.log_v_ref;
  return records;
}

}  // namespace rolling
