// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/run.h"

#include "unit/catch.h"
#include "unit/fit/simulated.h"

#include <fmt/format.h>

#include <limits>
#include <string>

using namespace rolling;
using simulated::differentiate;
using simulated::smooth_v;

namespace {

using Series = std::vector<double>;

const FilterChain chain = {
    differentiate(Quantity::x, Quantity::v),
    smooth_v(5),
    differentiate(Quantity::v, Quantity::a),
    {Quantity::a, Quantity::D, 0, [](auto, auto y) { return Series(y.begin(), y.end()); }}};

/// Noisy positions, and the columns that the chain makes of them.
Run filtered(int seed, std::size_t n = 60) {
  Run run{};
  run.shift_of = Body{1, 0.04, 0.5};
  simulated::Noise noise(static_cast<unsigned>(seed));
  run.t = simulated::times(n);
  for (const double t : run.t) run.x.push_back(0.5 * t - 0.03 * t * t + noise(3e-4));
  run.v = chain[1].apply(run.t, chain[0].apply(run.t, run.x));
  for (const double a : chain[2].apply(run.t, run.v)) run.D.push_back(-1.5 * 0.04 / 9.81 * a);
  return run;
}

/// Every k-th row.
Run thinned(const Run& run, std::size_t k) {
  Run few{};
  few.shift_of = run.shift_of;
  for (auto column : {&Run::t, &Run::x, &Run::v, &Run::D})
    for (std::size_t i = 0; i < run.t.size(); i += k) (few.*column).push_back((run.*column)[i]);
  return few;
}

/// The rows from `first` to before `end`.
Run part(const Run& run, std::ptrdiff_t first, std::ptrdiff_t end) {
  Run some{};
  some.shift_of = run.shift_of;
  for (auto column : {&Run::t, &Run::x, &Run::v, &Run::D})
    (some.*column).assign((run.*column).begin() + first, (run.*column).begin() + end);
  return some;
}

/// A row between each two, by linear interpolation.
Run interpolated(const Run& run) {
  Run more{};
  more.shift_of = run.shift_of;
  for (auto column : {&Run::t, &Run::x, &Run::v, &Run::D})
    for (std::size_t i = 0; i + 1 < run.t.size(); ++i) {
      const double here = (run.*column)[i], next = (run.*column)[i + 1];
      (more.*column).insert((more.*column).end(), {here, (here + next) / 2});
    }
  return more;
}

bool differs(const Run& run) { return mismatch(chain, run).inside; }

}  // namespace

TEST_CASE("replay: columns that the filters made are the same, rounded or not", "[fit]") {
  for (int seed = 1; seed <= 20; ++seed) {
    const Run run = filtered(seed);
    const Mismatch none = mismatch(chain, run);
    CHECK(!none.inside);
    CHECK(!none.begin);
    CHECK(!none.end);
    for (const int digits : {3, 4, 6}) {
      Run rounded = run;
      for (auto column : {&Run::v, &Run::D})
        for (double& y : rounded.*column) y = std::stod(fmt::format("{:.{}g}", y, digits));
      INFO("seed " << seed << ", " << digits << " digits");
      // Of three digits of the speeds, differences keep less than the noise has.
      if (digits > 3) CHECK(!differs(rounded));
      rounded.D.clear();
      CHECK(!differs(rounded));
    }
  }
}

TEST_CASE("replay: columns that something else has made differ, each stage of them", "[fit]") {
  for (int seed = 1; seed <= 20; ++seed) {
    INFO("seed " << seed);
    const Run run = filtered(seed);
    for (const std::size_t k : {2U, 3U}) CHECK(differs(thinned(run, k)));
    CHECK(differs(interpolated(run)));
    Run v = run, D = run, speeds_alone = run;
    v.v = smooth_v(7).apply(run.t, chain[0].apply(run.t, run.x));  // not 5
    CHECK(differs(v));
    v.D = run.D, v.D.clear();
    CHECK(differs(v));
    v = run;
    for (double& y : v.v) y += 0.01;
    CHECK(differs(v));
    D.D = simulated::mean(run.D, 3);
    CHECK(differs(D));
    // Positions tell of speeds, speeds of shifts, and without both there is nothing to compare.
    D.x.clear();
    CHECK(differs(D));
    speeds_alone.v = v.v;
    speeds_alone.x.clear(), speeds_alone.D.clear();
    CHECK(!differs(speeds_alone));
  }
}

TEST_CASE("replay: a missing reading hides its windows alone", "[fit]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (auto column : {&Run::x, &Run::v, &Run::D}) {
    Run run = filtered(1);
    (run.*column)[20] = nan;
    const Mismatch none = mismatch(chain, run);
    CHECK(!none.inside);
    CHECK(!none.begin);
    CHECK(!none.end);
    for (double& y : run.v) y *= 1.01;
    CHECK(differs(run));
  }
}

TEST_CASE("replay: rows that were cut off differ at that end alone", "[fit]") {
  for (int seed = 1; seed <= 20; ++seed) {
    const Run run = filtered(seed);
    for (const auto& [first, end] : {std::pair(4, 60), {0, 55}, {9, 50}}) {
      INFO("seed " << seed << ", " << first << " to " << end);
      Run some = part(run, first, end);
      const Mismatch found = mismatch(chain, some);
      CHECK(!found.inside);
      CHECK(found.begin == (first > 0));
      CHECK(found.end == (end < 60));
      some.D.clear();  // the last filter is then a mean of v, of which x tells
      CHECK(mismatch(chain, some).begin == (first > 0));
      CHECK(mismatch(chain, some).end == (end < 60));
    }
  }
}
