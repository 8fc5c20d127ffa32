// SPDX-License-Identifier: GPL-3.0-or-later
#include <gsl/gsl_cdf.h>

#include <functional>

#include "bench/studies.h"
#include "unit/catch.h"
#include "unit/fit/rolls.h"
#include "unit/many.h"

using namespace rolling;
using rolls::cylinder, rolls::felt, rolls::roll, rolls::rubber;

namespace {

/// So many rolls on felt of six rows each, 0.8 s apart.
std::vector<Run> short_rolls(int count, simulated::Noise& noise) {
  std::vector<Run> runs;
  for (int k = 0; k < count; ++k) {
    const Run all = roll(felt, 0, 1, noise);
    Run& run = runs.emplace_back();
    run.body = all.body;
    for (std::size_t i = 0; i < 120; i += 20) run.t.push_back(all.t[i]), run.x.push_back(all.x[i]);
  }
  return runs;
}

/// The smallest sum over all ln D(0.3 m/s) and b that is found from this start, by steps along
/// either that become smaller.
double least(const std::function<double(double, double)>& sum, double log_D, double b) {
  double found = sum(log_D, b);
  for (double step = 0.1; step > 1e-10; step /= 2)
    for (bool lower = true; lower;) {
      lower = false;
      for (const auto& [by_D, by_b] :
           {std::pair(0.01 * step, 0.0), {-0.01 * step, 0.0}, {0.0, step}, {0.0, -step}}) {
        const double next = sum(log_D + by_D, b + by_b);
        if (next < found) found = next, log_D += by_D, b += by_b, lower = true;
      }
    }
  return found;
}

}  // namespace

// Means of D, each of 7 rows, with b held at 0: chi^2 and the errors are those of any textbook.
TEST_CASE("agreement: the scatter of means, by hand", "[fit]") {
  const double means[] = {5, 5.3, 4.6, 5.5};
  // Sum 0, squares 0.0258; neighbours are hardly correlated, and the sizes even along the run.
  const double off[] = {0, -0.1, -0.02, 0.05, 0.02, 0.1, -0.05};
  std::vector<Run> runs;
  for (double mean : means) {
    Run& run = runs.emplace_back();
    for (double d : off) run.v.push_back(1 + std::abs(d)), run.D.push_back(mean + d);
  }
  FitOptions options;
  options.fixed[1] = 0;
  const auto r = fit(Route::shift, runs, options);
  const double variance = 0.0258 / 6 / 7;  // of each mean
  REQUIRE(r.agreement);
  CHECK(r.agreement->dof == 3);
  CHECK_FALSE(r.agreement->agree());
  CHECK(r.agreement->run == 2);
  CHECK(r.agreement->log_D.value < 0);
  // The errors of ln a are those of a over each a; tau^2 beside them is what makes the sum of
  // squares 3.
  double tau_square = 0, mean = 0, weights = 0;
  for (double low = 0, high = 1; high - low > 1e-16;) {
    tau_square = (low + high) / 2;
    double sum = 0, squares = 0;
    weights = 0;
    for (double a : means) {
      const double w = 1 / (variance / (a * a) + tau_square);
      weights += w, sum += w * std::log(a);
    }
    mean = sum / weights;
    for (double a : means)
      squares += std::pow(std::log(a) - mean, 2) / (variance / (a * a) + tau_square);
    (squares > 3 ? low : high) = tau_square;
  }
  CHECK(std::abs(r.a - std::exp(mean)) < 1e-9);
  // The variance of the mean is V = sum of k r^2 with k = h^2/(1 - h), h the shares of the weights;
  // its degrees of freedom are 2 V^2/var V, where the residuals r of the model have the covariance
  // C = 1/w - 1/W on the diagonal and -1/W beside it.
  std::vector<double> k;
  double V = 0, trace = 0, squares = 0;
  const auto weight = [&](double a) { return 1 / (variance / (a * a) + tau_square); };
  for (double a : means) {
    const double h = weight(a) / weights;
    k.push_back(h * h / (1 - h));
    V += k.back() * std::pow(std::log(a) - mean, 2);
  }
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const double C = (i == j ? 1 / weight(means[i]) : 0) - 1 / weights;
      if (i == j) trace += k[i] * C;
      squares += k[i] * k[j] * C * C;
    }
  const double t = gsl_cdf_tdist_Pinv(0.975, trace * trace / squares);
  CHECK(t == Approx(3.182446).epsilon(1e-3));  // 3 degrees of freedom if all were as precise
  CHECK(std::abs(r.sigma_a / (t / 1.96 * r.a * std::sqrt(V)) - 1) < 1e-6);
  // chi^2 is that of the noise alone.
  double by_noise = 0, sum = 0, chi2 = 0;
  for (double a : means) by_noise += a * a, sum += a * a * std::log(a);
  for (double a : means) chi2 += std::pow(a * (std::log(a) - sum / by_noise), 2);
  CHECK(std::abs(r.agreement->chi2 / (chi2 / variance) - 1) < 1e-9);
  CHECK(r.sigma_b == 0);

  // Another law has the errors of the pooled noise, which grow as the root of chi^2 does.
  FitOptions constant;
  constant.law = &laws()[1];
  const auto other = fit(Route::shift, runs, constant);
  CHECK(std::abs(other.coefficients[0].value - 5.1) < 1e-9);
  CHECK(std::abs(other.coefficients[0].sigma / std::sqrt(0.0258 / 6 / 28 * chi2 / variance / 3) -
                 1) < 1e-6);

  // Runs that agree have the errors of one fit.
  for (std::size_t i = 0; i < 4; ++i)
    for (double& D : runs[i].D) D += 5.1 - means[i];
  const auto same = fit(Route::shift, runs, options);
  CHECK(same.agreement->agree());
  CHECK(same.agreement->chi2 < 1e-20);
  CHECK(std::abs(same.sigma_a / std::sqrt(4 * 0.0258 / 27 / 28) - 1) < 1e-10);
}

