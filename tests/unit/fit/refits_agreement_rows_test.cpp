// SPDX-License-Identifier: GPL-3.0-or-later
#include "statistics/run_laws.h"

#include <gsl/gsl_cdf.h>

#include <random>

#include "unit/catch.h"
#include "unit/normal.h"
#include "unit/fit/rolls.h"
#include "unit/many.h"

using namespace rolling;
using rolls::felt, rolls::roll, rolls::rubber;

namespace {

OwnLaw row_of(const FitResult& r, std::size_t run, std::size_t parameters) {
  const double log_a = r.sigma_a / r.a;
  return {run,
          {std::log(r.a), r.b},
          {log_a * log_a, r.corr * log_a * r.sigma_b, r.sigma_b * r.sigma_b},
          static_cast<double>(r.n - parameters),
          r.rms};
}

/// Rows of fits whose noise is known to the covariance C within `freedom` degrees of freedom, of
/// laws that scatter about ln a = 0 and b = 0.
class Rows {
 public:
  explicit Rows(unsigned seed) : random_(seed) {}
  std::vector<OwnLaw> operator()(std::size_t count, double scatter, double freedom,
                                 double uneven = 1) {
    std::vector<OwnLaw> rows;
    for (std::size_t i = 0; i < count; ++i) {
      const double size = i % 2 ? uneven : 1, a = size * 0.012 * (1 + 0.3 * uniform_(random_)),
                   b = 0.66 * a, x = normal_(random_), y = normal_(random_), corr = 0.99;
      const Pair law{
          scatter * normal_(random_) + a * x,
          scatter / 5 * normal_(random_) + b * (corr * x + std::sqrt(1 - corr * corr) * y)};
      const double factor =
          gsl_cdf_chisq_Pinv((uniform_(random_) + 1e-12) / (1 + 2e-12), freedom) / freedom;
      rows.push_back({i, law, factor * Symmetric{a * a, corr * a * b, b * b}, freedom,
                      size * std::sqrt(factor)});
    }
    return rows;
  }

 private:
  std::mt19937_64 random_;
  Normal normal_;
  std::uniform_real_distribution<> uniform_{0, 1};
};

}  // namespace

// Of `sets` sets the intervals hold ln a and b in .93 to .97, and as many as are due for their
// number beyond that.
TEST_CASE("joint law: of 5, 30 and 1000 rows the intervals hold a and b", "[fit][many]") {
  for (const double scatter : {0.0, 0.02, 0.05})
    for (const auto& [count, sets] :
         {std::pair<std::size_t, int>(5, 2000), {30, 1000}, {1000, 100}}) {
      Rows rows(static_cast<unsigned>(1000 * scatter) + static_cast<unsigned>(count));
      double a = 0, b = 0, told = 0;
      for (int set = 0; set < sets; ++set) {
        const JointLaw joint = joint_law(rows(count, scatter, 47), {});
        a += std::abs(joint.law.a) < 1.96 * std::sqrt(joint.covariance.aa);
        b += std::abs(joint.law.b) < 1.96 * std::sqrt(joint.covariance.bb);
        told += !joint.agreement.agree();
      }
      CAPTURE(scatter, count, a / sets, b / sets, told / sets);
      const double beyond = 3 * std::sqrt(0.05 * 0.95 / sets);
      for (const double held : {a / sets, b / sets}) {
        CHECK(held > 0.95 - std::max(0.02, beyond));
        CHECK(held < 0.95 + std::max(0.02, beyond));
      }
      if (scatter > 0) CHECK(told > 0.99 * sets);
      else CHECK(told / sets < 0.01 + 3.5 * std::sqrt(0.01 / sets));
    }
}

// A verdict by exp(-chi2/2) underflows from 745 rows on.
TEST_CASE("joint law: p is that of chi2, for 760 rows too, and for rows of unequal noise",
          "[fit]") {
  for (const double uneven : {1.0, 3.0}) {
    Rows rows(7);
    int alarms = 0;
    for (int set = 0; set < 40; ++set) {
      const Agreement found = joint_law(rows(760, 0, 47, uneven), {}).agreement;
      CHECK(found.dof == 1518);
      CHECK(found.p == Approx(gsl_cdf_chisq_Q(found.ratio, 1518)));
      alarms += !found.agree();
    }
    CAPTURE(uneven);
    CHECK(alarms <= 3);  // more of 1 % by chance in 0.07 %
  }
}

// Five of its standard errors: the chi-square of 50 rows misses most of such rows. The squared
// distance of the row is above 20.5, the limit by F, in 0.70: drawn by themselves, 200,000 normal
// errors beside variances of 47 degrees of freedom.
TEST_CASE("joint law: one row of 50 that is off is found, and of good rows 1 % are", "[fit]") {
  Rows rows(11);
  const unsigned sets = of_many(2000);
  unsigned alarms = 0;
  unsigned found = 0;
  unsigned as_a_whole = 0;
  for (unsigned set = 0; set < sets; ++set) {
    std::vector<OwnLaw> laws = rows(50, 0, 47);
    alarms += joint_law(laws, {}).agreement.p_of_run <= levels::run_off;
    laws[30].law.a += 5 * laws[30].log_D(laws[30].best_log_v()).sigma;
    const Agreement off = joint_law(laws, {}).agreement;
    found += off.p_of_run <= levels::run_off && off.run == 30;
    as_a_whole += !off.agree();
  }
  CAPTURE(alarms, found, as_a_whole);
  CHECK(alarms <= at_most(sets, 0.01));
  CHECK(alarms >= at_least(sets, 0.01));
  CHECK(found >= at_least(sets, 0.7));
  CHECK(as_a_whole <= at_most(sets, 0.5));
}

