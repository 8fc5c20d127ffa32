#include "contact/balance.h"

#include "base/error.h"

namespace rolling {

const Ledger& Balance::push(double t, double v, double D) {
  now_ = ledger(body_, geometry_, v, D);
  end_ = now_.E_trans + now_.E_rot;
  if (!begun_) start_ = end_;
  begun_ = true;
  dissipated_ = outflow_.push(t, now_.P_diss);
  return now_;
}

double Balance::closure() const {
  if (start_ == end_)
    fail(
        "the energy at the start and at the end of the run are equal: there is no closure to speak "
        "of");
  return dissipated_ / (start_ - end_) - 1;
}

}  // namespace rolling
