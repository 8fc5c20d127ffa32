// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/smooth_motion.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "least_squares/triangles.h"

namespace rolling {
namespace {

/// Calls put(j, T_j, dT_j/dt) with each Chebyshev polynomial T_j below `end`; t is scaled from
/// 0 <= t <= 2 half.
void for_each_polynomial(double t, double half, std::size_t end, auto&& put) {
  const double u = t / half - 1;
  double T = 1, next = u, slope = 0, next_slope = 1;
  for (std::size_t j = 0; j < end; ++j) {
    put(j, T, slope / half);
    slope = std::exchange(next_slope, 2 * next + 2 * u * next_slope - slope);
    T = std::exchange(next, 2 * u * next - T);
  }
}

ObservedRun smooth_motion(Route route, const ObservedRun& run, std::size_t number,
                          const Noise& noise, const FitOptions& options) {
  const bool position = route == Route::position;
  // Filters that turn positions into speeds do not see a constant.
  const bool slopes = run.raw_is_position && !position;
  const std::size_t n = run.y.size(), terms = std::min<std::size_t>(1 + n / (slopes ? 3 : 2), 7);
  const std::size_t first = slopes ? 1 : 0;
  const double half = std::max(run.t.back() / 2, std::numeric_limits<double>::min());
  Triangles R(1, terms, 0);
  evaluate(
      run, number, terms, noise,
      [&](double t, double* to, std::size_t stride) {
    for_each_polynomial(t, half, first + terms, [&](std::size_t j, double T, double) {
      if (j >= first) to[(j - first) * stride] = T;
    });
    return 0.0;
      },
      [&](std::size_t, std::span<double> f, std::span<double> J) { R.add(0, f, J); });
  R.join();
  const std::vector<double> c = R.solve();

  ObservedRun smooth{run.place, run.body, run.geometry, 1, run.origin, position, {}, {}, {}};
  const std::size_t begin = run.H->columns_of(0).first, end = run.H->columns_of(n - 1).end;
  for (std::size_t i = begin; i < end; i += (end - begin + 255) / 256) {
    double y = 0;
    for_each_polynomial(run.t[i], half, first + terms, [&](std::size_t j, double T, double slope) {
      if (j >= first) y += c[j - first] * (slopes ? slope : T);
    });
    smooth.t.push_back(run.t[i]);
    smooth.y.push_back(y);
  }
  smooth.way = way_of(position, smooth.t, smooth.y, options);
  return smooth;
}

}  // namespace

std::vector<ObservedRun> smooth_motion(Route route, const std::vector<ObservedRun>& runs,
                                       const Noise& noise, const FitOptions& options) {
  std::vector<ObservedRun> smooth;
  for (const ObservedRun& run : runs)
    smooth.push_back(smooth_motion(route, run, smooth.size(), noise, options));
  return smooth;
}

}  // namespace rolling
