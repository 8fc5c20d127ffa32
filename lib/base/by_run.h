// The parts of a column of all runs that belong to each run.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rolling {

/// Views of consecutive parts of `all`, one for each run: of sizes[r] rows of `columns` numbers.
auto by_run(auto& all, const auto& sizes, std::size_t columns = 1) {
  std::span rest(all);
  std::vector<decltype(rest)> parts;
  for (const std::size_t rows : sizes) {
    parts.push_back(rest.first(rows * columns));
    rest = rest.subspan(rows * columns);
  }
  return parts;
}

}  // namespace rolling
