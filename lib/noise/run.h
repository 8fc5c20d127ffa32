// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of a run as read, with the filters of its columns; and whether its columns are what
// these filters make of each other.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/quantity.h"
#include "contact/contact.h"
#include "noise/response.h"

namespace rolling {

/// The acceleration [m/s^2] from which the shift D [m] of a body was computed, by Eq. 11 or by the
/// exact root of Eq. 9. For A = 1 the relation is linear and holds for any D.
inline double acceleration_of(const Body& body, double D) {
  if (body.exact) check_shift(body, D);
  return accelerate(body, D).a;
}

/// The data of one run in SI units: t [s], x [m], v [m/s], D [m], one element for each row. The
/// routes loglog and shift read v and D (and t, where the filters are known); velocity reads t and
/// v; position reads t and x.
struct Run {
  std::vector<double> t, x, v, a, D;
  std::vector<double>& operator[](Quantity q) { return this->*columns[q]; }
  const std::vector<double>& operator[](Quantity q) const { return this->*columns[q]; }
  static const PerQuantity<std::vector<double> Run::*> columns;

  double x0 = 0;        ///< where speeds begin on the road of the body
  Body body;            ///< the body and its mat: K, R, g and slope (trajectory routes only); runs
                        ///< that give the same number with the same uncertainty share its error
  FilterChain filters;  ///< the filters that made the fitted columns of x alone or of v alone, in
                        ///< order; empty if they are unknown. In the chain, the column D stands for
                        ///< the acceleration from which shift_of computed D.
  std::optional<Body> shift_of = {};  ///< the body for which the column D was computed
  std::string name = {};              ///< for messages
};

inline constexpr PerQuantity<std::vector<double> Run::*> Run::columns{
    {&Run::t, &Run::x, &Run::v, &Run::a, &Run::D}};

/// How a run differs from its filters.
struct Mismatch {
  bool inside = false;              ///< the columns are not those of these filters
  bool begin = false, end = false;  ///< only there, where a window may reach beyond the run
};

/// Applies the filters again to the columns of the run that no later filter has changed (x, v, and
/// for D the acceleration from which shift_of computed it) and compares each column that they make.
/// What differs from it by the rounding of the numbers, or by much less than its noise, is the
/// same. Columns that are missing, and the windows of missing readings, are not compared.
Mismatch mismatch(const FilterChain&, const Run&);

}  // namespace rolling
