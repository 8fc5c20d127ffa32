#include "motion/trajectory.h"

#include <algorithm>
#include <cmath>

#include "base/double_double.h"
#include "base/error.h"
#include "contact/contact.h"
#include "contact/trial.h"
#include "motion/power_integral.h"

namespace rolling {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// D(v0)/R and 1 - (D(v0)/R)^2, the latter without cancellation where D is near R.
struct Depth {
  double ratio, arm_square;
};

Depth depth_of(const Body& body, PowerLaw law, double v0) {
  const DoubleDouble depth = (Scaled(law.a) * power(v0, law.b) / Scaled(body.R)).value();
  const double arm_square = std::max(0.0, (-(depth * depth) + 1).hi);
  if (body.K == 0 && arm_square == 0)
    fail("K = 0 and D(v0) = R: the force of the mat would have no bound");
  return {std::min(depth.hi, 1.0), arm_square};
}

/// Throws Error as check_roll does, but passes any D.
void check_numbers(const Body& body, PowerLaw law, double v0) {
  const auto positive = [](const char* name, double value) {
    if (!(value > 0 && std::isfinite(value)))
      fail("{} = {} must be a positive number", name, value);
  };
  const auto not_negative = [](const char* name, double value) {
    if (!(value >= 0 && std::isfinite(value)))
      fail("{} = {} must be a number that is not negative", name, value);
  };
  positive("the radius R", body.R);
  not_negative("the shape factor K", body.K);
  positive("gravity g", body.g);
  positive("the coefficient a", law.a);
  if (!std::isfinite(body.slope)) fail("the slope {} must be finite", body.slope);
  if (!(std::abs(law.b) <= 1000)) fail("the exponent b = {} is beyond -1000 to 1000", law.b);
  not_negative("the initial velocity v0", v0);
}

SpeedIntegrals integrals_of(const Body& body, Geometry geometry, PowerLaw law, double v0,
                            bool passes_radius) {
  check_numbers(body, law, v0);
  if (!passes_radius) check_shift(body, law(v0));
  if (!std::isfinite(law(v0))) fail("the shift at v0 = {} m/s has no finite value", v0);
  if (geometry == Geometry::approximate || body.slope != 0 || v0 == 0) return {law.b, body.K, 0};
  const Depth depth = depth_of(body, law, v0);
  return {law.b, body.K, depth.ratio, depth.arm_square};
}

}  // namespace

Trajectory::Trajectory(const Body& body, Geometry geometry, PowerLaw law, double v0,
                       Derivatives derivatives, AtRadius at_radius)
    : body_(body), geometry_(geometry), law_(law), v0_(v0), log_v0_(std::log(v0)),
      integrals_(integrals_of(body, geometry, law, v0,
                              at_radius == AtRadius::passed && geometry == Geometry::approximate)),
      passed_(at_radius == AtRadius::passed) {
  if (v0 == 0) return;
  if (body.slope != 0 || derivatives == Derivatives::of_law_and_slope) {
    const Depth depth =
        geometry == Geometry::exact ? depth_of(body, law, v0) : Depth{law(v0) / body.R, 1};
    incline_.emplace(geometry, law.b, body.K, depth.ratio, depth.arm_square, body.slope,
                     std::log(law.a) + law.b * log_v0_ - std::log(body.R));
    unit_ = v0 * std::hypot(1, body.slope) / body.g;
    stop_time_ = unit_ * incline_->stop();
    radius_time_ = unit_ * incline_->end();
    if (radius_time_ < infinity) radius_speed_ = v0 * incline_->speed(incline_->last());
    if (std::isinf(stop_time_) && !(passed_ && radius_speed_ > 0)) return;
    stopped_ = point_of(incline_->last(), Wanted::speed_and_distance);
    if (radius_speed_ > 0) {
      const auto g = incline_->gradient(incline_->last(), Wanted::speed);
      stop_at_radius({-unit_ * g.h0 / law.a, -unit_ * (log_v0_ * g.h0 - g.h1),
                      unit_ / v0 / incline_->start_rate(), -unit_ * (g.k0 - fall() * g.time)});
    }
    stopped_.v = stopped_.v_a = stopped_.v_b = stopped_.v_v0 = stopped_.v_S = 0;
    return;
  }
  const double D = law(v0);  // v0^b may have left the range of double, or v0^(1-b)
  unit_ = (D >= std::numeric_limits<double>::min() ? v0 / D : std::pow(v0, 1 - law.b) / law.a) *
          ((body.K + 1) * body.R / body.g);
  stop_time_ = unit_ * integrals_.stop();
  radius_time_ = unit_ * integrals_.end();
  if (radius_time_ < infinity) radius_speed_ = velocity(integrals_.last());
  if (std::isinf(stop_time_) && !(passed_ && radius_speed_ > 0)) return;
  const auto g = integrals_.gradient(infinity);
  const double length = v0 * unit_, x = length * g.distance;
  stopped_ = {0,
              x,
              0,
              0,
              0,
              -length * g.g0 / law.a,
              -length * (log_v0_ * g.g0 - g.g1),
              (v0 - radius_speed_) / v0 * unit_ * integrals_.f(0)};
  if (radius_speed_ > 0)
    stop_at_radius(
        {-unit_ * g.h0 / law.a, -unit_ * (log_v0_ * g.h0 - g.h1), unit_ / v0 * integrals_.f(0)});
}

