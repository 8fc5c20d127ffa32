// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/sorted_window.h"

#include <algorithm>
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
    blocks_.push_back({y}), size_ = 1;
    return;
  }
  const std::size_t b = block_of(y);
  auto& block = blocks_[b];
  block.insert(std::upper_bound(block.begin(), block.end(), y), y);
  ++size_;
  if (block.size() < 512 || block.size() * block.size() < 4 * size_) return;
  const auto middle = block.begin() + std::ssize(block) / 2;
  std::vector<double> upper(middle, block.end());
  block.erase(middle, block.end());
  blocks_.insert(blocks_.begin() + static_cast<std::ptrdiff_t>(b) + 1, std::move(upper));
}

void SortedWindow::erase(double y) {
  std::size_t b = block_of(y);
  if (blocks_[b].back() < y) ++b;
  auto& block = blocks_[b];
  block.erase(std::lower_bound(block.begin(), block.end(), y));
  --size_;
  if (block.empty()) blocks_.erase(blocks_.begin() + static_cast<std::ptrdiff_t>(b));
}

double SortedWindow::operator[](std::size_t rank) const {
  auto block = blocks_.begin();
  for (; rank >= block->size(); ++block) rank -= block->size();
  return (*block)[rank];
}

double SortedWindow::median() const {
  const double upper = (*this)[size_ / 2];
  return size_ % 2 == 1 ? upper : std::midpoint((*this)[size_ / 2 - 1], upper);
}

}  // namespace rolling
