#include "fit/model_shift.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "fit/shift_records.h"

namespace rolling {
namespace {

System power_system(ShiftRecords records, const Height& height, double unit) {
  return system_of(std::move(records), height, [height, unit](const std::vector<double>& theta) {
    const double b = height.exponent(theta),
                 h = height.a ? *height.a * std::exp(b * height.log_v_ref) : theta[0] * unit;
    return [=](double log_u) -> Curve {
      const double power = std::exp(b * log_u);
      return {h * power, unit * power, h * power * log_u, h * power};
    };
  });
}

/// Every k-th record, with k the smallest that leaves at most `most` records.
ShiftRecords thinned(const ShiftRecords& records, std::size_t most) {
  ShiftRecords few;
  few.log_v_ref = records.log_v_ref;
  const std::size_t n = records.y.size();
  for (std::size_t i = 0, step = (n + most - 1) / most; i < n; i += step) {
    few.y.push_back(records.y[i]);
    few.log_u.push_back(records.log_u[i]);
  }
  few.runs = {few.y.size()};
  return few;
}

/// A starting point: the exponent of a coarse grid with the smallest sum of squares (the height
/// follows by linear least squares), or the values that the user gives. From one exponent of the
/// grid to the next no D changes by more than a factor e^(1/2) relative to D at the mean of ln v.
std::vector<double> power_start(const ShiftRecords& few, const FitOptions& options, double unit) {
  const auto a_given = options.given_a(), b_given = options.given_b();
  std::vector<double> exponents;
  if (b_given) exponents = {*b_given};
  else {
    double widest = 2;
    for (const double log_u : few.log_u) widest = std::max(widest, std::abs(log_u));
    for (double b = -4; b <= 8; b += 0.5 / widest) exponents.push_back(b);
  }
  double least = std::numeric_limits<double>::infinity(), best_b = exponents.front(), best_h = 0;
  for (double b : exponents) {
    double mm = 0, mD = 0, rss = 0;
    for (std::size_t i = 0; i < few.y.size(); ++i) {
      const double m = std::exp(b * few.log_u[i]);
      mm += m * m;
      mD += m * few.y[i];
    }
    const double h = a_given ? *a_given * std::exp(b * few.log_v_ref) : mD / mm;
    for (std::size_t i = 0; i < few.y.size(); ++i) {
      const double f = h * std::exp(b * few.log_u[i]) - few.y[i];
      rss += f * f;
    }
    if (rss < least || exponents.size() == 1) least = rss, best_b = b, best_h = h;
  }
  std::vector<double> theta;
  if (!options.a) theta.push_back(best_h / unit);
  if (!options.b) theta.push_back(best_b);
  return theta;
}

}  // namespace

Fitted fit_shift(const std::vector<FitRun>& all, const FitOptions& options) {
  const ShiftRecords records = shift_records(all, options, false);
  const Height height{options.a, options.b, records.log_v_ref};
  double unit = 0;
  for (double D : records.y) unit = std::max(unit, std::abs(D));
  if (unit == 0) fail("all shifts are 0: b cannot be determined");
  // For many records, a few thousand of them give a starting point close to the minimum.
  constexpr std::size_t most = 4096;
  const std::size_t n = records.y.size();
  const ShiftRecords few = thinned(records, options.robust ? n : most);
  std::vector<double> theta = power_start(few, options, unit);
  if (few.y.size() < n) theta = attempt(power_system(few, height, unit), theta).theta;

  const System system = power_system(records, height, unit);
  Minimum minimum = solve(system, {theta}, options);
  const double b = height.exponent(minimum.theta), scale = std::exp(-b * records.log_v_ref),
               a = minimum.theta.front() * unit * scale;  // if it is not held
  Fitted result{.system = system, .minimum = std::move(minimum)};
  result.records = n;
  result.left_out = records.left_out;
  height.report(result, a, unit * scale);
  for (double x : records.log_u) result.v.push_back(std::exp(x + records.log_v_ref));
  return result;
}

}  // namespace rolling
