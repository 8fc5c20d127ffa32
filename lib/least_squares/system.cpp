// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_squares/system.h"

namespace rolling {

Matrix jacobian(const System& system, const std::vector<double>& theta) {
  Matrix all(system.columns());
  for (std::vector<double>& column : all) column.reserve(system.residuals());
  system.evaluate(theta, [&](std::size_t, std::span<double> f, std::span<double> J) {
    for (std::vector<double>& column : all) {
      const auto block = J.first(f.size());
      column.insert(column.end(), block.begin(), block.end());
      J = J.subspan(f.size());
    }
  });
  return all;
}

}  // namespace rolling
