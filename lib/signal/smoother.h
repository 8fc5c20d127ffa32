// A smoothed column, one sample in at a time.
#pragma once

#include <span>
#include <vector>

#include "signal/method.h"

namespace rolling {

/// mean, median and savgol: all have a width.
extern const std::span<const SignalMethod> smoothing_methods;

/// The width, in samples, whose window predicts the run best: about each sample the polynomial that
/// the method stands for (a straight line for mean and median) is fitted without it and the two on
/// either side of it, whose noise may be bound to its own (as it is after a central difference),
/// and the squared distances are added up. At least 7, or what the order needs beyond the five left
/// out; at most half of the run, or 2001. For short runs the narrowest. Of 4000 samples or more
/// every second, third, ... is predicted, so that the work is bounded.
std::size_t best_width(std::span<const Sample> run, const SignalOptions&);

/// Smooths as the options say, but by the best width of the run, which it therefore needs whole.
class AutoSmoother : public Signal {
 public:
  explicit AutoSmoother(const SignalOptions& options) : options_(options) {}
  std::span<const double> push(double t, double y) override;
  std::span<const double> finish() override;
  const SignalOptions& options() const { return options_; }  ///< with the width, once finished

 private:
  SignalOptions options_;
  std::vector<Sample> run_;
  std::vector<double> smooth_;
};

}  // namespace rolling
