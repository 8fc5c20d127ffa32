// A progress line on the terminal.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace rolling {

/// Shows a line `NAME: WHAT 43 %, 12 s` on standard error if that is a terminal: first after two
/// seconds, then twice a second. The line is removed at the end. A thread of its own writes it, so
/// that the computation does not have to look at the clock.
class Progress {
 public:
  /// Starts the clock and the thread. Does nothing if standard error is not a terminal or if no
  /// thread can be made.
  void start(std::string name);
  /// Sets the text of the line and the fraction of the work that is done, NaN if it is not known.
  /// Nothing is shown before the first call.
  void at(std::string_view what, double part);
  /// Removes the line for good. Call it before anything else is written to the terminal.
  void stop();
  ~Progress() { stop(); }

 private:
  void show(const std::stop_token&);

  std::string name_;
  std::mutex mutex_;  // of the two that follow
  std::string what_;
  double part_ = 0;
  std::condition_variable_any stopped_;
  std::jthread thread_;
};

}  // namespace rolling