// With b = 0 speeds fall along straight lines, all with the same slope in the joint fit: the errors
// of v0 are those of textbooks (HC3), by residuals around lines of the runs' own.
TEST_CASE("agreement: uneven noise around the runs' own laws, by hand", "[fit]") {
  constexpr std::size_t count = 4, m = 12;
  constexpr double n = count * m, mean_t = 0.05 * (m - 1) / 2;
  simulated::Noise noise(41);
  std::vector<Run> runs;
  for (const double a : {5e-4, 6e-4, 7e-4, 8e-4}) {
    Run& run = runs.emplace_back();
    run.body = cylinder;
    for (std::size_t i = 0; i < m; ++i) {
      run.t.push_back(0.05 * static_cast<double>(i));
      run.v.push_back(0.5 - a * cylinder.g / (1.5 * cylinder.R) * run.t[i] +
                      noise(1e-5 * (1 + 2 * static_cast<double>(i * i))));
    }
  }
  FitOptions options;
  options.fixed[1] = 0;
  const auto r = fit(Route::velocity, runs, options);
  REQUIRE_FALSE(r.agreement->agree());
  REQUIRE(r.errors == Errors::uneven);
  double squares_t = 0;
  for (double t : runs[0].t) squares_t += (t - mean_t) * (t - mean_t);
  double sum = 0;  // of the squares of what each row brings to the v0 of the first run
  for (std::size_t k = 0; k < count; ++k) {
    double mean_v = 0, slope = 0;
    for (std::size_t i = 0; i < m; ++i) {
      mean_v += runs[k].v[i] / m;
      slope += (runs[k].t[i] - mean_t) * runs[k].v[i] / squares_t;
    }
    for (std::size_t i = 0; i < m; ++i) {
      const double off = runs[k].t[i] - mean_t, residual = runs[k].v[i] - mean_v - slope * off,
                   leverage = 1.0 / m + off * off / (count * squares_t),
                   by_v = (k == 0 ? 1.0 / m : 0) - mean_t * off / (count * squares_t);
      sum += std::pow(by_v * residual / (1 - leverage), 2);
    }
  }
  // The lines have two parameters each, the joint fit one each and the slope.
  sum *= (n - count - 1) / (n - 2 * count);
  CHECK(r.v0[0].sigma == Approx(std::sqrt(sum)).epsilon(1e-6));
}

