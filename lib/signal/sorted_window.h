// The readings of a window in order of size, by rank.
#pragma once

#include <cstddef>
#include <vector>

namespace rolling {

/// In blocks of about the square root of their number, so that a reading goes in or out by O(sqrt
/// w) moves in one piece of memory, and small windows are one block.
class SortedWindow {
 public:
  void insert(double);
  void erase(double);  ///< one that is there
  std::size_t size() const { return size_; }
  double operator[](std::size_t rank) const;

  /// The middle one, or the mean of the two in the middle; the window is not empty.
  double median() const;
  /// The median distance of the readings from their median.
  double median_distance(double median) const;

 private:
  std::size_t block_of(double) const;
  double nth_distance(double median, std::size_t rank) const;

  std::vector<std::vector<double>> blocks_;  // none is empty
  std::vector<std::size_t> first_;           // the rank of each block's first reading
  std::size_t size_ = 0;
};

}  // namespace rolling