TEST_CASE("joint law: rows say what a joint fit of their runs says", "[fit]") {
  for (const double scatter : {0.0, 0.02, 0.05}) {
    simulated::Noise noise(12);
    double off = 0;
    for (int set = 0; set < 10; ++set) {
      std::vector<Run> runs;
      std::vector<OwnLaw> rows;
      for (int i = 0; i < 5; ++i) {
        runs.push_back(roll({rubber.a * (1 + noise(scatter)), rubber.b}, 0, 1, noise));
        rows.push_back(row_of(fit(Route::position, {runs.back()}, {}), rows.size(), 4));
      }
      const FitResult r = fit(Route::position, runs, {});
      const JointLaw joint = joint_law(rows, {});
      const double sigma_a = std::exp(joint.law.a) * std::sqrt(joint.covariance.aa),
                   sigma_b = std::sqrt(joint.covariance.bb);
      CHECK(joint.agreement.run == r.agreement->run);
      CHECK(joint.agreement.p == Approx(r.agreement->p).epsilon(0.05).margin(1e-6));
      const double a = (std::exp(joint.law.a) - r.a) / r.sigma_a,
                   b = (joint.law.b - r.b) / r.sigma_b;
      off += a * a + b * b;
      CHECK(sigma_a == Approx(r.sigma_a).epsilon(0.1));
      CHECK(sigma_b == Approx(r.sigma_b).epsilon(0.1));
    }
    CAPTURE(scatter, off);
    CHECK(std::sqrt(off / 20) < 0.1);
  }
}

// Two bodies of two rolls each, all equally precise: the error of a body's K counts for half of the
// rows, that of g for all.
TEST_CASE("joint law: an error that rows have in common counts once", "[fit]") {
  const Symmetric C{1e-4, 0, 1e-4};
  std::vector<OwnLaw> rows;
  for (const double log_a : {0.01, -0.01, 0.005, -0.005})
    rows.push_back({rows.size(), {log_a, 0.2}, C, known_errors});
  const Pair k{0.02, 0}, g{0.03, 0};
  const JointLaw alone = joint_law(rows, {}),
                 common = joint_law(rows, {{k, k, {}, {}}, {g, g, g, g}});
  CHECK(alone.covariance.aa == Approx(1e-4 / 4));
  CHECK(common.covariance.aa == Approx(1e-4 / 4 + 0.01 * 0.01 + 0.03 * 0.03));
  CHECK(common.covariance.bb == Approx(1e-4 / 4));
  CHECK(common.agreement.ratio == alone.agreement.ratio);
  for (OwnLaw& row : rows) row.law.a *= 100;
  const JointLaw scattered = joint_law(rows, {}), all = joint_law(rows, {{g, g, g, g}});
  REQUIRE_FALSE(all.agreement.agree());
  CHECK(all.covariance.aa == Approx(scattered.covariance.aa + 0.03 * 0.03));
  CHECK(scattered.scatter_log_a == Approx(std::sqrt(2.5 / 3 - 1e-4)).epsilon(1e-6));
  CHECK(scattered.scatter_b == 0);
}

TEST_CASE("joint law: b that all rows hold fixed", "[fit]") {
  std::vector<OwnLaw> rows;
  for (const double log_a : {0.01, -0.02, 0.01})
    rows.push_back({rows.size(), {log_a, 0.2}, {1e-4, 0, 0}, known_errors});
  const JointLaw joint = joint_law(rows, {});
  CHECK(joint.agreement.dof == 2);
  CHECK(joint.agreement.ratio == Approx(6).epsilon(1e-4));
  CHECK(joint.law.b == Approx(0.2));
  CHECK(joint.covariance.bb == 0);
}

// Five rows of three degrees of freedom, one of another variance: Bartlett's chi^2 is
// (15 ln((4 + variance)/5) - 3 ln variance)/(1 + (5/3 - 1/15)/12), 12.4 and 19.0 for 19 and 40; of
// four degrees of freedom 1 % of chi^2 are beyond 13.3. Covariances in units of the variance of
// their rows.
TEST_CASE("joint law: noise of one size by Bartlett's test, by hand", "[fit]") {
  for (const double variance : {19.0, 40.0}) {
    std::vector<OwnLaw> rows;
    for (const double of_row : {1.0, 1.0, 1.0, 1.0, variance})
      rows.push_back({rows.size(), {0, 0.2}, {0, 0, 1e-4 * of_row}, 3, std::sqrt(of_row)});
    const double weights = variance < 30 ? 5 / ((4 + variance) / 5) : 4 + 1 / variance;
    CHECK(joint_law(rows, {}).covariance.bb == Approx(1e-4 / weights).epsilon(1e-12));
  }
}
