// A smoothed column, one sample in at a time.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "signal/signal.h"

namespace rolling {

enum class SmoothingMethod { mean, median, savgol };

inline const std::map<std::string, SmoothingMethod> smoothing_methods = {
    {"mean", SmoothingMethod::mean},
    {"median", SmoothingMethod::median},
    {"savgol", SmoothingMethod::savgol}};

struct SmootherOptions {
  SmoothingMethod method = SmoothingMethod::mean;
  Width width{};
  std::size_t order = 2;  ///< of savgol
};

/// As a `##` line says it: `mean width 11`, `savgol seconds 0.4 order 2`.
std::string describe(const SmootherOptions&);

/// Throws Error for a width and an order that do not go together.
std::unique_ptr<Signal> make_smoother(const SmootherOptions&);

/// The width, in samples, whose window predicts the run best: about each sample the polynomial that
/// the method stands for (a straight line for mean and median) is fitted without it and the two on
/// either side of it, whose noise may be bound to its own (as it is after a central difference),
/// and the squared distances are added up. At least 7, or what the order needs beyond the five left
/// out; at most half of the run. For short runs the narrowest; O(n^2) in all.
std::size_t best_width(std::span<const Sample> run, const SmootherOptions&);

/// Smooths as the options say, but by the best width of the run, which it therefore needs whole.
class AutoSmoother : public Signal {
 public:
  explicit AutoSmoother(const SmootherOptions& options) : options_(options) {}
  std::span<const double> push(double t, double y) override;
  std::span<const double> finish() override;
  const SmootherOptions& options() const { return options_; }  ///< with the width, once finished

 private:
  SmootherOptions options_;
  std::vector<Sample> run_;
  std::vector<double> smooth_;
};

}  // namespace rolling
