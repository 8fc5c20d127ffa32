#include "motion/trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

struct Reference {
  int exact;
  double K, a, b, v0, t, v, x, v_a, v_b, v_v0, x_a, x_b, x_v0;
};

const Reference references[] = {
#include "unit/motion/trajectory_reference.inc"
};

constexpr double eps = std::numeric_limits<double>::epsilon();

Trajectory roll(const Reference& r) {
  return {{1, 0.04, r.K}, r.exact ? Geometry::exact : Geometry::approximate, {r.a, r.b}, r.v0};
}

/// What an error eps of t makes of v, relatively: 1 + t |dv/dt| / v (Eq. 12).
double condition(const Reference& r) {
  const double d = r.a * std::pow(r.v, r.b) / 0.04, A = r.exact ? std::sqrt(1 - d * d) : 1;
  return 1 + r.t * 9.81 * d / (r.K + A) / r.v;
}

}  // namespace

TEST_CASE("Trajectory: speed, distance and derivatives against quadrature with 40 digits",
          "[rolling]") {
  for (const Reference& r : references) {
    const auto s = roll(r).at(r.t);
    const double tolerance = 20 * eps * condition(r);
    const auto close = [&](double value, double expected, double scale) {
      return std::abs(value - expected) <= tolerance * scale;
    };
    INFO("exact " << r.exact << " K " << r.K << " a " << r.a << " b " << r.b << " v0 " << r.v0
                  << " t " << r.t);
    CHECK(close(s.v, r.v, r.v));
    CHECK(close(s.x, r.x, r.x));
    CHECK(close(roll(r).distance_at(r.t), r.x, r.x));
    CHECK(close(s.v_a, r.v_a, std::abs(r.v_a)));
    CHECK(close(s.v_v0, r.v_v0, std::abs(r.v_v0)));
    CHECK(close(s.x_a, r.x_a, std::abs(r.x_a)));
    CHECK(close(s.x_v0, r.x_v0, std::abs(r.x_v0)));
    // d/db changes its sign where ln(u) does.
    const double log_u = std::abs(std::log(r.v0)) + std::abs(std::log(r.v));
    CHECK(close(s.v_b, r.v_b, std::abs(r.a * r.v_a) * log_u));
    CHECK(close(s.x_b, r.x_b, std::abs(r.a * r.x_a) * log_u));
    const auto speed = roll(r).speed_at(r.t);
    CHECK(close(speed.v, r.v, r.v));
    CHECK(close(speed.v_a, r.v_a, std::abs(r.v_a)));
    CHECK(close(speed.v_b, r.v_b, std::abs(r.a * r.v_a) * log_u));
    CHECK(close(speed.v_v0, r.v_v0, std::abs(r.v_v0)));
  }
}

TEST_CASE("Trajectory: after the stop the speed is 0, and the place is where the derivatives lead",
          "[rolling]") {
  for (const Geometry geometry : {Geometry::approximate, Geometry::exact})
    for (const double b : {-0.01, 0.0, 0.215, 0.9}) {
      const Body body{1, 0.04, 0.5};
      const PowerLaw law{8e-3, b};
      const Trajectory trajectory(body, geometry, law, 0.7);
      const double T = trajectory.stop_time();
      for (const double t : {T, std::nextafter(T, 1e9), 2 * T, 1e300}) {
        const auto s = trajectory.at(t);
        CHECK(s.v == 0);
        CHECK((s.v_a == 0 && s.v_b == 0 && s.v_v0 == 0));
        CHECK(trajectory.distance_at(t) == s.x);
      }
      const auto stopped = trajectory.at(2 * T), rolling = trajectory.at(T * (1 - 1e-12));
      CHECK(rolling.v > 0);
      CHECK(std::abs(rolling.x / stopped.x - 1) < 1e-12);
      const double h = 1e-6;
      const auto x = [&](double a, double bb, double v0) {
        return Trajectory(body, geometry, {a, bb}, v0).at(1e9).x;
      };
      const double x_a =
          (x(law.a * (1 + h), b, 0.7) - x(law.a * (1 - h), b, 0.7)) / (2 * h * law.a);
      const double x_b = (x(law.a, b + h, 0.7) - x(law.a, b - h, 0.7)) / (2 * h),
                   x_v0 = (x(law.a, b, 0.7 + h) - x(law.a, b, 0.7 - h)) / (2 * h);
      CHECK(std::abs(stopped.x_a / x_a - 1) < 1e-8);
      CHECK(std::abs(stopped.x_b / x_b - 1) < 1e-8);
      CHECK(std::abs(stopped.x_v0 / x_v0 - 1) < 1e-8);
    }
}

