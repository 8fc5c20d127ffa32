// SPDX-License-Identifier: GPL-3.0-or-later
// ulp [SAMPLES] - the largest errors of the exact geometry against 60 digits, and the times of both
// geometries beside the ways without them.
#include <fmt/format.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "base/gsl.h"
#include "motion/scene.h"
#include "unit/exact_body.h"
#include "unit/motion/closed_roll.h"
#include "unit/motion/exact_form_reference.h"
#include "unit/motion/random_scene.h"

using namespace rolling;

namespace {

constexpr int calls = 20000, rounds = 25;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// One after the other in each round, so that what else the machine does hits all of them; a first
/// round is not counted.
using Jobs = std::vector<std::pair<std::string, std::function<double()>>>;
void print_times(const Jobs& jobs) {
  std::vector<std::vector<double>> ns(jobs.size());
  volatile double sink = 0;
  for (int round = 0; round <= rounds; ++round)
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      const std::clock_t begin = std::clock();
      sink = jobs[i].second();
      if (round > 0)
        ns[i].push_back(static_cast<double>(std::clock() - begin) * (1e9 / CLOCKS_PER_SEC) / calls);
    }
  (void)sink;
  const auto ratio = [&](std::size_t i, std::size_t to) {
    std::vector<double> ratios;
    for (int round = 0; round < rounds; ++round)
      ratios.push_back(ns[i][static_cast<std::size_t>(round)] /
                       ns[to][static_cast<std::size_t>(round)]);
    return median(ratios);
  };
  const std::size_t step = jobs.size() - 1, pow = step - 1;
  fmt::print(
      "# ns of the processor a sample: median, least; parts of a step of GSL's rkf45 with pow, and "
      "of pow: medians of {} rounds\n",
      rounds);
  for (std::size_t i = 0; i < jobs.size(); ++i)
    fmt::print("{}\t{:.1f}\t{:.1f}\t{:.3f}\t{:.2f}\n", jobs[i].first, median(ns[i]),
               *std::min_element(ns[i].begin(), ns[i].end()), ratio(i, step), ratio(i, pow));
}

}  // namespace

int main(int argc, char** argv) {
  const int samples = argc > 1 ? std::atoi(argv[1]) : 100000;
  std::mt19937_64 random(2026);
  double v = 0, x = 0;
  for (int n = 0, scenes = 0; n < samples; ++scenes) {
    const RandomScene scene =
        scenes % 20 == 0 ? deep_scene(random, scenes / 20) : random_scene(random);
    const ExactFormReference reference(scene.body, scene.law, scene.v0);
    const auto rolled =
        start({exact_body(scene.body), scene.law, {0}, scene.v0, 0}, {Method::exact}, 0);
    Motion& motion = *rolled;
    const double T = motion.stop_time();
    for (int i = 0; i < 4; ++i) {
      const double t = i < 3 && std::isfinite(T) ? T * (1 - std::pow(1e-3, i + 1))
                                                 : random_time(random, scene, T, i);
      motion.seek(t);
      if (motion.velocity() < 1e-300) continue;  // denormal
      // Beside the stop one last digit of t is worth more than v: there the error is that of a
      // time. A rounding of D makes as much of the force as A is small.
      const auto error = reference.errors(t, motion.velocity(), motion.position());
      const double D = scene.law(scene.v0);
      const double A = std::sqrt(std::max(0.0, 1 - D / scene.body.R));
      const double of_D = 1e-16 / std::max(A * (A + scene.body.K), 1e-8);
      const double as_part_of_v0 = std::abs(error.v) * motion.velocity() / scene.v0;
      v = std::max(v, std::min(as_part_of_v0, std::abs(error.v / error.v_by_t)) - of_D);
      const double unit = (scene.body.K + 1) * scene.body.R * scene.v0 / (scene.body.g * D);
      const double way = std::max(motion.position(), scene.v0 * unit);
      x = std::max(x, std::abs(error.x) * motion.position() / way - of_D);
      ++n;
    }
  }
  fmt::print(
      "# exact geometry: largest errors over {} samples, one scene of twenty with D(v0) near R, "
      "three "
      "of four at T(1 - 1e-3, 1e-6, 1e-9): v over v0, or as if t were moved by this part "
      "of "
      "it\nv\t{:.2g}\nx\t{:.2g}\n",
      samples, v, x);

  const auto closed_owned = closed_roll({1.375, 0.04, 0.5}, {1.87e-3, 0.215}, 0.5);
  Motion& closed = *closed_owned;
  const auto rolled = start({exact_body({1.375, 0.04, 0.5}), PowerLaw{1.87e-3, 0.215}, {0}, 0.5, 0},
                            {Method::exact}, 0);
  Motion& exact = *rolled;
  const auto along = [](auto& motion, auto of) {
    return [&motion, of] {
      double sum = 0;
      for (int i = 0; i < calls; ++i) motion.seek(2.4 * i / calls), sum += of(motion);
      return sum;
    };
  };
  const volatile double b = 0.215;
  const auto power = [&] {
    double sum = 0;
    for (int i = 0; i < calls; ++i) sum += std::pow(0.5 - 2.4e-5 * i * 0.2, b);
    return sum;
  };
  const auto derivative = [](double, const double* y, double* dydt, void*) {
    dydt[0] = -0.305745 * std::pow(y[0], 0.215);
    return 0;
  };
  gsl_odeiv2_system system{derivative, nullptr, 1, nullptr};
  const auto stepper = own(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rkf45, 1), gsl_odeiv2_step_free);
  const auto step = [&] {
    double y = 0.5, error = 0;
    for (int i = 0; i < calls; ++i)
      gsl_odeiv2_step_apply(stepper.get(), 0, 1e-5, &y, &error, nullptr, nullptr, &system);
    return y;
  };
  print_times(
      {{"v", along(closed, [](auto& m) { return m.velocity(); })},
       {"v,x", along(closed, [](auto& m) { return m.velocity() + m.position(); })},
       {"v,x,a",
        along(closed, [](auto& m) { return m.velocity() + m.position() + m.acceleration(); })},
       {"exact v", along(exact, [](auto& m) { return m.velocity(); })},
       {"pow", power},
       {"rkf45", step}});
}
