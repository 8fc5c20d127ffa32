// The parameter vector theta of a roll, scaled to numbers of order one, and the physical parameters
// that it stands for.
#pragma once

#include "contact/power_law.h"
#include "fit/input.h"

#include <cmath>
#include <utility>

namespace rolling {

/// For each run, theta holds v0 in units of v_ref and x0 in units of x_ref. The parameters shared
/// by all runs follow: ln D(v_ref), b, and the slope of the mat in millimetres per metre. ln
/// D(v_ref) replaces ln a, which is nearly collinear with b. Parameters that are held fixed have no
/// element in theta. v0 is the speed along the direction of motion and is not negative.
class Parameters {
 public:
  static constexpr double slope_unit = 1e-3;

  /// `position`: the raw column is a position, so that each run has an x0.
  Parameters(const FitOptions& options, bool position, std::size_t runs, double v_ref, double x_ref)
      : a_(options.a), b_(options.b), v0_(options.v0), x0_(options.x0), slope_(options.fit_slope),
        position_(position), runs_(runs), v_ref_(v_ref), log_v_ref_(std::log(v_ref)),
        x_ref_(x_ref) {}

  std::size_t shared() const { return !a_ + !b_ + slope_; }
  std::size_t own() const { return !v0_ + free_x0(); }
  std::size_t columns() const { return own() + shared(); }
  std::size_t count() const { return runs_ * own() + shared(); }

  PowerLaw law(const std::vector<double>& theta) const {
    const double b = b_ ? *b_ : theta[count() - 1 - slope_];
    return {a_ ? *a_ : std::exp(theta[count() - shared()] - b * log_v_ref_), b};
  }
  double v0(const std::vector<double>& theta, std::size_t run) const {
    return v0_ ? std::abs(*v0_) : theta[run * own()] * v_ref_;
  }
  double x0(const std::vector<double>& theta, std::size_t run) const {
    return !position_ ? 0 : x0_ ? *x0_ : theta[run * own() + !v0_] * x_ref_;
  }
  /// The slope of the mat along growing x; `given` if the slope is not a parameter.
  double slope(const std::vector<double>& theta, double given) const {
    return slope_ ? theta.back() * slope_unit : given;
  }
  bool fits_slope() const { return slope_; }
  bool has_x0() const { return position_; }
  /// The parameters of a single run on a mat whose slope is held.
  Parameters of_one_run() const {
    Parameters one = *this;
    one.runs_ = 1;
    one.slope_ = false;
    return one;
  }
  std::vector<double> theta_of_run(const std::vector<double>& theta, std::size_t run) const {
    const auto at = [&](std::size_t i) { return theta.begin() + static_cast<std::ptrdiff_t>(i); };
    std::vector<double> one(at(run * own()), at((run + 1) * own()));
    one.insert(one.end(), at(runs_ * own()), at(count() - slope_));
    return one;
  }
  /// The theta of this law with these v0 and x0 (one for each run), and slope 0.
  std::vector<double> theta(PowerLaw law, const std::vector<double>& v0,
                            const std::vector<double>& x0) const {
    std::vector<double> all;
    for (std::size_t r = 0; r < runs_; ++r) {
      if (!v0_) all.push_back(v0[r] / v_ref_);
      if (free_x0()) all.push_back(x0[r] / x_ref_);
    }
    if (!a_) all.push_back(std::log(law.a) + law.b * log_v_ref_);
    if (!b_) all.push_back(law.b);
    if (slope_) all.push_back(0);
    return all;
  }

  /// Partial derivatives of a number with respect to a, b, the v0 and x0 of its run, and the slope.
  struct Derivatives {
    double a, b, v0 = 0, x0 = 0, slope = 0;
  };
  /// Converts derivatives with respect to v0 and x0 to the elements of theta that belong to the run
  /// and writes them `stride` apart; returns the place for the next one.
  double* chain_own(double* to, std::size_t stride, double v0, double x0) const noexcept {
    if (!v0_) *std::exchange(to, to + stride) = v0 * v_ref_;
    if (free_x0()) *std::exchange(to, to + stride) = x0 * x_ref_;
    return to;
  }
  /// The same for all columns of a run: its own parameters, then the shared ones. a is the value of
  /// a under theta.
  void chain(double* to, std::size_t stride, double a, const Derivatives& by) const noexcept {
    double* place = chain_own(to, stride, by.v0, by.x0);
    const auto put = [&](double value) { *std::exchange(place, place + stride) = value; };
    if (!a_) put(a * by.a);
    if (!b_) put(by.b - (a_ ? 0 : log_v_ref_ * a * by.a));
    if (slope_) put(by.slope * slope_unit);
  }

 private:
  bool free_x0() const { return position_ && !x0_; }

  std::optional<double> a_, b_, v0_, x0_;
  bool slope_, position_;
  std::size_t runs_;
  double v_ref_, log_v_ref_, x_ref_;
};

}  // namespace rolling
