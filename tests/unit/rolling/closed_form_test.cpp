#include "rolling/closed_form.h"

#include <cmath>
#include <limits>

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
const Body cylinder{1.375, 0.04, 0.5}, shell{1.375, 0.04, 0.83};

}  // namespace

TEST_CASE("ClosedForm: Eq. 13 as the paper prints it", "[rolling]") {
  for (const Body& body : {cylinder, shell})
    for (const double b : {-0.3, 0.0, 0.0244, 0.215, 0.6, 1.4, 2.0, 2.5})
      for (const double v0 : {0.02, 0.5, 3.0}) {
        const double a = 1.87e-3;
        ClosedForm motion(body, {a, b}, v0, 0.25);
        const long double ac = 1.0L * a * body.g / ((1.0L + body.K) * body.R), s = 1.0L - b;
        const double end = std::isinf(motion.stop_time()) ? 50 : 0.99 * motion.stop_time();
        if (b < 1) CHECK(std::abs(motion.stop_time() / static_cast<double>(std::pow(1.0L * v0, s) / (s * ac)) - 1) <= 4 * eps);
        for (int i = 1; i <= 20; ++i) {
          const double t = end * i / 20;
          motion.seek(t);
          const long double v = std::pow(std::pow(1.0L * v0, s) - s * ac * t, 1 / s);
          const long double x = b == 2 ? std::log(v0 / v) / ac : (std::pow(1.0L * v0, 2.0L - b) - std::pow(v, 2.0L - b)) / (ac * (2.0L - b));
          INFO("K " << body.K << " b " << b << " v0 " << v0 << " t " << t);
          const double condition = 1 + t * static_cast<double>(ac * std::pow(v, b - 1.0L));
          CHECK(std::abs(motion.velocity() / static_cast<double>(v) - 1) <= 8 * eps * condition);
          CHECK(std::abs(motion.position() - 0.25 - static_cast<double>(x)) <= 8 * eps * static_cast<double>(x) + eps);
          if (a * std::pow(motion.velocity(), b) > body.R) continue;
          CHECK(motion.shift() == a * std::pow(motion.velocity(), b));
          CHECK(std::abs(motion.acceleration() + static_cast<double>(ac) * std::pow(motion.velocity(), b)) <= 4 * eps * -motion.acceleration());
        }
      }
}

TEST_CASE("ClosedForm: b = 1 and its neighbours are the exponential", "[rolling]") {
  for (const double b : {1 - 1e-15, 1 - eps / 2, 1.0, 1 + eps, 1 + 1e-15}) {
    ClosedForm motion(cylinder, {1.87e-3, b}, 0.5, 0);
    const double rate = 1.87e-3 * 9.81 / (1.5 * 0.04);
    for (const double t : {1e-9, 0.1, 1.0, 10.0, 100.0}) {
      motion.seek(t);
      const double difference = std::abs(1 - b) * rate * t * (rate * t + 1);  // of first order in 1 - b
      CHECK(std::abs(motion.velocity() / (0.5 * std::exp(-rate * t)) - 1) <= difference + 16 * eps * (1 + rate * t));
      CHECK(std::abs(motion.position() / (-0.5 * std::expm1(-rate * t) / rate) - 1) <= difference + 8 * eps);
    }
    CHECK((b < 1 ? motion.stop_time() > 1e14 : std::isinf(motion.stop_time())));
  }
}

TEST_CASE("ClosedForm: the paper's scenes stop later than the exact ones by what model.md says", "[rolling]") {
  CHECK(std::abs(ClosedForm(cylinder, {1.87e-3, 0.215}, 0.5, 0).stop_time() / 2.41718911155359 - 1.00035) < 5e-6);
  CHECK(std::abs(ClosedForm(shell, {1.78e-3, 0.255}, 0.5, 0).stop_time() / 3.35660676251978 - 1.00023) < 5e-6);
  CHECK(std::abs(ClosedForm(shell, {5.75e-4, 0.0244}, 0.5, 0).stop_time() / 6.7638660251676 - 1.00005) < 5e-6);
}

TEST_CASE("ClosedForm: from the stop on it is at rest, to the last bit", "[rolling]") {
  ClosedForm motion(cylinder, {1.87e-3, 0.215}, 0.5, 1);
  const double T = motion.stop_time();
  motion.seek(std::nextafter(T, 0));
  CHECK(motion.velocity() > 0);
  const double x = motion.position();
  for (const double t : {T, std::nextafter(T, 10), 100.0}) {
    motion.seek(t);
    CHECK((motion.velocity() == 0 && motion.acceleration() == 0 && motion.shift() == 0));
    CHECK_FALSE(std::signbit(motion.acceleration()));
    CHECK(std::abs(motion.position() - x) <= eps);
  }
}

TEST_CASE("ClosedForm: a speed so low that the mat takes longer than a double can say", "[rolling]") {
  ClosedForm motion(cylinder, {1.87e-3, 3}, 1e-300, 0);
  motion.seek(5);
  CHECK((motion.position() == 5e-300 && motion.velocity() == 1e-300 && motion.acceleration() == 0));
}

TEST_CASE("ClosedForm: at rest from the start", "[rolling]") {
  for (const double b : {-0.5, 0.0, 0.215, 1.0, 2.0}) {
    ClosedForm motion(cylinder, {1.87e-3, b}, 0, 0.7);
    CHECK(motion.stop_time() == 0);
    motion.seek(3);
    CHECK((motion.velocity() == 0 && motion.position() == 0.7 && motion.acceleration() == 0 && motion.shift() == 0));
  }
}

TEST_CASE("ClosedForm: what has no meaning is refused", "[rolling]") {
  CHECK_THROWS_AS(ClosedForm(cylinder, {1.87e-3, 0.215}, -0.5, 0), Error);
  CHECK_THROWS_AS(ClosedForm(cylinder, {1.87e-3, 0.215}, 0.5, std::nan("")), Error);
  CHECK_THROWS_AS(ClosedForm(cylinder, {0.05, 0}, 0.5, 0), Error);
}
