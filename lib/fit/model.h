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
//
// Parameters are the vector theta of a fit, scaled to numbers of order one, and the physical
// parameters that it stands for.
#pragma once

#include "law/law.h"
#include "fit/input.h"
#include "least_squares/minimise.h"
#include "motion/roll.h"
#include "noise/noise.h"
#include "noise/response.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace rolling {

/// The numbers of a roll: v0 and x0 of each run, the coefficients of the law and the numbers of the
/// scene. The wind is not one of them under a law without the drag of the air.
/// Those that are not fixed are the elements of theta, each in a unit that makes it of order one:
/// for each run v0 and x0, then the shared ones. Of a v^b they are ln D at the unit of speed, in
/// place of a, which is nearly collinear with b, and b. v0 is the speed along the direction of
/// motion and is not negative.
class Parameters {
 public:
  static constexpr std::size_t first_of_law = 2;
  static constexpr std::size_t first_of_scene = first_of_law + LawForm::most;
  static constexpr std::size_t most = first_of_scene + scene_numbers.size();
  /// v0, x0, the coefficients of the law and those of the scene, or derivatives by them.
  using Numbers = std::array<double, most>;

  Parameters() = default;
  /// Of rolls under a v^b. `position`: the raw column is a position, so that each run has an x0.
  Parameters(const FitOptions&, bool position, std::size_t runs, double v_ref, double x_ref);
  /// Of D = a v^b alone.
  Parameters(const FitOptions&, double v_unit);
  /// The same parameters with another law. If some of its coefficients are fixed, theta holds the
  /// others as they are written; else those that suit a search.
  Parameters with(const LawForm&, double D_unit, double v_unit, const FitOptions::Fixed&) const;
  /// The same parameters with one of Numbers fixed, such as the exponent of a v^b.
  Parameters with(std::size_t number, double value) const;
  /// The same parameters of so many runs.
  Parameters of_runs(std::size_t n) const;
  /// The parameters of a single run in a scene that is fixed.
  Parameters of_one_run() const;

  double speed_unit() const { return v_unit_; }  ///< [m/s], see Law
  const LawForm& form() const { return *form_; }
  /// The value of coefficient j in SI units if it is fixed.
  std::optional<double> fixed(std::size_t j) const { return fixed_[first_of_law + j]; }
  /// Whether number i of the scene is a parameter.
  bool fits(std::size_t i) const { return !fixed_[first_of_scene + i]; }
  /// The number of free coefficients of the law, and of the numbers of the scene that are free.
  std::size_t coefficients() const { return free(first_of_law, first_of_scene); }
  std::size_t scene() const { return free(first_of_scene, most); }
  std::size_t shared() const { return free(first_of_law, most); }
  std::size_t own() const { return free(0, first_of_law); }
  std::size_t columns() const { return free(0, most); }
  std::size_t count() const { return runs_ * own() + shared(); }
  bool has_x0() const { return position_ || !fixed_[1]; }
  bool fixes_v0() const { return fixed_[0].has_value(); }
  bool of_positions() const { return position_; }

  Law law(const std::vector<double>& theta) const;
  double v0(const std::vector<double>& theta, std::size_t run) const {
    return numbers(theta, run)[0];
  }
  double x0(const std::vector<double>& theta, std::size_t run) const {
    return numbers(theta, run)[1];
  }
  /// The given body with the numbers of the scene that are parameters.
  Body body(const std::vector<double>& theta, Body given) const;
  /// The theta of these runs alone.
  std::vector<double> theta_of_runs(const std::vector<double>& theta,
                                    const std::vector<std::size_t>& runs) const;
  /// The theta of a v^b with these v0 and x0 (one for each run), and a road as steep as it is.
  std::vector<double> theta(PowerLaw law, const std::vector<double>& v0,
                            const std::vector<double>& x0, double slope = 0) const;

  /// The elements of theta of these coefficients of a search in the given units.
  std::vector<double> start(const std::vector<double>& c) const;

  /// Converts derivatives to the elements of theta, those of the run first and then the shared
  /// ones, and writes them `stride` apart. c0 is the first coefficient under theta.
  void chain(double* to, std::size_t stride, double c0, const Numbers& by) const noexcept;

 private:
  std::size_t free(std::size_t first, std::size_t end) const;
  Numbers numbers(const std::vector<double>& theta, std::size_t run) const;

  const LawForm* form_ = &laws().front();
  std::array<std::optional<double>, most> fixed_ = {};  // coefficients of a v^b in SI units
  Numbers unit_ = {};                                   // of the elements of theta
  bool is_power_ = true;                                // the law is a v^b
  bool as_written_ = false;                             // theta holds coefficients of the formula
  bool fit_wind_ = false;
  bool position_ = false;
  std::size_t runs_ = 0;
  double D_unit_ = 1;
  double v_unit_ = 1;
};

