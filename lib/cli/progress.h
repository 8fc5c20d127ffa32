// SPDX-License-Identifier: GPL-3.0-or-later
// A progress line on the terminal.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace rolling {

/// Shows a line `NAME: WHAT 43 %, 12 s` on standard error if that is a terminal: first after two
/// seconds, then twice a second. The line is removed at the end. A thread of its own writes it, so
/// that the computation does not have to look at the clock.
class Progress {
 public:
  Progress();
  ~Progress();
  /// Starts the clock and the thread. Does nothing if standard error is not a terminal or if no
  /// thread can be made.
  void start(std::string name);
  /// Sets the text of the line and the fraction of the work that is done, NaN if it is not known.
  /// Nothing is shown before the first call.
  void at(std::string_view what, double part);
  /// Removes the line for good. Call it before anything else is written to the terminal.
  void stop();

 private:
  struct Writer;  // the line and its thread
  std::unique_ptr<Writer> writer_;
};

}  // namespace rolling
