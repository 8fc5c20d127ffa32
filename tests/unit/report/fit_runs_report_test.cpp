// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/fit_runs.h"

#include "unit/catch.h"

using namespace rolling;

TEST_CASE("fit report: runs that disagree are told with the furthest one, and by how much",
          "[cli]") {
  std::vector<Run> runs(3);
  runs[1].name = "two";
  Agreement found{.dof = 2, .ratio = 20, .p = 1e-4, .runs = 3, .run = 1, .speed = 0.5};
  found.log_D = {std::log(1.1), 0.01};
  const std::string
      before =
          "the runs disagree by more than their noise (chi2 20 of 2 degrees of "
          "freedom, p = 0.0001): run two is furthest from the others, in D(0.5 m/s) by +10 +- 1 %",
      after = "; the row is their mean, with their scatter in its uncertainties";
  CHECK(disagreement(found, runs, false) ==
        before + "; the uncertainties of the row contain their scatter");
  found.of_mean = true;
  CHECK(disagreement(found, runs, false) == before + after);  // b is fixed
  found.b = {-0.02, 0.003};
  CHECK(disagreement(found, runs, false) == before + ", in its exponent by -0.02 +- 0.003" + after);
  found.p = 0.0099;
  CHECK_FALSE(disagreement(found, runs, false).empty());
  // Runs that agree as a whole, from 1 % on: a check alone names one that is off, from 1 % on.
  found.p = 0.0101;
  found.p_of_run = 0.004;
  CHECK(disagreement(found, runs, false).empty());
  CHECK(disagreement(found, runs, true) ==
        "the runs agree as a whole, but one of 3 is off (p = 0.004): run two is furthest from the "
        "others, in D(0.5 "
        "m/s) by +10 +- 1 %, in its exponent by -0.02 +- 0.003");
  found.p_of_run = 0.0099;
  CHECK_FALSE(disagreement(found, runs, true).empty());
  found.p_of_run = 0.0101;
  CHECK(disagreement(found, runs, true).empty());
}
