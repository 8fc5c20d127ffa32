// SPDX-License-Identifier: GPL-3.0-or-later
// Selection of the samples of a run: those between two times, without outliers, of the free roll.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/growing.h"
#include "signal/free_roll.h"
#include "signal/outliers.h"

namespace rolling {

struct SelectionOptions {
  double from = -std::numeric_limits<double>::infinity(),
         to = std::numeric_limits<double>::infinity();  ///< [s]
  /// Readings further from the motion than this many times the scatter are left out; 0: none.
  double outliers = 0;
  Width width{};           ///< width of the windows for outliers
  bool coast = false;      ///< selects the free roll only, which needs the whole run
  bool positions = false;  ///< the column is a position, not a speed (for coast)

  bool all() const {
    return !coast && outliers == 0 && std::isinf(from) && std::isinf(to);
  }  ///< true if no sample is left out
};

class Selection {
 public:
  explicit Selection(const SelectionOptions&);

  /// As in Signal: the samples for which the decision is now known, in order.
  std::span<const Judged> push(double t, double y);
  /// Ends the run. Throws Error as free_roll does.
  void finish();
  /// The next samples for which the decision is known; behind the last one, none.
  std::span<const Judged> next();
  const std::vector<double>& outliers() const { return outliers_; }  ///< their times so far
  /// After finish(), for coast: the free roll, and the times [s] of its first and last sample, of
  /// that with which something else begins, and those of another roll.
  struct Roll {
    std::size_t samples, of;
    FreeRoll::End how;
    double from, to, after;
    std::optional<std::pair<double, double>> other;
  };
  const std::optional<Roll>& roll() const { return roll_; }

 private:
  void take(std::span<const Judged>);
  void keep_roll();

  SelectionOptions options_;
  std::optional<Outliers> test_;
  // Samples that next() has not returned, for coast the whole run; and the indices of those that
  // are not kept, whatever the roll is.
  Growing<Sample> run_;
  std::vector<std::size_t> off_;
  std::size_t next_ = 0, next_off_ = 0;
  Stretch kept_{0, std::numeric_limits<std::size_t>::max()};  // of the others
  std::vector<Judged> decided_;
  std::vector<double> outliers_;
  std::optional<Roll> roll_;
};

}  // namespace rolling
