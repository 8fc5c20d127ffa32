// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/law.h"

#include "unit/catch.h"

#include <cmath>
#include <span>
#include <string>
#include <vector>

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

constexpr std::pair<double, bool> both[]{{1.7, false}, {-0.4, false}, {1.7, true}, {-0.4, true}};

/// The law by the coefficients of the formula, or by those of a search.
Law made(const LawForm& form, std::span<const double> c, bool of_search) {
  return of_search ? Law::searched(form, c, 0.002, 7) : Law(form, c, 0.002, 7);
}

}  // namespace

TEST_CASE("law: the coefficients of the formula, in SI units, give the law again", "[law]") {
  for (std::size_t k = 0; k < laws().size(); ++k)
    for (const auto& [third, of_search] : both) {
      const double c[]{0.9, 0.4, third};
      const Law law = made(laws()[k], c, of_search);
      double SI[LawForm::most], by_c[LawForm::most];
      for (std::size_t j = 0; j < law.size(); ++j) SI[j] = law.in_SI(j, by_c);
      if (k == 6 && of_search) CHECK(SI[2] > 0);
      for (double v : {0.3, 2.0, 7.0}) {
        CAPTURE(laws()[k].formula, v);
        CHECK(law.at(v).D == Approx(by_hand(k, SI, v)).epsilon(1e-12));
        CHECK(law(-v) == -law(v));
        CHECK(Law(laws()[k], SI).at(v).D == Approx(law.at(v).D).epsilon(1e-12));
      }
      CHECK(law(0) == 0);
    }
}

TEST_CASE("law: derivatives are limits of differences", "[law]") {
  for (const LawForm& form : laws())
    for (const auto& [third, of_search] : both) {
      const std::vector<double> c{0.9, 0.4, third};
      const auto law = [&, of = of_search](std::span<const double> at) {
        return made(form, at, of);
      };
      constexpr double h = 1e-6;
      double by_c[LawForm::most], SI_by_c[LawForm::most], unused[LawForm::most];
      const Shift s = law(c).at(3, by_c);
      const double by_log_v =
          (law(c).at(3 * std::exp(h)).D - law(c).at(3 * std::exp(-h)).D) / (2 * h);
      CHECK(s.by_log_v == Approx(by_log_v).epsilon(1e-7).margin(1e-12));
      for (std::size_t j = 0; j < law(c).size(); ++j) {
        std::vector<double> low = c, high = c;
        low[j] -= h, high[j] += h;
        CAPTURE(form.formula, j);
        CHECK(by_c[j] ==
              Approx((law(high).at(3).D - law(low).at(3).D) / (2 * h)).epsilon(1e-7).margin(1e-12));
        for (std::size_t i = 0; i < law(c).size(); ++i) {
          law(c).in_SI(i, SI_by_c);
          CHECK(SI_by_c[j] ==
                Approx((law(high).in_SI(i, unused) - law(low).in_SI(i, unused)) / (2 * h))
                    .epsilon(1e-6)
                    .margin(1e-12));
        }
      }
    }
}

TEST_CASE("law: where b is small d0 + a v^b tends to a logarithm", "[law]") {
  const LawForm& law = laws()[5];
  double by_c[LawForm::most];
  for (double n : {0.0, 1e-9, 1e-5, -1e-5, 1e-4, 1e-3}) {
    const double c[]{1, 0.2, n}, log = std::log(0.05);
    // h + s (ln v + n ln^2 v/2 + n^2 ln^3 v/6 + ...)
    const double series = log + n * log * log / 2 + n * n * log * log * log / 6 +
                          n * n * n * log * log * log * log / 24;
    CAPTURE(n);
    CHECK(law.searched(c, 0.05, by_c).D == Approx(1 + 0.2 * series).epsilon(1e-9));
    CHECK(by_c[2] == Approx(0.2 * (log * log / 2 + n * log * log * log / 3 +
                                   n * n * log * log * log * log / 8))
                         .epsilon(1e-7));
  }
}

TEST_CASE("law: the peak lies at w and is p above d0", "[law]") {
  const double c[]{0.3, 0.5, 0.2};
  double by_c[LawForm::most];
  const auto D = [&](double v) { return laws()[6].shift(c, v, by_c).D; };
  CHECK(D(0.2) == Approx(0.8));
  CHECK(D(0.19) < D(0.2));
  CHECK(D(0.21) < D(0.2));
}
