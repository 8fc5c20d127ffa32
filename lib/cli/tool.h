// What every command shares: options, the scene file, input and output, messages, exit status. The
// only room that knows CLI11.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/ranges.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "cli/progress.h"
#include "contact/body.h"
#include "contact/power_law.h"
#include "text/output.h"
#include "text/reader.h"

namespace rolling {

/// What a number on the command line may be.
struct Range {
  const char* text;  ///< as the message says it: "greater than 0"
  bool (*holds)(double);
};
inline constexpr Range any_number{"a number", [](double) { return true; }};
inline constexpr Range positive{"greater than 0", [](double x) { return x > 0; }};
inline constexpr Range not_negative{"0 or more", [](double x) { return x >= 0; }};
inline constexpr Range whole{"a whole number greater than 0", [](double x) {
                               return x >= 1 && x <= 1e9 &&
                                      x == static_cast<double>(static_cast<std::int64_t>(x));
                             }};

inline constexpr Range odd{"an odd whole number", [](double x) {
                             return whole.holds(x) && static_cast<std::int64_t>(x) % 2 == 1;
                           }};

inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

class Tool {
 public:
  Tool(std::string name, const std::string& purpose);

  // Options of one tool. `names` as CLI11 writes them: "-w,--width". Each may be given once; the
  // value must be a number of rolling-columns(5), whole, within the range.
  void flag(const std::string& names, bool& value, const std::string& help);
  void number(const std::string& names, double& value, const Range&, const std::string& help);
  void count(const std::string& names, std::size_t& value, const Range&, const std::string& help);
  void numbers(const std::string& names, std::vector<double>& values, const Range&,
               const std::string& help);  ///< 0.5,0.83
  void text(const std::string& names, std::string& value, const std::string& type,
            const std::string& help);
  void list(const std::string& names, std::vector<std::string>& values, const std::string& type,
            const std::string& help);  ///< may be repeated
  template <typename T>
  void choice(const std::string& names, T& value, const std::map<std::string, T>& choices,
              const std::string& help);

  // Options that tools share.
  void body(Body&, const std::string& which = "mRKg");  ///< -m -R -K -g, those named
  void law(PowerLaw&);                                  ///< -a -b
  void geometry(Geometry&);                             ///< --exact
  void scene();   ///< --scene, for the options above and --v0 --x0
  void input();   ///< operands, --use --run --strict
  void output();  ///< --digits -u

  /// Parses the command line, runs `work`, flushes; returns the exit status: what work returns, or
  /// 2 after one line on standard error.
  int run(int argc, char** argv, const std::function<int()>& work);

  /// The records of the operands. `order` names the columns of a file without names.
  Reader& read(std::vector<std::string> order);
  /// The records of one file that an option names.
  Reader& read_file(const std::string& file, std::vector<std::string> order);

  /// One line of printable ASCII on standard error, at most 512 bytes.
  void say(const std::string& text);
  /// The same, unless -q: something that the user should know, and that is no error.
  void warn(const std::string& text) {
    if (!quiet_) say(text);
  }

  /// Says how many records were left out and why, unless -q.
  void count_left_out(std::size_t count, const std::string& why);

  /// Throw Error when a value was neither on the command line nor in the scene.
  void need(double value, const std::string& option) const;
  void need(const Body&, const std::string& which) const;
  void need(const PowerLaw&) const;
  /// An option, by its long name, that was given on the command line itself.
  bool on_command_line(const std::string& option) const {
    return app_.get_option("--" + option)->count() > 0;
  }

  Output out;
  Progress progress;  ///< of work that takes its time; Readers tell it themselves

 private:
  void add(const std::string& names, const std::string& type, const std::string& help,
           const std::function<void(const std::string&)>& set);
  void add_flag(const std::string& names, const std::string& help,
                const std::function<void(bool)>& set);
  Reader& open(ReaderOptions, std::vector<std::string> order);
  void read_scene();
  std::string help() const;
  int print(const std::string& text);

  std::string name_;
  CLI::App app_;
  ReaderOptions input_;
  std::string scene_file_;
  bool quiet_ = false;
  std::map<std::string, std::function<void(const std::string&)>> setters_;  // by long name
  std::vector<std::unique_ptr<Reader>> readers_;
};

template <typename T>
void Tool::choice(const std::string& names, T& value, const std::map<std::string, T>& choices,
                  const std::string& help) {
  std::vector<std::string> all;
  for (const auto& choice : choices) all.push_back(choice.first);
  add(names, fmt::format("{{{}}}", fmt::join(all, ",")), help,
      [&value, choices, names, all](const std::string& text) {
    const auto found = choices.find(text);
    if (found == choices.end())
      fail("{}: '{}' is not one of {}", names, shown(text), fmt::join(all, ", "));
    value = found->second;
  });
}

}  // namespace rolling
