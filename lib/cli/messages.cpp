// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/messages.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <exception>
#include <new>

namespace rolling {

void write_message(std::string_view name, std::string_view text) {
  std::array<char, 512> line;
  char* end = line.data();
  for (const std::string_view part : {name, std::string_view(": "), text})
    end += part.copy(end, static_cast<std::size_t>(line.data() + line.size() - 1 - end));
  std::replace_if(
      line.data(), end, [](char c) { return c < ' ' || c > '~'; }, '?');
  *end = '\n';
  // If this fails, there is no place left for a message.
  [[maybe_unused]] const auto count =
      ::write(STDERR_FILENO, line.data(), static_cast<std::size_t>(end + 1 - line.data()));
}

namespace {

/// The terminate handler. It reports exceptions that nothing catches: before main(), from a static
/// object, or while a message is being made.
[[noreturn]] void report_uncaught() {
  const char* what = "unknown error";
  try {
    if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    what = "out of memory";
  } catch (const std::exception& error) {
    what = error.what();
  } catch (...) {}
  write_message(program_invocation_short_name, what);
  ::_exit(trouble);
}

/// Runs before the constructors of static objects.
[[gnu::constructor(101)]] void set_terminate_handler() { std::set_terminate(report_uncaught); }

// The last line of the output after a signal; static because a signal handler has no arguments.
std::array<char, 128> last_line;
std::size_t last_line_size = 0;
const Output* printed = nullptr;

/// The signal handler: writes the last line, unless standard output would block, and ends the tool
/// by the same signal. Output::flush() blocks signals, so the output ends with a whole line.
void end_by_signal(int signal) {
  pollfd ready{STDOUT_FILENO, POLLOUT, 0};
  if (printed->has_printed() && ::poll(&ready, 1, 0) == 1 && (ready.revents & POLLOUT) != 0) {
    [[maybe_unused]] const auto count = ::write(STDOUT_FILENO, last_line.data(), last_line_size);
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void end_output_on_signals(const Output& out, const std::string& line) {
  if (line.size() >= last_line.size()) return;
  last_line_size = line.copy(last_line.data(), line.size());
  last_line[last_line_size++] = '\n';
  printed = &out;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, end_by_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
}

}  // namespace rolling
