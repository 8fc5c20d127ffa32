// SPDX-License-Identifier: GPL-3.0-or-later
// One line on standard error, and how a tool ends where no exception can be caught.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "text/output.h"

namespace rolling {

inline constexpr int trouble = 2;  ///< the exit status after an error

/// Writes `NAME: TEXT`, one line of printable ASCII of at most 512 bytes, to standard error.
/// Allocates no memory, so that it works when memory has run out. (Exceptions that nothing catches,
/// before main() or while a message is being made, are reported by such a line too.)
void write_message(std::string_view name, std::string_view text);

/// Lines about runs: those of several runs that differ in their numbers alone are one, as
/// `run a.csv (and b.csv, c.csv, d.csv and 4 more): sigma_a is 0.62 times a: ...`.
class LinesOfRuns {
 public:
  /// A line without a run, as about a joint fit, is a line of its own.
  void add(const std::string& run, const std::string& text);
  /// The lines in the order of their first runs.
  std::vector<std::string> all() const;

 private:
  struct Line {
    std::string text, alike;  ///< of the first run; without numbers
    std::vector<std::string> runs;
  };
  std::vector<Line> lines_;
};

/// From now on SIGINT, SIGTERM and SIGHUP write `last_line` behind the output, unless nothing has
/// been printed or standard output would block, before they end the tool. Signals that the caller
/// has set to be ignored stay ignored. A line of more than 127 bytes changes nothing.
void end_output_on_signals(const Output& out, const std::string& last_line);

}  // namespace rolling