/// The derivative of ln(1/cos(theta)) by the slope.
double Trajectory::fall() const { return body_.slope / (1 + body_.slope * body_.slope); }

// With q = -v' while D stays R, which is proportional to cos(theta), the stop is v/q later and
// v^2/(2 q) further on. At fixed t, dx/dp = dX/dp - v dT/dp, as above.
void Trajectory::stop_at_radius(const ByParameters& time) {
  const double v = radius_speed_, T = v * body_.K / (body_.g * incline(body_).cos), x = v * T / 2;
  stop_time_ = radius_time_ + T;
  stopped_.x += x;
  stopped_.x_a += v * time.a, stopped_.x_b += v * time.b, stopped_.x_v0 += v * time.v0;
  stopped_.x_S += v * time.S + x * fall();
  stop_time_by_ = time;
  stop_time_by_.S += T * fall();
}

Trajectory::Point Trajectory::at_radius(double rest) const {
  const ByParameters& T = stop_time_by_;
  const double q = radius_deceleration(), v = q * rest;
  return {v,
          stopped_.x - v * rest / 2,
          q * T.a,
          q * T.b,
          q * T.v0,
          stopped_.x_a - v * T.a,
          stopped_.x_b - v * T.b,
          stopped_.x_v0 - v * T.v0,
          q * (T.S - fall() * rest),
          stopped_.x_S - v * (T.S - fall() * rest / 2)};
}

void check_roll(const Body& body, PowerLaw law, double v0) {
  check_numbers(body, law, v0);
  check_shift(body, law(v0));
}

void Trajectory::check_time(double t) const {
  if (t > radius_time_)
    fail(
        "at t = {:.6g} s the shift has grown beyond the radius {:.6g} m (since t = {:.6g} s): b < "
        "0 has no meaning there",
        t, body_.R, radius_time_);
}

double Trajectory::log_ratio(double t, double rest) const {
  if (rest <= 0) return infinity;
  if (t == 0) return 0;
  if (rolls_at_radius(t)) return std::log(v0_ / (radius_deceleration() * rest));
  check_time(t);
  return integrals_.lambda(t / unit_, rest_of_law(rest) / unit_);
}

double Trajectory::velocity(double lambda) const { return v0_ * std::exp(-lambda); }

double Trajectory::position(double t, double lambda) const {
  if (lambda == infinity) return stopped_.x;
  if (rolls_at_radius(t)) return at_radius(stop_time_ - t).x;
  return lambda < 1e-17 ? v0_ * t
                        : v0_ * (unit_ * integrals_.distance(lambda));  // unit_ may be infinite
}

double Trajectory::shift(double v) const {
  const double D = law_(v);
  if (!passed_) check_shift(body_, D);
  return passed_ && geometry_ == Geometry::exact ? std::min(D, body_.R) : D;
}

double Trajectory::acceleration(double v) const {
  return passed_ ? trial_acceleration(body_, geometry_, shift(v))
                 : acceleration_from_shift(body_, geometry_, shift(v));
}

