// Prints the tables of tests/bench/records.h and studies.h: records [RUNS [TABLE [TROUBLE]]], all
// of them or one of troubles, remedies, laws, agreement, slope, given, min-speed. `make coverage`.
#include "bench/records.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "bench/studies.h"

namespace {

constexpr unsigned seed = 20261122;
const std::pair<const char*, rolling::PowerLaw> scenes[] = {{"CR", studies::CR},
                                                            {"CF", studies::CF}};

const char* only = nullptr;  // the trouble that is looked at, if not all

void troubles(int runs) {
  std::printf(
      "# What a record really has: %d records each, position route; shares of them; best: what the "
      "most powerful test of the fit could find at 0.5 %%\n",
      runs);
  std::printf("%-31s %-5s %8s %7s %7s %8s %6s %9s %6s %9s %9s %9s %6s %6s %6s %7s\n", "# trouble",
              "scene", "%_of_a", "cover_a", "cover_b", "adequate", "noise", "eccentric", "mm",
              "other_law", "beginning", "not_white", "check", "told", "best", "refused");
  for (const auto& trouble : records::troubles())
    for (const auto& [name, law] : scenes) {
      if (only && !std::strstr(trouble.name, only)) continue;
      const auto v = records::judge(trouble, law, runs, seed);
      std::printf(
          "%-31s %-5s %+8.2f %7.3f %7.3f %8.3f %6.3f %9.3f %6.3f %9.3f %9.3f %9.3f %6.3f %6.3f "
          "%6.3f "
          "%7d\n",
          trouble.name, name, 100 * v.bias, v.cover_a, v.cover_b, v.adequate, v.noise, v.eccentric,
          1e3 * v.e, v.other_law, v.beginning, v.not_white, v.failed, v.told,
          records::best_power(trouble, law), v.refused);
      std::fflush(stdout);
    }
}

constexpr const char* tally_names =
    "#            bias               sd      sigma sigma/sd  cover\n";
void print(const char* name, const studies::Tally& x) {
  std::printf("%-12s %+10.2e %10.3e %10.3e %7.3f %7.3f\n", name, x.bias(), x.sd(), x.sigma(),
              x.sigma() / x.sd(), x.cover());
}

void remedies(int runs) {
  std::printf("# a of %d records each, where something is done about the trouble\n%s", runs,
              tally_names);
  for (const auto& [name, law] : scenes) {
    for (const auto& trouble : records::troubles()) {
      const bool remedy = trouble.K != records::cylinder.K || trouble.hand > 0;
      if (!remedy && trouble.slope == 0) continue;
      std::printf("# %s, %s\n", trouble.name,
                  trouble.slope != 0  ? "rolled both ways, --slope fit"
                  : trouble.hand != 0 ? "the first 0.2 s cut off"
                                      : "-K 0.515+-0.015");
      print(name, remedy ? studies::remedied(trouble, law, runs, seed)
                         : studies::slope_pairs(law, trouble.slope, runs, seed).a);
      std::fflush(stdout);
    }
  }
}

void laws(int runs) {
  std::printf(
      "# Which law made the record: of %d records, those in which the AICc of the true law is 10 "
      "or more away from that of the other, and the share of them in which it is the smaller\n",
      runs);
  std::printf("%-29s", "# true law");
  for (const auto& law : rolling::laws()) std::printf(" %24s", law.formula);
  std::printf(" %6s %12s\n", "cover", "undetermined");
  for (const auto& truth : records::truths()) {
    const auto c = records::contest(truth, runs, seed);
    std::printf("%-29s", rolling::laws()[truth.law].formula);
    for (std::size_t j = 0; j < c.won.size(); ++j)
      if (c.apart[j] == 0) std::printf(" %24s", "-");
      else
        std::printf("            %4d %7.3f", c.apart[j],
                    static_cast<double>(c.won[j]) / c.apart[j]);
    std::printf(" %6.3f %12d\n", c.cover, c.not_determined);
    std::fflush(stdout);
  }
}

void agreement(int runs) {
  std::printf("# Rolls that are said to disagree, of %d joint fits\n", runs);
  for (const auto& [name, law] : scenes) {
    for (int rolls : {2, 4, 10})
      std::printf("%-5s %2d rolls under one law         %5d\n", name, rolls,
                  studies::disagreements(law, rolls, 0, runs, seed));
    std::printf("%-5s  2 rolls up and down 1 mm/m      %5d\n", name,
                studies::disagreements(law, 2, 1e-3, runs, seed));
    std::fflush(stdout);
  }
}

void slope(int runs) {
  std::printf("# %d pairs of rolls up and down a slope of 1 mm/m, the slope fitted\n%s", runs,
              tally_names);
  for (const auto& [name, law] : scenes) {
    const auto all = studies::slope_pairs(law, 1e-3, runs, seed);
    for (const auto& [what, tally] :
         {std::pair(" a", &all.a), std::pair(" b", &all.b), std::pair(" slope", &all.slope)})
      print((std::string(name) + what).c_str(), *tally);
    std::fflush(stdout);
  }
}

void given(int runs) {
  const auto all = studies::given_numbers(10 * runs, seed);
  std::printf("# %d draws of K, R, g and the slope: spread, and the error that is stated\n",
              10 * runs);
  const auto line = [](const char* name, double spread, double stated) {
    std::printf("%-5s %10.4e %10.4e %7.4f\n", name, spread, stated, stated / spread);
  };
  line("a", all.a.sd(), all.stated_a);
  line("b", all.b.sd(), all.stated_b);
  line("v0", all.v0.sd(), all.stated_v0);
  line("corr", all.corr, all.stated_corr);
}

void min_speed(int runs) {
  std::printf("# %d records of noisy speeds, --min-speed 0.1\n%s", runs, tally_names);
  for (const auto& [name, law] : scenes) {
    const auto all = studies::min_speed(law, 0.1, runs, seed);
    print((std::string(name) + " a").c_str(), all.a);
    print((std::string(name) + " b").c_str(), all.b);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 1000;
  if (argc > 3) only = argv[3];
  const std::pair<const char*, void (*)(int)> tables[] = {
      {"troubles", troubles}, {"laws", laws},           {"agreement", agreement}, {"slope", slope},
      {"given", given},       {"min-speed", min_speed}, {"remedies", remedies}};
  for (const auto& [name, table] : tables)
    if (argc < 3 || std::strcmp(argv[2], name) == 0) table(runs);
}
