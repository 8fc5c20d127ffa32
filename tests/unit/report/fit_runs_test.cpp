// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/fit_runs.h"

#include <unistd.h>

#include <cmath>
#include <sstream>

#include "unit/catch.h"
#include "unit/text/files.h"

using namespace rolling;

// Rows of two bodies: the error of K belongs to the rows of one of them, that of R to all.
TEST_CASE("fit_rows: what a number brings to rows is common to those that give it", "[cli]") {
  const double sigma = 0.01, by_K = 0.006 / 1.5, by_other = 0.006 / 1.83, by_R = 0.0002 / 0.04;
  const auto row = [&](double by) {
    return fmt::format("{}\t{}\t0.2\t0.01\t0\n", 0.002,
                       0.002 * std::sqrt(sigma * sigma + by * by + by_R * by_R));
  };
  const TemporaryFile rows("# a[m]\tsigma_a[m]\tb\tsigma_b\tcorr\n" + row(by_K) + row(by_K) +
                           row(by_other) + row(by_other)),
      printed;
  Tool tool("tool", "");
  tool.input();
  std::vector<std::string> words{"tool", rows.name()};
  std::vector<char*> arguments{words[0].data(), words[1].data(), nullptr};
  Bodies bodies;
  bodies.all.clear();
  for (const double K : {0.5, 0.5, 0.83, 0.83}) {
    Body& body = bodies.all.emplace_back();
    body.K = K;
    body.sigma_K = 0.006;
    body.R = 0.04;
    body.sigma_R = 0.0002;
  }
  int status = 0;
  {
    const Redirect to_file(STDOUT_FILENO, printed.name());
    status = tool.run(2, arguments.data(), [&] {
      fit_rows(tool, bodies);
      return 0;
    });
  }
  CHECK(status == 0);
  const std::string text = printed.text();
  std::istringstream line(text.substr(text.rfind('\n', text.size() - 2)));
  double a = 0, sigma_a = 0;
  line >> a >> sigma_a;
  CHECK(a == Approx(0.002));
  CHECK(sigma_a / a == Approx(std::sqrt(sigma * sigma / 4 + by_K * by_K / 4 +
                                        by_other * by_other / 4 + by_R * by_R)));
}
