// SPDX-License-Identifier: GPL-3.0-or-later
// The readings of a window in sorted order, with access by rank.
#pragma once

#include <cstddef>
#include <vector>

namespace rolling {

/// The readings are stored in blocks of about the square root of their number. Insertion and
/// removal move O(sqrt w) contiguous numbers; a small window is one block.
class SortedWindow {
 public:
  void insert(double);
  void erase(double);  ///< of a reading that is in the window
  std::size_t size() const { return size_; }
  double operator[](std::size_t rank) const;

  /// The median (the mean of the two middle readings for an even number). The window must not be
  /// empty.
  double median() const;

 private:
  std::size_t block_of(double) const;

  std::vector<std::vector<double>> blocks_;  // no block is empty
  std::size_t size_ = 0;
};

}  // namespace rolling
