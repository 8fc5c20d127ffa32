#include "contact/balance.h"

#include <cmath>

#include "base/error.h"

namespace rolling {

void Balance::push(double t, const Ledger& now) {
  end_ = now.E_trans() + now.E_rot();
  if (!begun_) start_ = end_, worst_time_ = t;
  begun_ = true;
  dissipated_ = outflow_.push(t, now.P_diss());
  if (inclined_) lifted_ = lift_.push(t, now.P_g());
  const double off = std::abs(start_ - end_ - lifted_ - dissipated_);
  if (off > worst_) worst_ = off, worst_time_ = t;
}

double Balance::missing() const {
  const double energy = start_ - end_ - lifted_;
  if (energy == 0)
    fail("the body has as much energy at the end of the run as at its start: there is no closure");
  return energy;
}

double Balance::closure() const { return dissipated_ / missing() - 1; }

double Balance::imbalance() const { return worst_ / std::abs(missing()); }

}  // namespace rolling
