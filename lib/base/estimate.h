// SPDX-License-Identifier: GPL-3.0-or-later
// A number with its uncertainty.
#pragma once

namespace rolling {

/// An estimate and its standard uncertainty (the standard deviation of the estimate), in one unit.
struct Estimate {
  double value = 0;
  double sigma = 0;  ///< 0: none was given

  bool operator==(const Estimate&) const = default;
};

}  // namespace rolling
