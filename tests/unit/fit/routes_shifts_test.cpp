// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/routes.h"

#include "base/error.h"
#include "unit/catch.h"
#include "unit/fit/simulated.h"
#include "unit/many.h"

#include <cmath>
#include <limits>
#include <memory>

using namespace rolling;

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

Run run_of(std::vector<double> v, std::vector<double> D) {
  Run run{};
  run.v = std::move(v);
  run.D = std::move(D);
  return run;
}

Model observed(const std::vector<Run>& runs, const FitOptions& options, bool logarithms) {
  std::vector<Rows> rows;
  for (const Run& run : runs) rows.push_back(shift_rows(run, options, logarithms));
  return model_of_shifts(runs, rows, options, logarithms);
}

}  // namespace

TEST_CASE("shift rows: along the motion, v finite and positive, D positive for logarithms",
          "[fit]") {
  const std::vector<Run> runs{run_of({0.4, missing, 0.1, 0, 0.2}, {3, 2, -1, 1, missing}),
                              run_of({-0.4, -0.1, 0.05}, {-3, -1, -1})};
  const Model model = observed(runs, {}, false);
  const std::vector<ObservedRun>& all = model.runs();
  CHECK(all[0].y == std::vector<double>{3, -1});
  CHECK(all[1].y == std::vector<double>{3, 1});
  CHECK(shift_rows(runs[0], {}, false) == Rows{0, 2});
  CHECK(shift_rows(runs[1], {}, true) == Rows{0, 1});
  CHECK(usable(Route::loglog, runs) == std::vector<Rows>{{0, 2, 3}, {0, 1, 2}});
  // The geometric mean of 0.4 and 0.1, twice.
  CHECK(model.parameters().speed_unit() == Approx(0.2).epsilon(1e-15));
  for (const ObservedRun& run : all) CHECK(run.t == std::vector<double>{0.4, 0.1});

  const std::vector<ObservedRun> positive = observed(runs, {}, true).runs();
  CHECK(positive[0].y == std::vector<double>{std::log(3)});
  CHECK(positive[1].y == std::vector<double>{std::log(3), 0});
  CHECK(shift_rows(runs[0], {}, true) == Rows{0});

  FitOptions fast;
  fast.min_speed = 0.3;
  fast.fixed[1] = 1;  // with one speed alone b has to be held
  const std::vector<ObservedRun> few = observed(runs, fast, false).runs();
  for (const ObservedRun& run : few) CHECK(run.y == std::vector<double>{3});
  fast.fixed[1].reset();
  CHECK_THROWS_AS(observed(runs, fast, false), Error);
}

TEST_CASE("shift rows: what rounding leaves of a difference is 0", "[fit]") {
  const std::vector<Run> runs{run_of({0.4, 0.3, 0.2, 3e-17, 0.1}, {3, 2e-15, 2, 1, 1e20})};
  CHECK(shift_rows(runs[0], {}, false) == Rows{0, 1, 2, 4});
  CHECK(shift_rows(runs[0], {}, true) == Rows{0, 2, 4});  // one large shift leaves the others
}

TEST_CASE("shift rows: the derivatives of the residuals are those of differences", "[fit]") {
  const std::vector<Run> runs{run_of({0.4, 0.2, 0.1, 0.05}, {3e-3, 2e-3, 2.5e-3, 1e-3})};
  for (const bool logarithms : {false, true})
    for (const bool hold_a : {false, true})
      for (const bool hold_b : {false, true}) {
        if (hold_a && hold_b) continue;
        FitOptions options;
        if (hold_a) options.fixed[0] = 4e-3;
        if (hold_b) options.fixed[1] = 0.3;
        const Model model = observed(runs, options, logarithms);
        const std::vector<ObservedRun>& rows = model.runs();
        const Parameters& q = model.parameters();
        const System system = system_of(model);
        const auto at = [&](const std::vector<double>& theta) {
          std::vector<double> all;
          system.evaluate(theta, [&](std::size_t, std::span<double> f, std::span<double> J) {
            all.assign(f.begin(), f.end());
            all.insert(all.end(), J.begin(), J.end());
          });
          return all;
        };
        const auto theta = q.theta({4e-3, 0.3}, {}, {});
        REQUIRE(theta.size() == 2u - hold_a - hold_b);
        const auto f = at(theta);
        for (std::size_t i = 0; i < 4; ++i) {
          const double D = 4e-3 * std::pow(rows[0].t[i], 0.3);
          CHECK(f[i] == Approx((logarithms ? std::log(D) : D) - rows[0].y[i]).epsilon(1e-12));
        }
        for (std::size_t j = 0; j < theta.size(); ++j) {
          auto up = theta, down = theta;
          up[j] += 1e-5, down[j] -= 1e-5;
          for (std::size_t i = 0; i < 4; ++i)
            CHECK(f[4 * (1 + j) + i] == Approx((at(up)[i] - at(down)[i]) / 2e-5).epsilon(1e-8));
        }
      }
}

// An encoder with noise of 5 cm/s beside an accelerometer: without the bias .57 of the intervals
// hold a, and .67 hold b. What is not noise, the curve of a noiseless v(t), brings none.
TEST_CASE("shift: noise of the speeds counts as a bias", "[fit][many]") {
  const PowerLaw law{1.87e-3, 0.215};
  Roll truth({1, 0.04, 0.5}, law, 0.5);
  const auto rows = [&](double of_v, simulated::Noise& noise) {
    Run run;
    for (double t = 0; t < 2.2; t += 0.04) {
      const double v = truth.at(t).v;
      run.t.push_back(t);
      run.v.push_back(v + noise(of_v));
      run.D.push_back(law(v) * (1 + noise(0.05)));
    }
    return run;
  };
  const auto bias_of_b = [](const FitResult& r) {
    for (const ErrorShare& share : r.shares)
      if (share.of == "bias") return share.sigma(1);
    return 0.0;
  };
  simulated::Noise noise(8);
  const unsigned runs = of_many(300);
  unsigned a = 0;
  unsigned b = 0;
  double mean = 0;
  double bias = 0;
  for (unsigned k = 0; k < runs; ++k) {
    const FitResult r = fit(Route::shift, {rows(0.05, noise)}, {});
    a += std::abs(r.a - law.a) < 1.96 * r.sigma_a;
    b += std::abs(r.b - law.b) < 1.96 * r.sigma_b;
    mean += (law.b - r.b) / runs;
    bias += bias_of_b(r) / runs;
  }
  CAPTURE(mean, bias);
  CHECK(a >= at_least(runs, 0.9));
  CHECK(b >= at_least(runs, 0.9));
  CHECK(std::abs(bias / mean - 1) < 0.4);
  // In another unit of speed the exponent and its bias are the same.
  Run run = rows(0.05, noise);
  const double here = bias_of_b(fit(Route::shift, {run}, {}));
  for (double& v : run.v) v *= 10;
  CHECK(here > 0);
  CHECK(bias_of_b(fit(Route::shift, {run}, {})) == Approx(here).epsilon(1e-6));
  const FitResult exact = fit(Route::shift, {rows(0, noise)}, {});
  CHECK(bias_of_b(exact) < 1e-6 * exact.sigma_b);
}