// With T(v; a, b, v0) = t the integral over speed, at fixed t:  dv/dp = -(dT/dp) / (dT/dv) =
// -(dT/dp) dv/dt,  and
//   dT/da = -int h ... / a,   dT/db = -int ln(u) h ...,   dT/dv0 = -1 / (dv/dt at v0);
//   dx/dp = dX/dp - v dT/dp,  which is the same integral with a factor u - v.
Trajectory::Point Trajectory::at(double t, Wanted wanted) const {
  if (t == 0) return {v0_, 0, 0, 0, v0_ > 0 ? 1.0 : 0.0, 0, 0, 0};
  if (incline_) return on_slope(t, wanted);
  if (rolls_at_radius(t)) return at_radius(stop_time_ - t);
  const double lambda = log_ratio(t), a = law_.a, log_v0 = log_v0_;
  if (lambda == infinity) return stopped_;
  // The limit for lambda -> 0, where the speed hardly changes, lambda^2 underflows and unit_ may be
  // infinite.
  if (lambda < 1e-100) {
    const double A = arm_factor(body_, geometry_, law_(v0_)), K = body_.K;
    const double dv_da = -body_.g / body_.R * std::pow(v0_, law_.b) * t * (K + 1 / A) /
                         ((K + A) * (K + A)),
                 dv_db = a * log_v0 * dv_da;
    return {v0_, v0_ * t, dv_da, dv_db, 1, dv_da * t / 2, dv_db * t / 2, t};
  }
  const auto g = integrals_.gradient(lambda, wanted);
  const double rate = std::exp(-law_.b * lambda) / integrals_.f(lambda);  // -(dv/dt) unit_ / v0
  Point point{velocity(lambda),
              0,
              -v0_ * rate * g.h0 / a,
              -v0_ * rate * (log_v0 * g.h0 - g.h1),
              rate * integrals_.f(0),
              0,
              0,
              0};
  if (wanted == Wanted::speed) return point;
  const double length = v0_ * unit_;
  point.x = v0_ * (unit_ * g.distance);
  point.x_a = -length * g.g0 / a;
  point.x_b = -length * (log_v0 * g.g0 - g.g1);
  point.x_v0 = -std::expm1(-lambda) * unit_ * integrals_.f(0);
  return point;
}

Trajectory::Point Trajectory::on_slope(double t, Wanted wanted) const {
  const double rest = stop_time_ - t;
  if (rest <= 0) return stopped_;
  if (rolls_at_radius(t)) return at_radius(rest);
  check_time(t);
  return point_of(incline_->place(t / unit_, rest_of_law(rest) / unit_), wanted);
}

// With q = g cos(theta) net/(K + A), the deceleration, the time is T = int du/q, and as above, at
// fixed t,  dv/dp = q dT/dp,  dx/dp = dX/dp - v dT/dp.  The slope acts through A S in net and
// through cos(theta), whose logarithm has the derivative -S cos(theta)^2 by S.
Trajectory::Point Trajectory::point_of(SlopeIntegrals::Place place, Wanted wanted) const {
  const auto g = incline_->gradient(place, wanted);
  const double a = law_.a, E = incline_->speed(place), S = body_.slope,
               sign = incline_->slows() ? 1 : -1, fall = sign * S / (1 + S * S),
               length = v0_ * unit_, start = incline_->start_rate();
  Point point{v0_ * E,
              0,
              -v0_ * g.rate * g.h0 / a,
              -v0_ * g.rate * (log_v0_ * g.h0 - sign * g.h1),
              g.rate / start,
              0,
              0,
              0,
              -v0_ * g.rate * (g.k0 - fall * g.time)};
  if (wanted == Wanted::speed) return point;
  point.x = v0_ * (unit_ * g.distance);
  point.x_a = -length * g.g0 / a;
  point.x_b = -length * (log_v0_ * g.g0 - sign * g.g1);
  point.x_v0 = g.change * unit_ / start;
  point.x_S = -length * (g.j - fall * g.w);
  if (place.beyond == 0) return point;  // at D = R and K = 0 the derivatives of v have no bound
  const double beyond = place.beyond * unit_;
  point.x += point.v * beyond;
  point.x_a += point.v_a * beyond, point.x_b += point.v_b * beyond;
  point.x_v0 += point.v_v0 * beyond, point.x_S += point.v_S * beyond;
  return point;
}

// For A = 1 on a level mat, Eq. 13: with s = 1 - b and w = (v/v0)^s = 1 - s t/unit the integral h0
// is t/unit, and the rate e^(-b lambda) is (v/v0)/w.
Trajectory::Point Trajectory::speed_at(double t) const {
  if (incline_) return at(t, Wanted::speed);
  const double s = 1 - law_.b, rest = stop_time_ - t, time = t / unit_;
  if (geometry_ == Geometry::exact || s == 0 || !(time > 1e-100 && rest > 0))
    return at(t, Wanted::speed);
  const double w = rest < t ? s * (rest / unit_) : 1 - s * time;
  const double lambda = -(rest < t ? std::log(w) : std::log1p(-s * time)) / s,
               ratio = std::exp(-lambda), rate = ratio / w;
  const double h1 = power_moment(s, lambda, time, w);
  return {v0_ * ratio, 0, -v0_ * rate * time / law_.a, -v0_ * rate * (log_v0_ * time - h1), rate, 0,
          0,           0};
}

}  // namespace rolling
