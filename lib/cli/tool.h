// SPDX-License-Identifier: GPL-3.0-or-later
// The frame of every command: its options, input and output, messages, exit status.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cli/messages.h"
#include "cli/options.h"
#include "text/output.h"
#include "text/reader.h"

namespace rolling {

class Tool : public Options {
 public:
  Tool(std::string name, const std::string& purpose);

  // Options of the input and the output.
  void input();  ///< operands, --use --run --strict
  /// Whether --use says which column this quantity is.
  bool used(const std::string& quantity) const;
  void output();  ///< --digits -u

  /// Parses the command line, runs `work` and flushes the output. Returns the exit status: that of
  /// `work`, 1 after an object() that fails a check, or 2 after an error, which is one line on
  /// standard error.
  int run(int argc, char** argv, const std::function<int()>& work);

  /// The rows of the operands. `order` names the columns of a file without names.
  Reader& read(std::vector<std::string> order);
  /// The rows of a file that is the value of an option.
  Reader& read_file(const std::string& file, std::vector<std::string> order);

  /// One line of printable ASCII on standard error, at most 512 bytes.
  void say(const std::string& text);
  /// A line about a run, which waits for the next of say() or the end: see LinesOfRuns.
  void say(const std::string& run, const std::string& text) { waiting_.add(run, text); }
  /// A warning: the same line, unless -q is given.
  void warn(const std::string& text) {
    if (!quiet_) say(text);
  }
  void warn(const std::string& run, const std::string& text) {
    if (!quiet_) say(run, text);
  }

  /// Prints how many rows were left out and why, unless -q is given.
  void count_left_out(std::size_t count, const std::string& why);

  /// What speaks against the result of a run, or of all: a warning; with `checks` a line that -q
  /// does not silence, and run() returns 1.
  void object(const std::string& run, const std::string& text) {
    if (!checks) return warn(run, text);
    say(run, text);
    failed_ = true;
  }

  bool checks = false;  ///< --check

  Output out;

 private:
  Reader& open(ReaderOptions, std::vector<std::string> order);
  int finish(int status);

  std::string name_, error_line_;
  ReaderOptions input_;
  bool quiet_ = false;
  bool standard_input_taken_ = false;  // a Reader reads it; a second one cannot
  bool failed_ = false;
  LinesOfRuns waiting_;
  std::vector<std::unique_ptr<Reader>> readers_;
};

}  // namespace rolling
