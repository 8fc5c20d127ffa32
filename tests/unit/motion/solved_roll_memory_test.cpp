// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/solved_roll.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "unit/motion/closed_roll.h"
#include "motion/scene.h"
#include "contact/ledger.h"
#include "unit/catch.h"
#include "unit/exact_body.h"

using namespace rolling;

namespace {

const Body cylinder{1.375, 0.04, 0.5};
const PowerLaw rubber{1.87e-3, 0.215};

Scene scene(Bulge bulge, const Body& body = cylinder, PowerLaw law = rubber, double v0 = 0.5,
            double x0 = 0) {
  return {body, law, bulge, v0, x0};
}

MemoryRoll roll(const Scene& of, Stepper stepper, double rtol = 1e-10,
                unsigned long most_steps = 3'000'000) {
  return {of, stepper, rtol, most_steps};
}

MemoryRoll roll(Bulge bulge, const Body& body = cylinder, PowerLaw law = rubber, double v0 = 0.5,
                double x0 = 0) {
  const Scene of = scene(bulge, body, law, v0, x0);
  return roll(of, memory_stepper(of));
}

struct Backwards {
  double begin, end, lowest, distance;
};

/// The first roll backwards, looked for between t and t + 1 s in steps of 20 us.
Backwards backwards(Motion& motion, double t) {
  Backwards b{0, 0, 0, 0};
  double x_begin = 0;
  for (const double last = t + 1; t < last; t += 2e-5) {
    motion.seek(t);
    const double v = motion.velocity();
    if (b.begin == 0 && v < 0) b.begin = t, x_begin = motion.position();
    if (b.begin > 0) b.lowest = std::min(b.lowest, v);
    if (b.begin > 0 && v >= 0) {
      b.end = t, b.distance = x_begin - motion.position();
      break;
    }
  }
  return b;
}

}  // namespace

TEST_CASE("MemoryRoll: the roll backwards before the rest", "[rolling]") {
  MemoryRoll millimetre = roll({1e-3});
  const Backwards b = backwards(millimetre, 2.3);
  CHECK(std::abs(b.begin - 2.3722) < 5e-5 + 2e-5);
  CHECK(std::abs(b.lowest + 8.98e-3) < 5e-6);
  CHECK(std::abs(b.end - b.begin - 0.315) < 5e-4);
  CHECK(std::abs(b.distance - 1.76e-3) < 5e-6);
  MemoryRoll tenth = roll({1e-4});
  const Backwards c = backwards(tenth, 2.3);
  CHECK(std::abs(c.lowest + 2.47e-3) < 5e-6);
  CHECK(std::abs(c.end - c.begin - 0.114) < 5e-4);
  CHECK(std::abs(c.distance - 0.176e-3) < 5e-7);
}

TEST_CASE("MemoryRoll: tends to the law without memory as the length goes to 0", "[rolling]") {
  const auto difference = [](const Body& body, Motion& law, double length) {
    MemoryRoll motion = roll({length}, body, {0.01, 0.215});
    motion.seek(0.3);
    law.seek(0.3);
    return motion.velocity() - law.velocity();
  };
  const auto closed_owned = closed_roll(cylinder, {0.01, 0.215}, 0.5, 0);
  Motion& closed = *closed_owned;
  const auto exact =
      start({exact_body(cylinder), PowerLaw{0.01, 0.215}, {0}, 0.5, 0}, {Method::exact}, 0);
  for (const auto& [body, law] :
       {std::pair<Body, Motion*>{cylinder, &closed}, {exact_body(cylinder), exact.get()}}) {
    const double coarse = difference(body, *law, 4e-4), fine = difference(body, *law, 1e-4);
    CHECK(std::abs(fine) < 2e-4);
    CHECK(std::abs(coarse / fine - 4) < 0.15);  // first order in the length
  }
}

