// SPDX-License-Identifier: GPL-3.0-or-later
// The fits of the routes: rolls, of positions, speeds, and shifts whose filters are known; laws
// D(v) and ln D of rows; speeds that the software of a sensor has made as differences of positions.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "fit/fitted.h"
#include "statistics/levels.h"

namespace rolling {

/// Fits by one route, without the errors. Throws Error as fit() does, except for the limits on the
/// standard errors.
Fitted fit_route(Route, const std::vector<Run>&, const FitOptions&);

/// The fit of another law, with these coefficients fixed, to the rows of a fit of a v^b with its
/// weights, in units in which shifts and speeds are of order one: the smallest minimum from the
/// starts of the law, since near a law without a peak a law with a peak has another minimum than at
/// its peak. The sum of squares is infinite where none is found.
Fitted fit_beside(const Fitted& power, const LawForm&, const FitOptions::Fixed&);

/// The starting point for the fit of a roll.
struct FirstGuess {
  Parameters parameters;  ///< with units v_ref and x_ref that suit the data
  /// theta; behind it others where a robust search may start as well.
  std::vector<std::vector<double>> starts;
};

/// Estimates theta from positions or speeds as if they were not filtered (without H). Throws Error
/// if the body does not move or if no law comes near the data.
FirstGuess first_guess(const std::vector<ObservedRun>&, const FitOptions&);

/// The rows of each run in which no reading is missing: those with finite values. For a roll under
/// shifts a row with v <= 0 counts too: to select by noisy speeds would be to select by their
/// noise.
std::vector<Rows> usable(Route, const std::vector<Run>&);

/// Fits a roll: position, velocity, and shift with known filters (`responses`).
Fitted fit_rolls(Route, const std::vector<Run>&, std::vector<Rows>, std::vector<Response>,
                 const FitOptions&, AddedNoise = {});

/// Minimises by the loss that the options name: squares from the first start. The robust loss
/// ignores what the cusps and the wall make.
Minimum search(const Model&, const std::vector<std::vector<double>>& starts, const FitOptions&);

/// The smallest sum of squares with this exponent of a v^b held, from a theta in which it is free,
/// and its place as such a theta, without f and R; infinite where the search finds none.
Minimum with_exponent_held(const Model&, std::vector<double> theta, double b);

/// The minimum at the wall of b = 0, if there is one: a body that turns on a slope or on a road
/// would be held there under a v^b with b < 0. Nothing if the search finds none.
std::optional<Minimum> minimum_at_wall(const Model&, const std::vector<double>& theta);

/// Says that the slope of the mat is not determined by runs in one direction; `found` follows.
[[noreturn]] void refuse_one_way(const std::string& found = "");

/// The fit of a model by a search from these starts, see search().
Fitted fit_from(Model, const std::vector<std::vector<double>>& starts, const FitOptions&);

/// Fits one run of a joint fit of rolls separately: the same rows and weights, the slope of the
/// mat fixed at the joint value. Throws Error if the run does not determine its parameters, or has
/// none.
Fitted fit_of_run(const Fitted& joint, std::size_t run, const FitOptions&);

/// A run of more rows is long: a smooth law needs no more, and no single one bends its fit.
inline constexpr std::size_t long_run = 4096;

/// The runs of a roll as means of blocks, at most long_run of each run, where there are more rows
/// than that on average; else nothing. The blocks of a run have one size: its means have equal
/// weights. They hold what a smooth law can tell.
std::vector<ObservedRun> block_means(const std::vector<ObservedRun>&);

/// The fit of these means; the fit itself where there are none, or a filter is known.
Fitted of_means(Fitted, const FitOptions&);

/// The sum of squares of model - data in the unit of the fitted column, without weights.
double sum_of_squares(const Fitted&);

/// The rows of a run that the routes loglog and shift use: with finite v > 0 of at least
/// options.min_speed, and with D > 0 if `logarithms`; what is no more than the rounding of a
/// difference (base/grid.h) counts as 0. From the time `stop` on no row is used. A body that rolls
/// towards falling x has v < 0 and D < 0; both are taken positive along its direction of motion.
Rows shift_rows(const Run&, const FitOptions&, bool logarithms, double stop = INFINITY);

/// The model of the columns D [m] or ln D with these rows, without the runs that have none. Its
/// unit of speed is the geometric mean of theirs, where the estimates of ln D and b are
/// uncorrelated. Throws Error if the rows do not determine the parameters.
Model model_of_shifts(const std::vector<Run>&, const std::vector<Rows>&, const FitOptions&,
                      bool logarithms);

/// Unweighted least squares on D (or the robust loss) for rows whose filters are not known. D
/// and a are in metres, v in m/s; runs that roll towards falling x are reflected. Throws Error if
/// the rows do not determine the parameters.
Fitted fit_shift(const std::vector<Run>&, const FitOptions&);

/// The log-log regression line of ln D on ln v through all rows with v > 0 and D > 0, with equal
/// weights, as one would draw it through a plot. If the filters are known (`responses`), the errors
/// are those of the noise of the raw column, propagated through the filters and the logarithms, and
/// the expected bias of the line is reported. Throws Error if the rows do not determine the
/// parameters.
Fitted fit_log_log(const std::vector<Run>&, const FitOptions&, std::vector<Response> responses);

/// The velocity fit with the difference filter of options.possible_filters, and the share of white
/// noise, that have the largest restricted likelihood; the likelihood is computed around `plain`, a
/// fit without a filter. None if white noise alone, or a mean of speeds, is nearly as likely or
/// more likely, or if the residuals of the new fit are not white or are uneven along the runs.
std::optional<Fitted> fit_differences(const std::vector<Run>&, const FitOptions&,
                                      const Fitted& plain);

/// An estimate of the share of white noise (the share of Noise).
struct WhiteShare {
  double share;
  double likelihood;  ///< ln of it, comparable with restricted_likelihood() under other noise
  double gain;        ///< ln of the likelihood ratio to no white noise

  /// Noise without additional white noise reaches this gain in about 1 % of the runs.
  bool decisive() const { return gain >= levels::likely; }
};

/// The search for the share of white noise uses at most this many rows from the beginning of
/// each run. They show a share that is larger than the noise which the filters leave of their
/// slowest motion, about 1e-4 of the noise of a run.
inline constexpr std::size_t searched_for_white_noise = 100'000;

/// The share between `least` and `most` with the largest restricted likelihood of the residuals,
/// with the model linear around theta. H of every run must be known.
WhiteShare most_likely_share(const Model&, const std::vector<double>& theta, double least,
                             double most);

}  // namespace rolling