TEST_CASE("Trajectory: at t = 0 it is where it starts", "[rolling]") {
  for (const Geometry geometry : {Geometry::approximate, Geometry::exact})
    for (const double a : {1e-3, 0.04}) {
      const auto s = Trajectory({1, 0.04, 0.5}, geometry, {a, 0.3}, 1).at(0);
      CHECK((s.v == 1 && s.x == 0 && s.v_v0 == 1));
      CHECK((s.v_a == 0 && s.v_b == 0 && s.x_a == 0 && s.x_b == 0 && s.x_v0 == 0));
    }
}

TEST_CASE("Trajectory: finite and monotone on random laws, up to D = R and down to rest",
          "[rolling]") {
  std::mt19937_64 random(4);
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(random);
  };
  for (int i = 0; i < 3000; ++i) {
    const double b = i % 7 == 0 ? 1 + between(-1e-15, 1e-15) : between(-0.5, 3),
                 v0 = std::pow(10, between(-6, 3)), K = between(0, 1);
    const double depth = i % 3 ? std::pow(10, between(-9, 0)) : 1;
    const Geometry geometry = i % 2 ? Geometry::exact : Geometry::approximate;
    const PowerLaw law{0.04 * depth * std::pow(v0, -b) * (1 - 1e-12), b};
    const Trajectory trajectory({1, 0.04, K}, geometry, law, v0);
    double v = v0 * (1 + 1e-12), x = -1;
    const double unit = v0 * 0.04 / (9.81 * law(v0));
    for (double t = 1e-12 * unit; t < 1e9 * unit; t *= 3) {
      INFO("i " << i << " b " << b << " K " << K << " depth " << depth << " t/unit " << t / unit);
      Trajectory::Point s{};
      try {
        s = trajectory.at(t);
      } catch (const Error&) {
        REQUIRE((geometry == Geometry::exact && b < 0));
        break;
      }
      REQUIRE((s.v >= 0 && s.v <= v && s.x >= x * (1 - 4 * eps) && s.x <= v0 * t * (1 + 1e-14)));
      for (const double d : {s.v_a, s.v_b, s.v_v0, s.x_a, s.x_b, s.x_v0}) REQUIRE(std::isfinite(d));
      v = s.v, x = s.x;
    }
  }
}

TEST_CASE("Trajectory: speeds beyond all use", "[rolling]") {
  for (const Geometry geometry : {Geometry::approximate, Geometry::exact})
    for (const double v0 : {1e-300, 1e-150, 1e-30, 1e30, 1e150})
      for (const double b : {-0.5, 0.215, 1 - 1e-15, 1.0, 1.5, 3.0}) {
        const double a = std::pow(v0, -b) * 1e-3;
        if (a < 1e-300 || a > 1e300) continue;
        INFO("v0 " << v0 << " b " << b);
        const Trajectory trajectory({1, 0.04, 0.5}, geometry, {a, b}, v0),
            unit({1, 0.04, 0.5}, geometry, {1e-3, b}, 1);
        // The law has no scale: v/v0 depends on t/v0 alone.
        const auto s = trajectory.at(2 * v0), u = unit.at(2);
        CHECK(std::abs(s.v / v0 - u.v) <= 1e-12);
        if (v0 > 1e-300) CHECK(std::abs(s.x / v0 / v0 - u.x) <= 1e-12 * u.x);
        CHECK(std::abs(s.v_v0 - (u.v_v0)) <= 1e-12);
      }
  const auto frozen = Trajectory({1, 0.04, 0.5}, Geometry::approximate, {1e-3, 3}, 1e-300).at(5);
  CHECK((frozen.v == 1e-300 && frozen.x == 5e-300 && frozen.v_v0 == 1 && frozen.x_v0 == 5));
}

