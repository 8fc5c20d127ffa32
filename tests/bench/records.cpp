// Prints the tables of tests/bench/records.h: records [RUNS]. `make coverage`.
#include "bench/records.h"

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 1000;
  const std::string only = argc > 2 ? argv[2] : "";
  constexpr rolling::PowerLaw CR{1.87e-3, 0.215}, CF{5.75e-4, 0.0244};
  std::printf("# What a record really has: %d records each, position route; shares of them\n",
              runs);
  std::printf("%-31s %-5s %8s %7s %7s %8s %6s %9s %6s %9s %9s %6s %7s\n", "# trouble", "scene",
              "%_of_a", "cover_a", "cover_b", "adequate", "noise", "eccentric", "mm", "other_law",
              "not_white", "check", "refused");
  for (const auto& trouble : records::troubles())
    for (const auto& [name, law] : {std::pair("CR", CR), std::pair("CF", CF)}) {
      if (only == "laws") continue;
      const auto v = records::judge(trouble, law, runs, 20261122);
      std::printf("%-31s %-5s %+8.2f %7.3f %7.3f %8.3f %6.3f %9.3f %6.3f %9.3f %9.3f %6.3f %7d\n",
                  trouble.name, name, 100 * v.bias, v.cover_a, v.cover_b, v.adequate, v.noise,
                  v.eccentric, 1e3 * v.e, v.other_law, v.not_white, v.failed, v.refused);
      std::fflush(stdout);
    }
  std::printf(
      "\n# Which law made the record: of %d records, those in which the AICc of the true law is 10 "
      "or more away from that of the other, and the share of them in which it is the smaller\n",
      runs);
  std::printf("%-29s", "# true law");
  for (const auto& law : rolling::laws()) std::printf(" %24s", law.formula);
  std::printf(" %6s %12s\n", "cover", "undetermined");
  for (const auto& truth : records::truths()) {
    const auto c = records::contest(truth, runs, 20261122);
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
