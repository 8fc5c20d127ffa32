#include "motion/speed_integrals.h"

#include <cmath>
#include <limits>

#include "unit/catch.h"

using namespace rolling;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool close(double x, double y, double tolerance) { return std::abs(x / y - 1) <= tolerance; }

}  // namespace

// The values themselves are checked against quadrature in trajectory_test.cpp.

TEST_CASE("SpeedIntegrals: D(v0) = R, b = 1, where time is (K lambda + artanh A - A) / (K + 1)",
          "[rolling]") {
  for (const double K : {0.5, 0.83}) {
    const SpeedIntegrals integrals(1, K, 1);
    for (const double lambda : {1e-6, 1e-4, 0.1, 0.3, 0.5, 0.7, 5.0, 100.0}) {
      // artanh A = lambda + ln(1 + A); for small A its Taylor series less A
      const double A = std::sqrt(-std::expm1(-2 * lambda));
      const double A_part =
          lambda < 0.001 ? A * A * A * (1. / 3 + A * A * (1. / 5 + A * A * (1. / 7 + A * A / 9)))
                         : lambda + std::log1p(A) - A;
      const double time = (K * lambda + A_part) / (K + 1);
      CHECK(close(integrals.lambda(time, infinity), lambda, 1e-14));
    }
  }
}

TEST_CASE("SpeedIntegrals: the series and the panels are one function", "[rolling]") {
  // z = 1/4 at depth 1/2: across it a straight line, up to its curvature of order h^2.
  const double h = 1e-6;
  for (const double b : {0.0244, 0.215, 0.8}) {
    const auto at = [&](double depth) { return SpeedIntegrals(b, 0.5, depth); };
    const auto line = [&](auto value) {
      return std::abs((value(at(0.5 - h)) - value(at(0.5 + h))) /
                          (value(at(0.5 - 3 * h)) - value(at(0.5 + 3 * h))) -
                      1. / 3);
    };
    CHECK(line([](const SpeedIntegrals& s) { return s.stop(); }) < 1e-7);
    CHECK(line([](const SpeedIntegrals& s) { return s.distance(0.9); }) < 1e-7);
    CHECK(line([](const SpeedIntegrals& s) { return s.gradient(40).h1; }) < 1e-7);
    CHECK(line([](const SpeedIntegrals& s) { return s.gradient(2).g1; }) < 1e-7);
  }
  // b > 0 is summed, b < 0 integrated by panels, b = 0 has A constant.
  const SpeedIntegrals above(1e-14, 0.5, 0.3), below(-1e-14, 0.5, 0.3), zero(0, 0.5, 0.3);
  for (const SpeedIntegrals* s : {&above, &below}) {
    CHECK(close(s->stop(), zero.stop(), 1e-13));
    for (const double lambda : {0.01, 0.4, 3.0, 30.0}) {
      CHECK(close(s->distance(lambda), zero.distance(lambda), 1e-13));
      const auto x = s->gradient(lambda), y = zero.gradient(lambda);
      CHECK(close(x.h0, y.h0, 1e-13));
      CHECK(close(x.h1, y.h1, 1e-13));
      CHECK(close(x.g0, y.g0, 1e-13));
      CHECK(close(x.g1, y.g1, 1e-13));
    }
  }
}

TEST_CASE("SpeedIntegrals: b < 0 ends where D reaches R, or stops if that is too slow to see",
          "[rolling]") {
  const SpeedIntegrals soon(-0.5, 0.5, 0.1);
  CHECK(std::isinf(soon.stop()));
  CHECK(close(soon.lambda(soon.end(), infinity), std::log(10) / 0.5,
              1e-7));  // time is flat there: A = 0
  const SpeedIntegrals never(-0.01, 0.5, 0.1);
  CHECK(std::isinf(never.end()));
  CHECK(never.stop() < SpeedIntegrals(0.01, 0.5, 0.1).stop());
  // So shallow at first that the panels begin late.
  const SpeedIntegrals late(-0.5, 0.5, 1e-14), shallow(-0.5, 0.5, 0);
  CHECK(close(late.distance(5), shallow.distance(5), 1e-15));
  CHECK(close(late.lambda(0.6, infinity), shallow.lambda(0.6, shallow.stop() - 0.6), 1e-14));
}

TEST_CASE("SpeedIntegrals: close to the stop lambda comes from the rest", "[rolling]") {
  for (const double b : {-1e-13, 0.0, 1e-13})
    for (const double depth : {0.1, 0.8}) {  // A is constant: rest = f e^(-s lambda) / s
      const SpeedIntegrals s(b, 0.5, depth);
      for (const double rest : {1e-3, 1e-9, 1e-15})
        CHECK(close(s.lambda(s.stop() - rest, rest), -std::log((1 - b) * rest / s.f(0)) / (1 - b),
                    1e-12));
    }
  for (const double b : {0.215, 0.6})
    for (const double depth : {0.1, 0.8}) {  // z has died away: f = 1
      const SpeedIntegrals s(b, 0.5, depth);
      const double rest = std::pow(1e-14, (1 - b) / b);
      CHECK(close(s.lambda(s.stop() - rest, rest), -std::log((1 - b) * rest) / (1 - b), 1e-14));
    }
}

TEST_CASE("SpeedIntegrals: lambda, its time and its rest agree from start to stop", "[rolling]") {
  for (const double b : {-0.005, 0.0, 1e-9, 0.0244, 0.215, 0.9, 0.9999})
    for (const double depth : {0.0, 0.05, 0.5, 0.8, 1.0}) {
      if (b < 0 && depth > 0.7) continue;
      const SpeedIntegrals s(b, 0.5, depth);
      double before = 0;
      for (int i = 1; i <= 1000; ++i) {
        const double time = s.stop() * (i / 1001.0), lambda = s.lambda(time, s.stop() - time);
        INFO("b " << b << " depth " << depth << " i " << i);
        REQUIRE(lambda > before);
        before = lambda;
        // dlambda/dtime = e^(s lambda) / f
        const double h = s.stop() * 1e-6, slope = (s.lambda(time + h, s.stop() - time - h) -
                                                   s.lambda(time - h, s.stop() - time + h)) /
                                                  (2 * h);
        if (i > 2)
          REQUIRE(close(slope, std::exp((1 - b) * lambda) / s.f(lambda),
                        1e-5 + 1e-11 / (1 - b) / (1 - b)));
      }
    }
}
