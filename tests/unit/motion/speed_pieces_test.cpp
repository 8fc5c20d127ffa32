// The two kinds of piece of the integrals over speed, and the bounds between them.
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "motion/speed_integrals.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// |x/y - 1| in units of 1e-16.
double error(double x, double y) { return x == y ? 0 : std::abs(x - y) / std::abs(y) * 1e16; }

SpeedArm arm_of(double b, double K, double depth) {
  return {b, K, depth, (1 - depth) * (1 + depth)};
}

/// Simpson's rule in long double with one extrapolation, for integrands that are smooth.
double simpson(double from, double to, const std::function<long double(long double)>& integrand) {
  const auto rule = [&](int n) {
    const long double h = (static_cast<long double>(to) - from) / n;
    long double sum = integrand(from) + integrand(to);
    for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4 : 2) * integrand(from + i * h);
    return sum * h / 3;
  };
  return static_cast<double>((16 * rule(8000) - rule(4000)) / 15);
}

long double A_of(const SpeedArm& arm, long double y) {
  return std::sqrt(1 - arm.depth * arm.depth * std::exp(-2 * arm.b * y));
}

/// The integrals of both kinds of piece, by Simpson's rule.
void check_against_simpson(const auto& piece, const SpeedArm& arm, double from, double y) {
  const long double K = arm.K, s = 1 - arm.b;
  const auto integral = [&](const auto& of) {
    return simpson(0, y,
                   [&](long double u) { return of(u, A_of(arm, from + u)) * std::exp(-s * u); });
  };
  CAPTURE(arm.b, arm.K, arm.depth, from, y);
  CHECK(error(piece.time(y), integral([=](auto, auto A) { return (K + A) / (K + 1); })) <= 20);
  const double lag = integral([=](auto, auto A) { return (1 - A) / (K + 1); });
  CHECK(std::abs(piece.lag(y) - lag) <= 4e-16 * (lag + piece.time(y)));  // 1 - A may be small
  CHECK(error(piece.distance(y),
              integral([=](auto u, auto A) { return (K + A) / (K + 1) * std::exp(-u); })) <= 20);
  const auto h = [=](auto A) { return (K + 1 / A) / (K + 1); };
  const auto ahead = [=](auto u) { return -std::exp(-u) * std::expm1(u - y); };
  const SpeedGradient gradient = piece.gradient(y, Wanted::speed_and_distance);
  CHECK(error(gradient.h0, integral([=](auto, auto A) { return h(A); })) <= 40);
  CHECK(error(gradient.h1, integral([=](auto u, auto A) { return u * h(A); })) <= 40);
  CHECK(error(gradient.g0, integral([=](auto u, auto A) { return ahead(u) * h(A); })) <= 40);
  CHECK(error(gradient.g1, integral([=](auto u, auto A) { return u * ahead(u) * h(A); })) <= 40);
  CHECK(gradient.distance == piece.distance(y));
  const SpeedGradient speed = piece.gradient(y, Wanted::speed);
  CHECK((speed.h0 == gradient.h0 && speed.h1 == gradient.h1));
  CHECK((speed.distance == 0 && speed.g0 == 0 && speed.g1 == 0));
}

}  // namespace

TEST_CASE("SpeedPanel: 16 nodes are enough where z changes by a factor 2 at most", "[rolling]") {
  for (const double b : {-3.0, -0.5, -0.01, 0.0244, 0.215, 0.9, 1.0, 1.5, 30.0})
    for (const double depth : {0.1, 0.5, 0.9}) {
      const double width = 1 / (std::abs(1 - b) + 3 * std::abs(b));
      const double root = std::log(depth) / b;  // D = R there
      if (b < 0 && root < 1.1 * width) continue;
      const SpeedArm arm = arm_of(b, 0.5, depth);
      const SpeedPanel panel(arm, 0, width);
      check_against_simpson(panel, arm, 0, width);
      check_against_simpson(panel, arm, 0, width / 3);
    }
  // One that begins later is a roll that begins later.
  const SpeedArm arm = arm_of(0.215, 0.5, 0.9);
  check_against_simpson(SpeedPanel(arm, 0.4, 0.7), arm, 0.4, 0.7);
}

