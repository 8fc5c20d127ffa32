// For who waits at a terminal: what a program is doing, and how much of it is done.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace rolling {

/// A line on standard error, `NAME: WHAT 43 %, 12 s`, from two seconds on and twice a second, wiped
/// in the end; only on a terminal. A thread writes it, so that the work need not look at the clock.
class Progress {
 public:
  /// The clock begins. Without this, a terminal, or a thread to be had, nothing is ever shown.
  void start(std::string name);
  /// What is being done, and the part of it that is done, from 0 to 1; NaN if that is not known.
  /// Nothing is shown before the first.
  void at(std::string_view what, double part);
  /// Wipes the line, and it does not come back. Whoever writes to the terminal stops it first.
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
