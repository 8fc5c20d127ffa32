#include "base/by_column.h"

#include <numeric>

#include "unit/catch.h"

using namespace rolling;

TEST_CASE("by_column: columns become longer, shorter, or keep their length", "[base]") {
  const std::vector<double> X{1, 10, 2, 20, 3, 30};  // the columns 1 2 3 and 10 20 30
  const auto sums = [](std::vector<double> x) {
    return std::vector{std::accumulate(x.begin(), x.end(), 0.0)};
  };
  const auto with_end = [](std::vector<double> x) {
    x.push_back(x.back() + 1);
    return x;
  };
  const auto doubled = [](std::vector<double> x) {
    for (double& value : x) value *= 2;
    return x;
  };
  CHECK(by_column(X, 2, sums) == std::vector<double>{6, 60});
  CHECK(by_column(X, 2, with_end) == std::vector<double>{1, 10, 2, 20, 3, 30, 4, 31});
  CHECK(by_column(X, 2, doubled) == std::vector<double>{2, 20, 4, 40, 6, 60});
  CHECK(by_column(X, 1, with_end) == std::vector<double>{1, 10, 2, 20, 3, 30, 31});
}
