// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the tables of tests/bench/troubles.h and studies.h: troubles [RUNS [TABLE [TROUBLE]]], all
// of them or one of troubles, remedies, laws, agreement, slope, given, min-speed. `make coverage`.
#include "bench/troubles.h"

#include <fmt/printf.h>

#include <cstdlib>
#include <cstring>

#include "bench/rows.h"
#include "bench/studies.h"

namespace {

using Rows = std::vector<std::function<std::string()>>;

constexpr unsigned seed = 20261122;
constexpr std::pair<const char*, rolling::PowerLaw> scenes[] = {{"CR", studies::CR},
                                                                {"CF", studies::CF}};

const char* only = nullptr;  // the trouble that is looked at, if not all

void add_text(Rows& rows, std::string text) {
  rows.push_back([text = std::move(text)] { return text; });
}

std::string judged(const troubled::Trouble& trouble, const char* name, rolling::PowerLaw law,
                   int runs) {
  const auto v = troubled::judge(trouble, law, runs, seed);
  return fmt::sprintf(
      "%-31s %-5s %+8.2f %7.3f %7.3f %8.3f %6.3f %9.3f %6.3f %9.3f %9.3f %9.3f %6.3f %6.3f %6.3f "
      "%7d\n",
      trouble.name, name, 100 * v.bias, v.cover_a, v.cover_b, v.adequate, v.noise, v.eccentric,
      1e3 * v.e, v.other_law, v.beginning, v.not_white, v.failed, v.told,
      troubled::best_power(trouble, law), v.refused);
}

void troubles(Rows& rows, int runs) {
  add_text(rows,
           fmt::sprintf("# What a run really has: %d runs each, position route; shares of "
                        "them; best: what the most powerful test of the fit could find at 0.5 %%\n"
                        "%-31s %-5s %8s %7s %7s %8s %6s %9s %6s %9s %9s %9s %6s %6s %6s %7s\n",
                        runs, "# trouble", "scene", "%_of_a", "cover_a", "cover_b", "adequate",
                        "noise", "eccentric", "mm", "other_law", "beginning", "not_white", "check",
                        "told", "best", "refused"));
  for (const auto& trouble : troubled::troubles())
    for (const auto& scene : scenes)
      if (!only || std::strstr(trouble.name, only))
        rows.push_back([=] { return judged(trouble, scene.first, scene.second, runs); });
}

constexpr const char* tally_names =
    "#            bias               sd      sigma sigma/sd  cover\n";
std::string line(const std::string& name, const studies::Tally& x) {
  return fmt::sprintf("%-12s %+10.2e %10.3e %10.3e %7.3f %7.3f\n", name, x.bias(), x.sd(),
                      x.sigma(), x.sigma() / x.sd(), x.cover());
}

void remedies(Rows& rows, int runs) {
  add_text(rows,
           fmt::sprintf("# a of %d runs each, where something is done about the trouble\n", runs) +
               tally_names);
  for (const auto& scene : scenes)
    for (const auto& trouble : troubled::troubles()) {
      const bool remedy = trouble.K != troubled::cylinder.K || trouble.hand > 0;
      if (!remedy && trouble.slope == 0) continue;
      rows.push_back([=] {
        return fmt::sprintf("# %s, %s\n", trouble.name,
                            trouble.slope != 0  ? "rolled both ways, --slope fit"
                            : trouble.hand != 0 ? "the first 0.2 s cut off"
                                                : "-K 0.515+-0.015") +
               line(scene.first,
                    remedy ? studies::remedied(trouble, scene.second, runs, seed)
                           : studies::slope_pairs(scene.second, trouble.slope, runs, seed).a);
      });
    }
}

std::string contest(const troubled::Truth& truth, int runs) {
  const auto c = troubled::contest(truth, runs, seed);
  std::string text = fmt::sprintf("%-29s", rolling::laws()[truth.law].formula);
  for (std::size_t j = 0; j < c.won.size(); ++j)
    text += c.apart[j] == 0 ? fmt::sprintf(" %24s", "-")
                            : fmt::sprintf("            %4d %7.3f", c.apart[j],
                                           static_cast<double>(c.won[j]) / c.apart[j]);
  return text + fmt::sprintf(" %6.3f %12d\n", c.cover, c.not_determined);
}

void laws(Rows& rows, int runs) {
  std::string head = fmt::sprintf(
      "# Which law made the run: of %d runs, those in which the AICc of the true law is 10 "
      "or more away from that of the other, and the share of them in which it is the smaller\n"
      "%-29s",
      runs, "# true law");
  for (const auto& law : rolling::laws()) head += fmt::sprintf(" %24s", law.formula);
  add_text(rows, head + fmt::sprintf(" %6s %12s\n", "cover", "undetermined"));
  for (const auto& truth : troubled::truths()) rows.push_back([=] { return contest(truth, runs); });
}

void agreement(Rows& rows, int runs) {
  add_text(rows, fmt::sprintf("# Rolls that are said to disagree, of %d joint fits\n", runs));
  for (const auto& scene : scenes) {
    const auto add = [&](int rolls, double slope, const char* what) {
      rows.push_back([=] {
        return fmt::sprintf("%-5s %2d %-29s %5d\n", scene.first, rolls, what,
                            studies::disagreements(scene.second, rolls, slope, runs, seed));
      });
    };
    for (int rolls : {2, 4, 10}) add(rolls, 0, "rolls under one law");
    add(2, 1e-3, "rolls up and down 1 mm/m");
  }
}

void slope(Rows& rows, int runs) {
  add_text(
      rows,
      fmt::sprintf("# %d pairs of rolls up and down a slope of 1 mm/m, the slope fitted\n", runs) +
          tally_names);
  for (const auto& scene : scenes)
    rows.push_back([=] {
      const auto all = studies::slope_pairs(scene.second, 1e-3, runs, seed);
      const std::string name = scene.first;
      return line(name + " a", all.a) + line(name + " b", all.b) + line(name + " slope", all.slope);
    });
}

void turns(Rows& rows, int runs) {
  add_text(rows,
           fmt::sprintf("# %d runs up a slope and back: sigma_a/a, sigma_b, and the shares of the "
                        "intervals that hold, of the runs that are not refused\n"
                        "%-9s %5s %9s %7s %7s %5s %5s %5s %8s\n",
                        runs, "# body", "slope", "route", "sigma_a", "sigma_b", "a", "b", "slope",
                        "refused"));
  for (const auto& body : studies::turning)
    for (const double slope : {0.01, 0.02, 0.05, 0.1})
      for (const auto route : {rolling::Route::position, rolling::Route::velocity})
        rows.push_back([=] {
          const auto all = studies::turning_runs(body, slope, route, runs, seed);
          return fmt::sprintf("%-9s %5.2f %9s %7.4f %7.4f %5.3f %5.3f %5.3f %8d\n", body.name,
                              slope, route == rolling::Route::position ? "position" : "velocity",
                              all.a.sigma() / body.law.a, all.b.sigma(), all.a.cover(),
                              all.b.cover(), all.slope.cover(), all.refused);
        });
}

void given(Rows& rows, int runs) {
  rows.push_back([=] {
    const auto all = studies::input_quantities(10 * runs, seed);
    std::string text = fmt::sprintf(
        "# %d draws of K, R, g and the slope: spread, and the error that is stated\n", 10 * runs);
    const auto add = [&](const char* name, double spread, double stated) {
      text += fmt::sprintf("%-5s %10.4e %10.4e %7.4f\n", name, spread, stated, stated / spread);
    };
    add("a", all.a.sd(), all.stated_a);
    add("b", all.b.sd(), all.stated_b);
    add("v0", all.v0.sd(), all.stated_v0);
    add("corr", all.corr, all.stated_corr);
    return text;
  });
}

void min_speed(Rows& rows, int runs) {
  add_text(rows, fmt::sprintf("# %d runs of noisy speeds, --min-speed 0.1\n", runs) + tally_names);
  for (const auto& scene : scenes)
    rows.push_back([=] {
      const auto all = studies::min_speed(scene.second, 0.1, runs, seed);
      const std::string name = scene.first;
      return line(name + " a", all.a) + line(name + " b", all.b);
    });
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 1000;
  if (argc > 3) only = argv[3];
  constexpr std::pair<const char*, void (*)(Rows&, int)> tables[] = {
      {"troubles", troubles}, {"laws", laws},           {"agreement", agreement}, {"slope", slope},
      {"given", given},       {"min-speed", min_speed}, {"remedies", remedies},   {"turns", turns}};
  Rows rows;
  for (const auto& [name, add] : tables)
    if (argc < 3 || std::strcmp(argv[2], name) == 0) add(rows, runs);
  bench::print_rows(std::move(rows));
}
