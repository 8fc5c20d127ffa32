// SPDX-License-Identifier: GPL-3.0-or-later
// work_precision FOLDER [PROBLEM] - error against run time of every method on every problem or this
// one, side by side in one run: FOLDER/PROBLEM.txt each.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "bench/bare_gsl.h"
#include "bench/cvode.h"
#include "contact/road.h"
#include "motion/scene.h"

using namespace rolling;

namespace {

constexpr std::size_t samples = 200;  // to 1.2 times the stop, with memory to the stop, or to 10 s

Scene scene(double a, double b, double K) {
  Scene roll{};
  roll.body = {1.375, 0.04, K}, roll.law = PowerLaw{a, b}, roll.v0 = 0.5;
  return roll;
}

/// h(x) every `step` from `from` to `to`.
Road track(double from, double to, double step, double (*h)(double)) {
  std::vector<double> x, y;
  for (double at = from; at < to + step / 2; at += step) {
    x.push_back(at);
    y.push_back(h(at));
  }
  return {x, y};
}

/// A slope, a turning point on a slope, a ball in a bowl that turns five times, and a car on hills.
void add_roads(std::vector<std::pair<std::string, Scene>>& all) {
  for (const auto& [name, slope] : {std::pair("slope", 0.005), std::pair("turn", 0.02)}) {
    all.emplace_back(name, scene(5.75e-4, 0.0244, 0.5));
    all.back().second.body.slope = slope;
  }
  static const Road bowl = track(-0.3, 0.3, 0.01, [](double x) { return x * x / 2; });
  static const Road hills = track(-5, 300, 5, [](double x) { return 2 * std::sin(x / 30); });
  all.emplace_back("bowl", scene(5e-5, 0.1, 0.4));
  all.back().second.body.R = 0.0127;
  all.back().second.body.road = &bowl;
  all.emplace_back("hills", scene(1, 1, 0.04));
  all.back().second.body.R = 0.3;
  all.back().second.body.road = &hills;
  all.back().second.law = Law(laws()[4], std::vector{3e-3, 1e-5});
  all.back().second.v0 = 20;
}

std::vector<std::pair<std::string, Scene>> problems() {
  std::vector<std::pair<std::string, Scene>> all = {{"CR", scene(1.87e-3, 0.215, 0.5)},
                                                    {"CF", scene(5.75e-4, 0.0244, 0.5)},
                                                    {"SR", scene(1.78e-3, 0.255, 0.83)},
                                                    {"SF", scene(5.75e-4, 0.0244, 0.83)}};
  for (const auto& [name, b] : std::vector<std::pair<std::string, double>>{{"b=-0.5", -0.5},
                                                                           {"b=0", 0},
                                                                           {"b=1e-8", 1e-8},
                                                                           {"b=0.5", 0.5},
                                                                           {"b=0.9", 0.9},
                                                                           {"b=1-1e-12", 1 - 1e-12},
                                                                           {"b=1", 1},
                                                                           {"b=1+1e-12", 1 + 1e-12},
                                                                           {"b=1.5", 1.5},
                                                                           {"b=2", 2}})
    all.emplace_back(name, scene(1.87e-3, b, 0.5));
  for (const auto& [name, a] : {std::pair("exact-CR", 1.87e-3), std::pair("exact-deep", 0.04)}) {
    all.emplace_back(name, scene(a, 0.215, 0.5));
    all.back().second.body.exact = true;
  }
  for (const char* length : {"1e-3", "1e-4", "1e-5", "1e-6", "1e-7"}) {
    all.emplace_back(fmt::format("memory-{}", length), scene(1.87e-3, 0.215, 0.5));
    all.back().second.bulge.length = std::stod(length);
  }
  for (const int n : {5, 50}) {
    std::vector<double> v, D;
    for (int i = 1; i <= n; ++i)
      v.push_back(0.5 * i / n),
          D.push_back(1.87e-3 * std::pow(v.back(), 0.215) * (1 + 0.05 * std::sin(7.0 * i)));
    all.emplace_back(fmt::format("table-{}", n), scene(1, 1, 0.5));
    all.back().second.law = TableLaw(v, D);
  }
  add_roads(all);
  return all;
}

void row(std::FILE* file, const std::string& who, const std::string& method, double rtol,
         const Measured& m) {
  fmt::print(file, "{}\t{}\t{:g}\t", who, method, rtol);
  if (m.failure.empty())
    fmt::print(file, "{:.3g}\t{:.3g}\t{}\t{:.4g}\tdone\n", m.v_error, m.stop_error, m.evaluations,
               1e9 * m.seconds);
  else fmt::print(file, "nan\tnan\t{}\tnan\tfailed: {}\n", m.evaluations, m.failure);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) return 2;
  const std::vector<std::pair<std::string, Stepper>> ours = {{"rkf45", gsl_odeiv2_step_rkf45},
                                                             {"rk8pd", gsl_odeiv2_step_rk8pd},
                                                             {"rk4imp", gsl_odeiv2_step_rk4imp},
                                                             {"bsimp", gsl_odeiv2_step_bsimp},
                                                             {"msbdf", gsl_odeiv2_step_msbdf}};
  const std::vector<std::pair<std::string, const gsl_odeiv2_step_type*>> bare = {
      {"rkf45", gsl_odeiv2_step_rkf45},
      {"rk8pd", gsl_odeiv2_step_rk8pd},
      {"rk4imp", gsl_odeiv2_step_rk4imp},
      {"bsimp", gsl_odeiv2_step_bsimp},
      {"msbdf", gsl_odeiv2_step_msbdf}};
  const std::vector<double> tolerances = {1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
  for (const auto& [name, roll] : problems()) {
    if (argc == 3 && name != argv[2]) continue;
    const std::string path = fmt::format("{}/{}.txt", argv[1], name);
    std::FILE* file = std::fopen(path.c_str(), "w");
    if (!file) {
      std::perror(path.c_str());
      return 2;
    }
    const Reference right = reference(roll, samples, 10);
    fmt::print(file,
               "# by\tmethod\trtol\tmax_error\tstop_error\tevaluations\tns_sample\toutcome\n");
    const Method best = best_method(roll);
    const auto rolled = [&, &scene = roll](const Method& method, double rtol) {
      return measure([&] { return start(scene, method, rtol); }, right);
    };
    const bool road = roll.body.road != nullptr;
    if (best.kind != Method::solver) {
      for (const double rtol : road ? tolerances : std::vector<double>{0})
        row(file, "rolling", best.kind == Method::closed ? "closed" : "exact", rtol,
            rolled(best, rtol));
      fmt::print(file, "\n\n");
    }
    // No solver knows a height, and the bare ones know no slope.
    for (const auto& [method, stepper] :
         road ? std::vector<std::pair<std::string, Stepper>>() : ours) {
      for (const double rtol : tolerances)
        row(file, "rolling", method, rtol, rolled({Method::solver, stepper}, rtol));
      fmt::print(file, "\n\n");
    }
    const bool level = roll.body.slope == 0 && !road;
    for (const bool odd : level ? std::vector{false, true} : std::vector<bool>()) {
      if (!odd && roll.bulge.length > 0) continue;  // that law is odd by itself
      for (const auto& [method, type] : bare) {
        for (const double rtol : tolerances)
          row(file, odd ? "GSL-odd" : "GSL", method, rtol,
              measure([&, &scene = roll,
                       type = type] { return std::make_unique<BareGsl>(scene, type, rtol, odd); },
                      right));
        fmt::print(file, "\n\n");
      }
    }
#ifdef HAVE_CVODE
    for (const auto& [method, kind] : {std::pair("adams", CV_ADAMS), std::pair("bdf", CV_BDF)}) {
      if (!level) continue;
      for (const double rtol : tolerances)
        row(file, "CVODE", method, rtol,
            measure([&, &scene = roll,
                     kind = kind] { return std::make_unique<Cvode>(scene, kind, rtol); },
                    right));
      fmt::print(file, "\n\n");
    }
#endif
    if (std::fclose(file) != 0) {
      std::perror(path.c_str());
      return 2;
    }
  }
  return 0;
}
