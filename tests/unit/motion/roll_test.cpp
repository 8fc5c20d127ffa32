// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/roll.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "base/error.h"
#include "unit/catch.h"
#include "unit/exact_body.h"

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

Roll roll(const Reference& r) {
  return {exact_body({1, 0.04, r.K}, r.exact), PowerLaw{r.a, r.b}, r.v0};
}

/// The time in which a body would lose its speed at the deceleration of v0.
double unit_time(const Reference& r) {
  const double d = r.a * std::pow(r.v0, r.b) / 0.04, A = r.exact ? std::sqrt(1 - d * d) : 1;
  return r.v0 * (r.K + A) / (9.81 * d);
}

}  // namespace

TEST_CASE("Roll: speed, distance and derivatives against quadrature with 40 digits", "[rolling]") {
  for (const Reference& r : references) {
    const auto s = roll(r).at(r.t);
    // x of the first rows is a millionth of the way, and its derivatives are the square of that.
    const double T = unit_time(r), way = std::max(r.x, r.v0 * T);
    INFO("exact " << r.exact << " K " << r.K << " a " << r.a << " b " << r.b << " v0 " << r.v0
                  << " t " << r.t);
    CHECK(std::abs(s.v - r.v) <= 1e-13 * r.v0);
    CHECK(std::abs(s.x - r.x) <= 1e-14 * way);
    // What an error eps of t makes of v, relatively.
    const double condition = 1 + r.t * std::abs(s.a) / r.v;
    const auto close = [&](double value, double expected, double scale) {
      CHECK(std::abs(value - expected) <= (1e-9 + 40 * eps * condition) * scale);
    };
    // d/db changes its sign where ln(u) does.
    const double log_u = std::abs(std::log(r.v0)) + std::abs(std::log(r.v));
    const double of_v = std::abs(r.v_a) + r.v0 / r.a, of_x = std::abs(r.x_a) + way / r.a;
    close(s.v_c[0], r.v_a, of_v);
    close(s.v_c[1], r.v_b, r.a * of_v * log_u);
    close(s.v_v0, r.v_v0, 1 + r.v_v0);
    close(s.x_c[0], r.x_a, of_x);
    close(s.x_c[1], r.x_b, r.a * of_x * log_u);
    close(s.x_v0, r.x_v0, T + r.x_v0);
  }
}

TEST_CASE("Roll: after the stop the speed is 0, and the place is where the derivatives lead",
          "[rolling]") {
  for (const bool is_exact : {false, true})
    for (const double b : {-0.01, 0.0, 0.215, 0.9}) {
      const Body body{1, 0.04, 0.5};
      const PowerLaw law{8e-3, b};
      Roll trajectory(exact_body(body, is_exact), law, 0.7);
      const double T = trajectory.stop_time();
      for (const double t : {T, std::nextafter(T, 1e9), 2 * T, 1e300}) {
        const auto s = trajectory.at(t);
        CHECK(s.v == 0);
        CHECK((s.v_c[0] == 0 && s.v_c[1] == 0 && s.v_v0 == 0));
      }
      const auto stopped = trajectory.at(2 * T), rolling = trajectory.at(T * (1 - 1e-12));
      CHECK(rolling.v > 0);
      CHECK(std::abs(rolling.x / stopped.x - 1) < 1e-12);
      const double h = 1e-6;
      const auto x = [&](double a, double bb, double v0) {
        return Roll(exact_body(body, is_exact), PowerLaw{a, bb}, v0).at(1e9).x;
      };
      const double x_a =
          (x(law.a * (1 + h), b, 0.7) - x(law.a * (1 - h), b, 0.7)) / (2 * h * law.a);
      const double x_b = (x(law.a, b + h, 0.7) - x(law.a, b - h, 0.7)) / (2 * h),
                   x_v0 = (x(law.a, b, 0.7 + h) - x(law.a, b, 0.7 - h)) / (2 * h);
      CHECK(std::abs(stopped.x_c[0] / x_a - 1) < 1e-8);
      CHECK(std::abs(stopped.x_c[1] / x_b - 1) < 1e-8);
      CHECK(std::abs(stopped.x_v0 / x_v0 - 1) < 1e-8);
    }
}

