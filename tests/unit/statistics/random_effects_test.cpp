// SPDX-License-Identifier: GPL-3.0-or-later
#include "statistics/random_effects.h"

#include <gsl/gsl_cdf.h>

#include <cmath>

#include "base/matrix.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

RandomEffectsLine mean_line(const std::vector<Estimate>& x) {
  return random_effects_line(x, std::vector<double>(x.size(), 0),
                             static_cast<double>(x.size()) - 1);
}

double error_of(const RandomEffectsMean& mean) { return std::sqrt(dot(mean.parts, mean.parts)); }

}  // namespace

// The 13 trials of BCG vaccine of Colditz et al. (1994, JAMA 271, 698): cases and others among the
// vaccinated, then among the controls. The package metafor of R gives tau^2 = 0.3181 and the mean
// -0.7150 for ln of the relative risk, by the method of Mandel and Paule (rma, method = "PM").
TEST_CASE("random effects: tau and the mean of a published example", "[statistics]") {
  const double counts[][4] = {
      {4, 119, 11, 128},       {6, 300, 29, 274},        {3, 228, 11, 209},
      {62, 13536, 248, 12619}, {33, 5036, 47, 5761},     {180, 1361, 372, 1079},
      {8, 2537, 10, 619},      {505, 87886, 499, 87892}, {29, 7470, 45, 7232},
      {17, 1699, 65, 1600},    {186, 50448, 141, 27197}, {5, 2493, 3, 2338},
      {27, 16886, 29, 17825},
  };
  std::vector<Estimate> x;
  for (const auto& [a, b, c, d] : counts)
    x.push_back({std::log(a / (a + b) / (c / (c + d))),
                 std::sqrt(1 / a - 1 / (a + b) + 1 / c - 1 / (c + d))});
  const auto line = mean_line(x);
  CHECK(std::abs(line.tau_square - 0.3181) < 0.00005);
  CHECK(std::abs(line.mean - -0.7150) < 0.00005);
  CHECK(line.slope == 0);
  CHECK(line.chi2 == Approx(12).epsilon(1e-9));
  CHECK(random_effects_mean(x, 12).value == line.mean);
}

TEST_CASE("random effects: numbers that agree are weighted by their errors alone", "[statistics]") {
  const auto line = mean_line({{1, 0.1}, {1.05, 0.2}, {0.98, 0.05}});
  CHECK(line.tau_square == 0);
  CHECK(line.mean == Approx((100 + 1.05 * 25 + 0.98 * 400) / 525).epsilon(1e-14));
}

TEST_CASE("random effects: a line through exact points has their slope", "[statistics]") {
  const auto line = random_effects_line({{1, 0.1}, {3, 0.2}, {7, 0.3}}, {0, 1, 3}, 1);
  CHECK(line.slope == Approx(2).epsilon(1e-12));
  CHECK(line.mean - line.slope * line.mean_g == Approx(1).epsilon(1e-12));
  CHECK(line.chi2 < 1e-20);
}

TEST_CASE("random effects: equal weights give the error of a plain mean, by Student",
          "[statistics]") {
  const std::vector<Estimate> x{{1, 0.01}, {1.5, 0.01}, {2.2, 0.01}, {0.9, 0.01}, {1.9, 0.01}};
  const double mean = 7.5 / 5;
  double squares = 0;
  for (const Estimate& each : x) squares += (each.value - mean) * (each.value - mean);
  const auto found = random_effects_mean(x, 4);
  CHECK(found.value == Approx(mean).epsilon(1e-14));
  CHECK(error_of(found) ==
        Approx(std::sqrt(squares / 4 / 5) * gsl_cdf_tdist_Pinv(0.975, 4) / 1.96).epsilon(1e-12));
}

// The degrees of freedom of Bell and McCaffrey as (tr M)^2/tr M^2 with M = G V G^T, the rows of G
// being h_i/sqrt(1 - h_i) times those of I - H; another program computed them with whole matrices.
TEST_CASE("random effects: few numbers of unequal weights have fewer degrees of freedom",
          "[statistics]") {
  const auto found = random_effects_mean({{0.1, 1}, {0.2, 0.5}, {0, 1.0 / 3}}, 2);
  CHECK(found.value == Approx(0.06428571428571428).epsilon(1e-14));
  CHECK(error_of(found) / student(1.2845849802371538) == Approx(0.08303032299643114).epsilon(1e-9));
}

// The shares of the weights are then 1 - 2e-18, 1e-18 and 1e-18, and there is one degree of
// freedom: the error is sqrt(2e-18) times the distance 0.1 from the mean of the other two, times
// Student's t.
TEST_CASE("random effects: one number may have all the weight", "[statistics]") {
  const auto found = random_effects_mean({{1, 1e-9}, {1.5, 1}, {0.7, 1}}, 2);
  CHECK(found.value == 1);
  // The others contribute 1e-18 times their distances, which is less by 1e9.
  CHECK(error_of(found) == Approx(std::sqrt(2e-18) * 0.1 * student(1)).epsilon(1e-6));
}

TEST_CASE("random effects: a parameter that is held is its own mean", "[statistics]") {
  const auto held = random_effects_mean({{0.3, 0}, {0.3, 0}}, 1);
  CHECK(held.value == 0.3);
  CHECK(error_of(held) == 0);
}
