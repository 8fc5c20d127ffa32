// SPDX-License-Identifier: GPL-3.0-or-later
// Smoothing of a column, sample by sample.
#pragma once

#include <span>
#include <vector>

#include "signal/method.h"

namespace rolling {

/// The methods mean, median and savgol; all have a width.
extern const std::span<const SignalMethod> smoothing_methods;

/// The width in samples with the smallest error of prediction (cross-validation). The polynomial of
/// the method (a straight line for mean and median) is fitted to the window around each sample
/// without that sample and the two on either side, whose noise may be correlated with it (as after
/// a central difference); the squared prediction errors are summed. The windows are those of the
/// method, at the ends of the run too.
///
/// The width is at least 7, or what the order needs in addition to the five samples left out, and
/// at most half of the run, or 2001; half widths are tried an eighth apart. A short run has the
/// smallest width. From 4000 samples on, only every second, third, ... sample is predicted, so that
/// the cost is bounded.
std::size_t best_width(std::span<const Sample> run, const SignalOptions&);

/// Smooths with the best width of the run, which is computed when the run is complete.
class AutoSmoother : public WholeRunSignal {
 public:
  explicit AutoSmoother(const SignalOptions& options) : options_(options) {}
  std::span<const double> finish() override;
  const SignalOptions& options() const { return options_; }  ///< with that width after finish()

 private:
  SignalOptions options_;
  std::vector<double> smooth_;
};

}  // namespace rolling
