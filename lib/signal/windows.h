// SPDX-License-Identifier: GPL-3.0-or-later
// The samples of a run, and the window around each as soon as its samples are known; needs the
// memory of one window.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace rolling {

struct Sample {
  double t, y;
};

/// Units in which the readings of a run and its duration are of order one. A computation that takes
/// squares of readings or times first changes to these units: no square overflows or underflows
/// then. Both units are powers of two, so the change does not round.
struct Units {
  int t = 0, y = 0;  ///< the exponents of 2

  explicit Units(std::span<const Sample> run) {
    double largest = 0;
    for (const Sample& s : run) largest = std::max(largest, std::abs(s.y));
    if (largest > 0) y = std::ilogb(largest);
    if (run.size() > 1) t = std::ilogb(run.back().t - run.front().t);
  }
  Sample operator()(const Sample& s) const { return {std::ldexp(s.t, -t), std::ldexp(s.y, -y)}; }
};

/// The width of a window: an odd number of samples or, if seconds > 0, a duration, half of which
/// lies on either side [s].
///
/// A sample belongs to a duration if it lies outside by no more than a sixteenth of the step to its
/// inner neighbour. Times are rounded, so that whether a sample lies exactly on the edge is not
/// decidable; a fraction of the step gives the same result for every offset of the times. (At 25 Hz
/// and for times since 1970, a step is 170 000 times the rounding error.)
struct Width {
  std::size_t samples = 11;
  double seconds = 0;
  std::size_t least = 1;  ///< least number of samples (odd) of a window in seconds, for Ends::cut
};

/// The largest number of samples to either side that such a window reaches in a run with these
/// times; a window at the end of a run that stays wide (Ends::stay) may reach twice as many.
std::size_t samples_within(Width, std::span<const double> t);

class Windows {
 public:
  /// The treatment of windows at the ends of a run. shrink: symmetrically smaller. cut: cut off.
  /// stay: the first or last complete window, with the sample off its middle.
  enum class Ends { shrink, cut, stay };
  /// Throws Error for an even width.
  Windows(Width, Ends);

  void push(double t, double y) {
    if (count_ - first_ == ring_.size()) make_room();
    if (count_ == 0) start_ = t;
    ring_[count_++ & mask_] = {t, y};
  }
  void finish() { finished_ = true; }
  /// Moves to the next sample whose window is complete; false if there is none yet: the window, and
  /// the samples in it, then remain.
  bool next() {
    if (next_ < half_ || finished_) return next_ < count_ && near_end();
    if (next_ + half_ >= count_) return false;
    begin_ = next_ - half_;
    end_ = ++next_ + half_;
    return true;
  }

  /// The samples of the window have the indices [begin(), end()), counted from the start of the
  /// run; at() is the index of the sample whose window it is.
  std::size_t begin() const { return begin_; }
  std::size_t end() const { return end_; }
  std::size_t size() const { return end_ - begin_; }
  std::size_t at() const { return next_ - 1; }
  const Sample& sample(std::size_t i) const { return ring_[i & mask_]; }

 private:
  /// The samples [begin, end) within the width around one of them, and whether no more will be.
  struct Within {
    std::size_t begin, end;
    bool complete;
  };
  void make_room();
  bool near_end();
  Within by_count(std::size_t i) const;
  Within by_time(std::size_t i);

  Width width_;
  Ends ends_;
  bool finished_ = false;
  // Half of the width in samples. For a width in seconds it is the largest number, so that next()
  // calls near_end() for each sample.
  std::size_t half_;
  // A ring: sample i is at i modulo the size, a power of two; samples before first_ are dropped.
  std::vector<Sample> ring_;
  std::size_t mask_;  // size of the ring - 1
  std::size_t first_ = 0, count_ = 0, next_ = 0;
  std::size_t begin_ = 0, end_ = 0;   // the present window
  std::size_t left_ = 0, right_ = 0;  // range of the samples within the duration
  double start_ = 0;                  // time of the first sample of the run
};

/// What is made of the readings of a window, one after the other, as it moves along a run.
template <typename Held>
class Sliding {
 public:
  /// Of the present window: each reading that has entered is added, each that has left subtracted.
  const Held& of(const Windows& window) {
    const auto y = [&](std::size_t i) { return window.sample(i).y; };
    while (begin_ > window.begin()) held_.add(y(--begin_));
    while (end_ < window.end()) held_.add(y(end_++));
    while (begin_ < window.begin()) held_.subtract(y(begin_++));
    while (end_ > window.end()) held_.subtract(y(--end_));
    return held_;
  }

 private:
  Held held_;
  std::size_t begin_ = 0, end_ = 0;  // the samples that are in it
};

/// The readings of a window in sorted order, with access by rank. Insertion and removal move half
/// of the readings by one place, which takes 1 us for 10,000.
class SortedWindow {
 public:
  void add(double y) { sorted_.insert(std::ranges::upper_bound(sorted_, y), y); }
  /// Of a reading that is in the window.
  void subtract(double y) { sorted_.erase(std::ranges::lower_bound(sorted_, y)); }
  std::size_t size() const { return sorted_.size(); }
  double operator[](std::size_t rank) const { return sorted_[rank]; }

  /// The median (the mean of the two middle readings for an even number). The window must not be
  /// empty.
  double median() const { return std::midpoint(sorted_[(size() - 1) / 2], sorted_[size() / 2]); }

 private:
  std::vector<double> sorted_;
};

}  // namespace rolling