TEST_CASE("Trajectory: exact geometry with b < 0 ends where D reaches R", "[rolling]") {
  const Body body{1, 0.04, 0.5};
  const Trajectory trajectory(body, Geometry::exact, {2e-3, -0.5}, 0.5);
  CHECK(std::isinf(trajectory.stop_time()));
  CHECK_NOTHROW(trajectory.at(0.5));
  CHECK_THROWS_AS(trajectory.at(5), Error);
  // A = 1 goes on to its stop, but has no shift to show on the way.
  const Trajectory approximate(body, Geometry::approximate, {2e-3, -0.5}, 0.5);
  CHECK(approximate.at(approximate.stop_time()).v == 0);
  CHECK_THROWS_AS(approximate.shift(1e-4), Error);
  CHECK_THROWS_AS(approximate.acceleration(1e-4), Error);
}

TEST_CASE("Trajectory: where D stays R, the roll and its derivatives against quadrature",
          "[rolling]") {
  struct {
    double K, a, b, v0, S, t, radius_time, stop, v, x;
    double v_a, v_b, v_v0, v_S, x_a, x_b, x_v0, x_S;
  } const rolls[] = {
#include "unit/motion/radius_reference.inc"
  };
  using Derivatives = Trajectory::Derivatives;
  for (const auto& r : rolls)
    for (const auto by : {Derivatives::of_law, Derivatives::of_law_and_slope}) {
      const Trajectory roll({1, 0.04, r.K, 9.81, r.S}, Geometry::exact, {r.a, r.b}, r.v0, by,
                            Trajectory::AtRadius::passed);
      CAPTURE(r.K, r.b, r.S, r.t);
      const auto p = roll.at(r.t);
      // v belongs to the time that is left. Where A should be 0 it is some sqrt(2 eps), which is so
      // much of an integral over dA/b, in units of the time that is left at D = R.
      const double error = 20 * eps, s = 1 - r.b,
                   of_v = r.v > 0 ? error * r.stop / (r.stop - r.t) : 0,
                   of_slopes = error + std::sqrt(2 * eps) / -r.b * s *
                                           std::pow(roll.radius_speed() / r.v0, s);
      const double log_u = std::abs(std::log(r.v0)) + std::abs(std::log(roll.radius_speed()));
      CHECK(roll.radius_time() == Approx(r.radius_time).epsilon(error));
      CHECK(roll.stop_time() == Approx(r.stop).epsilon(error));
      CHECK(p.v == Approx(r.v).epsilon(of_v));
      CHECK(roll.speed_at(r.t).v == p.v);
      CHECK(p.x == Approx(r.x).epsilon(error));
      CHECK(roll.distance_at(r.t) == Approx(p.x).epsilon(error));
      CHECK(p.v_a == Approx(r.v_a).epsilon(of_slopes));
      CHECK(p.v_b == Approx(r.v_b).epsilon(0).margin(of_slopes * log_u * std::abs(r.a * r.v_a)));
      CHECK(p.v_v0 == Approx(r.v_v0).epsilon(of_slopes));
      CHECK(p.x_a == Approx(r.x_a).epsilon(of_slopes));
      CHECK(p.x_b == Approx(r.x_b).epsilon(0).margin(of_slopes * log_u * std::abs(r.a * r.x_a)));
      CHECK(p.x_v0 == Approx(r.x_v0).epsilon(of_slopes));
      if (by == Derivatives::of_law && r.S == 0) continue;
      CHECK(p.v_S == Approx(r.v_S).epsilon(of_slopes));
      CHECK(p.x_S == Approx(r.x_S).epsilon(of_slopes));
    }
}

