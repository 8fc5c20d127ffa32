#include "fit/band_matrix.h"

#include "unit/fit/dense.h"
#include "unit/catch.h"

using namespace rolling;

TEST_CASE("band matrix: a sum of rows, of which one or both may be all 0", "[fit]") {
  const std::vector<double> values{0, 2, 3}, none(3, 0);
  BandMatrix X, Y, sum;
  for (const auto* row : {&values, &none, &values, &none}) X.append(1, *row);
  for (const auto* row : {&values, &values, &none, &none}) Y.append(0, *row);
  for (std::size_t i = 0; i < 4; ++i) sum.append(i, 5, X, 7, Y);
  CHECK(dense(sum, 4) ==
        std::vector<double>{0, 14, 31, 15, 0, 14, 21, 0, 0, 0, 10, 15, 0, 0, 0, 0});
}

TEST_CASE("band matrix: a product, of which a row may be all 0", "[fit]") {
  const std::vector<double> pair{2, 3}, one{5}, none(2, 0);
  BandMatrix A, B;
  A.append(1, pair), A.append(2, one), A.append(0, none), A.append(0, one);
  B.append(0, pair), B.append(1, one), B.append(0, none);
  const BandMatrix product = A * B;
  CHECK(dense(product, 3) == std::vector<double>{0, 10, 0, 0, 0, 0, 0, 0, 0, 10, 15, 0});
  for (std::size_t i : {1u, 2u}) {
    CHECK(product.row(i).empty());
    CHECK(product.end(i) == 0);
  }
  CHECK(product.columns() == 2);
}
