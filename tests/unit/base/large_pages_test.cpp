#include "base/large_pages.h"

#include <numeric>

#include "unit/catch.h"

using namespace rolling;

TEST_CASE("large pages: room of any size, and what was there is kept", "[base]") {
  for (const std::size_t n : {std::size_t{0}, std::size_t{10},
                              (std::size_t{4} << 20) / sizeof(double), std::size_t{3000001}}) {
    std::vector<double> column(7);
    std::iota(column.begin(), column.end(), 1.0);
    reserve_large(column, n);
    CHECK(column.capacity() >= n);
    column.resize(std::max<std::size_t>(n, 7));
    const double* const data = column.data();
    reserve_large(column, n);  // there is room already
    CHECK(column.data() == data);
    CHECK(std::accumulate(column.begin(), column.end(), 0.0) == 28);
  }
}
