#include "cli/fit_report.h"

#include "unit/catch.h"

using namespace rolling;

TEST_CASE("fit report: each route has a name and its columns", "[fit]") {
  CHECK(fit_routes().size() == 4);
  for (const auto& [name, route] : fit_routes()) {
    const auto columns = columns_of(*route);
    CHECK(columns.size() == 2);
    CHECK((columns[0] == "t") == (name == "velocity" || name == "position"));
  }
}

TEST_CASE("fit report: a robust fit is not compared with other laws", "[fit]") {
  FitRun run{};
  for (int i = 1; i <= 12; ++i) run.v.push_back(i), run.D.push_back(0.1 * i + 0.01 * (i * i % 5));
  FitOptions options;
  CHECK(compare_if_possible(Route::shift, {run}, options));
  options.robust = true;
  CHECK_FALSE(compare_if_possible(Route::shift, {run}, options));
}
