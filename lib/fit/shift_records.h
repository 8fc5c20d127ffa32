// The records (v, D) of the routes loglog and shift, and the parameters that both routes fit.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "fit/fitted.h"

namespace rolling {

/// The records that the routes loglog and shift use, all runs in sequence. A body that rolls
/// towards falling x has v < 0 and D < 0; both are taken positive along its direction of motion.
struct ShiftRecords {
  std::vector<double> y;          ///< D, or ln D for the route loglog
  std::vector<double> log_u;      ///< ln v - log_v_ref
  std::vector<std::size_t> runs;  ///< number of records of each run
  std::size_t left_out = 0;       ///< number of records that are not missing and not used
  std::size_t negative = 0;       ///< number of those with D <= 0 alone, if logarithms are taken
  /// ln of the geometric mean of v, where the estimates of ln D and b are uncorrelated.
  double log_v_ref = 0;
};

/// The records with finite v > 0 of at least options.min_speed, and with D > 0 if `logarithms`;
/// what is no more than the rounding of a difference (base/rounding.h) counts as 0. `stops`, if not
/// empty, has the time of each run from which on no record is used. Throws Error if the records do
/// not determine the parameters.
ShiftRecords shift_records(const std::vector<FitRun>&, const FitOptions&, bool logarithms,
                           const std::vector<double>& stops = {});

/// The indices of the records of a run that are among these.
Rows shift_rows(const FitRun&, const FitOptions&, bool logarithms,
                double stop = std::numeric_limits<double>::infinity());

/// True if a record of the run has v > 0 and D > 0.
bool has_logarithm(const FitRun&, const FitOptions&);

/// The law in nearly uncorrelated parameters: the height and b. The height is D(v_ref) in some unit
/// for a power law and ln D(v_ref) for a line. Parameters that are held fixed have no element in
/// theta.
struct Height {
  std::optional<double> a, b;  // held
  double log_v_ref;

  std::size_t count() const { return !a + !b; }
  double exponent(const std::vector<double>& theta) const { return b ? *b : theta.back(); }
  /// Writes the derivatives of residual k of n: by the height, and by b at constant height. If a is
  /// held, the height depends on b; its part log_v_ref * by_log_height is added.
  void put(std::span<double> J, std::size_t k, std::size_t n, double by_height, double by_b,
           double by_log_height) const {
    if (!a) J[k] = by_height;
    if (!b) J[J.size() - n + k] = by_b + (a ? log_v_ref * by_log_height : 0);
  }
  /// Writes a and b at the minimum with their gradients; a_slope is the derivative of a with
  /// respect to the height.
  void report(Fitted& fit, double a_fitted, double a_slope) const {
    const double a_value = a.value_or(a_fitted);
    fit.a = {a_value, std::vector<double>(count(), 0)};
    fit.b = {exponent(fit.minimum.theta), std::vector<double>(count(), 0)};
    if (!a) fit.a.gradient[0] = a_slope;
    if (!a && !b) fit.a.gradient[1] = -a_value * log_v_ref;
    if (!b) fit.b.gradient.back() = 1;
  }
};

/// The fitted function at a record, and its derivatives: by the height, by b at constant height,
/// and by ln D(v_ref).
struct Curve {
  double value, by_height, by_b, by_log_height;
};

/// The least-squares problem of these records. curve_of(theta) is a function of log_u that returns
/// a Curve. The residuals are passed on in blocks of at most 256, which fit into the cache.
template <typename CurveOf>
System system_of(ShiftRecords all, Height height, CurveOf curve_of) {
  const std::size_t p = height.count();
  std::vector<std::size_t> runs = all.runs;
  return {std::move(runs), 0, p,
          [records = std::make_shared<const ShiftRecords>(std::move(all)), height, curve_of, p](
              const std::vector<double>& theta, const TakeRows& take) {
    const auto curve = curve_of(theta);
    std::vector<double> f, J;
    std::size_t i = 0;
    for (std::size_t r = 0; r < records->runs.size(); ++r)
      for (const std::size_t end = i + records->runs[r]; i < end; take(r, f, J)) {
        f.resize(std::min<std::size_t>(end - i, 256));
        J.resize(f.size() * p);
        for (std::size_t k = 0; k < f.size(); ++k, ++i) {
          const Curve at = curve(records->log_u[i]);
          f[k] = at.value - records->y[i];
          height.put(J, k, f.size(), at.by_height, at.by_b, at.by_log_height);
        }
      }
          }};
}

}  // namespace rolling
