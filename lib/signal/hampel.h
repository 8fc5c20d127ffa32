// Readings that do not belong: Hampel's test against the median of a window about each.
#pragma once

#include "signal/signal.h"
#include "signal/sorted_window.h"

namespace rolling {

struct Judged {
  double t, y;
  bool kept;
};

class Hampel {
 public:
  /// A reading further from the median than `threshold` scaled MADs (1.4826 times the median
  /// distance from the median, the standard deviation of normal noise) is an outlier; never by less
  /// than `threshold` of the smallest steps that the run has had so far, so that the last digit of
  /// rounded readings makes none. Windows are cut off at the ends of a run. They have at least 11
  /// samples, whatever the width: the MAD of few readings is often far too small (of 3 normal ones
  /// with threshold 4, one in seven is left out; of 11, one in 250). O(sqrt w) a sample.
  Hampel(Width, double threshold);

  /// As of Signal: the samples that are now judged, in order.
  std::span<const Judged> push(double t, double y);
  std::span<const Judged> finish();

 private:
  std::span<const Judged> judge();

  Windows windows_;
  double threshold_;
  bool begun_ = false;
  double last_ = 0, step_ = 0;  // step_: the smallest between neighbours that is not 0
  SortedWindow sorted_;
  std::size_t begin_ = 0, end_ = 0;  // the samples in sorted_
  std::vector<Judged> judged_;
};

}  // namespace rolling
