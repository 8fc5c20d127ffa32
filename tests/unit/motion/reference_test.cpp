// SPDX-License-Identifier: GPL-3.0-or-later
// Rolls and their derivatives against tests/reference, which has 25 digits of each.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "motion/roll.h"
#include "unit/catch.h"
#include "unit/exact_body.h"

using namespace rolling;

namespace {

/// v and x, their derivatives by a, b, v0 and S in that order, time and place of the stop or the
/// turn; NaN where the table has none.
using Values = std::array<double, 12>;

struct Instant {
  std::string kind, of;  // the numbers of the roll, as they are written
  double t;
  Values expected, found;
};

double number(const std::string& text) { return text == "-" ? std::nan("") : std::stod(text); }

Law law_of(const std::string& a, const std::string& b, const std::string& table) {
  if (table == "-") return PowerLaw{number(a), number(b)};
  std::vector<double> v, D;
  std::istringstream points(table);
  for (std::string point; std::getline(points, point, ',');) {
    v.push_back(number(point));
    D.push_back(number(point.substr(point.find(':') + 1)));
  }
  return TableLaw(v, D);
}

Values values_of(Roll roll, double t) {
  const Roll::Point p = roll.at(t);
  const std::size_t S = roll.law().size(), b = S > 1 ? 1 : S;
  const double stop = roll.stop_time();
  return {p.v,    p.x,      p.v_c[0], p.v_c[b],
          p.v_v0, p.v_c[S], p.x_c[0], p.x_c[b],
          p.x_v0, p.x_c[S], stop,     std::isfinite(stop) ? roll.at(stop).x : 0};
}

std::vector<Instant> instants() {
  std::vector<Instant> all;
  std::ifstream file("tests/reference/rolls.tsv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::vector<std::string> cell;
    std::istringstream cells(line);
    for (std::string one; std::getline(cells, one, '\t');) cell.push_back(one);
    const auto at = [&](std::size_t i) { return number(cell.at(i)); };
    const Body body{1, at(3), at(2), at(4), at(5)};
    const bool is_exact = cell[1] != "1";
    Instant instant{cell[0], line.substr(0, line.find('\t' + cell[10] + '\t')), at(10), {}, {}};
    for (std::size_t i = 0; i < instant.expected.size(); ++i) instant.expected[i] = at(11 + i);
    instant.found = values_of(
        {exact_body(body, is_exact), law_of(cell[6], cell[7], cell[8]), at(9)}, instant.t);
    all.push_back(std::move(instant));
  }
  return all;
}

}  // namespace

TEST_CASE("Roll: the table of reference values, derivatives too", "[rolling]") {
  const auto all = instants();
  REQUIRE(all.size() > 500);
  for (auto first = all.begin(); first != all.end();) {
    const auto last =
        std::find_if(first, all.end(), [&](const Instant& i) { return i.of != first->of; });
    Values largest{};
    for (auto i = first; i != last; ++i)
      for (std::size_t k = 0; k < largest.size(); ++k)
        if (!std::isnan(i->expected[k]))
          largest[k] = std::max(largest[k], std::abs(i->expected[k]));
    for (; first != last; ++first)
      for (std::size_t k = 0; k < largest.size(); ++k) {
        if (std::isnan(first->expected[k])) continue;
        INFO(first->of << ", t " << first->t << ", value " << k);
        const double error = std::abs(first->found[k] - first->expected[k]);
        CHECK(error <= (k < 2 || k > 9 ? 1e-12 : 1e-9) * largest[k]);
      }
  }
}
