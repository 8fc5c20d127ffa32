// The model of every route but a plain D = a v^b: a roll, seen through the filters of the data.
//
//   y = H r(t; a, b, v0, x0) + H e
//
// r is the raw column (positions or speeds of the roll), H what the filters did to it, e white
// noise of one unknown size. Positions, speeds and accelerations (for shifts) differ in H alone.
// The covariance H H^T of the noise does not depend on the parameters, and what smoothing does to
// the data it does to the model.
#pragma once

#include "fit/minimise.h"
#include "fit/noise.h"
#include "fit/parameters.h"
#include "fit/response.h"
#include "motion/trajectory.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace rolling {

/// The records of one run that a route can use.
using Rows = std::vector<std::size_t>;

/// One run, as the model of a roll sees it.
struct ObservedRun {
  Body body;  ///< as far as the roll depends on it
  Geometry geometry = Geometry::approximate;
  double way = 1;     ///< -1: the body rolls towards falling x, v < 0
  double origin = 0;  ///< the time at which v0 and x0 hold; the times below count from it
  double start = 0;   ///< the time for which v0 is reported, from the origin
  bool raw_is_position = false;
  std::vector<double> t;          ///< where the model is needed: all records of the raw column
  std::optional<FilterMatrix> H;  ///< y = H raw; none: y is the raw column itself
  std::vector<double> y;          ///< a number for each fitted record; for shifts their
                                  ///< acceleration, and at the end the mean speed
  double unit = 1;                ///< the unit of the fitted column is so many units of y

  std::size_t records() const { return y.size() - (H && H->bordered()); }
};

/// How the columns of each run came from the raw one; none if that is not known.
struct Making {
  std::vector<Response> responses;
  bool known() const { return !responses.empty(); }
};
/// Known if the chains of all runs lead from positions or speeds to the column that the route fits.
Making making_of(Route, const std::vector<FitRun>&);

/// The runs as the model sees them, of the rows alone. Throws Error for a run without any.
std::vector<ObservedRun> observe(Route, const std::vector<FitRun>&, const std::vector<Rows>&,
                                 const Making&, const FitOptions&);

/// The noise of these runs, with the weights of Noise; nothing is known of it without H.
std::shared_ptr<const Noise> noise_of(const std::vector<ObservedRun>&, double share);

/// The raw column of one run under one theta, and its derivatives.
class RawModel {
 public:
  RawModel(const ObservedRun& run, const Parameters& parameters, const std::vector<double>& theta,
           std::size_t number, Trajectory);
  /// At time t from the origin. The derivatives by the parameters of the run, then by the shared
  /// ones, are written to `slopes`, `stride` apart.
  double operator()(double t, double* slopes, std::size_t stride) const;

 private:
  const ObservedRun& run_;
  const Parameters& parameters_;
  double a_, x0_;
  Trajectory roll_;
};

class RollModel {
 public:
  RollModel(std::vector<ObservedRun> runs, const Parameters& parameters)
      : runs_(std::move(runs)), parameters_(parameters) {}

  const std::vector<ObservedRun>& runs() const { return runs_; }
  const Parameters& parameters() const { return parameters_; }
  Trajectory trajectory(const std::vector<double>& theta, std::size_t run) const;
  RawModel raw(const std::vector<double>& theta, std::size_t run) const {
    return {runs_[run], parameters_, theta, run, trajectory(theta, run)};
  }
  /// Runs of positions whose mean the filters have taken away, so that x0 is no parameter.
  std::size_t means_taken() const {
    return parameters_.has_x0() ? 0
                                : static_cast<std::size_t>(std::ranges::count_if(
                                      runs_, [](const auto& run) { return run.raw_is_position; }));
  }
  /// The slope that a run sees along its way.
  double slope(const std::vector<double>& theta, std::size_t run) const;
  /// Hands over model - data of each run, weighted where the noise says so.
  void evaluate(const std::vector<double>& theta, const Noise&, const TakeRows&) const;

 private:
  std::vector<ObservedRun> runs_;
  Parameters parameters_;
};

/// Hands over H raw - y of one run and its derivatives, weighted where the noise says so, for the
/// rows of its raw column that come one after another. Few records at a time stay in the cache.
class Residuals {
 public:
  /// Of the run with this number, with derivatives by so many parameters.
  Residuals(const ObservedRun& run, std::size_t number, std::size_t parameters, const Noise&,
            const TakeRows&);
  /// Where the next number of the raw column belongs, and its derivatives, `stride` apart.
  struct Place {
    double* raw;
    double* slopes;
    std::size_t stride;
  };
  Place place() {
    if (!filters_) return {&f_[k_], &J_[k_], f_.size()};
    return {filters_->place(), filters_->place() + 1, 1};
  }
  /// Takes what stands at the place.
  void push();

 private:
  void begin_rows();
  void hand_over();

  const ObservedRun& run_;
  std::size_t number_, parameters_;
  const TakeRows& take_;
  std::optional<FilterPass> filters_;
  std::optional<Whitener::Pass> whitener_;
  std::size_t done_ = 0, k_ = 0;
  std::vector<double> f_, J_;
};

/// The model and the weights as one problem of least squares.
System system_of(std::shared_ptr<const RollModel>, std::shared_ptr<const Noise>);

}  // namespace rolling
