// SPDX-License-Identifier: GPL-3.0-or-later
// The frame of every command: its options, whose values come from the command line, else from a
// scene file; input and output, messages, exit status.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/enumeration.h"
#include "base/error.h"
#include "base/estimate.h"
#include "contact/body.h"
#include "text/number.h"
#include "text/output.h"
#include "text/reader.h"

namespace CLI {
class App;  // only tool_options.cpp includes CLI11, which needs several seconds to compile
}

namespace rolling {

struct BodyOption;
struct FitOptions;

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
    std::string text;   ///< of the first run
    std::string alike;  ///< the same without numbers
    std::vector<std::string> runs;
  };
  std::vector<Line> lines_;
};

/// The values that a numeric option accepts.
struct Domain {
  const char* text;  ///< in the message "must be ...": "greater than 0"
  bool (*holds)(double);
};
inline constexpr Domain any_number{"a number", [](double) { return true; }};
inline constexpr Domain positive{"greater than 0", [](double x) { return x > 0; }};
inline constexpr Domain not_negative{"0 or more", [](double x) { return x >= 0; }};
inline constexpr Domain whole{"a whole number from 1 to 1e9", [](double x) {
                                return x >= 1 && x <= 1e9 &&
                                       x == static_cast<double>(static_cast<std::int64_t>(x));
                              }};

/// The number in a text; with `sigma` it may have an uncertainty (0.5+-0.005). Throws Error for
/// another text and for a number outside the domain.
double to_number(const std::string& text, const Domain&, double* sigma = nullptr);

/// The index of the value for run i of so many: there is one for all, or one for each.
std::size_t value_of_run(std::string_view option, std::size_t values, std::size_t i,
                         std::size_t runs);

inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

class Tool {
 public:
  /// Receives the value of an option as it was typed.
  using Set = std::function<void(const std::string&)>;

  Tool(std::string name, const std::string& purpose);
  ~Tool();
  Tool(const Tool&) = delete;
  Tool& operator=(const Tool&) = delete;

  // Options of one tool. `names` in the notation of CLI11: "-w,--width". Each option may be given
  // once. Its value must be a number in the syntax of rolling-columns(5) and within the domain.
  void flag(const std::string& names, bool& value, const std::string& help) {
    choice<bool>(names, value, {{"false", false}, {"true", true}}, help, Values::none);
  }
  template <typename Number>
  void number(const std::string& names, Number& value, const Domain& domain,
              const std::string& help) {
    add(names, std::is_integral_v<Number> ? "N" : "NUMBER", help,
        [&value, domain](const auto& text) {
      value = static_cast<Number>(to_number(text, domain));
    });
  }
  void text(const std::string& names, std::string& value, const std::string& type,
            const std::string& help);
  enum class Values { none, one, many };
  /// Without a value the option chooses `true`.
  template <typename T>
  void choice(const std::string& names, T& value, const std::map<std::string, T>& choices,
              const std::string& help, Values values = Values::one) {
    std::string all;
    for (const auto& choice : choices) add_item(all, choice.first);
    const auto set = [&value, choices, all](const std::string& text) {
      const auto found = choices.find(text);
      if (found == choices.end()) fail("'{}' is not one of {}", shown(text), all);
      value = found->second;
    };
    const std::string type = '{' + replace_all(all, {{", ", ","}}) + '}';
    add(names, values == Values::none ? "" : type, help, set, values);
  }

  /// An option of any kind. One with many values may be repeated, and `set` receives one after the
  /// other; without a value it receives `true`. A name without hyphens is that of the words that
  /// are not options: the input files. Errors of `set` need not name the option.
  void add(const std::string& names, const std::string& type, const std::string& help, Set set,
           Values values = Values::one);

