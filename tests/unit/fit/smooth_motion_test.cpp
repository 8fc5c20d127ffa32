// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/first_guess.h"

#include <numeric>
#include <random>

#include "unit/fit/simulated.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

const Body cylinder{1.375, 0.04, 0.5};

Rows all_of(std::size_t n) {
  Rows rows(n);
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

/// The slopes of the parabola through each row and its two neighbours, and of the line at the
/// ends.
std::vector<double> slopes(std::span<const double> t, std::span<const double> y) {
  const auto line = [&](std::size_t i) { return (y[i + 1] - y[i]) / (t[i + 1] - t[i]); };
  std::vector<double> result{line(0)};
  for (std::size_t i = 1; i + 1 < t.size(); ++i)
    result.push_back(((t[i + 1] - t[i]) * line(i - 1) + (t[i] - t[i - 1]) * line(i)) /
                     (t[i + 1] - t[i - 1]));
  result.push_back(line(t.size() - 2));
  return result;
}

}  // namespace

TEST_CASE("smooth motion: a motion that is a polynomial in time comes out of its filters unchanged",
          "[fit]") {
  const auto x = [](double t) { return 0.3 + t * (0.5 + t * (-0.2 + t * 0.03)); };
  const auto v = [](double t) { return 0.5 + t * (-0.4 + t * 0.09); };
  for (const Route route : {Route::velocity, Route::position})
    for (const bool of_positions : {true, false})
      for (const std::size_t n : {13U, 16U, 40U, 1000U}) {
        if (route == Route::position && !of_positions) continue;
        FitRun run{};
        run.body = cylinder;
        std::vector<double> raw;
        for (std::size_t i = 0; i < n; ++i) {
          const double k = static_cast<double>(i);
          run.t.push_back(7 + 1.8 * (k + 0.4 * std::sin(k)) / static_cast<double>(n));
          raw.push_back(of_positions ? x(run.t[i] - 7) : v(run.t[i] - 7));
        }
        if (route == Route::position)
          run.filters = {{"x", "x", 2, [](auto, auto y) { return simulated::mean(y, 5); }}};
        else if (of_positions) run.filters = {{"x", "v", 1, slopes}, simulated::smooth_v(5)};
        else run.filters = {simulated::smooth_v(5)};
        for (const LinearFilter& filter : run.filters) raw = filter.apply(run.t, raw);
        (route == Route::position ? run.x : run.v) = raw;
        const auto runs =
            observe(route, {run}, {all_of(n)}, responses_of(route, {run}), FitOptions{});
        const auto noise = noise_of(runs);
        const auto smooth = smooth_motion(route, runs, *noise, {});
        REQUIRE(smooth.size() == 1);
        CAPTURE(route == Route::position, of_positions, n);
        CHECK(smooth[0].t.size() >= std::min<std::size_t>(n, 128));
        CHECK(smooth[0].t.size() <= 256);
        CHECK(smooth[0].raw_is_position == (route == Route::position));
        CHECK(!smooth[0].H);
        CHECK(smooth[0].way == 1);
        for (std::size_t i = 0; i < smooth[0].t.size(); ++i) {
          const double t = smooth[0].t[i];
          CHECK(smooth[0].y[i] == Approx(route == Route::position ? x(t) : v(t)).epsilon(1e-9));
        }
      }
}

TEST_CASE("smooth motion: a few rows are enough, and the direction is that of the body", "[fit]") {
  for (const std::size_t n : {1U, 2U, 3U, 7U, 8U})
    for (const double way : {1.0, -1.0}) {
      FitRun run{};
      run.body = cylinder;
      run.t = simulated::times(n);
      run.v.assign(n, 0.25 * way);
      run.filters = {{"v", "v", 0, [](auto, auto y) {
                        std::vector<double> same(y.begin(), y.end());
                        same[0] *= 2;  // not the identity
                        return same;
                      }}};
      run.v[0] *= 2;
      const auto runs = observe(Route::velocity, {run}, {all_of(n)},
                                responses_of(Route::velocity, {run}), FitOptions{});
      const auto smooth = smooth_motion(Route::velocity, runs, *noise_of(runs), FitOptions{});
      CAPTURE(n, way);
      CHECK(smooth[0].way == way);
      CHECK(smooth[0].t.size() == n);
      for (const double y : smooth[0].y) CHECK(y == Approx(0.25 * way));
    }
}

// Slopes of positions that are averaged at uneven times do not telescope: the noise of their
// integral, and of their mean, grows like a random walk, and hides even the direction. The weights
// of the fit know the steps of that walk.
TEST_CASE("smooth motion: the fit of noisy slopes at uneven times finds its law", "[fit]") {
  const auto truth = simulated::roll(cylinder, 1.87e-3, 0.215, 0.5);
  int against = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    simulated::Noise noise(seed);
    std::mt19937_64 uneven(seed);
    FitRun run{};
    run.body = cylinder;
    constexpr int n = 10000;
    std::vector<double> x;
    for (int i = 0; i < n; ++i) {
      const double jitter = 0.9 * (static_cast<double>(uneven() >> 11) * 0x1p-53 - 0.5);
      run.t.push_back(2 * (i + jitter) / n);
      x.push_back(truth.x(run.t.back()) + noise(1e-2));
    }
    run.filters = {{"x", "v", 1, slopes}, simulated::smooth_v(11)};
    run.v = run.filters[1].apply(run.t, run.filters[0].apply(run.t, x));
    against += std::accumulate(run.v.begin(), run.v.end(), 0.0) < 0;
    const auto r = fit(Route::velocity, {run}, {});
    CAPTURE(seed, r.a, r.sigma_a, r.b, r.sigma_b);
    CHECK(r.sigma_b < 0.1);
    CHECK(std::abs(r.a - 1.87e-3) < 4 * r.sigma_a);
    CHECK(std::abs(r.b - 0.215) < 4 * r.sigma_b);
    CHECK(r.v0[0].value == Approx(0.5).epsilon(0.05));
  }
  CHECK(against > 0);  // else the noise was too small to show anything
}
