// SPDX-License-Identifier: GPL-3.0-or-later
// The result of a route before its errors are computed: the minimum, and the reported numbers with
// their gradients with respect to the parameters.
#pragma once

#include "fit/model_roll.h"
#include "least_squares/minimise.h"
#include "statistics/residuals.h"

namespace rolling {

/// A reported number and its gradient with respect to the parameters of its run, then the shared
/// ones (zero for a number that is fixed).
struct FittedNumber {
  double value;
  std::vector<double> gradient;
};

/// The independent sources of the noise of a fit: theta - truth = -R^-1 sum B(s) e(s) over the
/// sources s.
struct Sources {
  std::vector<double> e;          ///< estimated noise of each source
  std::vector<std::size_t> runs;  ///< number of sources of each run
  Matrix B;                       ///< one row for each source, as many columns as R
  std::size_t means_taken = 0;    ///< see means_taken() of model_roll.h
};

/// The noise of the raw column, as estimated from the residuals of a fit with known filters.
struct RawNoise {
  double variance;
  std::size_t freedom;  ///< degrees of freedom of the variance
  /// The weighted residuals that are not determined by those before them (see
  /// Noise::innovations()); they are white if the noise of the raw column is white.
  std::vector<double> innovations;
  std::vector<std::size_t> innovation_runs;
  Taken taken;  ///< of the innovations, by the fit
  Sources sources = {};
};

struct ShiftRows;

/// A minimum with what its errors need. fit(), compare_laws() and the other questions about a fit
/// start from it.
struct Fitted {
  System system;  ///< weighted
  Minimum minimum;
  std::shared_ptr<const Noise> noise = std::make_shared<const Noise>();  ///< of the weights
  std::optional<RawNoise> raw_noise = {};  ///< if another fit has estimated it (loglog)
  std::size_t rows = 0, left_out = 0;
  std::size_t negative = 0;                     ///< see FitResult
  std::optional<Parameters> parameters = {};    ///< theta of the minimum
  std::vector<FittedNumber> coefficients = {};  ///< of the law, as its formula names them
  std::vector<double> bias = {};  ///< the expected bias of each; empty where it is not known
  std::optional<FittedNumber> slope = {};       ///< if it is a parameter
  std::vector<FittedNumber> v0 = {};            ///< one for each run, if the model is a roll
  std::vector<FittedNumber> x0 = {};            ///< likewise, if positions are fitted
  std::shared_ptr<const RollModel> rolls = {};  ///< the model, if it is a roll
  std::optional<Taken> taken = {};  ///< see taken_of(); if other fits have left these residuals
  std::shared_ptr<const ShiftRows> shifts = {};  ///< the rows, if the model is a law D(v)

  Law law() const;
  /// The highest speed that was fitted.
  double fastest() const;
  std::size_t means_taken() const {
    return rolls ? rolling::means_taken(rolls->runs(), rolls->parameters()) : 0;
  }
  /// The number of degrees of freedom that are left for the size of the noise; with none left there
  /// are no errors. Filters at the ends of a short run may leave fewer than its rows less the
  /// mean.
  std::size_t degrees_left() const;
  /// True if the noise is that of the raw column alone, through filters that the data name. White
  /// noise beside it makes the weighted residuals those of independent noise, as if nothing had
  /// been filtered.
  bool filters_known() const { return raw_noise || noise->from_sources_alone(); }
};

/// Writes the coefficients of the law with their gradients into the fit.
void report_law(Fitted&, const Parameters&);

/// Minimises by the loss that the options name: squares from the first start.
Minimum solve(const System&, const std::vector<std::vector<double>>& starts, const FitOptions&);

/// Throws Error if n rows, so many of which filters leave independent, are too few for p
/// parameters, or if p = 0.
void require_rows(std::size_t n, std::size_t p, std::size_t independent);

}  // namespace rolling
