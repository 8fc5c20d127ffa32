// What the four routes hand to fit(): a minimum, and how the quantities that are reported hang on
// its parameters.
#pragma once

#include "fit/covariance.h"
#include "fit/fit.h"
#include "fit/least_squares.h"

#include <algorithm>

namespace rolling {

/// A reported number and its derivatives by the parameters of its run and the shared ones (all zero
/// for one that was held fixed).
struct Quantity {
  double value;
  std::vector<double> gradient;
};

/// One run, as the trajectory sees it. `way` is +1 or -1: a body that rolls towards the sensor has
/// falling x and v < 0.
struct FittedRun {
  Body body;
  double way, origin, start;  ///< v0 and x0 are fitted at the time origin, and told at start
  std::vector<double> t, y;   ///< the fitted records, t from the origin
  std::vector<double>
      raw_t;  ///< where the model is needed if filters are known: all records of the raw column
  BandMatrix filters;  ///< fitted column = filters * raw column; no rows if nothing is known
  bool raw_is_position = false;  ///< what the raw column is (without filters, the route's own)
  double v0, x0;                 ///< coarse; v0 along the way
};

struct RouteFit {
  Minimum minimum;
  std::vector<std::size_t> runs;  ///< fitted records of each run
  std::vector<double> plain =
      {};  ///< residuals in the unit of the fitted column, where the minimum's f are whitened
  std::vector<double> Q =
      {};  ///< J R^-1 of the minimum, where the errors need it; the last of its columns are shared
  std::size_t shared = 0;
  KnownNoise noise;      ///< from the filters; empty if they are not known
  double whiteness = 0;  ///< as in FitResult
  bool judged = false;   ///< the filters are not known, but found by the residuals: noise.weight()
                         ///< leaves nothing but white noise
  std::size_t left_out = 0;
  Quantity a, b;
  std::vector<Quantity> v0, x0;
  std::vector<double> log_u = {};  ///< of the fitted records (loglog and shift), ln v - log_v_ref
  double log_v_ref = 0;
  std::vector<FittedRun> rolls = {};  ///< the fitted runs (trajectory routes)
};

/// What the errors need of the system at its minimum: whiteness, Q. True if the (weighted)
/// residuals are taken as independent: white in the test of Ljung and Box at 1 %, or fewer than 30.
bool assess(const System&, RouteFit&);

RouteFit fit_route(Route, const std::vector<FitRun>&, const FitOptions&);
RouteFit fit_log_log(const std::vector<FitRun>&, const FitOptions&);
RouteFit fit_shift(const std::vector<FitRun>&, const FitOptions&);
RouteFit fit_trajectory(Route, const std::vector<FitRun>&, const FitOptions&);

/// The records of one run that a route can use.
using Rows = std::vector<std::size_t>;

/// Throws Error when n records are too few for p parameters.
void require_records(std::size_t n, std::size_t p);

/// Hands over what fill(run, first, f, J) makes of the records `first` and on, numbered through all
/// runs, weighted where the noise is known: whole runs, as it needs, or else few records at a time,
/// which stay in the cache.
template <typename Fill>
void hand_over_rows(const std::vector<std::size_t>& runs, std::size_t columns, bool whole,
                    const KnownNoise& noise, const TakeRows& take, Fill&& fill) {
  std::vector<double> f, J;
  std::size_t first = 0;
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (const std::size_t end = first + runs[r]; first < end; first += f.size()) {
      const std::size_t m = whole ? runs[r] : std::min<std::size_t>(end - first, 256);
      f.resize(m);
      J.resize(m * columns);
      fill(r, first, f, J);
      if (!noise.empty()) noise.weight(r, f, J);
      take(r, f, J);
    }
}

/// The minimum by the loss that the options name; Error for a robust one of filtered columns.
Minimum solve(const System&, const std::vector<double>& start, const FitOptions&,
              bool filters_known);

/// v and D of the records that loglog and shift use, all runs one after another, and how their
/// noise arises.
struct ShiftRecords {
  std::vector<double> D, log_u;  ///< log_u = ln v - log_v_ref
  std::vector<std::size_t> runs;
  std::size_t left_out = 0;
  double log_v_ref =
      0;  ///< ln of the geometric mean of v: seen from there, ln a and b are all but uncorrelated

  ShiftRecords(const std::vector<FitRun>&, const FitOptions&, bool positive_D);
  bool filters_known() const { return !response_.empty(); }
  /// The roll under (a, b) that is closest to the data, filtered like the data: a wide mean of v^b
  /// is not the power of the mean. For each record its v and D, and a v^b, with the derivatives by
  /// a and b; where there is no such roll, the record's v and a v^b for D, without derivatives.
  struct Smoothed {
    std::vector<double> v, D, law, D_a, D_b, law_a, law_b;
  };
  Smoothed smoothed(double a, double b) const;
  /// Of the residuals (D - a v^b) scale: both columns carry noise, that of v with the slope of the
  /// law at the smoothed speeds. `own` as in KnownNoise.
  KnownNoise noise(double b, const Smoothed&, const std::vector<double>& scale,
                   std::vector<double> own = {}) const;
  void leave_out(const std::vector<bool>& lost);  ///< a flag for each record
  /// The result at a minimum of a system that weights its residuals with this noise. Its first
  /// parameter is one of height, with the derivative a_slope of a by it, its last is b, as far as
  /// they are free.
  RouteFit hand_over(const System&, Minimum, KnownNoise& noise, double a, double a_slope,
                     double b) &&;

 private:
  void refer();  ///< makes log_u of ln v, and log_v_ref
  const std::vector<FitRun>& all_;
  const FitOptions& options_;
  std::vector<NoiseResponse> response_;  // none if the filters are not known, nor
  std::vector<Rows> rows_;
  std::vector<double> v_;
};

}  // namespace rolling
