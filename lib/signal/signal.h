// A column on its way through a filter, one sample in at a time.
#pragma once

#include <span>
#include <vector>

#include "signal/windows.h"

namespace rolling {

class Signal {
 public:
  virtual ~Signal() = default;
  /// Takes the next sample of the run (times increase); returns the numbers that are now known, in
  /// order. Valid until the next call.
  virtual std::span<const double> push(double t, double y) = 0;
  /// The run has ended: the numbers still owed.
  virtual std::span<const double> finish() = 0;
};

/// One whose number for a sample depends on a window about it: Of::value(window).
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
    known_.clear();
    while (windows_.next()) known_.push_back(static_cast<Of*>(this)->value(windows_));
    return known_;
  }

  Windows windows_;
  std::vector<double> known_;
};

}  // namespace rolling
