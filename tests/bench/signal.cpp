// SPDX-License-Identifier: GPL-3.0-or-later
// How far smoothed speeds and their derivatives are from the truth, method by method and window by
// window: the four scenes of the paper, seen by a sonar, many seeds each. Plain columns on standard
// output; tests/bench/signal.sh runs it and draws the figure.
//
//   signal [SEEDS]          the table; 200 seeds
//   signal runs SEEDS    the runs: scene, seed, t, x, and the true v and a
//
// From positions at 25 Hz (0.3 mm of noise, rounded to 1 mm) v comes by central differences, as
// smooth(1) gets it. Then either v is smoothed and differentiated by central differences, or
// differentiated by a method that smooths as it goes.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <vector>

#include "unit/motion/closed_roll.h"
#include "sensor/sonar.h"
#include "signal/method.h"

using namespace rolling;

namespace {

struct Experiment {
  const char* name;
  double K;
  PowerLaw law;
};
const Experiment scenes[] = {{"CF", 0.5, {5.75e-4, 2.44e-2}},
                             {"CR", 0.5, {1.87e-3, 0.215}},
                             {"SF", 0.83, {5.75e-4, 2.44e-2}},
                             {"SR", 0.83, {1.78e-3, 0.255}}};

using Series = std::vector<double>;

Series through(Signal& signal, const Series& t, const Series& y) {
  Series out;
  const auto take = [&](std::span<const double> values) {
    out.insert(out.end(), values.begin(), values.end());
  };
  for (std::size_t i = 0; i < t.size(); ++i) take(signal.push(t[i], y[i]));
  take(signal.finish());
  return out;
}

const auto smoothing = by_name(smoothing_methods), differentiation = by_name(derivative_methods);

Series apply(const SignalOptions& options, const Series& t, const Series& y) {
  return through(*make_signal(options), t, y);
}

/// The free roll of one run: from two rows after the release, where the central difference
/// has left the push behind, to a tenth of the greatest speed.
struct NoisyRoll {
  Series t, x, v, a;
};  // v and a: the truth

NoisyRoll roll(const Experiment& scene, unsigned long seed) {
  const auto motion_owned = closed_roll({1.375, 0.04, scene.K}, scene.law, 0.5, 0);
  Motion& motion = *motion_owned;
  SonarOptions options;
  options.seed = seed, options.lost = 0;
  NoisyRoll out;
  std::vector<SonarSample> run;
  sonar_run(motion, options, [&](const SonarSample& s) { run.push_back(s); });
  motion.seek(0);
  for (const SonarSample& s : run) {
    const double t = s.t - options.rest_before - options.push;
    if (t < 1.5 / options.rate) continue;
    motion.seek(t);
    if (motion.velocity() < 0.05) break;
    out.t.push_back(s.t), out.x.push_back(*s.x), out.v.push_back(motion.velocity()),
        out.a.push_back(motion.acceleration());
  }
  return out;
}

struct Pipeline {
  std::string name;
  double width;  // NaN: none
  std::function<void(const NoisyRoll&, const Series& v, Series& smooth, Series& a)> apply;
};

constexpr std::size_t next(std::size_t width) {
  return width + (width < 15 ? 2 : width < 31 ? 4 : 10);
}

std::vector<Pipeline> methods() {
  std::vector<Pipeline> all;
  const SignalOptions central{differentiation.at("central")};
  for (const auto& [name, method] : smoothing)
    for (std::size_t width = method->has_order ? 5 : 1; width <= 61; width = next(width)) {
      if (name == "median" && width == 1) continue;
      const SignalOptions options{method, {width, 0}};
      all.push_back({name + "+central", static_cast<double>(width),
                     [=](const NoisyRoll& r, const Series& v, Series& s, Series& a) {
        s = apply(options, r.t, v), a = apply(central, r.t, s);
                     }});
    }
  for (std::size_t order = 1; order <= 2; ++order)
    for (std::size_t width = 5; width <= 61; width = next(width))
      all.push_back({fmt::format("savgol{}", order), static_cast<double>(width),
                     [=](const NoisyRoll& r, const Series& v, Series& s, Series& a) {
        s = apply({smoothing.at("savgol"), {width, 0}, order}, r.t, v),
        a = apply({differentiation.at("savgol"), {width, 0}, order}, r.t, v);
                     }});
  for (const auto& [name, method] : differentiation)
    if (name != "savgol" && name != "central")
      all.push_back({name, NAN,
                     [m = method](const NoisyRoll& r, const Series& v, Series& s, Series& a) {
        s = v, a = apply({m}, r.t, v);
                     }});
  all.push_back({"spline_of_x+central", NAN,
                 [=](const NoisyRoll& r, const Series&, Series& s, Series& a) {
    s = apply({differentiation.at("spline")}, r.t, r.x), a = apply(central, r.t, s);
                 }});
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2) {  // the runs themselves, for others: tests/bench/signal_scipy.py
    const unsigned long count = std::strtoul(argv[2], nullptr, 10);
    for (const Experiment& scene : scenes)
      for (unsigned long seed = 1; seed <= count; ++seed) {
        const NoisyRoll r = roll(scene, seed);
        for (std::size_t i = 0; i < r.t.size(); ++i)
          fmt::print("{}\t{}\t{}\t{}\t{}\t{}\n", scene.name, seed, r.t[i], r.x[i], r.v[i], r.a[i]);
      }
    return 0;
  }
  const unsigned long seeds = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 200;
  fmt::print(
      "# {} seeds each; errors are root mean squares over runs and seeds, of D relative to its "
      "truth; ends: the first\n"
      "# and last five rows; bias and scatter: of a inside, over runs of the mean over seeds "
      "and about it;\n"
      "# seconds: median over the seeds\n"
      "# "
      "scene\tmethod\twidth\terror_v[m/s]\terror_a[m/s^2]\tbias_a[m/s^2]\tscatter_a[m/"
      "s^2]\tends_a[m/s^2]\terror_D\tseconds_per_row\n",
      seeds);
  constexpr std::size_t ends = 5;
  for (const Experiment& scene : scenes)
    for (const Pipeline& method : methods()) {
      std::vector<double> sum, squares, smooth, a, seconds;  // seconds: of each run, a row
      double v_errors = 0, inside = 0, outside = 0, relative = 0;
      std::size_t n = 0;
      for (unsigned long seed = 1; seed <= seeds; ++seed) {
        const NoisyRoll r = roll(scene, seed);
        const Series v = apply({differentiation.at("central")}, r.t, r.x);
        const auto begin = std::chrono::steady_clock::now();
        method.apply(r, v, smooth, a);
        n = r.t.size();
        seconds.push_back(
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() /
            static_cast<double>(n));
        sum.resize(n), squares.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
          const double error = a[i] - r.a[i];
          sum[i] += error, squares[i] += error * error;
          if (i < ends || i + ends >= n) outside += error * error;
          else {
            inside += error * error, relative += error * error / (r.a[i] * r.a[i]);
            v_errors += (smooth[i] - r.v[i]) * (smooth[i] - r.v[i]);
          }
        }
      }
      const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
      std::nth_element(seconds.begin(), middle, seconds.end());
      const auto count = static_cast<double>(seeds), inner = static_cast<double>(n - 2 * ends);
      double bias = 0, scatter = 0;
      for (std::size_t i = ends; i + ends < n; ++i) {
        const double mean = sum[i] / count;
        bias += mean * mean / inner, scatter += (squares[i] / count - mean * mean) / inner;
      }
      fmt::print("{}\t{}\t{}\t{:.3e}\t{:.3e}\t{:.3e}\t{:.3e}\t{:.3e}\t{:.4f}\t{:.2e}\n", scene.name,
                 method.name, std::isnan(method.width) ? "NaN" : fmt::format("{}", method.width),
                 std::sqrt(v_errors / count / inner), std::sqrt(inside / count / inner),
                 std::sqrt(bias), std::sqrt(scatter), std::sqrt(outside / count / (2 * ends)),
                 std::sqrt(relative / count / inner), *middle);
    }
}
