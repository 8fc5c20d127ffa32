// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/progress.h"

#include <fmt/core.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>

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

struct Progress::Writer {
  std::string name;
  std::mutex mutex = {};  // of the three that follow
  std::string what = {};
  double part = std::nan("");
  bool ended = false;
  std::condition_variable end = {};
  std::thread thread = std::thread([this] { show(); });

  ~Writer() {
    {
      const std::lock_guard lock(mutex);
      ended = true;
    }
    end.notify_one();
    thread.join();
  }
  void show();
};

Progress::Progress() = default;
Progress::~Progress() = default;

void Progress::start(std::string name) {
  if (!::isatty(STDERR_FILENO)) return;
  try {
    writer_.reset(new Writer{std::move(name)});
  } catch (const std::system_error&) {  // no thread can be made: there is no progress line
  }
}

void Progress::at(std::string_view what, double part) {
  if (!writer_) return;
  const std::lock_guard lock(writer_->mutex);
  writer_->what = what;
  writer_->part = part;
}

void Progress::stop() { writer_.reset(); }

void Progress::Writer::show() {
  sigset_t all;  // the main thread handles signals, between whole lines of output
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, nullptr);
  const auto begin = steady_clock::now();
  bool shown = false;
  std::unique_lock lock(mutex);
  for (auto next = begin + patience; !end.wait_until(lock, next, [this] { return ended; });
       next += interval) {
    if (what.empty()) continue;
    std::string text = name + ": " + what;
    for (char& c : text)
      if (c < ' ' || c > '~') c = '?';
    text.resize(std::min(text.size(), width - 16));
    if (!std::isnan(part)) text += fmt::format(" {:.0f} %", 100 * part);
    put(text +
        fmt::format(
            ", {} s",
            std::chrono::duration_cast<std::chrono::seconds>(steady_clock::now() - begin).count()));
    shown = true;
  }
  if (shown) put("");
}

}  // namespace rolling
