// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the table of tests/bench/coverage.h: coverage [RUNS [WORD]], only the cases whose name has
// WORD. `make coverage`.
#include "bench/coverage.h"

#include <fmt/printf.h>

#include <cstdlib>
#include <cstring>

#include "bench/rows.h"

namespace {

std::string shares(const double (&covers)[4]) {
  std::string text;
  for (const double cover : covers) text += fmt::sprintf(" %5.3f", cover);
  return text;
}

std::string row(const coverage::Case& what, const coverage::Scene& scene, int runs) {
  const char* const route_names[] = {"loglog", "shift", "velocity", "position"};
  const auto r = coverage::measure(what, scene, runs, 20261121);
  return fmt::sprintf(
      "%-31s %-8s %-5s %+7.2f %+7.2f %+7.2f %8.5f %9s %7.3f %7.3f%s%s %5s %7s %5.2f %6.3f %4d "
      "%8d %6.2f\n",
      what.name, route_names[static_cast<int>(what.route)], scene.name, r.bias_a, r.percent_a,
      r.bias_b, r.sd_b, what.bound ? fmt::sprintf("%.3f", r.over_bound) : "-", r.sigma_a, r.sigma_b,
      shares(r.covers_a), shares(r.covers_b),
      what.begins_at_v0() ? fmt::sprintf("%.3f", r.cover_v0) : "-",
      what.down > 0 ? fmt::sprintf("%.3f", r.cover_slope) : "-", r.told, r.differ, r.far, r.refused,
      1e3 * r.seconds);
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 1000;
  std::vector<std::function<std::string()>> rows;
  for (const auto& what : coverage::cases()) {
    if (argc > 2 && !std::strstr(what.name, argv[2])) continue;
    const auto add = [&](const coverage::Scene& scene) {
      rows.push_back([=] { return row(what, scene, runs); });
    };
    add(coverage::CR);
    if (what.law == 0) add(coverage::CF);
    if (what.whole)
      for (const auto& scene : {coverage::SR, coverage::SF}) add(scene);
    if (what.rises > 0) add(coverage::exponents[0]);
    if (what.name == std::string("white x") || what.name == std::string("D from x, mean 11"))
      for (const auto& scene : coverage::exponents) add(scene);
  }
  std::printf(
      "# %d runs each; biases in sd; sigma/sd: standard errors over the spread; a50 .. b99: shares "
      "of the intervals of 50, 68, 95 and 99 %% that hold; v0, slope: of 95 %%; "
      "told: errors of the autocorrelation or of uneven noise; differ: joint runs that are said to "
      "disagree; far: beyond 6 standard errors\n",
      runs);
  std::printf(
      "%-31s %-8s %-5s %7s %7s %7s %8s %9s %7s %7s %5s %5s %5s %5s %5s %5s %5s %5s %5s %7s %5s "
      "%6s %4s %8s %6s\n",
      "# case", "route", "scene", "bias_a", "%_of_a", "bias_b", "sd_b", "sd/bound", "sigma_a",
      "sigma_b", "a50", "a68", "a95", "a99", "b50", "b68", "b95", "b99", "v0", "slope", "told",
      "differ", "far", "refused", "ms");
  bench::print_rows(std::move(rows));
}
