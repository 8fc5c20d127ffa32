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

/// Passes the residuals fill(record, J, row, rows of the block) to the callback, in blocks of at
/// most 256 records, which fit into the cache.
template <typename Fill>
void hand_over(const std::vector<std::size_t>& runs, std::size_t columns, const TakeRows& take,
               Fill&& fill) {
  std::vector<double> f, J;
  std::size_t first = 0;
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (const std::size_t end = first + runs[r]; first < end; first += f.size()) {
      f.resize(std::min<std::size_t>(end - first, 256));
      J.resize(f.size() * columns);
      for (std::size_t k = 0; k < f.size(); ++k) f[k] = fill(first + k, std::span(J), k, f.size());
      take(r, f, J);
    }
}

}  // namespace rolling
