#include "motion/memory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"
#include "contact/contact.h"
#include "motion/trajectory.h"
#include "contact/trial.h"

namespace rolling {

namespace {

constexpr double rest_fraction = 1e-3;  // of v0
constexpr unsigned long most_evaluations = 5'000'000;
constexpr double stiff = 3e4;  // measured: from here on an implicit solver is faster

OdeOptions options(Stepper stepper) {
  OdeOptions options;
  options.stepper = stepper;
  return options;
}

}  // namespace

Stepper memory_stepper(const Body& body, PowerLaw law, Bulge bulge, double v0) {
  const double slowing = v0 / std::abs(trial_acceleration(body, Geometry::approximate, law(v0))),
               following = bulge.length / v0;
  return slowing > stiff * following ? Stepper::rk4imp : Stepper::rk8pd;
}

MemoryRoll::MemoryRoll(const Body& body, Geometry geometry, PowerLaw law, Bulge bulge, double v0,
                       double x0)
    : MemoryRoll(body, geometry, law, bulge, v0, x0,
                 options(memory_stepper(body, law, bulge, v0))) {}

MemoryRoll::MemoryRoll(const Body& body, Geometry geometry, PowerLaw law, Bulge bulge, double v0,
                       double x0, const OdeOptions& options)
    : body_(body), geometry_(geometry), law_(law), bulge_(bulge), v0_(v0), x0_(x0),
      options_(options), ode_(start()), at_rest_(v0 == 0) {}

Integrator MemoryRoll::start() const {
  check_roll(body_, law_, v0_);
  if (law_.b < 0)
    fail(
        "the exponent b = {} is negative: a bulge with memory needs a shift that is finite at rest",
        law_.b);
  if (!(bulge_.length > 0 && std::isfinite(bulge_.length)))
    fail("the length of the memory = {} m must be a positive number", bulge_.length);
  if (!(bulge_.damping >= 0 && std::isfinite(bulge_.damping)))
    fail("the damping of the memory = {} s must be a number that is not negative", bulge_.damping);
  if (!std::isfinite(x0_)) fail("the initial position x0 = {} must be finite", x0_);
  // y = (x, v, z). The system keeps its own copy of what it needs: this object may be moved.
  const auto derivative = [body = body_, geometry = geometry_, law = law_, bulge = bulge_](
                              double, const double* y, double* dydt) {
    const double v = y[1], z = y[2];
    dydt[0] = v;
    dydt[2] = std::abs(v) * (law(v) - z) / bulge.length;
    dydt[1] = trial_acceleration(body, geometry, z + bulge.damping * dydt[2]);
  };
  const auto jacobian = [body = body_, geometry = geometry_, law = law_, bulge = bulge_](
                            double, const double* y, double* dfdy, double* dfdt) {
    const double v = y[1], z = y[2], speed = std::abs(v);
    const double dv_dD = trial_acceleration_slope(
        body, geometry, z + bulge.damping * speed * (law(v) - z) / bulge.length);
    const double dz_dv =
                     ((1 + law.b) * std::abs(law(v)) - std::copysign(1.0, v) * z) / bulge.length,
                 dz_dz = -speed / bulge.length;
    const double rows[9] = {
        0, 1,     0,    0, dv_dD * bulge.damping * dz_dv, dv_dD * (1 + bulge.damping * dz_dz),
        0, dz_dv, dz_dz};
    std::copy(rows, rows + 9, dfdy);
    dfdt[0] = dfdt[1] = dfdt[2] = 0;
  };
  return {{3, derivative, jacobian}, options_, 0, {x0_, v0_, law_(v0_)}};
}

bool MemoryRoll::advance(Integrator& ode, bool& backwards, double t) const {
  // The system has a kink at v = 0: each zero is located, and the integration starts again from v =
  // 0 exactly.
  while (ode.advance(t, [](const std::vector<double>& y) { return y[1]; })) {
    std::vector<double> y = ode.state();
    y[1] = 0;
    const double z = y[2], c = body_.g / ((body_.K + arm_factor(body_, geometry_, z)) * body_.R);
    const double fastest = std::pow((2 + law_.b) * bulge_.length * c * z * z / (2 * law_.a),
                                    1 / (2 + law_.b));  // E at v = 0
    ode.restart(y);
    if (law_.b < 2 && body_.slope == 0 && backwards && fastest <= rest_fraction * v0_) return true;
    backwards = true;
    if (ode.evaluations() > most_evaluations)
      fail("the bulge still rings at t = {:.6g} s, after {} evaluations of its equation",
           ode.time(), ode.evaluations());
  }
  return false;
}

double MemoryRoll::stop_time() const {
  if (v0_ == 0) return 0;
  if (law_.b >= 2 || body_.slope != 0) return std::numeric_limits<double>::infinity();
  if (!stop_time_) {
    Integrator ode = start();
    bool backwards = false;
    advance(ode, backwards, std::numeric_limits<double>::infinity());
    stop_time_ = ode.time();
  }
  return *stop_time_;
}

void MemoryRoll::seek(double t) {
  if (at_rest_) return;
  // Where the steps end changes the time of rest by a rounding or so: the one that was told counts.
  const double stop = stop_time_.value_or(std::numeric_limits<double>::infinity());
  at_rest_ = advance(ode_, backwards_, std::min(t, stop)) || t >= stop;
  if (at_rest_ && !stop_time_) stop_time_ = ode_.time();
}

double MemoryRoll::position() { return ode_.state()[0]; }

double MemoryRoll::velocity() { return at_rest_ ? 0 : ode_.state()[1]; }

double MemoryRoll::acceleration() {
  return at_rest_ ? 0 : acceleration_from_shift(body_, geometry_, shift());
}

double MemoryRoll::shift() {
  const double v = velocity(), z = ode_.state()[2];
  return at_rest_ ? 0 : z + bulge_.damping * std::abs(v) * (law_(v) - z) / bulge_.length;
}

}  // namespace rolling