TEST_CASE("MemoryRoll: every stepper that is fit for it finds the same rest", "[rolling]") {
  for (const double length : {1e-2, 1e-3, 1e-4, 1e-5})
    for (const Bulge bulge : {Bulge{length}, Bulge{length, length / 2}}) {
      const double stop = roll(bulge).stop_time();
      for (const Stepper stepper :
           {gsl_odeiv2_step_rkf45, gsl_odeiv2_step_bsimp, gsl_odeiv2_step_rk4imp}) {
        INFO("length " << length << " damping " << bulge.damping << " stepper " << stepper->name);
        MemoryRoll motion = roll(scene(bulge), stepper);
        CHECK(std::abs(motion.stop_time() / stop - 1) < 1e-6);
      }
    }
}

TEST_CASE("MemoryRoll: the rest does not depend on the units of length and time", "[rolling]") {
  const double stop = roll({1e-3}, exact_body(cylinder)).stop_time();
  for (const double m : {1e-20, 1e-9, 1e-3, 1.0, 1e9})
    for (const double s : {1e-20, 1e-9, 1.0, 1e9}) {
      const Body body{1, 0.04 * m, 0.5, 9.81 * m / (s * s)};
      const PowerLaw law{1.87e-3 * m * std::pow(s / m, 0.215), 0.215};
      for (const Stepper stepper :
           {gsl_odeiv2_step_rk8pd, gsl_odeiv2_step_rk4imp, gsl_odeiv2_step_msbdf}) {
        MemoryRoll motion = roll({exact_body(body), law, {1e-3 * m}, 0.5 * m / s, 0}, stepper);
        INFO("metre " << m << " second " << s << " stepper " << stepper->name);
        CHECK(std::abs(motion.stop_time() / (s * stop) - 1) < 1e-6);
      }
    }
}

// At b = 110 and 1 mm/s the law has no shift that a double can hold.
TEST_CASE("MemoryRoll: a shift that vanishes at v0", "[rolling]") {
  for (const double slope : {0.0, -0.1})
    for (const double b : {50.0, 110.0, 1000.0}) {
      const auto speed = [&](Stepper stepper) {
        const Body body{1, 0.04, 0.5, 9.81, slope};
        MemoryRoll motion = roll({body, PowerLaw{1e-3, b}, {1e-2}, 1e-3, 0}, stepper);
        motion.seek(3);
        return motion.velocity();
      };
      const double by_rk8pd = speed(gsl_odeiv2_step_rk8pd);
      INFO("slope " << slope << " b " << b);
      CHECK(std::abs(speed(gsl_odeiv2_step_rk4imp) - by_rk8pd) < 1e-9);
      CHECK(std::abs(speed(gsl_odeiv2_step_msbdf) - by_rk8pd) < 1e-9);
    }
}

// The bulge stays as it is while the body rolls forwards, and the steps grow until one of them
// leaves the finite numbers.
TEST_CASE("MemoryRoll: under a constant shift too", "[rolling]") {
  for (const double damping : {1e-4, 1e-3, 3e-3}) {
    const auto stop = [&](Stepper stepper) {
      const Bulge bulge{1e-4, damping};
      return roll(scene(bulge, cylinder, {1.87e-3, 0}), stepper).stop_time();
    };
    const double by_rkf45 = stop(gsl_odeiv2_step_rkf45);
    CHECK(std::abs(stop(gsl_odeiv2_step_rk8pd) - by_rkf45) < 1e-8);
    CHECK(std::abs(stop(gsl_odeiv2_step_rk4imp) - by_rkf45) < 1e-8);
  }
}

