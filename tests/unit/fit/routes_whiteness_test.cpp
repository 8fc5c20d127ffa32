// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/routes.h"

#include "fit/refits.h"
#include "least_squares/minimise.h"
#include "unit/catch.h"
#include "unit/fit/simulated.h"

using namespace rolling;

namespace {

/// The most likely share in speeds that are central differences of noisy positions, and hold white
/// noise of this share of theirs besides.
WhiteShare found_share(double share, simulated::Noise& noise, std::size_t n = 400) {
  const Body body{1, 0.04, 0.5};
  const auto truth = simulated::roll(body, 2e-4, 0.2, 1.5);
  constexpr double of_x = 1e-4;
  Run run{};
  run.body = body;
  run.t = simulated::times(n);
  for (double& t : run.t) t /= 10;
  std::vector<double> x;
  for (double t : run.t) x.push_back(truth.x(t) + noise(of_x));
  run.v = simulated::slope(run.t, x);
  const double of_v = of_x / std::sqrt(2) / 0.01;
  for (double& v : run.v) v += noise(share * of_v);
  run.filters = {simulated::differentiate(Quantity::x, Quantity::v)};
  const std::vector<Run> runs{run};
  const Fitted fit =
      fit_rolls(Route::velocity, runs, usable(Route::velocity, runs), responses_of(runs), {});
  return most_likely_share(fit.model, fit.minimum.theta, 1e-7, 1);
}

}  // namespace

TEST_CASE("white share: that of white noise on differences is found", "[fit][many]") {
  simulated::Noise noise(11);
  for (const double share : {0.1, 0.2, 0.5}) {
    double sum = 0;
    for (int i = 0; i < 100; ++i) {
      const WhiteShare found = found_share(share, noise);
      INFO(share << ": found " << found.share << ", gain " << found.gain);
      CHECK(found.decisive());
      sum += std::log(found.share / share) / 100;
    }
    INFO(share << ": " << std::exp(sum));
    CHECK(std::abs(sum) < 0.1);
  }
}

TEST_CASE("white share: differences alone seem to hold white noise in few rows", "[fit]") {
  simulated::Noise noise(12);
  int decisive = 0;
  for (int i = 0; i < 200; ++i) decisive += found_share(0, noise, 100).decisive();
  CHECK(decisive <= 6);  // more than 6 of 200 at 1 % come by chance in 0.4 %
}

// Speeds that a filter has left as they were: more white noise is more of the same, and its share
// does not change the likelihood, which is that of white noise without a filter.
TEST_CASE("white share: of a filter that changes nothing each is as likely as none", "[fit]") {
  simulated::Noise noise(13);
  Run run{};
  run.body = {1, 0.04, 0.5};
  const auto truth = simulated::roll(run.body, 2e-4, 0.2, 1.5);
  run.t = simulated::times(60);
  for (const double t : run.t) run.v.push_back(truth.v(t) + noise(0.01));
  const std::vector<Run> read{run};
  run.filters = {simulated::smooth_v(1)};
  const std::vector<Run> runs{run};
  const auto rows = usable(Route::velocity, runs);
  const Fitted fit = fit_rolls(Route::velocity, runs, rows, responses_of(runs), {});
  REQUIRE(fit.noise().known());
  const auto plain = Model(observe(Route::velocity, read, rows, {}, {}), fit.model.parameters());
  const double of_white_noise =
      restricted_likelihood(evaluated(system_of(plain), fit.minimum.theta));
  const WhiteShare found = most_likely_share(fit.model, fit.minimum.theta, 1e-3, 10);
  CHECK(found.likelihood == Approx(of_white_noise).epsilon(0).margin(1e-9));
  CHECK(found.gain == Approx(0).margin(1e-9));
}
