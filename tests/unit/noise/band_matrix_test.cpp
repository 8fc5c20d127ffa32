// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/band_matrix.h"

#include <random>

#include "unit/noise/dense.h"
#include "unit/catch.h"

using namespace rolling;

TEST_CASE("band matrix: a product, of which a row may be all 0", "[fit]") {
  const std::vector<double> pair{2, 3}, one{5}, none(2, 0);
  BandMatrix A(3), B(3);
  A.append(1, pair), A.append(2, one), A.append(0, none), A.append(0, one);
  B.append(0, pair), B.append(1, one), B.append(0, none);
  CHECK(dense(A * B) == std::vector<double>{0, 10, 0, 0, 0, 0, 0, 0, 0, 10, 15, 0});
}

// Random bands that move on by 0 to 3 columns a row, at times back by one, and rows left out.
TEST_CASE("band matrix: the transposed product of any bands", "[fit]") {
  std::mt19937 random(3);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const auto band = [&](std::size_t rows, std::size_t columns) {
    BandMatrix L(columns);
    for (std::size_t i = 0, first = 0; i < rows; ++i) {
      std::vector<double> row(std::min(below(5), columns - first));
      for (double& x : row) x = static_cast<double>(below(9)) - 4;
      L.append(first - std::min(first, below(2)), row);
      first = std::min(first + below(4), columns - 1);
    }
    return L;
  };
  for (int k = 0; k < 500; ++k) {
    const std::size_t rows = 1 + below(30);
    const BandMatrix M = band(rows, 40), all = band(1 + below(30), rows) * M;
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < all.rows(); i += 1 + below(3)) chosen.push_back(i);
    const BandMatrix H = all.of_rows(chosen);
    const std::vector<double> elements = dense(H);
    std::vector<double> x(H.rows()), product(H.columns());
    for (double& value : x) value = static_cast<double>(below(9)) - 4;
    for (std::size_t i = 0; i < elements.size(); ++i)
      product[i % H.columns()] += elements[i] * x[i / H.columns()];
    CHECK(H.transposed_times(x) == product);
  }
}
