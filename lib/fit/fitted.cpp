#include "fit/fitted.h"

#include "base/error.h"
#include "least_squares/robust.h"

namespace rolling {

void require_records(std::size_t n, std::size_t p, std::size_t means) {
  if (n == 0) fail("no record can be fitted");
  if (p == 0) fail("a and b are both held: nothing is left to fit");
  if (n < p + means)
    fail("{} record{} cannot determine {} parameters{}", n, n == 1 ? "" : "s", p,
         means > 0 ? ", for their derivatives have lost the mean position" : "");
}

std::size_t Fitted::degrees_left() const {
  const bool by_filters = filters_known() && !raw_noise;
  const std::size_t n = by_filters ? noise->informative() : minimum.f.size() - means_taken(),
                    p = minimum.theta.size();
  return n > p ? n - p : 0;
}

Minimum solve(const System& system, const std::vector<std::vector<double>>& starts,
              const FitOptions& options) {
  return options.robust ? minimise_robust(system, starts) : minimise(system, starts.front());
}

}  // namespace rolling
