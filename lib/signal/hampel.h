// Detection of outliers: Hampel's test of each reading against the median of the window around it.
#pragma once

#include "signal/signal.h"
#include "signal/sorted_window.h"

namespace rolling {

/// A sample and the result of the test.
struct Judged {
  double t, y;
  bool kept;
};

class Hampel {
 public:
  /// A reading is an outlier if its distance from the median exceeds `threshold` times the scale.
  /// The scale is 1.4826 times the median absolute deviation (MAD), which is the standard deviation
  /// for normal noise, and at least the smallest step between neighbours in the run so far, so that
  /// the last digit of rounded readings makes no outlier, nor does the rounding error of a program
  /// (program_rounding). Windows are cut off at the ends of a run.
  /// They hold at least 11 samples, because the MAD of few readings is often far too small: with
  /// threshold 4, one in seven normal readings would be removed by windows of 3 samples, and one in
  /// 250 by windows of 11. O(sqrt w) per sample.
  Hampel(Width, double threshold);

  /// As in Signal: the samples that have now been tested, in order.
  std::span<const Judged> push(double t, double y);
  std::span<const Judged> finish();

 private:
  std::span<const Judged> judge();

  Windows windows_;
  double threshold_;
  bool begun_ = false;
  double last_ = 0;
  double large_ = 0;  // the largest reading so far that a neighbour reaches too
  double step_ = 0;   // the smallest step between neighbours so far
  SortedWindow sorted_;
  std::size_t begin_ = 0, end_ = 0;  // range of the samples in sorted_
  std::vector<Judged> judged_;
};

}  // namespace rolling
