#include "signal/free_roll.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/error.h"

namespace rolling {
namespace {

/// The local speeds, over windows cut off at the ends of the run.
std::vector<double> local_speeds(std::span<const Sample> run, bool positions, std::size_t k) {
  std::vector<double> speeds;
  speeds.reserve(run.size());
  for (std::size_t i = 0; i < run.size(); ++i) {
    const auto window =
        run.subspan(i - std::min(i, k), std::min(i + k + 1, run.size()) - (i - std::min(i, k)));
    const auto n = static_cast<double>(window.size());
    double t = 0, y = 0, tt = 0, ty = 0;
    for (const Sample& s : window) t += (s.t - run[i].t) / n, y += (s.y - run[i].y) / n;
    for (const Sample& s : window)
      tt += (s.t - run[i].t - t) * (s.t - run[i].t - t),
          ty += (s.t - run[i].t - t) * (s.y - run[i].y);
    speeds.push_back(positions ? ty / tt : run[i].y + y);
  }
  return speeds;
}

/// The noise of local speeds, from the second differences of windows that do not overlap: those
/// after the peak while the body moves, or all of them where these are too few.
double noise_of(const std::vector<double>& speeds, std::size_t peak, std::size_t k) {
  const std::size_t apart = 2 * k + 1;
  std::vector<double> distances;
  const auto collect = [&](std::size_t from, double least) {
    for (std::size_t i = from + apart; i + apart < speeds.size(); ++i)
      if (std::abs(speeds[i]) >= least)
        distances.push_back(std::abs(speeds[i + apart] - 2 * speeds[i] + speeds[i - apart]));
  };
  collect(peak, std::abs(speeds[peak]) / 5);
  if (distances.size() < 10) collect(0, 0);
  if (distances.empty()) return 0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return 1.4826 * *middle / std::sqrt(6.0);
}

/// A run seen through windows of 2k + 1 samples.
struct View {
  std::size_t k, peak;
  std::vector<double> speeds;
  double fastest, noise;

  View(std::span<const Sample> run, bool positions, std::size_t half)
      : k(half), speeds(local_speeds(run, positions, half)) {
    const auto slower = [](double a, double b) { return std::abs(a) < std::abs(b); };
    peak = static_cast<std::size_t>(std::max_element(speeds.begin(), speeds.end(), slower) -
                                    speeds.begin());
    fastest = std::abs(speeds[peak]), noise = noise_of(speeds, peak, k);
  }
};

}  // namespace

Stretch free_roll(std::span<const Sample> run, bool positions) {
  const std::size_t n = run.size();
  if (n < 10) fail("a run of {} records is too short to find its free roll", n);
  View view(run, positions, 2);
  for (std::size_t k = 3; view.noise > 0.02 * view.fastest && 20 * k < n; k += (k + 1) / 2)
    if (View wider(run, positions, k); wider.noise * view.fastest < view.noise * wider.fastest)
      view = std::move(wider);
  const auto& [k, peak, speeds, fastest, noise] = view;
  if (!(fastest > 8 * noise)) fail("nothing moves in this run: it has no free roll");

  const double sign = speeds[peak] < 0 ? -1 : 1;
  std::size_t release = peak;  // where the speed is last as great as its noise can tell
  for (std::size_t i = peak; i < n && sign * speeds[i] > 0.9 * fastest; ++i)
    if (sign * speeds[i] > fastest - noise) release = i;
  const std::size_t begin =
      peak <= k ? 0 : std::min(release + k + 3, n);  // no push: the record begins with the roll
  std::size_t end = begin;
  while (end < n && sign * speeds[end] > 2 * noise) ++end;
  if (end < n) end -= std::min(k, end - begin);
  while (!positions && end > begin && sign * run[end - 1].y <= 0) --end;
  if (end - begin < 3) fail("no free roll is found after the push");
  return {begin, end};
}

}  // namespace rolling
