#include "noise/filter_matrix.h"

#include "unit/noise/dense.h"
#include "unit/catch.h"

using namespace rolling;

TEST_CASE("band matrix: a product, of which a row may be all 0", "[fit]") {
  const std::vector<double> pair{2, 3}, one{5}, none(2, 0);
  BandMatrix A, B;
  A.append(1, pair), A.append(2, one), A.append(0, none), A.append(0, one);
  B.append(0, pair), B.append(1, one), B.append(0, none);
  const FilterMatrix product = FilterMatrix(B).then(A);
  CHECK(dense(product, 3) == std::vector<double>{0, 10, 0, 0, 0, 0, 0, 0, 0, 10, 15, 0});
}