TEST_CASE("agreement: of 1000 pairs of rolls under one law 1 % are said to disagree",
          "[fit][many]") {
  const unsigned pairs = of_many(1000);
  const unsigned alarms =
      static_cast<unsigned>(studies::disagreements(rubber, 2, 0, static_cast<int>(pairs), 31));
  CHECK(alarms <= at_most(pairs, 0.01));
  CHECK(alarms >= at_least(pairs, 0.01));
}

// Six rows leave two degrees of freedom, or three where b is held.
TEST_CASE("agreement: the chance is that of the law with which the runs agree best", "[fit]") {
  simulated::Noise noise(43);
  const double log_v = std::log(0.3);
  for (int k = 0; k < 10; ++k) {
    const auto runs = short_rolls(8, noise);
    FitOptions options;
    if (k % 2) options.fixed[1] = felt.b;
    // The mean of c ln(1 + d/freedom) is the number of parameters.
    const double freedom = options.fixed[1] ? 3 : 2,
                 c = options.fixed[1] ? 1 / (2 * std::log(2.0) - 1) : 2;
    std::vector<FitResult> own;
    for (const Run& run : runs) own.push_back(fit(Route::position, {run}, options));
    const auto sum = [&](double log_D, double b) {
      double all = 0;
      for (const FitResult& r : own) {
        const double off_b = options.fixed[1] ? 0 : (b - r.b) / r.sigma_b,
                     off_a = (log_D - (options.fixed[1] ? *options.fixed[1] : b) * log_v -
                              std::log(r.a)) /
                             (r.sigma_a / r.a),
                     d = (off_a * off_a - 2 * r.corr * off_a * off_b + off_b * off_b) /
                         (1 - r.corr * r.corr);
        all += c * std::log1p(d / freedom);
      }
      return all;
    };
    double smallest = INFINITY;
    for (const FitResult& r : own)
      smallest = std::min(smallest, least(sum, std::log(r.a) + r.b * log_v, r.b));
    const auto r = fit(Route::position, runs, options);
    CHECK(r.agreement->p ==
          Approx(gsl_cdf_chisq_Q(smallest, static_cast<double>(r.agreement->dof))).epsilon(1e-5));
  }
}

TEST_CASE("agreement: of 200 times 40 short rolls under one law 1 % are said to disagree",
          "[fit][many]") {
  simulated::Noise noise(44);
  const unsigned sets = of_many(200);
  unsigned alarms = 0;
  for (unsigned k = 0; k < sets; ++k) {
    FitOptions options;
    if (k % 2) options.fixed[1] = felt.b;
    alarms += !fit(Route::position, short_rolls(40, noise), options).agreement->agree();
  }
  CHECK(alarms <= at_most(sets, 0.01));
}

// In a single roll the valley of d0, a and b is long and bent: its covariance is no measure of it.
TEST_CASE("agreement: rolls of d0 + a v^b agree, and one that is 5 % off does not", "[fit][many]") {
  simulated::Noise noise(45);
  FitOptions options;
  options.law = &laws()[5];
  for (unsigned k = 0; k < of_many(10); ++k) {
    std::vector<Run> runs;
    for (int i = 0; i < 30; ++i) runs.push_back(roll(rubber, 0, 1, noise));
    CHECK(fit(Route::position, runs, options).agreement->p > 1e-3);
    runs[7] = roll({1.05 * rubber.a, rubber.b}, 0, 1, noise);
    CHECK_FALSE(fit(Route::position, runs, options).agreement->agree());
  }
}