  // Options that tools share.
  /// -m -R -K -g --slope --wind, as far as these numbers are named. Before they are read, Body has
  /// not_given, 9.81 for g, and 0 for the slope and the wind. R, K, g and the slope may have an
  /// uncertainty (0.5+-0.005).
  void body(Body&, std::initializer_list<double Body::*>);
  /// The same for runs: each option has one number, or one for each run, and there are then so many
  /// bodies, and `list` is the option that has them. With FitOptions the slope and the wind may be
  /// `fit`.
  void bodies(std::vector<Body>&, std::string& list, std::initializer_list<double Body::*>,
              FitOptions* = nullptr);
  void geometry(bool& exact) {
    flag("--exact", exact, "exact geometry: A = sqrt(1 - D^2/R^2), instead of 1");
  }
  void scene();        ///< --scene, whose keys are listed in tool_options.cpp
  void input();        ///< operands, --use --run --strict
  void equal_times();  ///< --equal-times
  void accept();       ///< --accept
  /// Whether --use says which column this quantity is.
  bool uses(const std::string& quantity) const;
  void output();  ///< --digits --plain -u

  /// Throws one Error that lists those of these options (long names) which have a value neither on
  /// the command line nor in the scene.
  void need(const std::vector<std::string>& options) const;
  /// Throws an OptionError, "--NAME why", for the first of these options (long names) that is on
  /// the command line. For options without effect beside the other ones.
  void refuse(std::initializer_list<const char*> options, std::string_view why) const;
  /// True if the tool has an option with this long name.
  bool has(const std::string& option) const;
  /// True if the option with this long name has a value from the command line or from the scene.
  bool given(const std::string& option) const;
  /// The same for the option of this number of the body.
  bool given(double Body::*number) const;
  /// True if it is on the command line.
  bool on_command_line(const std::string& option) const {
    return given(option) && !in_scene_.contains(option);
  }

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
  /// What an error says, and the way out of its kind, without steps that have been taken already.
  std::string told(const Error&) const;
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
  /// does not silence, and run() returns 1, unless --accept names the run.
  void object(const std::string& run, const std::string& text) { object(run, text, run); }
  /// The same of several runs, one of which is off.
  void object(const std::string& run, const std::string& text, const std::string& off) {
    if (!checks) return warn(run, text);
    if (accepted_.contains(off)) return warn(run, "accepted: " + text);
    say(run, text);
    failed_ = true;
  }

  /// There is a run of this name, which --accept may name.
  void know_run(const std::string& run) { unknown_.erase(run); }

  bool checks = false;  ///< --check
  Output out;

 private:
  /// Returns what a program of this name prints for --help or --version, if one is given; else an
  /// empty text. Throws Error for unknown options and for values that are missing, too many or
  /// wrong.
  std::string parse(int argc, const char* const* argv);
  /// Sets the options that are not on the command line from the scene file; ignores keys without
  /// an option in this tool. True if the scene was standard input.
  bool take_scene();
  void set(Body&, const BodyOption&, const Estimate&);
  void doubt_body();  ///< tells numbers that are hardly meant in these units
  std::string message_of(const Error&) const;  ///< with its place
  std::string fixed_values() const;            ///< `--fix a=2e-3, --slope 0.1`: on the command line
  /// Refuses a scene among the files of columns, and `K=0.5`, which is meant as an option, unless
  /// there is a file of that name.
  void refuse_misplaced(const std::string& file) const;
  Reader& open(ReaderOptions, std::vector<std::string> order);
  int finish(int status);

  std::string name_;
  std::string error_line_;
  ReaderOptions input_;
  bool quiet_ = false;
  bool standard_input_taken_ = false;  // a Reader reads it; a second one cannot
  bool failed_ = false;
  std::set<std::string> accepted_;  // the runs of --accept
  std::set<std::string> unknown_;   // those of them that have not been read
  LinesOfRuns waiting_;
  Body last_body_{not_given, not_given, not_given};  // of the options
  std::vector<std::string> doubts_;                  // about its numbers
  std::vector<std::unique_ptr<Reader>> readers_;
  const Reader* rows_ = nullptr;  // that of the operands
  std::unique_ptr<CLI::App> app_;
  std::set<std::string> in_scene_;  // the keys of the scene that are options of this tool
  std::string scene_file_;
};

}  // namespace rolling
