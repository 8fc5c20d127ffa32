// A filter of a column, which processes sample by sample.
#pragma once

#include <span>

#include "base/growing.h"
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

/// A filter whose output depends on a window around each sample: Of::value(window).
template <typename Of>
class WindowedSignal : public Signal {
 public:
  std::span<const double> push(double t, double y) final {
    windows_.push(t, y);
    return known();
  }
  std::span<const double> finish() final {
    windows_.finish();
    return known();
  }

 protected:
  WindowedSignal(Width width, Windows::Ends ends) : windows_(width, ends) {}

 private:
  std::span<const double> known() {
    known_.truncate(0);
    while (windows_.next()) known_.append(static_cast<Of*>(this)->value(windows_));
    return {known_.data(), known_.size()};
  }

  Windows windows_;
  Growing<double> known_;
};

}  // namespace rolling
