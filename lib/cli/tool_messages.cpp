// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/tool.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <exception>

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

void LinesOfRuns::add(const std::string& run, const std::string& text) {
  std::string alike = text;
  std::erase_if(alike, [](char c) {
    return std::string_view("0123456789.+-e").find(c) != std::string_view::npos;
  });
  auto line = std::ranges::find(lines_, alike, &Line::alike);
  if (run.empty() || line == lines_.end()) {
    lines_.push_back({text, std::move(alike), {}});
    line = lines_.end() - 1;
  }
  if (!run.empty()) line->runs.push_back(run);
}

std::vector<std::string> LinesOfRuns::all() const {
  constexpr std::size_t most = 4;  // that are named
  std::vector<std::string> all;
  for (auto [text, alike, runs] : lines_) {
    if (runs.size() > most) runs[most] = fmt::format("{} more", runs.size() - most);
    runs.resize(std::min(runs.size(), most + 1));
    if (runs.size() > 1) runs[0] += " (and " + enumeration({runs.begin() + 1, runs.end()}) + ')';
    all.push_back(runs.empty() ? text : fmt::format("run {}: {}", runs[0], text));
  }
  return all;
}

namespace {

/// The terminate handler: where nothing catches an exception, before Tool::run() or while a message
/// is being made, memory has run out.
[[noreturn]] void report_uncaught() {
  write_message(program_invocation_short_name, "out of memory");
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
