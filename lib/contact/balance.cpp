#include "contact/balance.h"

#include <cmath>

#include "base/error.h"

namespace rolling {

double Balance::missing() const {
  const double energy = start_ - end_ - lifted_;
  if (energy == 0)
    fail("the body has as much energy at the end of the run as at its start: there is no closure");
  return energy;
}

double Balance::closure() const { return dissipated_ / missing() - 1; }

double Balance::imbalance() const { return worst_ / std::abs(missing()); }

}  // namespace rolling
