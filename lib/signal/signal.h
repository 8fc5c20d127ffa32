// SPDX-License-Identifier: GPL-3.0-or-later
// A filter of a column, which processes sample by sample.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/error.h"
#include "signal/windows.h"

namespace rolling {

class Signal {
 public:
  virtual ~Signal() = default;
  /// Processes the next sample of the run (times increase) and returns the output values that are
  /// now known, in order. Valid until the next call.
  virtual std::span<const double> push(double t, double y) = 0;
  /// Ends the run and returns the remaining output values. Valid until the next call.
  virtual std::span<const double> finish() = 0;
};

/// The output of a filter for a whole run.
inline std::vector<double> output_of(Signal& filter, std::span<const double> t,
                                     std::span<const double> y) {
  std::vector<double> output;
  output.reserve(t.size());
  for (std::size_t i = 0; i < t.size(); ++i)
    for (const double value : filter.push(t[i], y[i])) output.push_back(value);
  for (const double value : filter.finish()) output.push_back(value);
  return output;
}

/// Throws Error for a run of one sample.
inline void require_slope(std::size_t samples) {
  if (samples == 1) fail("a run of one row has no derivative");
}

/// A filter whose output is a function of the window around each sample: value(const Windows&).
template <typename Value>
class WindowedSignal : public Signal {
 public:
  WindowedSignal(Width width, Windows::Ends ends, Value value)
      : windows_(width, ends), value_(std::move(value)) {}

  std::span<const double> push(double t, double y) final {
    windows_.push(t, y);
    return known();
  }
  std::span<const double> finish() final {
    windows_.finish();
    return known();
  }

 private:
  std::span<const double> known() {
    known_.clear();
    while (windows_.next()) known_.push_back(value_(windows_));
    return known_;
  }

  Windows windows_;
  Value value_;
  std::vector<double> known_;
};

/// Throws Error for an even width.
template <typename Value>
std::unique_ptr<Signal> windowed(Width width, Windows::Ends ends, Value value) {
  return std::make_unique<WindowedSignal<Value>>(width, ends, std::move(value));
}

}  // namespace rolling
