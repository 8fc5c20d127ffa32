// ulp SAMPLES - the largest errors of the closed form against 80 digits and, for a tenth of the samples, of the exact geometry against 60;
// and their times beside the ways without them.
#include <fmt/format.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "base/gsl.h"
#include "rolling/closed_form.h"
#include "rolling/exact_form.h"
#include "unit/rolling/closed_form_reference.h"
#include "unit/rolling/exact_form_reference.h"
#include "unit/rolling/random_scene.h"

using namespace rolling;

namespace {

struct Time {
  double median, scatter;  // ns
};

/// Of one call of the 20000 that `work` does: median of 15 runs after a first, and half the distance of their quartiles.
template <typename Work>
Time nanoseconds(Work&& work) {
  constexpr int calls = 20000;
  volatile double sink = work(calls);
  std::vector<double> runs;
  for (int i = 0; i < 15; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    sink = work(calls);
    runs.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() * 1e9 / calls);
  }
  (void)sink;
  std::sort(runs.begin(), runs.end());
  return {runs[7], (runs[11] - runs[3]) / 2};
}

}  // namespace

int main(int argc, char** argv) {
  const int samples = argc > 1 ? std::atoi(argv[1]) : 100000;
  std::mt19937_64 random(2026);
  double v = 0, x = 0, a = 0;
  for (int n = 0; n < samples;) {
    const RandomScene scene = random_scene(random);
    ClosedForm motion(scene.body, scene.law, scene.v0, 0);
    for (int i = 0; i < 4; ++i) {
      const double t = random_time(random, scene, motion.stop_time(), i);
      const ClosedFormReference exact = closed_form_reference(scene.body, scene.law, scene.v0, t);
      if (exact.v < 1e-300) continue;  // denormal
      motion.seek(t);
      v = std::max(v, ulp_error(motion.velocity(), exact.v));
      x = std::max(x, ulp_error(motion.position(), exact.x));
      a = std::max(a, ulp_error(motion.acceleration(), exact.a));
      ++n;
    }
  }
  fmt::print("# largest error in ulp over {} samples of random scenes\nv\t{:.3f}\nx\t{:.3f}\na\t{:.3f}\n", samples, v, x, a);

  v = x = 0;
  for (int n = 0, scenes = 0; n < samples / 10; ++scenes) {
    const RandomScene scene = scenes % 20 == 0 ? deep_scene(random, scenes / 20) : random_scene(random);
    const ExactFormReference reference(scene.body, scene.law, scene.v0);
    ExactForm motion(scene.body, scene.law, scene.v0, 0);
    const double T = motion.stop_time();
    for (int i = 0; i < 4; ++i) {
      const double t = i < 3 && std::isfinite(T) ? T * (1 - std::pow(1e-3, i + 1)) : random_time(random, scene, T, i);
      motion.seek(t);
      if (motion.velocity() < 1e-300) continue;  // denormal
      const auto error = reference.errors(t, motion.velocity(), motion.position());
      v = std::max(v, std::abs(error.v)), x = std::max(x, std::abs(error.x));
      ++n;
    }
  }
  fmt::print("# exact geometry: largest relative error over {} samples, one scene of twenty with D(v0) near R, three of four at T(1 - 1e-3, 1e-6, 1e-9)\nv\t{:.2g}\nx\t{:.2g}\n",
             samples / 10, v, x);

  ClosedForm motion({1.375, 0.04, 0.5}, {1.87e-3, 0.215}, 0.5, 0);
  const auto along = [&](auto&& of) {
    return nanoseconds([&](int calls) {
      double sum = 0;
      for (int i = 0; i < calls; ++i) motion.seek(2.4 * i / calls), sum += of();
      return sum;
    });
  };
  const volatile double b = 0.215;
  const Time power = nanoseconds([&](int calls) {
    double sum = 0;
    for (int i = 0; i < calls; ++i) sum += std::pow(0.5 - 2.4e-5 * i * 0.2, b);
    return sum;
  });
  const auto derivative = [](double, const double* y, double* dydt, void*) {
    dydt[0] = -0.305745 * std::pow(y[0], 0.215);
    return 0;
  };
  gsl_odeiv2_system system{derivative, nullptr, 1, nullptr};
  const auto step = own(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rkf45, 1), gsl_odeiv2_step_free);
  const Time gsl = nanoseconds([&](int calls) {
    double y = 0.5, error = 0;
    for (int i = 0; i < calls; ++i) gsl_odeiv2_step_apply(step.get(), 0, 1e-5, &y, &error, nullptr, nullptr, &system);
    return y;
  });
  fmt::print("# ns a sample, scatter, parts of a step of GSL's rkf45 with pow\n");
  const auto print = [&](const char* what, Time t) { fmt::print("{}\t{:.1f}\t{:.1f}\t{:.2f}\n", what, t.median, t.scatter, t.median / gsl.median); };
  print("v", along([&] { return motion.velocity(); }));
  print("v,x", along([&] { return motion.velocity() + motion.position(); }));
  print("v,x,a", along([&] { return motion.velocity() + motion.position() + motion.acceleration(); }));
  ExactForm exact({1.375, 0.04, 0.5}, {1.87e-3, 0.215}, 0.5, 0);
  print("exact v", nanoseconds([&](int calls) {
          double sum = 0;
          for (int i = 0; i < calls; ++i) exact.seek(2.4 * i / calls), sum += exact.velocity();
          return sum;
        }));
  print("pow", power);
  print("rkf45", gsl);
}
