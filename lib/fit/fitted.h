// SPDX-License-Identifier: GPL-3.0-or-later
// The result of a route before its errors are computed: the minimum, and the reported numbers with
// their gradients with respect to the parameters.
#pragma once

#include <cmath>

#include "fit/model.h"
#include "least_squares/minimise.h"
#include "statistics/residuals.h"

namespace rolling {

/// A reported number and its gradient with respect to the parameters of its run, then the shared
/// ones (zero for a number that is fixed).
struct FittedNumber {
  double value;
  std::vector<double> gradient;
  std::size_t run = 0;
};

/// The noise of independent sources, as the residuals of a fit show it: theta - truth is
/// -R^-1 sum B(s) e(s) over the sources s. For known filters they are the rows of the raw column.
/// White noise beside it makes the weighted residuals those of independent noise, as if nothing had
/// been filtered: then, and without filters, the residuals are the sources, and B is Q.
struct SeenNoise {
  std::size_t freedom;                    ///< degrees of freedom of the variance
  double variance = 0;                    ///< of the sources
  std::vector<double> e = {};             ///< the estimated noise of each source
  std::vector<std::size_t> sources = {};  ///< their number in each run
  Matrix B = {};                          ///< one row for each source
  /// The weighted residuals that are not determined by those before them (see
  /// Noise::innovations()), which are white if the noise is; and their number in each run.
  std::vector<double> innovations = {};
  std::vector<std::size_t> runs = {};
  LagSums taken = {};             ///< of them, by the fit
  std::vector<double> left = {};  ///< the share of the variance of each that the fit has left;
                                  ///< empty behind filters
};

/// A minimum with what its errors need. fit(), compare_laws() and the other questions about a fit
/// start from it.
struct Fitted {
  Minimum minimum;
  std::optional<SeenNoise> noise_of_roll = {};  ///< that made the rows of a log-log line
  std::size_t negative = 0;                     ///< see FitResult
  std::vector<FittedNumber> coefficients = {};  ///< of the law, as its formula names them
  std::vector<double> bias = {};  ///< the expected bias of each; empty where it is not known
  double error_of_clock = 0;  ///< of the v0 of the first run, if its rows do not tell their times
  std::vector<FittedNumber> scene = {};  ///< the numbers of it that are parameters
  std::vector<FittedNumber> v0 = {};     ///< one for each run, if the model is a roll
  std::vector<FittedNumber> x0 = {};     ///< likewise, if they are parameters
  Model model = {};

  bool is_roll() const { return model.is_roll(); }
  /// The weighted problem of which this is the minimum.
  System system() const { return system_of(model); }
  const Noise& noise() const { return model.noise(); }
  const Parameters& parameters() const { return model.parameters(); }
  Roll roll(std::size_t run) const { return model.roll(minimum.theta, run); }
  Law law() const;
  /// The numbers that have errors: the coefficients, those of the scene, and v0 and x0
  /// of the first run, if the model has them. A row reports these of a single run alone. If speeds
  /// tell x0, it is that of all runs.
  std::vector<FittedNumber> numbers() const;
  /// The highest speed that was fitted.
  double fastest() const;
  /// The number of degrees of freedom that are left for the size of the noise; with none left there
  /// are no errors. Filters at the ends of a short run may leave fewer than its rows less the mean.
  std::size_t degrees_left() const;
};

/// False if a search found no minimum.
inline bool was_found(const Fitted& fit) { return std::isfinite(fit.minimum.rss); }

/// Reads the numbers off the minimum: writes the coefficients of the law with their gradients into
/// the fit, and of a roll those of the scene, v0 and x0.
void read_off(Fitted&);

/// Throws Error if n rows, so many of which filters leave independent, are too few for p
/// parameters, or if p = 0.
void require_rows(std::size_t n, std::size_t p, std::size_t independent);

}  // namespace rolling
