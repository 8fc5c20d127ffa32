// The mean over a centred window, one sample in at a time. At the ends the window shrinks symmetrically, so a straight
// line comes out as itself. Each mean is within 1 ulp of the exact mean of its window, whatever came before it.
#pragma once

#include <cstddef>
#include <deque>
#include <span>
#include <vector>

#include "signal/exact_sum.h"

namespace rolling {

class MovingMean {
 public:
  /// An odd number of samples; or, if seconds > 0, a duration of which half lies on either side [s]. Throws Error for an even width.
  struct Window { std::size_t samples = 11; double seconds = 0; };
  explicit MovingMean(Window);

  /// Takes the next sample of the run; returns the means that are now known, in order. Valid until the next call.
  std::span<const double> push(double t, double y);
  /// The run has ended: the means still owed.
  std::span<const double> finish();

 private:
  struct Sample { double t, y; };

  const Sample& sample(std::size_t i) const { return samples_[i - first_]; }
  bool within(std::size_t i, std::size_t j) const;
  bool half_width(std::size_t i, bool at_end, std::size_t& k);
  void emit_known(bool at_end);

  Window window_;
  ExactSum sum_;
  std::deque<Sample> samples_;        // those from index first_ on
  std::size_t first_ = 0;
  std::size_t left_ = 0, right_ = 0;  // the samples within half a window of the next mean
  std::size_t next_ = 0;              // whose mean is next
  std::size_t begin_ = 0, end_ = 0;   // the samples in sum_
  std::vector<double> known_;
};

}  // namespace rolling
