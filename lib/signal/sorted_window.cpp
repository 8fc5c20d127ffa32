// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/sorted_window.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rolling {

/// The last block whose first reading is smaller than y, or block 0.
std::size_t SortedWindow::block_of(double y) const {
  const auto behind = std::lower_bound(
      blocks_.begin(), blocks_.end(), y,
      [](const std::vector<double>& block, double value) { return block.front() < value; });
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(behind - blocks_.begin(), 1)) - 1;
}

void SortedWindow::insert(double y) {
  if (blocks_.empty()) {
    blocks_.push_back({y}), first_.push_back(0), size_ = 1;
    return;
  }
  const std::size_t b = block_of(y);
  auto& block = blocks_[b];
  block.insert(std::upper_bound(block.begin(), block.end(), y), y);
  for (std::size_t i = b + 1; i < first_.size(); ++i) ++first_[i];
  ++size_;
  if (block.size() < 512 || block.size() * block.size() < 4 * size_) return;
  const auto middle = block.begin() + std::ssize(block) / 2;
  std::vector<double> upper(middle, block.end());
  block.erase(middle, block.end());
  first_.insert(first_.begin() + static_cast<std::ptrdiff_t>(b) + 1, first_[b] + block.size());
  blocks_.insert(blocks_.begin() + static_cast<std::ptrdiff_t>(b) + 1, std::move(upper));
}

void SortedWindow::erase(double y) {
  std::size_t b = block_of(y);
  if (blocks_[b].back() < y) ++b;
  auto& block = blocks_[b];
  block.erase(std::lower_bound(block.begin(), block.end(), y));
  for (std::size_t i = b + 1; i < first_.size(); ++i) --first_[i];
  --size_;
  if (!block.empty()) return;
  blocks_.erase(blocks_.begin() + static_cast<std::ptrdiff_t>(b));
  first_.erase(first_.begin() + static_cast<std::ptrdiff_t>(b));
}

double SortedWindow::operator[](std::size_t rank) const {
  const auto behind = std::upper_bound(first_.begin(), first_.end(), rank);
  const auto b = static_cast<std::size_t>(behind - first_.begin()) - 1;
  return blocks_[b][rank - first_[b]];
}

double SortedWindow::median() const {
  const double upper = (*this)[size_ / 2];
  return size_ % 2 == 1 ? upper : std::midpoint((*this)[size_ / 2 - 1], upper);
}

/// The distance of rank `rank`. Distances grow from the middle to both sides: the rank + 1 smallest
/// ones are the first `above` upwards and the others downwards. A binary search finds `above`.
double SortedWindow::nth_distance(double median, std::size_t rank) const {
  const std::size_t middle = size_ / 2;
  const auto upwards = [&](std::size_t i) { return std::abs((*this)[middle + i] - median); };
  const auto downwards = [&](std::size_t i) { return std::abs((*this)[middle - 1 - i] - median); };
  std::size_t least = rank + 1 > middle ? rank + 1 - middle : 0,
              most = std::min(rank + 1, size_ - middle);
  while (least < most) {
    const std::size_t above = std::midpoint(least, most);
    if (upwards(above) >= downwards(rank - above)) most = above;
    else least = above + 1;
  }
  const double up = least > 0 ? upwards(least - 1) : 0,
               down = least <= rank ? downwards(rank - least) : 0;
  return std::max(up, down);
}

double SortedWindow::median_distance(double median) const {
  const double upper = nth_distance(median, size_ / 2);
  return size_ % 2 == 1 ? upper : std::midpoint(nth_distance(median, size_ / 2 - 1), upper);
}

}  // namespace rolling