TEST_CASE("agreement: the errors allow for 2 % of scatter from run to run", "[fit][many]") {
  for (const auto& [law, count] : {std::pair(felt, 4), std::pair(rubber, 6)}) {
    simulated::Noise noise(33);
    const unsigned sets = of_many(200);
    unsigned a = 0;
    unsigned b = 0;
    unsigned told = 0;
    for (unsigned k = 0; k < sets; ++k) {
      std::vector<Run> runs;
      for (int i = 0; i < count; ++i)
        runs.push_back(roll({law.a * (1 + noise(0.02)), law.b}, 0, 1, noise));
      const auto r = fit(Route::position, runs, {});
      a += std::abs(r.a - law.a) < 1.96 * r.sigma_a;
      b += std::abs(r.b - law.b) < 1.96 * r.sigma_b;
      told += !r.agreement->agree();
    }
    CAPTURE(count, a, b);
    CHECK(told == sets);
    for (const unsigned covered : {a, b}) {
      CHECK(covered >= at_least(sets, 0.95));
      CHECK(covered <= at_most(sets, 0.95));
    }
  }
}

// The precise runs do not tell more of the scatter than the others.
TEST_CASE("agreement: the errors allow for scatter of runs that are not equally precise",
          "[fit][many]") {
  simulated::Noise noise(38);
  int a = 0, b = 0;
  for (int k = 0; k < 200; ++k) {
    std::vector<Run> runs;
    for (const double size : {3e-4, 15e-4, 15e-4, 15e-4})
      runs.push_back(roll({rubber.a * (1 + noise(0.02)), rubber.b}, 0, 1, noise, size));
    const auto r = fit(Route::position, runs, {});
    a += std::abs(r.a - rubber.a) < 1.96 * r.sigma_a;
    b += std::abs(r.b - rubber.b) < 1.96 * r.sigma_b;
  }
  CAPTURE(a, b);
  for (int covered : {a, b}) {
    CHECK(covered >= 178);  // fewer of 95 % by chance in 0.02 %
    CHECK(covered <= 198);  // more by chance in 0.04 %
  }
}

// Slow rolls of unequal noise: a is D at a speed that none of them has.
TEST_CASE("agreement: where runs disagree, the law and its errors do not depend on the units",
          "[fit]") {
  simulated::Noise noise(43);
  for (int k = 0; k < 10; ++k) {
    std::vector<Run> runs;
    for (const double size : {1e-4, 1e-3, 3e-3, 1e-4})
      runs.push_back(roll({rubber.a * (1 + noise(0.05)), rubber.b}, 0, 1, noise, size));
    const auto r = fit(Route::position, runs, {});
    REQUIRE_FALSE(r.agreement->agree());
    for (const auto& [length, time] : {std::pair(20.0, 1.0), {1e3, 1e3}, {0.03, 10.0}}) {
      std::vector<Run> same = runs;
      for (Run& run : same) {
        run.body.R *= length, run.body.g *= length / (time * time);
        for (double& x : run.x) x *= length;
        for (double& t : run.t) t *= time;
      }
      const auto other = fit(Route::position, same, {});
      const double log_v = std::log(length / time), relative = r.sigma_a / r.a;
      CHECK(other.b == Approx(r.b).epsilon(1e-9));
      CHECK(other.sigma_b == Approx(r.sigma_b).epsilon(1e-7));
      CHECK(other.a / (r.a * length * std::exp(-log_v * r.b)) == Approx(1).epsilon(1e-9));
      CHECK(std::pow(other.sigma_a / other.a, 2) ==
            Approx(relative * relative - 2 * log_v * r.corr * relative * r.sigma_b +
                   log_v * log_v * r.sigma_b * r.sigma_b)
                .epsilon(1e-6));
    }
  }
}

// What a run cannot tell by itself, it does not tell of agreement either.
TEST_CASE("agreement: a run of two rows has no say", "[fit]") {
  simulated::Noise noise(34);
  std::vector<Run> runs{roll(rubber, 0, 1, noise), roll(rubber, 0, 1, noise)};
  for (auto* column : {&runs[1].t, &runs[1].x}) column->resize(2);
  CHECK_FALSE(fit(Route::position, runs, {}).agreement);
  CHECK_FALSE(fit(Route::position, {runs[0]}, {}).agreement);
  runs.push_back(roll(rubber, 0, 1, noise));
  const auto r = fit(Route::position, runs, {});
  REQUIRE(r.agreement);
  CHECK(r.agreement->runs == 2);
  CHECK(r.agreement->dof == 2);
}

