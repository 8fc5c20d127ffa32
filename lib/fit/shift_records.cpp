#include "fit/shift_records.h"

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/median.h"
#include "base/rounding.h"

namespace rolling {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The sign of the velocities of a run.
double way_of(const FitRun& run) {
  double sum = 0;
  for (double v : run.v)
    if (std::isfinite(v)) sum += v;
  return sum < 0 ? -1 : 1;
}

/// Which records of a run are fitted. v and D along the motion must exceed what is left where the
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
  const double way = way_of(run);
  const Used used(run, options, logarithms, stop);
  Rows rows;
  for (std::size_t i = 0; i < run.v.size(); ++i)
    if (used.allows(i, way * run.v[i], way * run.D[i])) rows.push_back(i);
  return rows;
}

bool has_logarithm(const FitRun& run, const FitOptions& options) {
  const double way = way_of(run);
  const Used used(run, options, true, never);
  for (std::size_t i = 0; i < run.v.size(); ++i)
    if (used.allows(i, way * run.v[i], way * run.D[i])) return true;
  return false;
}

ShiftRecords shift_records(const std::vector<FitRun>& all, const FitOptions& options,
                           bool logarithms, const std::vector<double>& stops) {
  ShiftRecords records;
  auto &y = records.y, &log_u = records.log_u;
  std::size_t most = 0;
  for (const auto& run : all) most += run.v.size();
  y.reserve(most), log_u.reserve(most);
  double sum = 0;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const FitRun& run = all[r];
    const std::size_t before = y.size();
    const double way = way_of(run);
    const double stop = stops.empty() ? never : stops[r];
    const Used used(run, options, logarithms, stop), of_any_sign(run, options, false, stop);
    for (std::size_t i = 0; i < run.v.size(); ++i) {
      const double v = way * run.v[i], D = way * run.D[i];
      if (!used.allows(i, v, D)) {
        records.left_out += std::isfinite(v) && std::isfinite(D);
        records.negative += of_any_sign.allows(i, v, D);
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
    fail("no row has v > 0 and D > 0: there is no logarithm to fit");
  require_records(n, !options.a + !options.b, n);
  if (!options.b &&
      std::all_of(log_u.begin(), log_u.end(), [&](double x) { return x == log_u[0]; }))
    fail("all speeds are equal: b cannot be determined");
  const double mean = sum / static_cast<double>(n);
  for (double& x : log_u) x -= mean;
  records.log_v_ref = mean;
  return records;
}

}  // namespace rolling
