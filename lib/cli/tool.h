// What every command shares: options, the scene file, input and output, messages, exit status.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/estimate.h"
#include "cli/command_line.h"
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

/// The options that describe a body; see Tool::body().
enum class BodyOption { mass, radius, shape_factor, gravity, slope };

class Tool {
 public:
  Tool(std::string name, const std::string& purpose);

  // Options of one tool. `names` as CLI11 writes them: "-w,--width". Each may be given once; the
  // value must be a number of rolling-columns(5), whole, within the range.
  void flag(const std::string& names, bool& value, const std::string& help);
  void number(const std::string& names, double& value, const Range&, const std::string& help);
  void count(const std::string& names, std::size_t& value, const Range&, const std::string& help);
  /// One or several with commas between them, each perhaps with an uncertainty: 0.5+-0.005,0.83
  void numbers(const std::string& names, std::vector<Estimate>& values, const Range&,
               const std::string& help);
  void text(const std::string& names, std::string& value, const std::string& type,
            const std::string& help);
  void list(const std::string& names, std::vector<std::string>& values, const std::string& type,
            const std::string& help);  ///< may be repeated
  template <typename T>
  void choice(const std::string& names, T& value, const std::map<std::string, T>& choices,
              const std::string& help);

  // Options that tools share.
  /// Those of -m -R -K -g --slope that are named. Body holds not_given, 9.81 for g, and 0 for the
  /// slope until they are read. R, K, g and the slope may carry an uncertainty (0.5+-0.005): it
  /// goes to `uncertainty`, and nowhere without one.
  void body(Body&, std::initializer_list<BodyOption>, BodyUncertainty* uncertainty = nullptr);
  void law(PowerLaw&);       ///< -a -b
  void geometry(Geometry&);  ///< --exact
  void scene();              ///< --scene, for the options above and others that scene.cpp names
  void input();              ///< operands, --use --run --strict
  void output();             ///< --digits -u

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

  /// A check that was asked for does not hold: run() says the first such line, and how many
  /// followed, and returns 1, once work has returned. Where work is refused, the refusal is the
  /// only line.
  void check_failed(const std::string& text);

  /// Throws one Error for all of these options (long names of number(), numbers(), body() and
  /// law()) that still have no value: neither the command line nor the scene gives one.
  void need(const std::vector<std::string>& options) const;
  /// Whether an option, by its long name, was given on the command line itself.
  bool on_command_line(std::string_view option) const { return command_line_.given(option); }

  Output out;
  Progress progress;  ///< of work that takes its time; Readers tell it themselves

 private:
  using Set = CommandLine::Set;
  struct Option {
    Set set;                        // from text; its errors do not name the option
    std::function<bool()> missing;  // empty where need() has nothing to say
  };

  void add(const std::string& names, const std::string& type, const std::string& help, Set,
           std::function<bool()> missing = {});
  void add_flag(const std::string& names, const std::string& help,
                const std::function<void(bool)>& set);
  void estimate(const std::string& names, double& value, double* sigma, const Range&,
                const std::string& help);
  void one_of(const std::string& names, const std::vector<std::string>& choices,
              const std::string& help, const Set& set);
  Reader& open(ReaderOptions, std::vector<std::string> order);
  void take_scene();
  void handle_signals();
  int finish(int status);
  int print(const std::string& text);

  std::string name_, error_line_;
  CommandLine command_line_;
  std::map<std::string, Option> options_;  // by long name
  ReaderOptions input_;
  std::string scene_file_;
  bool quiet_ = false;
  bool standard_input_taken_ = false;  // by a Reader: there is no more of it for another
  std::string failed_check_;
  std::size_t failed_checks_ = 0;
  std::vector<std::unique_ptr<Reader>> readers_;
};

template <typename T>
void Tool::choice(const std::string& names, T& value, const std::map<std::string, T>& choices,
                  const std::string& help) {
  std::vector<std::string> all;
  for (const auto& choice : choices) all.push_back(choice.first);
  one_of(names, all, help,
         [&value, choices](const std::string& text) { value = choices.at(text); });
}

}  // namespace rolling