TEST_CASE("Roll: at the last speed of a falling mat the derivatives are those of differences",
          "[rolling]") {
  // a u^b = R |slope| at the last speed u, so that it changes by -u/(a b) with a, and x with it.
  const double a = 1e-3, b = 0.5, slope = -0.0125, h = 1e-5;
  const auto at = [&](double by_a, double by_b, double by_slope, double by_v0, double t) {
    Body body{1, 0.04, 0.5};
    body.slope = slope + by_slope;
    return Roll(body, PowerLaw{a + by_a, b + by_b}, 0.5 + by_v0).at(t);
  };
  for (const double t : {10., 1e3, 1e5}) {
    const auto s = at(0, 0, 0, 0, t);
    if (t > 10) CHECK(std::abs(s.v - 0.25) < 1e-12);
    const auto close = [&](double derivative, double of, const auto& more, const auto& less) {
      const double difference = (more.x - less.x) / (2 * of);
      CHECK(std::abs(derivative - difference) < 1e-6 * std::abs(difference));
    };
    close(s.x_c[0], h * a, at(h * a, 0, 0, 0, t), at(-h * a, 0, 0, 0, t));
    close(s.x_c[1], h, at(0, h, 0, 0, t), at(0, -h, 0, 0, t));
    close(s.x_c[2], h * slope, at(0, 0, h * slope, 0, t), at(0, 0, -h * slope, 0, t));
    close(s.x_v0, h, at(0, 0, 0, h, t), at(0, 0, 0, -h, t));
  }
}

TEST_CASE("Roll: D = a v on a falling mat, with its derivatives, is the closed form", "[rolling]") {
  // v' = -k (v - u), k = g cos a/(R (K + 1)), with the last speed u = R |S|/a.
  const double a = 1e-3, S = -0.0125;
  Body body{1, 0.04, 0.5};
  body.slope = S;
  const double u = -body.R * S / a, k = body.g / std::sqrt(1 + S * S) * a / body.R / (body.K + 1);
  for (const double v0 : {1.5, 0.1, u, u * (1 + 1e-9), u * (1 - 1e-12)}) {
    Roll roll(body, PowerLaw{a, 1}, v0);
    CHECK(std::abs(roll.last_speed() / u - 1) < 1e-14);
    for (double kt = 0.1; kt < 1e6; kt *= 1.2) {
      const double t = kt / k, fade = std::exp(-kt), once = -std::expm1(-kt) / k, w = v0 - u;
      const double v_a = -(once * k * u + w * kt * fade) / a,
                   x_a = -(u * t - u * once) / a + w * (t * fade - once) / a;
      const auto s = roll.at(t);
      INFO("v0 " << v0 << " kt " << kt);
      CHECK(std::abs(s.v - (u + w * fade)) < 1e-13);
      CHECK(std::abs(s.x - (u * t + w * once)) < 1e-13 * (v0 + u) * t);
      CHECK(std::abs(s.v_v0 - fade) < 1e-9);
      CHECK(std::abs(s.x_v0 - once) < 1e-9 * once);
      CHECK(std::abs(s.v_c[0] - v_a) < 1e-9 * (v0 + u) / a);
      CHECK(std::abs(s.x_c[0] - x_a) < 1e-9 * (v0 + u) / a * t);
    }
  }
}

TEST_CASE("Roll: D = a sqrt v on a falling mat, with its derivatives, is the closed form",
          "[rolling]") {
  // w = sqrt v falls as w' = -k (w - s)/(2 w), with s = R |S|/a; its time and what follows from it
  // are closed in L = ln((w - s)/(w0 - s)).
  const double a = 1e-3, S = -0.0125;
  Body body{1, 0.04, 0.5};
  body.slope = S;
  const double s = -body.R * S / a, k = body.g / std::sqrt(1 + S * S) * a / body.R / (body.K + 1);
  for (const double w0 : {1.5 * s, 0.7 * s, s * (1 + 1e-9)}) {
    Roll roll(body, PowerLaw{a, 0.5}, w0 * w0);
    for (double L = -0.1; L > -60; L -= 0.37) {
      const double d = (w0 - s) * std::exp(L), w = s + d, kt = -2 * (d - (w0 - s) + s * L),
                   v_a = (-kt * d + 2 * s * (d * L - s + d * s / (w0 - s))) / a;
      const auto at = roll.at(kt / k);
      INFO("w0 " << w0 << " L " << L);
      CHECK(std::abs(at.v - w * w) < 1e-13);
      CHECK(std::abs(at.v_v0 - std::exp(L)) < 1e-8);
      CHECK(std::abs(at.v_c[0] - v_a) < 2e-8 * w0 * w0 / a);
    }
  }
}

TEST_CASE("Roll: at t = 0 it is where it starts", "[rolling]") {
  for (const bool is_exact : {false, true})
    for (const double a : {1e-3, 0.04}) {
      const auto s = Roll(exact_body({1, 0.04, 0.5}, is_exact), PowerLaw{a, 0.3}, 1).at(0);
      CHECK((s.v == 1 && s.x == 0 && s.v_v0 == 1));
      CHECK((s.v_c[0] == 0 && s.v_c[1] == 0 && s.x_c[0] == 0 && s.x_c[1] == 0 && s.x_v0 == 0));
    }
}