TEST_CASE("Trajectory: the place of rest is a continuous function of b, through b = 0",
          "[rolling]") {
  const auto rest = [](double b) {
    return Trajectory({1, 0.04, 0.5}, Geometry::exact, {2e-3, b}, 0.5,
                      Trajectory::Derivatives::of_law, Trajectory::AtRadius::passed)
        .at(10);
  };
  // A step further is where the derivatives at both ends of the step lead (trapezoid rule).
  for (double b = -0.6; b < 0.1; b += 1e-3) {
    const auto here = rest(b), next = rest(b + 1e-3);
    CAPTURE(b);
    CHECK(next.x - here.x == Approx((here.x_b + next.x_b) / 2 * 1e-3).epsilon(1e-5));
  }
}

TEST_CASE("Trajectory: with A = 1 a roll that stays passes the radius, on a slope too",
          "[rolling]") {
  // v' = -g cos(theta) (D + R S)/((K + 1) R) is the same for a body of n R on a slope S/n under the
  // gravity n g cos(theta)/cos(theta/n).
  constexpr double n = 1e3, R = 0.04;
  using Derivatives = Trajectory::Derivatives;
  for (const double S : {0.0, 0.03, -0.03})
    for (const double b : {-0.2, 0.0, 0.215, 1.5})
      for (const auto by : {Derivatives::of_law, Derivatives::of_law_and_slope}) {
        const PowerLaw law{1.6 * R, b};  // at 2 m/s D is 1.4 R to 4.5 R
        const double g = n * 9.81 * std::hypot(1, S / n) / std::hypot(1, S);
        const auto geometry = Geometry::approximate;
        const Trajectory roll({1, R, 0.5, 9.81, S}, geometry, law, 2, by,
                              Trajectory::AtRadius::passed),
            wide({1, n * R, 0.5, g, S / n}, geometry, law, 2, by);
        CAPTURE(S, b);
        for (const double t : {0.05, 0.1, 0.2}) {
          const auto p = roll.at(t), q = wide.at(t);
          CHECK(p.v == Approx(q.v).epsilon(1e-13));
          CHECK(p.x == Approx(q.x).epsilon(1e-13));
          CHECK(p.v_a == Approx(q.v_a).epsilon(1e-12));
          CHECK(p.x_b == Approx(q.x_b).epsilon(1e-12));
          CHECK(roll.speed_at(t).v == Approx(q.v).epsilon(1e-13));
          if (p.v == 0) continue;
          CHECK(roll.shift(p.v) == law(p.v));
          CHECK(roll.acceleration(p.v) == Approx(wide.acceleration(p.v)).epsilon(1e-13));
        }
        CHECK_THROWS_AS(Trajectory({1, R, 0.5, 9.81, S}, geometry, law, 2), Error);
        CHECK_THROWS_AS(Trajectory({1, R, 0.5, 9.81, S}, Geometry::exact, law, 2, by,
                                   Trajectory::AtRadius::passed),
                        Error);
      }
}

TEST_CASE("Trajectory: refusals", "[rolling]") {
  const Body body{1, 0.04, 0.5};
  const PowerLaw law{1e-3, 0.2};
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  for (const Geometry geometry : {Geometry::approximate, Geometry::exact}) {
    const auto refused = [&](Body c, PowerLaw l, double v0) {
      CHECK_THROWS_AS(Trajectory(c, geometry, l, v0), Error);
    };
    for (const double bad : {nan, infinite, -infinite, -1.0}) {
      refused({1, bad, 0.5}, law, 0.5);
      refused({1, 0.04, bad}, law, 0.5);
      refused({1, 0.04, 0.5, bad}, law, 0.5);
      refused(body, {bad, 0.2}, 0.5);
      refused(body, law, bad);
      if (bad != -1) refused(body, {1e-3, bad}, 0.5);
    }
    refused({1, 0, 0.5}, law, 0.5);
    refused({1, 0.04, 0.5, 0}, law, 0.5);
    refused(body, {0, 0.2}, 0.5);
    refused(body, {0.041, 0.2}, 1);
    CHECK_NOTHROW(Trajectory(body, geometry, {0.04, 0.2}, 1));
  }
  CHECK_THROWS_AS(Trajectory({1, 0.04, 0}, Geometry::exact, {0.04, 0.2}, 1), Error);
}
