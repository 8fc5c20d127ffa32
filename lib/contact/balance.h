// The energy balance of a run: what was stored at its two ends against what was dissipated between
// them (Eq. 23).
#pragma once

#include "contact/ledger.h"
#include "contact/integral.h"

namespace rolling {

class Balance {
 public:
  Balance(const Body& body, Geometry geometry) : body_(body), geometry_(geometry) {}

  /// Takes the next record: time [s], velocity [m/s], shift [m]. Throws Error when |D| > R.
  const Ledger& push(double t, double v, double D);

  double start() const { return start_; }  ///< stored energy at the first record [J]
  double end() const { return end_; }      ///< stored energy at the last record [J]
  double dissipated() const {
    return dissipated_;
  }  ///< integral of I_E1 + I_E2 over time so far [J]
  /// dissipated / (start - end) - 1: 0 where shift and velocity tell one story. Throws Error when
  /// start equals end.
  double closure() const;

 private:
  Body body_;
  Geometry geometry_;
  Ledger now_{};
  Integral outflow_;
  bool begun_ = false;
  double start_ = 0, end_ = 0, dissipated_ = 0;
};

}  // namespace rolling