TEST_CASE("Roll: finite and monotone on random laws, up to D = R and down to rest", "[rolling]") {
  std::mt19937_64 random(4);
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(random);
  };
  for (int i = 0; i < 3000; ++i) {
    const double b = i % 7 == 0 ? 1 + between(-1e-15, 1e-15) : between(-0.5, 3),
                 v0 = std::pow(10, between(-6, 3)), K = between(0, 1);
    const double depth = i % 3 ? std::pow(10, between(-9, 0)) : 1;
    const bool is_exact = i % 2 == 1;
    const PowerLaw law{0.04 * depth * std::pow(v0, -b) * (1 - 1e-12), b};
    Roll trajectory(exact_body({1, 0.04, K}, is_exact), law, v0);
    double v = v0 * (1 + 1e-12), x = -1;
    const double unit = v0 * 0.04 / (9.81 * law(v0));
    for (double t = 1e-12 * unit; t < 1e9 * unit; t *= 3) {
      INFO("i " << i << " b " << b << " K " << K << " depth " << depth << " t/unit " << t / unit);
      Roll::Point s{};
      s = trajectory.at(t);
      REQUIRE((s.v >= 0 && s.v <= v * (1 + 4 * eps)));
      REQUIRE((s.x >= x * (1 - 4 * eps) && s.x <= v0 * (t + 1e-14 * unit)));
      for (const double d : {s.v_c[0], s.v_c[1], s.v_v0, s.x_c[0], s.x_c[1], s.x_v0})
        REQUIRE(std::isfinite(d));
      v = s.v, x = s.x;
    }
  }
}

TEST_CASE("Roll: speeds beyond all use", "[rolling]") {
  for (const bool is_exact : {false, true})
    for (const double v0 : {1e-300, 1e-150, 1e-30, 1e30, 1e150})
      for (const double b : {-0.5, 0.215, 1 - 1e-15, 1.0, 1.5, 3.0}) {
        const double a = std::pow(v0, -b) * 1e-3;
        if (a < 1e-300 || a > 1e300) continue;
        INFO("v0 " << v0 << " b " << b);
        Roll trajectory(exact_body({1, 0.04, 0.5}, is_exact), PowerLaw{a, b}, v0),
            unit(exact_body({1, 0.04, 0.5}, is_exact), PowerLaw{1e-3, b}, 1);
        // The law has no scale: v/v0 depends on t/v0 alone.
        const auto s = trajectory.at(2 * v0), u = unit.at(2);
        CHECK(std::abs(s.v / v0 - u.v) <= 1e-12);
        if (v0 > 1e-300) CHECK(std::abs(s.x / v0 / v0 - u.x) <= 1e-12 * u.x);
        CHECK(std::abs(s.v_v0 - (u.v_v0)) <= 1e-12);
      }
  const auto frozen = Roll({1, 0.04, 0.5}, PowerLaw{1e-3, 3}, 1e-300).at(5);
  CHECK((frozen.v == 1e-300 && frozen.x == 5e-300 && frozen.v_v0 == 1 && frozen.x_v0 == 5));
}

TEST_CASE("Roll: where D stays R, the roll and its derivatives against quadrature", "[rolling]") {
  struct {
    double K, a, b, v0, S, t, radius_time, stop, v, x;
    double v_a, v_b, v_v0, v_S, x_a, x_b, x_v0, x_S;
  } const rolls[] = {
#include "unit/motion/radius_reference.inc"
  };
  for (const auto& r : rolls) {
    Roll roll(exact_body({1, 0.04, r.K, 9.81, r.S}), PowerLaw{r.a, r.b}, r.v0);
    CAPTURE(r.K, r.b, r.S, r.t);
    const auto p = roll.at(r.t);
    const double error = 20 * eps;
    CHECK(roll.radius_time(r.stop) == Approx(r.radius_time).epsilon(error));
    CHECK(roll.stop_time() == Approx(r.stop).epsilon(error));
    CHECK(p.v == Approx(r.v).epsilon(0).margin(1e-13 * r.v0));
    CHECK(p.x == Approx(r.x).epsilon(error));
    // Where A should be 0 it is some sqrt(2 eps).
    const double of_root = 1e-8;
    const double log_u = std::abs(std::log(r.v0)) + std::abs(std::log(roll.radius_speed()));
    CHECK(p.v_c[0] == Approx(r.v_a).epsilon(of_root));
    CHECK(p.v_c[1] == Approx(r.v_b).epsilon(0).margin(of_root * log_u * std::abs(r.a * r.v_a)));
    CHECK(p.v_v0 == Approx(r.v_v0).epsilon(1e-11));
    CHECK(p.v_c[2] == Approx(r.v_S).epsilon(of_root));
    CHECK(p.x_c[0] == Approx(r.x_a).epsilon(of_root));
    CHECK(p.x_c[1] == Approx(r.x_b).epsilon(0).margin(of_root * log_u * std::abs(r.a * r.x_a)));
    CHECK(p.x_v0 == Approx(r.x_v0).epsilon(1e-12));
    CHECK(p.x_c[2] == Approx(r.x_S).epsilon(of_root));
  }
}