TEST_CASE("SpeedPanel: at D = R the pole of 1/A and the root of A are gone", "[rolling]") {
  // b = 1 and z = e^(-2 y): int A dy = artanh A - A, int dy/A = artanh A, int A e^-y dy by parts.
  for (const double y : {1e-12, 1e-6, 0.1, 1. / 3}) {
    const SpeedPanel panel(arm_of(1, 0, 1), 0, 1. / 3);  // the longest range of SpeedIntegrals
    const double A = std::sqrt(-std::expm1(-2 * y));
    const double artanh = y + std::log1p(A);
    if (y > 0.01) CHECK(error(panel.time(y), artanh - A) <= 200);
    CHECK(error(panel.gradient(y, Wanted::speed).h0, artanh) <= 20 + 10 / A);
    CHECK(error(panel.lambda(panel.time(y), infinity), y) <= 20 * (1 + 1 / (A * A)));
  }
}

TEST_CASE("SpeedSeries: at most 30 terms, and no term that is left out shows", "[rolling]") {
  for (const double b : {1e-6, 0.0244, 0.215, 0.9, 1.0, 1.5}) {
    const SpeedArm arm = arm_of(b, 0.5, 0.5);  // z = 1/4
    const SpeedSeries series = SpeedSeries::binomial(arm, 0);
    CHECK(series.terms() <= 30);
    for (const double y : {0.5, 4.0}) check_against_simpson(series, arm, 0, y);
    check_against_simpson(SpeedSeries::binomial(arm, 0.3), arm, 0.3, 2);
  }
  CHECK(SpeedSeries::binomial(arm_of(0.215, 0.5, 0.05), 0).terms() <= 8);
  // The part up to the stop and what is left there are the whole.
  const SpeedSeries series = SpeedSeries::binomial(arm_of(0.215, 0.5, 0.5), 0);
  for (const double y : {0.0, 0.1, 3.0, 30.0}) {
    const double whole = series.lag(infinity);
    CHECK(std::abs(series.lag(y) + series.lag_rest(y) - whole) <= 4e-16 * whole);
  }
}

TEST_CASE("SpeedSeries: a constant A is one term", "[rolling]") {
  for (const double depth : {0.0, 0.3, 0.99}) {
    const SpeedArm arm = arm_of(0, 0.5, depth);
    const SpeedSeries series = SpeedSeries::constant(arm);
    CHECK(series.terms() == 1);
    check_against_simpson(series, arm, 0, 2);
    CHECK(error(series.lag_rest(2), (1 - arm.f(0)) * std::exp(-2)) <= 10);
  }
}

TEST_CASE("SpeedSeries: lambda is the inverse of the time, from both ends", "[rolling]") {
  for (const double b : {0.0244, 0.215, 0.9, 1.0, 1.5})
    for (const double depth : {0.01, 0.2, 0.5}) {
      const SpeedSeries series = SpeedSeries::binomial(arm_of(b, 0.5, depth), 0);
      const double stop = b < 1 ? series.time(infinity) : infinity;
      for (const double y : {1e-12, 1e-3, 0.1, 1.0, 5.0}) {
        CAPTURE(b, depth, y);
        const double time = series.time(y);
        // `time` and `rest` are rounded, and lambda' = e^(s lambda) / f.
        const double slope = std::exp((1 - b) * y) / arm_of(b, 0.5, depth).f(y),
                     rounding = (b < 1 ? stop : time) * slope / y;
        CHECK(error(series.lambda(time, stop - time), y) <= 4 + 8 * rounding);
      }
    }
}

// The bounds of SpeedIntegrals: what changes from one side of each to the other is not seen.

