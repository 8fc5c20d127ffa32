#include "fit/shift_records.h"

#include "base/error.h"
#include "unit/catch.h"

#include <cmath>
#include <limits>

using namespace rolling;

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

FitRun run_of(std::vector<double> v, std::vector<double> D) {
  FitRun run{};
  run.v = std::move(v);
  run.D = std::move(D);
  return run;
}

}  // namespace

TEST_CASE("shift records: along the motion, v finite and positive, D positive for logarithms",
          "[fit]") {
  const std::vector<FitRun> runs{run_of({0.4, missing, 0.1, 0, 0.2}, {3, 2, -1, 1, missing}),
                                 run_of({-0.4, -0.1, 0.05}, {-3, -1, -1})};
  const ShiftRecords all = shift_records(runs, {}, false);
  CHECK(all.y == std::vector<double>{3, -1, 3, 1});
  CHECK(shift_rows(runs[0], {}, false) == Rows{0, 2});
  CHECK(shift_rows(runs[1], {}, true) == Rows{0, 1});
  CHECK(all.runs == std::vector<std::size_t>{2, 2});
  CHECK(all.left_out == 2);  // two more are missing
  // The geometric mean of 0.4 and 0.1, twice.
  CHECK(std::abs(all.log_v_ref - std::log(0.2)) < 1e-15);
  for (std::size_t i = 0; i < 4; ++i)
    CHECK(std::abs(all.log_u[i] - (i % 2 ? -1 : 1) * std::log(2)) < 1e-15);

  const ShiftRecords positive = shift_records(runs, {}, true);
  CHECK(positive.y == std::vector<double>{std::log(3), std::log(3), 0});
  CHECK(shift_rows(runs[0], {}, true) == Rows{0});
  CHECK(positive.left_out == 3);

  FitOptions fast;
  fast.min_speed = 0.3;
  fast.b = 1;  // with one speed alone b has to be held
  CHECK(shift_records(runs, fast, false).y == std::vector<double>{3, 3});
  fast.b.reset();
  CHECK_THROWS_AS(shift_records(runs, fast, false), Error);
}

TEST_CASE("shift records: what rounding leaves of a difference is 0", "[fit]") {
  const std::vector<FitRun> runs{run_of({0.4, 0.3, 0.2, 3e-17, 0.1}, {3, 2e-15, 2, 1, 1e20})};
  CHECK(shift_rows(runs[0], {}, false) == Rows{0, 1, 2, 4});
  CHECK(shift_rows(runs[0], {}, true) == Rows{0, 2, 4});  // one large shift leaves the others
  CHECK(shift_records(runs, {}, true).left_out == 2);
}

TEST_CASE("shift records: the derivatives of a height are those of differences", "[fit]") {
  constexpr double log_v_ref = -1.5, log_u = 0.7, step = 1e-6;
  // ln D = h + b log_u, where h = ln a + b log_v_ref moves with b if a is held.
  for (const bool hold_a : {false, true}) {
    const Height height{hold_a ? std::optional(2.0) : std::nullopt, {}, log_v_ref};
    const auto model = [&](double h, double b) {
      return (hold_a ? std::log(*height.a) + b * log_v_ref : h) + b * log_u;
    };
    REQUIRE(height.count() == (hold_a ? 1 : 2));
    std::vector<double> J(3 * height.count(), 0);
    height.put(J, 1, 3, 1, log_u, 1);
    CHECK(std::abs(J[J.size() - 2] - (model(0.3, 1 + step) - model(0.3, 1 - step)) / (2 * step)) <
          1e-9);
    if (!hold_a) CHECK(J[1] == 1);
  }
}
