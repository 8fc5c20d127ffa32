// SPDX-License-Identifier: GPL-3.0-or-later
// The command line, as CLI11 parses it. Only command_line.cpp includes CLI11, which needs several
// seconds to compile.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rolling {

class CommandLine {
 public:
  using Set = std::function<void(const std::string&)>;

  CommandLine(const std::string& name, const std::string& purpose);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  // `names` in the notation of CLI11: "-w,--width"; `type` is the word for the value in --help.
  // A setter receives the value as it was typed; its exceptions leave parse().
  void option(const std::string& names, const std::string& type, const std::string& help, Set);
  void flag(const std::string& names, const std::string& help, std::function<void()> set);
  /// An option that may be repeated; its setter receives one value after the other. A name without
  /// hyphens is that of the words that are not options: the input files.
  void list(const std::string& names, const std::string& type, const std::string& help, Set);

  enum class Asked { work, help, version };
  /// Throws Error for unknown options and for values that are missing or too many.
  Asked parse(int argc, const char* const* argv);

  /// True if the option with this long name was on the command line that was parsed.
  bool given(std::string_view option) const;

  /// The text of --help for a program of this name; cmd/install/completion.awk reads it.
  std::string help(const std::string& name) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace rolling
