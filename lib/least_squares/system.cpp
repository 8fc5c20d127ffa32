#include "least_squares/system.h"

namespace rolling {

std::vector<double> jacobian(const System& system, const std::vector<double>& theta) {
  const std::size_t q = system.columns();
  std::vector<double> rows(system.residuals() * q);
  double* block = rows.data();
  system.evaluate(theta, [&](std::size_t, std::span<double> f, std::span<double> J) {
    for (std::size_t j = 0; j < q; ++j)
      for (std::size_t i = 0; i < f.size(); ++i) block[i * q + j] = J[j * f.size() + i];
    block += J.size();
  });
  return rows;
}

}  // namespace rolling