/// The direction before the furthest place of these positions or speeds, from which the body comes
/// back; 0 if it does not, or by no more than noise, two steps of rounded positions and 0.2 % of
/// its way.
double way_before_turn(bool position, const std::vector<double>& t,
                       const std::vector<double>& rows);

/// The direction of motion, +1 or -1, of positions or speeds at these times: the first one, where
/// the body turns on a slope, which its furthest place tells. A few false echoes do not decide.
/// What it comes back must be more than noise.
double way_of(bool position, const std::vector<double>& t, const std::vector<double>& rows,
              double slope, const FitOptions&);

/// The indices of the rows of one run that a route fits.
using Rows = std::vector<std::size_t>;

/// The data of one run in the form that the model needs.
struct ObservedRun {
  std::string place;  ///< begins messages about the run; empty if there is no other
  Body body;          ///< the body and its mat; only what the motion depends on is meaningful
  double way = 1;     ///< direction of motion: -1 if the body rolls towards falling x (v < 0)
  double origin = 0;  ///< the time of the first row [s]: v0 and x0 hold there, t counts from it
  Quantity column = Quantity::v;  ///< the raw one: x or v of a roll; D of a law, or its logarithm
  bool logarithm = false;
  /// The times of the raw column, at which the model is evaluated [s]; of shifts, their speeds
  /// [m/s]
  std::vector<double> t = {};
  Filters H = {};              ///< y = H raw; without H, y is the raw column itself
  std::vector<double> y = {};  ///< the fitted rows
  /// For shift: the accelerations of the shifts of these rows, and their filters.
  std::vector<double> accelerations = {};
  Filters H_of_accelerations = {};
  double x0 = 0;  ///< where speeds begin on the road of the body
};

/// The response of each run, if the filters of all runs are known; otherwise empty.
std::vector<Response> responses_of(const std::vector<Run>&);

/// The runs in the form that the model needs, with the chosen rows alone. Throws Error for a run
/// without a row.
std::vector<ObservedRun> observe(Route, const std::vector<Run>&, const std::vector<Rows>&,
                                 const std::vector<Response>&, const FitOptions&);

/// The model of the raw column of one run: returns the value at time t from the origin (of shifts,
/// at this speed), and writes its derivatives, those that it has.
using RawModel = std::function<double(double t, Parameters::Numbers& by)>;

/// All runs under one law, and the weights of their rows. Copies share the runs and the weights.
class Model {
 public:
  Model() = default;
  Model(std::vector<ObservedRun> runs, const Parameters& parameters)
      : runs_(std::make_shared<const std::vector<ObservedRun>>(std::move(runs))),
        parameters_(parameters) {}
  /// The same runs under another law.
  Model with(const Parameters& parameters) const {
    Model other = *this;
    other.parameters_ = parameters;
    return other;
  }
  /// The same with the weights that the noise of the runs has, if they have an H; and without.
  Model weighted(AddedNoise = {}) const;
  Model unweighted() const { return {runs_, parameters_}; }

  const std::vector<ObservedRun>& runs() const { return *runs_; }
  /// The number of fitted rows of each run.
  std::vector<std::size_t> rows() const;
  /// The number of them that filters leave independent of the others.
  std::size_t informative_rows() const;
  /// The number of runs of positions whose mean the filters remove; each such run loses one degree
  /// of freedom. Where x0 is a parameter, the filters keep the mean.
  std::size_t means_taken() const;
  const Parameters& parameters() const { return parameters_; }
  /// That of the weights.
  const Noise& noise() const { return *noise_; }
  bool is_roll() const { return runs().front().column != Quantity::D; }
  Roll roll(const std::vector<double>& theta, std::size_t run) const;
  /// Refers to the runs.
  RawModel raw(const std::vector<double>& theta, std::size_t run) const;
  /// The raw column of a run without derivatives: x or v at its times.
  std::vector<double> raw_column(const std::vector<double>& theta, std::size_t run) const;

 private:
  Model(std::shared_ptr<const std::vector<ObservedRun>> runs, const Parameters& parameters)
      : runs_(std::move(runs)), parameters_(parameters) {}

  std::shared_ptr<const std::vector<ObservedRun>> runs_;
  Parameters parameters_;
  std::shared_ptr<const Noise> noise_ = std::make_shared<const Noise>();
};

/// The least-squares problem of a model: the residuals H raw - y and their derivatives, whitened
/// if the noise is known.
System system_of(const Model&);

}  // namespace rolling
