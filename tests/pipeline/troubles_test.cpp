// SPDX-License-Identifier: GPL-3.0-or-later
// The short form of the second table of `make coverage`: what fitpower says of runs with one
// thing wrong, and which law it finds.
#include "bench/troubles.h"
#include "unit/catch.h"

namespace {

troubled::Trouble find(const std::string& name) {
  for (const auto& trouble : troubled::troubles())
    if (trouble.name == name) return trouble;
  FAIL("there is no trouble " << name);
  return {};
}

constexpr rolling::PowerLaw CR{1.87e-3, 0.215}, CF{5.75e-4, 0.0244};

}  // namespace

// Of 60 good runs, 4 false alarms or more come by chance in 0.3 % where their rate is 1 %.
TEST_CASE("troubles: a good one passes the check, a body that runs true is not blamed",
          "[fit][many]") {
  for (const auto law : {CR, CF}) {
    const auto good = troubled::judge(find("nothing"), law, 60, 3);
    CAPTURE(law.b);
    CHECK(good.failed <= 3. / 60);
    CHECK(good.eccentric <= 3. / 60);
    CHECK(good.adequate >= 0.85);
    CHECK(good.refused == 0);
  }
}

TEST_CASE("troubles: an eccentric body, drag and a hand that stays on are caught", "[fit][many]") {
  const auto eccentric = troubled::judge(find("eccentricity 30 um"), CF, 30, 3);
  CHECK(eccentric.eccentric > 0.85);
  CHECK(eccentric.e == Approx(3e-5).epsilon(0.1));
  CHECK(eccentric.failed > 0.9);
  CHECK(troubled::judge(find("viscous drag 0.02/s"), CF, 30, 3).failed > 0.8);
  for (const auto law : {CR, CF}) {
    const auto held = troubled::judge(find("hand on for 0.2 s"), law, 30, 3);
    CHECK(held.failed > 0.8);
    CHECK(held.beginning > 0.8);
  }
}

TEST_CASE("troubles: where AICc tells two laws apart, the one that made the run is better",
          "[fit][many]") {
  for (const auto& truth : troubled::truths()) {
    const auto found = troubled::contest(truth, 12, 3);
    CAPTURE(rolling::laws()[truth.law].formula);
    CHECK(found.not_determined == 0);
    CHECK(found.cover > 0.8);  // of 12 runs: a wrong minimum covers nothing
    for (std::size_t j = 0; j < found.won.size(); ++j) {
      CAPTURE(rolling::laws()[j].formula);
      // A law that contains the true one is better by 10 in one run of a thousand.
      CHECK(found.apart[j] - found.won[j] <= 1);
      if (found.apart[j] > 5) CHECK(found.won[j] >= 0.95 * found.apart[j]);
    }
  }
}