TEST_CASE("SpeedIntegrals: |b| = 1e-19, below it A is constant", "[rolling]") {
  for (const double sign : {-1.0, 1.0})
    for (const double depth : {0.1, 0.45, 0.9}) {
      const SpeedIntegrals inside(sign * 0.99e-19, 0.5, depth),
          outside(sign * 1.01e-19, 0.5, depth), far_outside(sign * 1e-17, 0.5, depth);
      for (const SpeedIntegrals* other : {&outside, &far_outside}) {
        CHECK(error(other->stop(), inside.stop()) <= 20);
        CHECK(error(other->distance(1), inside.distance(1)) <= 20);
        CHECK(std::abs(other->lag(1) - inside.lag(1)) <= 2e-16);
        CHECK(error(other->gradient(1).g1, inside.gradient(1).g1) <= 40);
      }
    }
  // A b that is not too small to be seen is not neglected.
  for (const double b : {-1e-8, 1e-8}) {
    const SpeedArm arm = arm_of(b, 0.5, 0.9);
    const double time = simpson(0, 1, [&](long double y) {
      return (0.5L + A_of(arm, y)) / 1.5L * std::exp((static_cast<long double>(b) - 1) * y);
    });
    const double stop = b < 0 ? infinity : SpeedIntegrals(b, 0.5, 0.9).stop();
    CHECK(error(SpeedIntegrals(b, 0.5, 0.9).lambda(time, stop - time), 1) <= 20);
  }
}

TEST_CASE("SpeedIntegrals: z = 1e-20, below it A is 1 to the last bit (b < 0)", "[rolling]") {
  // With b = -30 A matters soon. The panels begin after the start and at it.
  for (const auto& scene : {std::pair{-0.5, 0.99e-10}, {-0.5, 1.01e-10}, {-30.0, 0.99e-10}}) {
    const double b = scene.first, depth = scene.second;
    const SpeedIntegrals integrals(b, 0.5, depth);
    const SpeedArm arm = arm_of(b, 0.5, depth);
    const auto part = [&](double y, auto of) {
      return simpson(0, y, [&](long double u) {
        return of(A_of(arm, u)) * std::exp(-(1 - static_cast<long double>(b)) * u);
      });
    };
    for (const double y : {0.01, 0.5, 0.7}) {
      CAPTURE(b, depth, y);
      CHECK(error(integrals.gradient(y).h0,
                  part(y, [](long double A) { return (0.5L + 1 / A) / 1.5L; })) <= 40);
    }
  }
}

TEST_CASE("SpeedIntegrals: what lies beyond y = 64 or s y = 64 does not show in a rest of 1e-10",
          "[rolling]") {
  const double K = 0.5;
  for (const double b : {-1e-4, 0.002, 0.005})  // panels all the way
    for (const double depth : {0.7, 0.95}) {
      const SpeedArm arm = arm_of(b, K, depth);
      const SpeedIntegrals integrals(b, K, depth);
      const long double s = 1 - static_cast<long double>(b);
      const auto lag = [&](double from) {
        return simpson(from, from + 70, [&](long double y) {
          return (1 - A_of(arm, y)) / (K + 1) * std::exp(-s * y);
        });
      };
      CAPTURE(b, depth);
      CHECK(error(integrals.stop(), static_cast<double>(1 / s) - lag(0)) <= 20);
      CHECK(error(integrals.lag_rest(0), lag(0)) <= 100);
      CHECK(error(integrals.lag_rest(23), lag(23)) <= 100);
    }
}

TEST_CASE("SpeedIntegrals: panels that begin or end at D = R lose nothing", "[rolling]") {
  const SpeedIntegrals begins(1, 0, 1);  // b = 1, K = 0: h0 = artanh A = lambda + ln(1 + A)
  for (const double lambda : {0.1, 0.3, 0.5, 1.0, 3.0}) {
    const double artanh = lambda + std::log1p(std::sqrt(-std::expm1(-2 * lambda)));
    CHECK(error(begins.gradient(lambda).h0, artanh) <= 20);
  }
  // b = -1, K = 0: h0 = depth^2 int dA / (1 - A^2)^2 from the A at the end to that at the start.
  for (const double depth : {0.3, 0.5, 0.6}) {
    const SpeedIntegrals ends(-1, 0, depth);
    const auto integral = [](double A) { return (A / ((1 - A) * (1 + A)) + std::atanh(A)) / 2; };
    const double A = 0.1, lambda = std::log(std::sqrt((1 - A) * (1 + A)) / depth),
                 A_0 = std::sqrt((1 - depth) * (1 + depth));
    CHECK(error(ends.gradient(lambda).h0, depth * depth * (integral(A_0) - integral(A))) <= 50);
  }
}
