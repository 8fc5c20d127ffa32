// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/fit_report.h"
#include "cli/fit_runs.h"

#include "unit/catch.h"

using namespace rolling;

TEST_CASE("fit report: each route has a name and its columns", "[fit]") {
  CHECK(all_routes().size() == 4);
  for (const auto& [route, name, columns, why] : all_routes()) {
    CHECK(&words_of(route).columns == &columns);
    CHECK(columns.size() == 2);
    CHECK((columns[0] == "t") ==
          (name == std::string("velocity") || name == std::string("position")));
  }
}
