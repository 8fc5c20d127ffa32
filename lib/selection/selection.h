// SPDX-License-Identifier: GPL-3.0-or-later
// Selection of the samples of a run: those between two times, without outliers, of free rolls.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "selection/free_roll.h"
#include "selection/outliers.h"

namespace rolling {

struct SelectionOptions {
  double from = -INFINITY, to = INFINITY;  ///< [s]
  /// Readings further from the motion than this many times the scatter are left out; 0: none.
  double outliers = 0;
  Width width{};           ///< width of the windows for outliers
  bool coast = false;      ///< selects the longest free roll only, which needs the whole run
  bool rolls = false;      ///< selects all free rolls only
  bool positions = false;  ///< the column is a position, not a speed (for a roll)

  bool needs_run() const { return coast || rolls; }
  /// True if no sample is left out.
  bool all() const { return !needs_run() && outliers == 0 && std::isinf(from) && std::isinf(to); }
};

class Selection {
 public:
  explicit Selection(const SelectionOptions&);

  /// As in Signal: the samples for which the decision is now known, in order; y of one that is left
  /// out is NaN. finish() throws Error as free_roll does.
  std::span<const Sample> push(double t, double y);
  std::span<const Sample> finish();
  const std::vector<double>& outliers() const { return outliers_; }  ///< their times so far
  /// After finish(), for coast and rolls: their indices do not count the outliers.
  const std::vector<FreeRoll>& rolls() const { return rolls_; }

 private:
  void take(std::span<const Sample>);

  SelectionOptions options_;
  std::optional<Outliers> test_;
  std::vector<Sample> run_;  // for a roll the whole run, otherwise what was returned last
  std::vector<double> outliers_;
  std::vector<FreeRoll> rolls_;
};

}  // namespace rolling
