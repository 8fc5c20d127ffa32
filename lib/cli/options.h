// SPDX-License-Identifier: GPL-3.0-or-later
// The options of a tool: values from the command line, else from its scene file, as CLI11 reads
// them.
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
#include <vector>

#include "base/enumeration.h"
#include "base/error.h"
#include "base/estimate.h"
#include "contact/body.h"
#include "contact/law.h"
#include "text/column.h"
#include "text/number.h"

namespace CLI {
class App;  // only options.cpp includes CLI11, which needs several seconds to compile
}

namespace rolling {

/// The values that a numeric option accepts.
struct Domain {
  const char* text;  ///< in the message "must be ...": "greater than 0"
  bool (*holds)(double);
  /// A radius above it is hardly meant in metres.
  double doubted = std::numeric_limits<double>::infinity();
};
inline constexpr Domain any_number{"a number", [](double) { return true; }};
inline constexpr Domain positive{"greater than 0", [](double x) { return x > 0; }};
inline constexpr Domain radius_in_metres{positive.text, positive.holds, 1};
inline constexpr Domain not_negative{"0 or more", [](double x) { return x >= 0; }};
inline constexpr Domain whole{"a whole number from 1 to 1e9", [](double x) {
                                return x >= 1 && x <= 1e9 &&
                                       x == static_cast<double>(static_cast<std::int64_t>(x));
                              }};

inline constexpr Domain odd{"an odd whole number from 1 to 1e9", [](double x) {
                              return whole.holds(x) && static_cast<std::int64_t>(x) % 2 == 1;
                            }};

/// The order of the polynomial of SavitzkyGolay.
inline constexpr Domain polynomial{"a whole number from 1 to 10",
                                   [](double x) { return whole.holds(x) && x <= 10; }};

/// The number in a text. Throws Error for another text and for a number outside the domain.
double to_number(const std::string& text, const Domain&);

inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// The options that describe a body; see Options::body().
enum class BodyOption { mass, radius, shape_factor, gravity, slope };

class Options {
 public:
  /// Receives the value of an option as it was typed.
  using Set = std::function<void(const std::string&)>;

  Options(const std::string& name, const std::string& purpose);
  ~Options();
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;

  // Options of one tool. `names` in the notation of CLI11: "-w,--width". Each option may be given
  // once. Its value must be a number in the syntax of rolling-columns(5) and within the domain.
  void flag(const std::string& names, bool& value, const std::string& help);
  /// With `sigma` the number may have an uncertainty (0.5+-0.005).
  void number(const std::string& names, double& value, const Domain&, const std::string& help,
              double* sigma = nullptr);
  template <typename Integer>
  void count(const std::string& names, Integer& value, const Domain& domain,
             const std::string& help) {
    add(names, "N", help, [&value, domain](const std::string& text) {
      value = static_cast<Integer>(to_number(text, domain));
    });
  }
  /// One number or several, separated by commas; each may have an uncertainty: 0.5+-0.005,0.83
  void numbers(const std::string& names, std::vector<Estimate>& values, const Domain&,
               const std::string& help);
  void text(const std::string& names, std::string& value, const std::string& type,
            const std::string& help);
  template <typename T>
  void choice(const std::string& names, T& value, const std::map<std::string, T>& choices,
              const std::string& help);

  enum class Values { none, one, many };
  /// An option of any kind. One with many values may be repeated, and `set` receives one after the
  /// other; without a value it receives `true`. A name without hyphens is that of the words that
  /// are not options: the input files. Errors of `set` need not name the option.
  void add(const std::string& names, const std::string& type, const std::string& help, Set set,
           Values values = Values::one);

  // Options that tools share.
  /// The named ones of -m -R -K -g --slope. Before they are read, Body has not_given, 9.81 for g,
  /// and 0 for the slope. R, K, g and the slope may have an uncertainty (0.5+-0.005), which is
  /// stored in `uncertainty`, or ignored if that is null.
  void body(Body&, std::initializer_list<BodyOption>, BodyUncertainty* uncertainty = nullptr);
  void law(PowerLaw&);       ///< -a -b
  void geometry(Geometry&);  ///< --exact
  void scene();              ///< --scene, whose keys are listed in options.cpp

  /// Throws one Error that lists those of these options (long names) which have a value neither on
  /// the command line nor in the scene.
  void need(const std::vector<std::string>& options) const;
  /// Throws an OptionError, "--NAME why", for the first of these options (long names) that is on
  /// the command line. For options without effect beside the other ones.
  void refuse(std::initializer_list<const char*> options, std::string_view why) const;
  /// True if the option with this long name has a value from the command line or from the scene.
  bool given(const std::string& option) const;
  /// True if it is on the command line.
  bool on_command_line(const std::string& option) const {
    return given(option) && !in_scene_.contains(option);
  }

 protected:
  /// Returns what a program of this name prints for --help or --version, if one is given; else an
  /// empty text. Throws Error for unknown options and for values that are missing, too many or
  /// wrong.
  std::string parse(const std::string& name, int argc, const char* const* argv);
  /// Sets the options that are not on the command line from the scene file; ignores keys without
  /// an option in this tool. True if the scene was standard input.
  bool take_scene();

  std::set<std::string> doubts_;  ///< what to ask about values that are hardly meant

 private:
  Estimate to_estimate(const std::string& text, const Domain&);
  /// The text of --help; cmd/install/completion.awk reads it.
  std::string help(const std::string& name) const;

  std::unique_ptr<CLI::App> app_;
  std::set<std::string> in_scene_;  // the keys of the scene that are options of this tool
  std::string scene_file_;
  BodyUncertainty ignored_;
};

template <typename T>
void Options::choice(const std::string& names, T& value, const std::map<std::string, T>& choices,
                     const std::string& help) {
  std::string all;
  for (const auto& choice : choices) add_item(all, choice.first, ",");
  add(names, '{' + all + '}', help, [&value, choices, all](const std::string& text) {
    const auto found = choices.find(text);
    if (found == choices.end())
      fail("'{}' is not one of {}", shown(text), replace_all(all, ",", ", "));
    value = found->second;
  });
}

}  // namespace rolling
