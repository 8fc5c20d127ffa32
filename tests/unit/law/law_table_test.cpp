// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/law.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

TEST_CASE("TableLaw: through its points, monotone between them, never beyond them", "[contact]") {
  std::mt19937_64 random(2);
  const auto between = [&](double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(random);
  };
  for (int n = 0; n < 300; ++n) {
    std::vector<double> v{between(0, 0.1)}, D{between(1e-4, 1e-2)};
    while (v.size() < 12)
      v.push_back(v.back() + std::pow(10, between(-4, 0))),
          D.push_back(between(0, 1) < 0.2 ? D.back() : between(1e-4, 1e-2));
    const TableLaw law(v, D);
    for (std::size_t i = 0; i + 1 < v.size(); ++i) {
      CHECK(law.at(v[i]).D == D[i]);
      const double direction = D[i + 1] - D[i];
      double before = D[i];
      for (int j = 1; j <= 50; ++j) {
        const double u = std::min(v[i] + (v[i + 1] - v[i]) * j / 50.0, v[i + 1]),
                     value = law.at(u).D;
        REQUIRE((value - before) * direction >= -1e-15 * std::abs(direction));
        REQUIRE((value >= std::min(D[i], D[i + 1]) && value <= std::max(D[i], D[i + 1])));
        before = value;
      }
      const double u = v[i] + 0.3 * (v[i + 1] - v[i]), h = 1e-5 * (v[i + 1] - v[i]);
      CHECK(std::abs((law.at(u + h).D - law.at(u - h).D) / (2 * h) - law.at(u).by_log_v / u) <=
            1e-5 * std::abs(direction) / (v[i + 1] - v[i]));
    }
  }
}

TEST_CASE(
    "TableLaw: a line is a line, the order of the points does not matter, below the lowest it is "
    "constant",
    "[contact]") {
  const TableLaw law({0.7, 0.1, 0.4}, {4e-3, 1e-3, 2.5e-3});
  for (const double v : {0.1, 0.2, 0.33, 0.4, 0.55, 0.7})
    CHECK(std::abs(law.at(v).D - (5e-4 + 5e-3 * v)) < 1e-17);
  CHECK((law.at(0.05).D == 1e-3 && law.at(0).D == 1e-3 && law.at(0.05).by_log_v == 0));
  const TableLaw one({0.2}, {1e-3});
  CHECK((one.at(0).D == 1e-3 && one.at(0.2).D == 1e-3 && one.at(0.1).by_log_v == 0));
}

TEST_CASE("TableLaw: close to the smooth law of its points", "[contact]") {
  const auto error = [](int n) {
    std::vector<double> v, D;
    for (int i = 0; i <= n; ++i)
      v.push_back(0.1 + 0.9 * i / n), D.push_back(2e-3 * std::pow(v.back(), 0.3));
    const TableLaw law(v, D);
    double worst = 0;
    for (int i = 0; i <= 1000; ++i)
      worst = std::max(
          worst, std::abs(law.at(0.1 + 9e-4 * i).D / (2e-3 * std::pow(0.1 + 9e-4 * i, 0.3)) - 1));
    return worst;
  };
  CHECK(error(40) < 1e-3);
  CHECK(error(40) / error(80) > 3.5);  // second order at least
}

TEST_CASE("TableLaw: refusals", "[contact]") {
  CHECK_THROWS_AS(TableLaw({}, {}), Error);
  CHECK_THROWS_AS(TableLaw({0.1, 0.2}, {1e-3}), Error);
  CHECK_THROWS_AS(TableLaw({0.1, 0.1}, {1e-3, 1e-3}), Error);
  CHECK_THROWS_AS(TableLaw({-0.1, 0.1}, {1e-3, 1e-3}), Error);
  CHECK_THROWS_AS(TableLaw({0, 0.1}, {0, 1e-3}), Error);
  CHECK_THROWS_AS(TableLaw({0.1, 0.2}, {1e-3, std::nan("")}), Error);
}
