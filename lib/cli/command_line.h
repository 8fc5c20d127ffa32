// The command line and a scene's assignments as CLI11 reads them. Only command_line.cpp includes
// CLI11, which takes several seconds to compile.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rolling {

class CommandLine {
 public:
  using Set = std::function<void(const std::string&)>;

  CommandLine(const std::string& name, const std::string& purpose);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  // `names` as CLI11 writes them: "-w,--width"; `type` is what --help calls the value. The values
  // arrive as they were typed. What a setter throws comes out of parse().
  void option(const std::string& names, const std::string& type, const std::string& help, Set);
  void flag(const std::string& names, const std::string& help, std::function<void()> set);
  /// An option that may be repeated.
  void list(const std::string& names, const std::string& type, const std::string& help,
            std::vector<std::string>& values);
  /// The words that belong to no option.
  void operands(const std::string& help, std::vector<std::string>& values);

  enum class Asked { work, help, version };
  /// Throws Error for what is no command line of these options.
  Asked parse(int argc, const char* const* argv);

  /// Whether an option, by its long name, stands on the command line that was parsed.
  bool given(std::string_view option) const;

  /// What --help prints for a program of this name; cmd/install/completion.awk reads it.
  std::string help(const std::string& name) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

/// The key and the value of a line `key = value` of a TOML file, without quotes and comment;
/// nothing where CLI11 finds anything else in it.
std::optional<std::pair<std::string, std::string>> read_assignment(const std::string& line);

}  // namespace rolling
