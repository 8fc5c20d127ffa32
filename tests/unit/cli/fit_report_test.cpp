// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/fit_report.h"
#include "cli/fit_runs.h"

#include "unit/catch.h"

using namespace rolling;

TEST_CASE("fit report: each route has a name and its columns", "[fit]") {
  CHECK(fit_routes().size() == 4);
  for (const auto& [name, route] : fit_routes()) {
    const auto columns = fitted_columns(*route);
    CHECK(columns.size() == 2);
    CHECK((columns[0] == "t") == (name == "velocity" || name == "position"));
  }
}