TEST_CASE("Roll: the place of rest is a continuous function of b, through b = 0", "[rolling]") {
  const auto rest = [](double b) {
    return Roll(exact_body({1, 0.04, 0.5}), PowerLaw{2e-3, b}, 0.5).at(10);
  };
  // A step further is where the derivatives at both ends of the step lead (trapezoid rule).
  for (double b = -0.6; b < 0.1; b += 1e-3) {
    const auto here = rest(b), next = rest(b + 1e-3);
    CAPTURE(b);
    CHECK(next.x - here.x == Approx((here.x_c[1] + next.x_c[1]) / 2 * 1e-3).epsilon(1e-5));
  }
}

TEST_CASE("Roll: with A = 1 a roll that stays passes the radius, on a slope too", "[rolling]") {
  // v' = -g cos(theta) (D + R S)/((K + 1) R) is the same for a body of n R on a slope S/n under the
  // gravity n g cos(theta)/cos(theta/n).
  constexpr double n = 1e3, R = 0.04;
  for (const double S : {0.0, 0.03, -0.03})
    for (const double b : {-0.2, 0.0, 0.215, 1.5}) {
      const PowerLaw law{1.6 * R, b};  // at 2 m/s D is 1.4 R to 4.5 R
      const double g = n * 9.81 * std::hypot(1, S / n) / std::hypot(1, S);
      const auto is_exact = false;
      Roll roll(exact_body({1, R, 0.5, 9.81, S}, is_exact), law, 2),
          wide(exact_body({1, n * R, 0.5, g, S / n}, is_exact), law, 2);
      CAPTURE(S, b);
      for (const double t : {0.05, 0.1, 0.2}) {
        const auto p = roll.at(t), q = wide.at(t);
        CHECK(p.v == Approx(q.v).epsilon(1e-12).margin(1e-14));
        CHECK(p.x == Approx(q.x).epsilon(1e-13));
        CHECK(p.v_c[0] == Approx(q.v_c[0]).epsilon(1e-10).margin(1e-12));
        CHECK(p.x_c[1] == Approx(q.x_c[1]).epsilon(1e-11));
      }
      CHECK_THROWS_AS(Roll(exact_body({1, R, 0.5, 9.81, S}), law, 2), Error);
    }
}

TEST_CASE("Roll: refusals", "[rolling]") {
  const Body body{1, 0.04, 0.5};
  const PowerLaw law{1e-3, 0.2};
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  const auto refused = [&](Body c, PowerLaw l, double v0) {
    CHECK_THROWS_AS(check_roll(c, l, v0), Error);
    if (l.a == law.a && l.b == law.b)
      for (const bool is_exact : {false, true})
        CHECK_THROWS_AS(Roll(exact_body(c, is_exact), l, v0), Error);
  };
  for (const double bad : {nan, infinite, -infinite, -1.0}) {
    refused({1, bad, 0.5}, law, 0.5);
    refused({1, 0.04, bad}, law, 0.5);
    refused({1, 0.04, 0.5, bad}, law, 0.5);
    refused(body, {bad, 0.2}, 0.5);
    refused(body, law, bad);
    if (bad != -1) refused(body, {1e-3, bad}, 0.5);
    if (bad != -1) refused({1, 0.04, 0.5, 9.81, bad}, law, 0.5);
  }
  refused({1, 0, 0.5}, law, 0.5);
  refused({1, 0.04, 0.5, 0}, law, 0.5);
  refused(body, {0, 0.2}, 0.5);
  refused(body, {0.041, 0.2}, 1);
  for (const bool is_exact : {false, true})
    CHECK_NOTHROW(Roll(exact_body(body, is_exact), PowerLaw{0.04, 0.2}, 1));
  CHECK_THROWS_AS(Roll(exact_body({1, 0.04, 0}), PowerLaw{0.04, 0.2}, 1), Error);
}