// Behind the first zero of v a strongly damped bulge under a constant shift has no other: D = z + s
// z' is about 0, so z falls to a thousandth of a within s ln(1000).
TEST_CASE("MemoryRoll: every stepper finds the same rest of a bulge that creeps back",
          "[rolling]") {
  for (const double b : {0.0, 0.1, 0.215})
    for (const double damping : {0.05, 0.1, 0.13, 0.5, 5.0}) {
      const auto stop = [&](Stepper stepper) {
        return roll(scene({1e-3, damping}, cylinder, {1.87e-3, b}), stepper).stop_time();
      };
      const double by_rk8pd = stop(gsl_odeiv2_step_rk8pd);
      INFO("b " << b << " damping " << damping);
      for (const Stepper stepper :
           {gsl_odeiv2_step_rkf45, gsl_odeiv2_step_rk4imp, gsl_odeiv2_step_bsimp})
        CHECK(std::abs(stop(stepper) / by_rk8pd - 1) < 1e-7);
      if (b == 0 && damping >= 0.5) {
        const double rolled = 0.5 / (9.81 * 1.87e-3 / (1.5 * 0.04));
        CHECK(std::abs(by_rk8pd - rolled - damping * std::log(1000)) < 0.04);
      }
    }
}

TEST_CASE("MemoryRoll: stiff lengths take an implicit solver, with few evaluations and damping too",
          "[rolling]") {
  CHECK(memory_stepper(scene({1e-3})) == gsl_odeiv2_step_rk8pd);
  for (const double damping : {0.0, 1e-3, 0.02}) {
    MemoryRoll motion = roll({1e-7, damping});
    CHECK(memory_stepper(scene({1e-7, damping})) == gsl_odeiv2_step_rk4imp);
    const auto law_owned = closed_roll(cylinder, {1.87e-3, 0.215}, 0.5, 0);
    Motion& law = *law_owned;
    motion.seek(2);
    law.seek(2);
    if (damping == 0) CHECK(std::abs(motion.velocity() - law.velocity()) < 1e-7);
    motion.seek(10);
    CHECK(motion.velocity() == 0);
    CHECK(std::abs(motion.stop_time() - law.stop_time()) < 0.5);
    CHECK(motion.evaluations() < 300000);  // rk8pd: 1e7
  }
}

TEST_CASE("MemoryRoll: down to any length the default needs few evaluations and finds the stop",
          "[rolling]") {
  // Of 1e-8 m the stop by rk4imp, whose steps shrink with the length.
  MemoryRoll slow = roll(scene({1e-8}), gsl_odeiv2_step_rk4imp);
  const double known = slow.stop_time();
  CHECK(std::abs(roll({1e-8}).stop_time() - known) < 1e-8 * known);
  // The way differs from that of the law by some lengths and the tolerance of 1e-10, and the stop
  // tends to its stop.
  const auto law_owned = closed_roll(cylinder, rubber, 0.5, 0);
  Motion& law = *law_owned;
  law.seek(3);
  double later = INFINITY;
  for (const double length : {1e-7, 9e-8, 4e-8, 1e-8, 1e-9, 1e-11, 1e-12, 1e-13, 1e-15}) {
    INFO(length);
    MemoryRoll motion = roll({length});
    const double stop = motion.stop_time();
    CHECK(motion.evaluations() < 150000);
    CHECK(stop > law.stop_time());
    CHECK(stop - law.stop_time() < later);
    later = stop - law.stop_time();
    motion.seek(3);
    CHECK(std::abs(motion.position() - law.position()) < 5 * length + 2e-10);
  }
  CHECK(later < 1e-6 * law.stop_time());
  // Both sides of the limit: the ratio of the times is 0.95 / length.
  CHECK(memory_stepper(scene({5e-8})) == gsl_odeiv2_step_rk4imp);
  CHECK(memory_stepper(scene({4.5e-8})) == gsl_odeiv2_step_bsimp);
}