TEST_CASE("agreement: where runs disagree, a and b are correlated as they scatter from run to run",
          "[fit]") {
  // b falls where a grows; the noise of one run would correlate them the other way round.
  simulated::Noise noise(35);
  std::vector<Run> runs;
  for (const double by : {-0.1, 0.1, -0.06, 0.06})
    runs.push_back(roll({rubber.a * std::exp(by), rubber.b - 0.3 * by}, 0, 1, noise));
  CHECK(fit(Route::position, {runs[0]}, {}).corr > 0.5);
  const auto r = fit(Route::position, runs, {});
  CHECK_FALSE(r.agreement->agree());
  CHECK(r.corr < -0.9);
  CHECK(r.corr >= -1);
}

// --min-speed leaves the rows out that are slower in the fitted roll, the joint one or the run's
// own: the two need not have the same rows.
TEST_CASE("agreement: runs that disagree are told where slow rows are left out", "[fit]") {
  simulated::Noise noise(37);
  FitOptions options;
  options.min_speed = 0.1;
  const std::vector<Run> runs{roll(rubber, 0, 1, noise), roll({2.4e-3, 0.215}, 0, 1, noise)};
  const auto r = fit(Route::position, runs, options);
  REQUIRE(r.agreement);
  CHECK_FALSE(r.agreement->agree());
  CHECK(std::abs(r.agreement->log_D.value) == Approx(std::log(2.4 / 1.87)).epsilon(0.05));
}

// The noise of the logarithms is that of a roll, which each run has by itself too.
TEST_CASE("agreement: by loglog, runs whose filters are known", "[fit]") {
  simulated::Noise noise(40);
  std::vector<Run> runs;
  for (const double by : {0.8, 1.2, 1.0}) {
    const Run raw = roll({by * felt.a, felt.b}, 0, 1, noise, 1e-5);
    runs.push_back(simulated::shifts(cylinder, raw.t, raw.x, 9, "x"));
    runs.back().body = cylinder;
  }
  FitOptions options;
  options.fixed[1] = felt.b;
  const auto r = fit(Route::loglog, runs, options);
  REQUIRE(r.agreement);
  CHECK_FALSE(r.agreement->agree());
  // The scatter of ln a is far beyond the noise, and the row is the mean.
  double mean = 0, squares = 0;
  for (const double by : {0.8, 1.2, 1.0}) mean += std::log(by) / 3;
  for (const double by : {0.8, 1.2, 1.0}) squares += std::pow(std::log(by) - mean, 2);
  CHECK(r.a / felt.a == Approx(std::exp(mean)).epsilon(0.01));
  constexpr double t = 4.302653;  // Student, 0.975, 2 degrees of freedom
  CHECK(r.sigma_a / r.a == Approx(t / 1.96 * std::sqrt(squares / 2 / 3)).epsilon(0.05));
}

TEST_CASE("agreement: the exponents of runs where a is held", "[fit]") {
  simulated::Noise noise(42);
  FitOptions options;
  options.fixed[0] = rubber.a;
  std::vector<Run> runs;
  double mean = 0, squares = 0;
  std::vector<double> own;
  for (const double b : {0.2, 0.22, 0.23, 0.21}) {
    runs.push_back(roll({rubber.a, b}, 0, 1, noise));
    own.push_back(fit(Route::position, {runs.back()}, options).b);
    mean += own.back() / 4;
  }
  for (const double b : own) squares += (b - mean) * (b - mean);
  const FitResult r = fit(Route::position, runs, options);
  REQUIRE(!r.agreement->agree());
  CHECK(r.b == Approx(mean).epsilon(0.002));
  constexpr double t = 3.182446;  // Student, 0.975, 3 degrees of freedom
  CHECK(r.sigma_b == Approx(t / 1.96 * std::sqrt(squares / 3 / 4)).epsilon(0.05));
}
