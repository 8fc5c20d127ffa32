// The roll under a law given as a table: time and distance as integrals over speed (Eq. 12), in
// either geometry.
#pragma once

#include "contact/body.h"
#include "motion/motion.h"
#include "contact/table_law.h"

#include <vector>

namespace rolling {

/// True if the body slows down at every speed up to v0; on a falling mat D may be too small for
/// that.
bool always_slows(const Body&, Geometry, const TableLaw&, double v0);

/// t = int_v^v0 (K + A(u)) R / (g D(u)) du, with the slope's part, by Gauss-Legendre panels within
/// the pieces of the table, inverted by Newton's method; the stop is the whole integral. Relative
/// error about 1e-14 for the interpolated law. Below the lowest point of the table D is constant,
/// so the body stops.
class TableRoll final : public Motion {
 public:
  /// Throws Error for v0 above the table, D > R at a speed up to v0, a slope on which the body does
  /// not always slow down, and as check_roll does.
  TableRoll(const Body&, Geometry, TableLaw, double v0, double x0);

  double stop_time() const override { return panels_.back().time; }
  void seek(double t) override;
  double position() override;
  double velocity() override { return v_; }
  double acceleration() override;
  double shift() override { return v_ == 0 ? 0 : law_(v_); }

 private:
  struct Panel {
    double v, time, distance;  // at the beginning; a panel ends where the next one begins
  };
  struct Integrals {
    double time, distance;
  };
  double inverse_acceleration(double v) const;
  Integrals integrals(double from, double to) const;
  void add_panels(double to, int halvings);

  Body body_;
  Geometry geometry_;
  TableLaw law_;
  double v0_, x0_;
  std::vector<Panel> panels_;  // from v0 down to 0
  std::size_t panel_ = 0;
  double v_;
};

}  // namespace rolling