TEST_CASE("MemoryRoll: rest is rest, and comes sooner with damping", "[rolling]") {
  for (const bool is_exact : {false, true}) {
    MemoryRoll motion = roll({1e-3}, exact_body(cylinder, is_exact));
    const double stop = motion.stop_time();
    CHECK(stop > 2.5);
    // No later speed beyond v0/1000 if the integration went on: a law that is at rest later, at a
    // lower speed, shows it.
    MemoryRoll longer = roll({1e-3}, exact_body(cylinder, is_exact));
    double fastest = 0;
    for (int i = 0; i < 200; ++i) {
      longer.seek(stop * (0.9 + i * 1e-3));
      if (stop * (0.9 + i * 1e-3) < stop) fastest = std::max(fastest, std::abs(longer.velocity()));
    }
    CHECK(fastest > 0);
    CHECK(fastest < 1e-3);
    motion.seek(std::nextafter(stop, 0));
    CHECK(std::abs(motion.velocity()) < 1e-9);  // it is a zero of v
    const double x = motion.position();
    for (const double t : {stop, stop + 1, 1e6}) {
      motion.seek(t);
      CHECK((motion.velocity() == 0 && motion.shift() == 0 && motion.acceleration() == 0));
      CHECK(std::abs(motion.position() - x) < 1e-12);
    }
    CHECK(roll({1e-3, 0.02}, exact_body(cylinder, is_exact)).stop_time() < 0.7 * stop);
  }
}

TEST_CASE("MemoryRoll: shift and acceleration are those of the moving bulge", "[rolling]") {
  for (const bool is_exact : {false, true}) {
    MemoryRoll motion = roll({5e-3, 5e-3}, exact_body(cylinder, is_exact), {0.02, 0.215});
    for (const double t : {0.01, 0.1, 0.2, 0.35, 0.5}) {
      const double h = 1e-4;
      motion.seek(t - h);
      const double before = motion.velocity();
      motion.seek(t);
      const double a = motion.acceleration(), D = motion.shift();
      motion.seek(t + h);
      CHECK(std::abs((motion.velocity() - before) / (2 * h) - a) < 1e-5 * (1 + std::abs(a)));
      const double A = is_exact ? std::sqrt(1 - D * D / 0.0016) : 1;
      CHECK(std::abs(a + 9.81 * D / ((0.5 + A) * 0.04)) < 1e-12);
    }
  }
}

TEST_CASE("MemoryRoll: seeking does not depend on the stops on the way, nor on stop_time()",
          "[rolling]") {
  MemoryRoll direct = roll({1e-3}), steps = roll({1e-3}), asked = roll({1e-3});
  asked.stop_time();
  direct.seek(3);
  asked.seek(3);
  for (int i = 1; i <= 300; ++i) steps.seek(0.01 * i);
  CHECK(direct.velocity() == asked.velocity());
  CHECK(std::abs(direct.velocity() - steps.velocity()) < 1e-10);
  CHECK(std::abs(direct.position() - steps.position()) < 1e-10);
}

TEST_CASE(
    "MemoryRoll: the outflow is the energy of the start (Eq. 23), the gift of the roll backwards "
    "included",
    "[rolling]") {
  for (const bool is_exact : {false, true}) {
    MemoryRoll motion = roll({1e-3}, exact_body(cylinder, is_exact), {0.02, 0.215});
    const double energy = 0.5 * 1.5 * cylinder.m * 0.25, dt = 1e-5;
    double sum = 0, back = 0;
    for (int i = 0; i * dt < 1.5; ++i) {
      motion.seek((i + 0.5) * dt);
      const double P =
          Ledger(exact_body(cylinder, is_exact), motion.velocity(), motion.shift()).P_diss() * dt;
      sum += P;
      back = std::min(back, P);
    }
    const double left = 0.5 * 1.5 * cylinder.m * motion.velocity() * motion.velocity();
    CHECK(std::abs((sum + left) / energy - 1) < 1e-7);
    CHECK(back < 0);
  }
}

TEST_CASE("MemoryRoll: at rest from the start, never at rest, and refusals", "[rolling]") {
  MemoryRoll rest = roll({1e-3}, cylinder, rubber, 0, 0.3);
  CHECK(rest.stop_time() == 0);
  rest.seek(5);
  CHECK((rest.velocity() == 0 && rest.position() == 0.3 && rest.shift() == 0));
  MemoryRoll never = roll({1e-3}, cylinder, {1.87e-3, 2});
  CHECK(std::isinf(never.stop_time()));
  never.seek(10);
  CHECK(never.velocity() > 0);
  // So long a bulge that v has zeros all the same.
  MemoryRoll swings = roll({5}, cylinder, {1.87e-3, 2});
  swings.seek(1e8);
  CHECK((swings.velocity() != 0 && std::isinf(swings.stop_time())));
  CHECK_THROWS_AS(roll({1e-3}, cylinder, {1.87e-3, -0.1}), Error);
  CHECK_THROWS_AS(start(scene({1e-3}, exact_body(cylinder), {0.05, 0}), {Method::solver}, 1e-10),
                  Error);
}

