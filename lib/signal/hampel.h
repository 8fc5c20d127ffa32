// Readings that do not belong: Hampel's test against the median of a window about each.
#pragma once

#include "signal/signal.h"

namespace rolling {

struct Judged {
  double t, y;
  bool kept;
};

class Hampel {
 public:
  /// A reading further from the median than `threshold` scaled MADs (1.4826 times the median
  /// distance from the median, s of normal noise) is an outlier; never by less than `threshold` of
  /// the smallest steps that the run has had so far, so that the last digit of rounded readings
  /// makes none. Windows are cut off at the ends of a run. O(w) a sample.
  Hampel(Width width, double threshold)
      : windows_(width, Windows::Ends::cut), threshold_(threshold) {}

  /// As of Signal: the samples that are now judged, in order.
  std::span<const Judged> push(double t, double y);
  std::span<const Judged> finish();

 private:
  std::span<const Judged> judge();

  Windows windows_;
  double threshold_;
  bool begun_ = false;
  double last_ = 0, step_ = 0;  // step_: the smallest between neighbours that is not 0
  std::vector<double> work_;
  std::vector<Judged> judged_;
};

}  // namespace rolling
