// SPDX-License-Identifier: GPL-3.0-or-later
// The energy balance of a run (Eq. 23): the loss of stored energy against the energy that the shift
// dissipates, at every moment and at the end.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "contact/integral.h"
#include "contact/ledger.h"

namespace rolling {

class Balance {
 public:
  explicit Balance(const Body& body) : inclined_(body.slope != 0) {}

  /// Adds the next row of the run: its time [s] and its quantities.
  void push(double t, const Ledger& now) {
    end_ = now.E_trans() + now.E_rot();
    if (!begun_) start_ = end_, worst_time_ = t;
    begun_ = true;
    dissipated_ = outflow_.push(t, now.P_diss());
    if (inclined_) lifted_ = lift_.push(t, now.P_g());
    const double off = std::abs(start_ - end_ - lifted_ - dissipated_);
    // There is no branch, which the processor would often predict wrongly: noise decides.
    const double times[] = {worst_time_, t};
    worst_time_ = times[off > worst_];
    worst_ = std::max(worst_, off);
  }

  bool empty() const { return !begun_; }   ///< no row has been added
  double start() const { return start_; }  ///< E_trans + E_rot at the first row [J]
  double end() const { return end_; }      ///< and at the last [J]
  /// I_E1 + I_E2 integrated over time so far [J].
  double dissipated() const { return dissipated_; }
  /// The work against gravity so far [J]: m g sin theta v integrated over time; 0 on a level mat.
  double lifted() const { return lifted_; }

  /// dissipated / (start - end - lifted) - 1: 0 if shift and velocity agree over the whole run.
  /// Throws Error if the denominator, the energy that is missing at the end, is 0.
  double closure() const { return dissipated_ / missing() - 1; }
  /// The largest |start - E(t) - lifted(t) - dissipated(t)| of the run, divided by the energy that
  /// is missing at its end: 0 if shift and velocity agree at every moment. Throws as closure().
  double imbalance() const { return worst_ / std::abs(missing()); }
  double time_of_imbalance() const { return worst_time_; }  ///< the time of that moment [s]

 private:
  double missing() const {
    const double energy = start_ - end_ - lifted_;
    if (energy == 0)
      fail(
          "the body has as much energy at the end of the run as at its start: there is no closure");
    return energy;
  }

  Integral outflow_, lift_;
  bool inclined_, begun_ = false;
  double start_ = 0, end_ = 0, dissipated_ = 0, lifted_ = 0;
  double worst_ = 0, worst_time_ = 0;  // the largest imbalance [J] and its time [s]
};

}  // namespace rolling
