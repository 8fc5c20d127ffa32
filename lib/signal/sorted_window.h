// SPDX-License-Identifier: GPL-3.0-or-later
// The readings of a window in sorted order, with access by rank.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace rolling {

/// Insertion and removal move half of the readings by one place, which takes 1 us for 10,000.
class SortedWindow {
 public:
  void add(double y) { sorted_.insert(std::ranges::upper_bound(sorted_, y), y); }
  /// Of a reading that is in the window.
  void subtract(double y) { sorted_.erase(std::ranges::lower_bound(sorted_, y)); }
  /// The same as subtract(old) and add(y); the readings between them alone are moved.
  void exchange(double y, double old) {
    const auto from = std::ranges::lower_bound(sorted_, old),
               to = std::ranges::lower_bound(sorted_, y);
    if (from < to) *std::move(from + 1, to, from) = y;
    else std::move_backward(to, from, from + 1), *to = y;
  }
  std::size_t size() const { return sorted_.size(); }
  double operator[](std::size_t rank) const { return sorted_[rank]; }

  /// The median (the mean of the two middle readings for an even number). The window must not be
  /// empty.
  double median() const { return std::midpoint(sorted_[(size() - 1) / 2], sorted_[size() / 2]); }

 private:
  std::vector<double> sorted_;
};

}  // namespace rolling
