#include "contact/law.h"

#include "unit/catch.h"

#include <cmath>
#include <string>

using namespace rolling;

namespace {

/// The formulas by hand, of the coefficients as they are written.
double by_hand(std::size_t law, const double* d, double v) {
  switch (law) {
    case 0:
      return d[0] * std::pow(v, d[1]);
    case 1:
      return d[0];
    case 2:
      return d[0] + d[1] * v;
    case 3:
      return d[0] + d[1] * v + d[2] * v * v;
    case 4:
      return d[0] + d[1] * v * v;
    case 5:
      return d[0] + d[1] * std::pow(v, d[2]);
    default:
      return d[0] + 2 * d[1] * v * d[2] / (v * v + d[2] * d[2]);
  }
}

}  // namespace

TEST_CASE("law: the coefficients of the formula, in SI units, give the law again", "[law]") {
  for (std::size_t k = 0; k < laws().size(); ++k) {
    const LawInUnits law{&laws()[k], 0.002, 7};
    for (const double third : {1.7, -0.4}) {
      const double c[]{0.9, 0.4, third};
      double SI[Law::most], by_c[Law::most];
      for (std::size_t j = 0; j < law.size(); ++j) SI[j] = law.in_SI(c, j, by_c);
      if (k == 6) CHECK(SI[2] > 0);
      for (double v : {0.3, 2.0, 7.0}) {
        CAPTURE(law.law->formula, v);
        CHECK(law(c, v, by_c) == Approx(by_hand(k, SI, v)).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("law: derivatives are limits of differences", "[law]") {
  for (const Law& of : laws()) {
    const LawInUnits law{&of, 0.002, 7};
    for (const double third : {1.7, -0.4}) {
      const double c[]{0.9, 0.4, third};
      constexpr double h = 1e-6;
      double by_c[Law::most], SI_by_c[Law::most], unused[Law::most];
      law(c, 3, by_c);
      for (std::size_t j = 0; j < law.size(); ++j) {
        double low[]{c[0], c[1], c[2]}, high[]{c[0], c[1], c[2]};
        low[j] -= h, high[j] += h;
        CAPTURE(of.formula, j);
        CHECK(by_c[j] == Approx((law(high, 3, unused) - law(low, 3, unused)) / (2 * h))
                             .epsilon(1e-7)
                             .margin(1e-12));
        for (std::size_t i = 0; i < law.size(); ++i) {
          law.in_SI(c, i, SI_by_c);
          CHECK(SI_by_c[j] ==
                Approx((law.in_SI(high, i, unused) - law.in_SI(low, i, unused)) / (2 * h))
                    .epsilon(1e-6)
                    .margin(1e-12));
        }
      }
    }
  }
}

TEST_CASE("law: where n is small d0 + a v^n tends to a logarithm", "[law]") {
  const Law& law = laws()[5];
  double by_c[Law::most];
  for (double n : {0.0, 1e-9, 1e-5, -1e-5, 1e-4, 1e-3}) {
    const double c[]{1, 0.2, n}, log = std::log(0.05);
    // h + s (ln v + n ln^2 v/2 + n^2 ln^3 v/6 + ...)
    const double series = log + n * log * log / 2 + n * n * log * log * log / 6 +
                          n * n * n * log * log * log * log / 24;
    CAPTURE(n);
    CHECK(law.shift(c, 0.05, by_c) == Approx(1 + 0.2 * series).epsilon(1e-9));
    CHECK(by_c[2] == Approx(0.2 * (log * log / 2 + n * log * log * log / 3 +
                                   n * n * log * log * log * log / 8))
                         .epsilon(1e-7));
  }
}

TEST_CASE("law: the peak lies at w and is p above d0", "[law]") {
  const double c[]{0.3, 0.5, 0.2};
  double by_c[Law::most];
  const auto D = [&](double v) { return laws()[6].shift(c, v, by_c); };
  CHECK(D(0.2) == Approx(0.8));
  CHECK(D(0.19) < D(0.2));
  CHECK(D(0.21) < D(0.2));
}
