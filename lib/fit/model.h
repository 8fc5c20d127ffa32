// SPDX-License-Identifier: GPL-3.0-or-later
// The model of the runs that every route fits: a roll that is observed through filters,
//
//   y = H r(t; a, b, v0, x0) + H e
//
// r is the raw column (positions or speeds of the roll), H the matrix of the filters, and e white
// noise of one unknown variance. Positions and speeds differ in H alone. The covariance H H^T of
// the noise does not depend on the parameters, and the filters smooth the model exactly as they
// smooth the data.
//
// Shifts whose filters are known are derivatives of the speeds beside them: they are a linear
// function of the speeds, without noise of their own. The weighted squares of v and D together are
// therefore those of v alone, and y is v. The noise of a second derivative could not be whitened in
// double precision: in n rows, that of a slow motion is n^2 times smaller than that of a fast
// one, in the covariance n^4 times.
//
// Shifts whose filters are not known, and logarithms of shifts, are no roll: y = D(v), or ln D(v).
#pragma once

#include "fit/parameters.h"
#include "least_squares/minimise.h"
#include "motion/roll.h"
#include "noise/noise.h"
#include "noise/response.h"

#include <memory>
#include <optional>
#include <string>

namespace rolling {

/// The direction of motion, +1 or -1, of positions or speeds at these times: the first one, where
/// the body turns on a slope, which its furthest place tells. A few false echoes do not decide.
/// What it comes back must be more than noise.
double way_of(bool position, const std::vector<double>& t, const std::vector<double>& rows,
              double slope, const FitOptions&);

/// The indices of the rows of one run that a route fits.
using Rows = std::vector<std::size_t>;

/// What a column holds: positions and speeds of a roll, or shifts and their logarithms.
enum class RawColumn { x, v, D, ln_D };

/// The data of one run in the form that the model needs.
struct ObservedRun {
  std::string place;  ///< begins messages about the run; empty if there is no other
  Body body;          ///< the body and its mat; only what the motion depends on is meaningful
  Geometry geometry = Geometry::approximate;
  double way = 1;     ///< direction of motion: -1 if the body rolls towards falling x (v < 0)
  double origin = 0;  ///< the time of the first row [s]: v0 and x0 hold there, t counts from it
  RawColumn column = RawColumn::v;  ///< the raw one
  /// The times of the raw column, at which the model is evaluated [s]; of shifts, their speeds
  /// [m/s]
  std::vector<double> t;
  Filters H;              ///< y = H raw; without H, y is the raw column itself
  std::vector<double> y;  ///< the fitted rows
  /// For shift: the accelerations of the shifts of these rows, and their filters.
  std::vector<double> accelerations = {};
  Filters H_of_accelerations = {};
};

/// The response of each run, if the filters of all runs are known; otherwise empty.
std::vector<Response> responses_of(const std::vector<FitRun>&);

/// The runs in the form that the model needs, with the chosen rows alone. Throws Error for a run
/// without a row.
std::vector<ObservedRun> observe(Route, const std::vector<FitRun>&, const std::vector<Rows>&,
                                 const std::vector<Response>&, const FitOptions&);

/// The number of runs of positions whose mean the filters remove; each such run loses one degree of
/// freedom. Where x0 is a parameter, the filters keep the mean.
std::size_t means_taken(const std::vector<ObservedRun>&, const Parameters&);

/// The noise of these runs; unknown if they have no H.
std::shared_ptr<const Noise> noise_of(const std::vector<ObservedRun>&, AddedNoise = {});

/// The number of rows of these runs that filters leave independent of the others.
std::size_t informative_rows(const std::vector<ObservedRun>&, const Parameters&, const Noise&);

/// The model of the raw column of one run: returns the value at time t from the origin (of shifts,
/// at this speed), and writes the derivatives with respect to the parameters of the run, then the
/// shared ones, to `slopes`, `stride` apart.
using RawModel = std::function<double(double t, double* slopes, std::size_t stride)>;

/// All runs under one law.
class Model {
 public:
  Model(std::vector<ObservedRun> runs, const Parameters& parameters)
      : runs_(std::make_shared<const std::vector<ObservedRun>>(std::move(runs))),
        parameters_(parameters) {}
  /// The same runs under another law.
  Model with(const Parameters& parameters) const {
    Model other = *this;
    other.parameters_ = parameters;
    return other;
  }

  const std::vector<ObservedRun>& runs() const { return *runs_; }
  /// The number of fitted rows of each run.
  std::vector<std::size_t> rows() const;
  const Parameters& parameters() const { return parameters_; }
  bool is_roll() const { return runs().front().column <= RawColumn::v; }
  Roll roll(const std::vector<double>& theta, std::size_t run) const;
  /// Refers to this object.
  RawModel raw(const std::vector<double>& theta, std::size_t run) const;
  /// The raw column of a run without derivatives: x or v at its times.
  std::vector<double> raw_column(const std::vector<double>& theta, std::size_t run) const;

 private:
  std::shared_ptr<const std::vector<ObservedRun>> runs_;
  Parameters parameters_;
};

/// The least-squares problem of a model: the residuals H raw - y and their derivatives, whitened
/// if the noise is known.
System system_of(std::shared_ptr<const Model>,
                 std::shared_ptr<const Noise> = std::make_shared<const Noise>());

}  // namespace rolling
