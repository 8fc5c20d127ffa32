#include "cli/progress.h"

#include <fmt/core.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <system_error>

namespace rolling {
namespace {

using std::chrono::steady_clock;
constexpr std::chrono::milliseconds patience(2000), interval(500);
constexpr std::size_t width = 79;

/// Clears the line of the terminal and writes `text` there.
void put(const std::string& text) {
  const std::string line = "\r\033[K" + text;
  [[maybe_unused]] const auto count = ::write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace

void Progress::start(std::string name) {
  if (!::isatty(STDERR_FILENO)) return;
  name_ = std::move(name);
  part_ = std::nan("");
  try {
    thread_ = std::jthread([this](const std::stop_token& stop) { show(stop); });
  } catch (const std::system_error&) {  // no thread can be made: there is no progress line
  }
}

void Progress::at(std::string_view what, double part) {
  if (!thread_.joinable()) return;
  const std::lock_guard lock(mutex_);
  what_ = what;
  part_ = part;
}

void Progress::stop() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  thread_.join();
}

void Progress::show(const std::stop_token& stop) {
  sigset_t all;  // the main thread handles signals, between whole lines of output
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, nullptr);
  const auto begin = steady_clock::now();
  bool shown = false;
  std::unique_lock lock(mutex_);
  for (auto next = begin + patience;
       !stopped_.wait_until(lock, stop, next, [] { return false; }) && !stop.stop_requested();
       next += interval) {
    if (what_.empty()) continue;
    std::string text = name_ + ": " + what_;
    for (char& c : text)
      if (c < ' ' || c > '~') c = '?';
    text.resize(std::min(text.size(), width - 16));
    if (!std::isnan(part_)) text += fmt::format(" {:.0f} %", 100 * part_);
    put(text +
        fmt::format(
            ", {} s",
            std::chrono::duration_cast<std::chrono::seconds>(steady_clock::now() - begin).count()));
    shown = true;
  }
  if (shown) put("");
}

}  // namespace rolling
