// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/pulses.h"

#include <cmath>
#include <vector>

#include "unit/catch.h"

using namespace rolling;

namespace {

double rounded(double x, double place) { return std::round(x / place) * place; }

/// The pulses of a wheel that slows down evenly, every 5 cm.
std::vector<double> pulses() {
  std::vector<double> t;
  for (int n = 0; n < 15; ++n) t.push_back(rounded(3 * (1 - std::sqrt(1 - n / 16.)), 1e-5));
  return t;
}

}  // namespace

TEST_CASE("pulses: one way over the time from row to row, stamped at either end") {
  const std::vector<double> t = pulses();
  for (const double way : {0.05, -0.05}) {
    std::vector<double> after(t.size(), 0.27), before = after;
    for (std::size_t i = 1; i < t.size(); ++i)
      after[i] = before[i - 1] = rounded(way / (t[i] - t[i - 1]), 1e-6);
    CHECK(way_between_pulses(t, after).value() == Approx(way).epsilon(1e-3));
    CHECK(way_between_pulses(t, before).value() == Approx(way).epsilon(1e-3));
    after[7] *= 1.01;
    CHECK_FALSE(way_between_pulses(t, after));
  }
}

TEST_CASE("pulses: whatever the last place of the times and of the speeds, and the clock's zero") {
  for (const double begin : {0., 100., 1.7e9, -1.7e9})
    for (int places_of_t = 4; places_of_t <= 12; ++places_of_t)
      for (int places_of_v = 3; places_of_v <= 12; ++places_of_v) {
        CAPTURE(begin, places_of_t, places_of_v);
        std::vector<double> t, v{0};
        for (int n = 0; n < 60; ++n)
          t.push_back(begin +
                      rounded(20 * (1 - std::sqrt(1 - n / 64.)), std::pow(10, -places_of_t)));
        for (std::size_t i = 1; i < t.size(); ++i)
          v.push_back(rounded(0.05 / (t[i] - t[i - 1]), std::pow(10, -places_of_v)));
        CHECK(way_between_pulses(t, v).value() == Approx(0.05).epsilon(0.01));
      }
}

TEST_CASE("pulses: speeds that are measured otherwise are none") {
  const std::vector<double> t = pulses();
  std::vector<double> v, even, constant(t.size(), 0.2);
  for (std::size_t i = 0; i < t.size(); ++i) {
    v.push_back(0.5 - 0.1 * t[i]);
    even.push_back(0.1 * static_cast<double>(i));
  }
  CHECK_FALSE(way_between_pulses(t, v));
  CHECK_FALSE(way_between_pulses(even, constant));  // even times tell nothing
  CHECK_FALSE(way_between_pulses(t, std::vector<double>(t.size(), NAN)));
}