TEST_CASE("MemoryRoll: too much work is refused", "[rolling]") {
  // An explicit solver is slow where the bulge is short, and is let do it.
  MemoryRoll slow = roll(scene({1e-6}), gsl_odeiv2_step_rk8pd, 1e-6);
  CHECK(std::abs(slow.stop_time() / roll({1e-6}).stop_time() - 1) < 1e-5);
  MemoryRoll never_done = roll(scene({1e-9}), gsl_odeiv2_step_rk8pd, 1e-10, 10'000);
  CHECK_THROWS_AS(never_done.stop_time(), Error);
  CHECK_THROWS_AS(never_done.seek(2), Error);
  MemoryRoll rings = roll(scene({1e300}), gsl_odeiv2_step_rk8pd, 1e-10, 10'000);
  CHECK_THROWS_AS(rings.stop_time(), Error);
  rings.seek(1);  // the roll before it
  CHECK((rings.evaluations() > 0 && rings.evaluations() < 500'000));
}

// The bulge takes up speed: v' = -c (z + damping z') with z near D(v) slows the body down by the
// factor 1 + damping c D'(v) less, and v follows z at the rate damping c D / length.
TEST_CASE("MemoryRoll: a strong damping makes the roll long and stiff", "[rolling]") {
  for (const double damping : {3.0, 30.0}) {
    const Bulge bulge{1e-4, damping};
    INFO("damping " << damping);
    CHECK(memory_stepper(scene(bulge)) == gsl_odeiv2_step_rk4imp);
    MemoryRoll motion = roll(bulge);
    const double stop = motion.stop_time();
    motion.seek(stop);
    CHECK(motion.evaluations() < 500000);  // rk8pd: 6e6
  }
}

// Near the stop v falls like a power of the time that is left. Where v^2 is about length c D(v),
// the bulge no longer follows: v^(2-b) ~ length. From there on the rest takes a time ~ v^(1-b) that
// differs from that without memory, so that its excess is length^((1-b)/(2-b)) times a constant.
TEST_CASE("MemoryRoll: the rest tends to that without memory, at the rate of its equations",
          "[rolling]") {
  for (const double b : {0.0, 0.215, 0.5}) {
    const PowerLaw law{1.87e-3, b};
    const double limit = closed_roll(cylinder, law, 0.5, 0)->stop_time();
    const auto rate = [&](double length) { return std::pow(length, (1 - b) / (2 - b)); };
    const auto stop = [&](double length) {
      MemoryRoll motion = roll({length}, cylinder, law);
      const double result = motion.stop_time();
      motion.seek(result);
      INFO("b " << b << " length " << length);
      CHECK(motion.evaluations() < 100'000);
      return result;
    };
    const double excess = (stop(1e-10) - limit) / rate(1e-10);
    for (double length = 1e-11; length > 1e-19; length *= 0.1) {
      INFO("b " << b << " length " << length << " constant " << excess);
      CHECK(std::abs(stop(length) - (limit + excess * rate(length))) < 1e-8 * limit);
    }
  }
}

TEST_CASE("MemoryRoll: the solver of stiff lengths agrees with the other where both work",
          "[rolling]") {
  for (const double b : {0.0, 0.215, 0.5})
    for (const double length : {1e-3, 1e-4, 1e-5, 1e-6}) {
      const Scene of = scene({length}, exact_body(cylinder), {1.87e-3, b});
      INFO("b " << b << " length " << length);
      CHECK(std::abs(roll(of, gsl_odeiv2_step_bsimp).stop_time() /
                         roll(of, gsl_odeiv2_step_rk8pd).stop_time() -
                     1) < 1e-8);
    }
}
