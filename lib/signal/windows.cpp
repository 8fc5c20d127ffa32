// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/windows.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/error.h"

namespace rolling {

Windows::Windows(Width width, Ends ends)
    : width_(width), ends_(ends),
      half_(width_.seconds > 0 ? std::numeric_limits<std::size_t>::max() : width_.samples / 2),
      ring_(16), mask_(ring_.size() - 1) {
  if (width_.seconds == 0 && width_.samples % 2 == 0)
    fail("the width of a centred window is an odd number of samples, not {}", width_.samples);
}

std::size_t samples_within(Width width, std::span<const double> t) {
  if (width.seconds == 0) return width.samples / 2;
  std::size_t most = 0;
  for (std::size_t i = 0, j = 0; i < t.size(); ++i) {
    while (t[i] - t[j] > width.seconds / 2) ++j;
    most = std::max(most, i - j);
  }
  return most + 1;  // what is late by a share of a step
}

void Windows::make_room() {
  first_ = std::max(first_, width_.seconds > 0 ? std::min(left_, begin_) : begin_);
  if (count_ - first_ < ring_.size()) return;
  std::vector<Sample> larger(2 * ring_.size());
  for (std::size_t i = first_; i < count_; ++i) larger[i & (larger.size() - 1)] = sample(i);
  ring_ = std::move(larger);
  mask_ = ring_.size() - 1;
}

/// next(), where the ends of the run may matter.
bool Windows::near_end() {
  const std::size_t i = next_;
  auto [begin, end, known] = width_.seconds > 0 ? by_time(i) : by_count(i);
  if (ends_ == Ends::cut) {
    begin = std::min(begin, i - std::min(i, width_.least / 2));
    end = std::min(std::max(end, i + width_.least / 2 + 1), count_);
    known &= i + width_.least / 2 < count_ || finished_;
  } else if (ends_ == Ends::shrink) {
    const std::size_t behind = i - begin;
    const std::size_t k = std::min(behind, end - 1 - i);
    known |= k == behind;
    begin = i - k;
    end = i + k + 1;
  }
  if (!known) return false;  // the samples of the last window are still needed
  begin_ = begin;
  end_ = end;
  ++next_;
  return true;
}

Windows::Within Windows::by_count(std::size_t i) const {
  const std::size_t middle = ends_ == Ends::stay ? std::max(i, half_) : i;
  std::size_t begin = middle - std::min(middle, half_);
  if (ends_ == Ends::stay) begin = std::min(begin, count_ - std::min(count_, width_.samples));
  return {begin, std::min(middle + half_ + 1, count_), middle + half_ < count_ || finished_};
}

Windows::Within Windows::by_time(std::size_t i) {
  constexpr double late = 1.0 / 16;  // of a step; see Width
  const double half = width_.seconds / 2;
  const double newest = sample(count_ - 1).t;
  double middle = sample(i).t;
  if (ends_ == Ends::stay) middle = std::max(middle, start_ + half);
  double from = middle - half;
  double to = middle + half;
  const auto step = [this](std::size_t j) { return sample(j + 1).t - sample(j).t; };
  right_ = std::max(right_, i + 1);
  while (right_ < count_ && sample(right_).t - late * step(right_ - 1) <= to) ++right_;
  const bool complete = right_ < count_ || finished_;
  if (ends_ == Ends::stay && !complete) return {};  // the window may yet reach further back
  if (ends_ == Ends::stay && finished_ && to > newest) from = newest - width_.seconds;
  while (left_ < i && sample(left_).t + late * step(left_) < from) ++left_;
  return {left_, right_, complete};
}

}  // namespace rolling
