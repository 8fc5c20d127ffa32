// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/tool.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/edit_distance.h"
#include "base/enumeration.h"
#include "base/version.h"
#include "fit/input.h"
#include "text/lines.h"

namespace rolling {

/// The options of the body. Their long names are keys of a scene.
struct BodyOption {
  const char* names;
  double Body::*value;
  double Body::*sigma;
  Domain domain;
  const char* help;
  double least;  ///< that bodies have
  double most;
  const char* doubt;  ///< what a value beyond them may mean
  double unit = 1;    ///< the other unit that it may be in
};
static constexpr BodyOption body_options[] = {
    {"-m,--mass", &Body::m, nullptr, positive, "mass m [kg]", 0, INFINITY, ""},
    {"-R,--radius", &Body::R, &Body::sigma_R, positive, "radius R [m]", 0, 1,
     "R = {} m: write {:.6g} if that is millimetres, {:.6g} if centimetres", 1e-3},
    {"-K,--shape-factor", &Body::K, &Body::sigma_K, not_negative, "shape factor K of J = K m R^2",
     0, 1, "K = {}: a cart has about 0, a ball 0.4, a solid cylinder 0.5, a tube 1"},
    {"-g,--gravity", &Body::g, &Body::sigma_g, positive, "gravity g [m/s^2] (9.81)", 1, 30,
     "g = {} m/s^2: on the earth it is 9.81 m/s^2, on the moon 1.62 m/s^2"},
    {"--slope", &Body::slope, &Body::sigma_slope, any_number,
     "slope tan(theta) of the mat, above 0 if x grows uphill (0)", -0.8, 0.8,
     "slope = {}: if that is per cent, write {:.6g}", 1e-2},
    {"--wind", &Body::wind, nullptr, any_number,
     "speed of the air towards falling x [m/s] (0): d2 v^2 becomes d2 (v + W)|v + W|", -30, 30,
     "wind = {} m/s: if that is km/h, write {:.3g}", 1 / 3.6}};

namespace {

constexpr std::size_t help_column = 30;

/// The keys of a scene. A tool ignores those that it does not need.
constexpr std::string_view keys[] = {"mass",  "radius",      "shape-factor", "gravity",
                                     "slope", "coefficient", "exponent",     "exact",
                                     "v0",    "x0",          "memory",       "damping"};

/// The value of a key, without a comment behind it: a number, true or false, or what stands in
/// quotes. Nothing for any other text: an array, a date, or a quote that is not closed.
std::optional<std::string_view> read_value(std::string_view text) {
  if (text.starts_with('"') || text.starts_with('\'')) {
    const auto close = text.find(text.front(), 1);
    if (close == std::string_view::npos) return {};
    const std::string_view behind = trim(text.substr(close + 1));
    if (!behind.empty() && behind.front() != '#') return {};
    return text.substr(1, close - 1);
  }
  const std::string_view value = trim(text.substr(0, text.find('#')));
  if (!is_number(value) && value != "true" && value != "false") return {};
  return value;
}

/// CLI11 takes an operand in brackets for a list of operands. This mark in front of an argument,
/// which no argument contains, makes it one word.
constexpr char one_word = '\0';

std::string without_mark(const std::string& argument) {
  return argument.substr(argument.starts_with(one_word) ? 1 : 0);
}

/// "mass" of "-m,--mass".
std::string long_name(std::string_view names) {
  return std::string(names.substr(names.find("--") + 2));
}

/// What CLI11 says of an option without a value, or with too many: `--width: 1 required N missing`.
std::string in_our_words(const CLI::App& app, std::string_view said) {
  const std::string name(said.substr(std::min(said.find_first_not_of('-'), said.size())));
  std::string option = "--" + name.substr(0, name.find_first_of(": "));
  const CLI::Option* const known = app.get_option_no_throw(option);
  if (known) option = known->get_name(false, true);  // -K,--shape-factor
  if (said.find("override") != std::string_view::npos) return option + " takes no value";
  if (said.find("At Most") != std::string_view::npos) return option + " is given twice";
  return option + " needs a value";
}

/// An explanation in lines that fit beside the names of the options.
std::string wrapped(std::string words) {
  constexpr std::size_t width = 79 - help_column;
  for (std::size_t begin = 0; begin + width < words.size();) {
    const std::size_t blank = words.rfind(' ', begin + width);
    words[blank] = '\n';
    begin = blank + 1;
  }
  return words;
}

/// Numbers with commas between them; each may have an uncertainty: 0.5+-0.005,0.83. Beside a
/// decimal point no comma is a decimal one.
std::vector<Estimate> to_numbers(const std::string& text, const Domain& domain) {
  const auto parts = split_names(text, ',');
  const auto both_whole = [](const auto& a, const auto& b) { return is_whole(a) && is_whole(b); };
  const bool has_point = text.find('.') < text.size();
  if (!has_point && std::ranges::adjacent_find(parts, both_whole) != parts.end())
    fail(
        "'{}' can be read in two ways: if its comma is a decimal one, make it a point; else "
        "write whole numbers with one, as 1.0,2.0",
        shown(text));
  std::vector<Estimate> values;
  for (const std::string& part : parts) {
    Estimate& one = values.emplace_back();
    one.value = to_number(part, domain, &one.sigma);
  }
  return values;
}

}  // namespace

double to_number(const std::string& text, const Domain& domain, double* sigma) {
  Estimate read;
  if (!(sigma ? parse_estimate(text, read) : parse_number(text, read.value)))
    fail("'{}' is not a number ({})", shown(text),
         text.find('%') < text.size() ? "5 % is 0.05" : "decimal point, no unit");
  if (!domain.holds(read.value)) fail("'{}' must be {}", shown(text), domain.text);
  if (sigma) *sigma = read.sigma;
  return read.value;
}

std::size_t value_of_run(std::string_view option, std::size_t values, std::size_t i,
                         std::size_t runs) {
  if (values == 1) return 0;
  if (values != runs)
    fail<OptionError>(
        "{} gives {} values for {}: give one for all, or one for each in the order of the runs, "
        "with decimal points",
        option, values, counted(runs, "run"));
  return i;
}

Tool::Tool(std::string name, const std::string& purpose)
    : name_(std::move(name)), app_(new CLI::App(purpose, name_)) {
  app_->get_formatter()->column_width(help_column);
  app_->set_help_flag("-h,--help", "print this and exit")->disable_flag_override();
  app_->set_version_flag("--version", "", "print the version and exit")->disable_flag_override();
  flag("-q,--quiet", quiet_, "print no warnings or counts on standard error");
}

Tool::~Tool() = default;

void Tool::add(const std::string& names, const std::string& type, const std::string& help, Set set,
               Values values) {
  const CLI::callback_t take =
      [names, set = std::move(set)](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) try {
        set(without_mark(text));
      } catch (const Error& error) {
        if (text.starts_with('='))
          fail("{0} takes its value without =: {0} {1}", names.substr(0, 2), shown(text.substr(1)));
        fail("{}: {}", names, error.what());
      }
    return true;
  };
  app_->add_option(names, take, wrapped(help))
      ->type_name(type)
      ->expected(values == Values::many ? CLI::detail::expected_max_vector_size
                                        : static_cast<int>(values))
      ->allow_extra_args(!names.starts_with('-'))
      ->disable_flag_override();
}

void Tool::text(const std::string& names, std::string& value, const std::string& type,
                const std::string& help) {
  add(names, type, help, [&value](const std::string& text) {
    if (text.empty()) fail("'' is no value");
    value = text;
  });
}

void Tool::set(Body& body, const BodyOption& of, const Estimate& x) {
  body.*of.value = x.value;
  if (of.sigma) body.*of.sigma = x.sigma;
  last_body_.*of.value = x.value;
  if (!(x.value >= of.least && x.value <= of.most))
    doubts_.push_back(
        fmt::format(fmt::runtime(of.doubt), x.value, x.value * of.unit, x.value * 10 * of.unit));
}

void Tool::body(Body& body, std::initializer_list<double Body::*> numbers) {
  body = {not_given, not_given, not_given};
  for (const BodyOption& of : body_options)
    if (std::ranges::find(numbers, of.value) != numbers.end())
      add(of.names, "NUMBER", of.help, [this, &of, &body](const std::string& text) {
        Estimate x;
        x.value = to_number(text, of.domain, of.sigma ? &x.sigma : nullptr);
        set(body, of, x);
      });
}

void Tool::bodies(std::vector<Body>& bodies, std::string& list,
                  std::initializer_list<double Body::*> numbers, FitOptions* options) {
  bodies = {{not_given, not_given, not_given}};
  for (const BodyOption& of : body_options) {
    if (std::ranges::find(numbers, of.value) == numbers.end()) continue;
    const auto fitted = std::ranges::find(scene_numbers, of.value, &SceneNumber::value);
    const bool may_be_fitted = options && fitted != scene_numbers.end();
    const auto take = [=, this, &of, &bodies, &list](const std::string& text) {
      if (may_be_fitted) options->*fitted->is_fitted = text == "fit";
      if (may_be_fitted && text == "fit") return;
      if (may_be_fitted && text.starts_with('f'))
        fail("'{}' is no number, and not 'fit'", shown(text));
      const std::vector<Estimate> values = to_numbers(text, of.domain);
      if (bodies.size() == 1) bodies.resize(values.size(), bodies.front());
      if (values.size() > 1) list = "--" + long_name(of.names);
      for (std::size_t i = 0; i < bodies.size(); ++i)
        set(bodies[i], of, values[value_of_run(list, values.size(), i, bodies.size())]);
    };
    add(of.names, may_be_fitted ? "NUMBER,...|fit" : "NUMBER,...",
        fmt::format("{}; one, or one for each run{}", of.help,
                    may_be_fitted ? "; fit: find one for all runs" : ""),
        take);
  }
}

void Tool::doubt_body() {
  const double R = last_body_.R;
  const double K = last_body_.K;
  if (K > 0 && K < 0.1 && (R == 0.4 || R == 0.5))
    warn(fmt::format("K = {} and R = {} m: if they are swapped, write -K {} -R {}", K, R, R, K));
  for (const std::string& doubt : doubts_) object("", doubt);
}

void Tool::scene() {
  text("--scene", scene_file_, "FILE",
       "TOML file with options by their long names; the command line wins");
}

bool Tool::given(double Body::*number) const {
  return std::ranges::any_of(body_options, [&](const BodyOption& option) {
    return option.value == number && given(long_name(option.names));
  });
}

namespace {

/// What to do about a word that is no option: the option that is meant, if the word is its
/// beginning or hardly another one; capital letters, underscores and dashes in front do not count.
std::string way_to_option(const CLI::App& app, const std::string& word) {
  if (word.ends_with(".toml")) return "a scene is given by --scene";
  const auto plain = [](std::string name) {
    name.erase(0, name.find_first_not_of('-'));
    for (char& c : name) c = c == '_' ? '-' : static_cast<char>(std::tolower(c));
    return name;
  };
  const std::string name = plain(word.substr(0, word.find('=')));
  std::string meant;
  std::size_t least = 3;
  const auto compare = [&](const std::string& option) {
    const std::string known = plain(option);
    const bool is_cut_off = name.size() > 2 && known.starts_with(name);
    const std::size_t changes = is_cut_off ? 0 : edit_distance(name, known);
    if (changes >= std::min(least, known.size())) return;
    least = changes;
    meant = option;
  };
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& known : option->get_snames()) compare("-" + known);
    for (const std::string& known : option->get_lnames()) compare("--" + known);
  }
  for (const BodyOption& of : body_options)
    for (const std::string& unused : split_names(of.names, ','))
      if (least > 0 && name == plain(unused)) return unused + " is not needed here";
  return meant.empty() ? "see --help" : "do you mean " + meant + "?";
}

}  // namespace

std::string Tool::parse(int argc, const char* const* argv) {
  std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  for (std::string& argument : arguments)
    if (argument.starts_with('[')) argument.insert(argument.begin(), one_word);
  for (const std::string& argument : arguments) {
    if (argument == "--") break;  // files follow
    if (argument.starts_with('-') && argument.size() > 2 &&
        app_->get_option_no_throw("-" + argument))
      fail("{}: write -{}", argument, argument);  // -coast would be -c oast
  }
  std::ranges::reverse(arguments);  // as CLI11 wants them
  try {
    app_->parse(std::move(arguments));
    return {};
  } catch (const CLI::CallForHelp&) {
    app_->name(name_)->footer("In full: man " + name_ + ". A tutorial: man rolling.");
    return app_->help();
  } catch (const CLI::CallForVersion&) {
    return fmt::format("{} (rolling) {} (GSL {})\n", name_, version(), version_of_gsl());
  } catch (const CLI::ExtrasError&) {
    const std::string word = without_mark(app_->remaining().front());
    fail("no such option or operand: {} ({})", shown(word), way_to_option(*app_, word));
  } catch (const CLI::ParseError& error) {
    fail("{} (see --help)", in_our_words(*app_, error.what()));
  }
}

std::string Tool::fixed_values() const {
  std::string values;
  for (const std::string name : {"--fix", "--slope"}) {
    const CLI::Option* const option = app_->get_option_no_throw(name);
    if (!option || in_scene_.contains(name.substr(2))) continue;
    for (const std::string& value : option->results())
      if (value != "fit") add_item(values, fmt::format("{} {}", name, shown(value)));
  }
  return values;
}

// A scene is TOML of a flat kind, and is read here: what CLI11 makes of other TOML differs from
// version to version.
bool Tool::take_scene() {
  if (scene_file_.empty()) return false;
  Lines lines(scene_file_);
  lines.separate_by('\0');
  while (lines.next()) try {
      const std::string_view text = trim(lines.text());
      if (text.empty() || text.front() == '#') continue;
      const auto equals = std::min(text.find('='), text.size() - 1);
      const auto value = read_value(trim(text.substr(equals + 1)));
      if (!value)
        fail(
            "'{}' is not KEY = VALUE with a number (decimal point, no unit), true, false, or a "
            "text in quotes",
            shown(text));
      const std::string key(trim(text.substr(0, equals)));
      if (std::ranges::count(keys, key) == 0)
        fail("a scene has no '{}'; it has mass, radius, shape-factor, ...", shown(key));
      CLI::Option* const option = app_->get_option_no_throw("--" + key);
      if (!option || on_command_line(key)) continue;
      if (!in_scene_.insert(key).second) fail("{} is there twice", key);
      option->add_result(std::string(*value));
      option->run_callback();
    } catch (const Error& error) {
      fail("{}:{}: {}", scene_file_, lines.number(), error.what());
    }
  return scene_file_ == "-";
}

bool Tool::has(const std::string& option) const {
  return app_->get_option_no_throw("--" + option) != nullptr;
}

void Tool::refuse_misplaced(const std::string& file) const {
  if (file.ends_with(".toml")) fail<OptionError>("{0} is a scene: write --scene {0}", shown(file));
  if (::access(file.c_str(), F_OK) == 0) return;
  for (const std::string_view dash : {"\u2013", "\u2014", "\u2212"})
    if (file.starts_with(dash))
      fail<OptionError>("a dash of a text program stands before '{0}': write -{0}",
                        shown(file.substr(dash.size())));
  const auto equals = file.find('=');
  if (equals == std::string::npos || equals == 0) return;
  const std::string name = (equals == 1 ? "-" : "--") + file.substr(0, equals);
  if (app_->get_option_no_throw(name))
    fail<OptionError>("'{}' is no file; write {} {}", shown(file), name,
                      shown(file.substr(equals + 1)));
}

bool Tool::given(const std::string& option) const {
  return app_->get_option("--" + option)->count() > 0;
}

void Tool::need(const std::vector<std::string>& options) const {
  const std::map<std::string, std::string> hints{
      {"radius", " (-R, in metres)"}, {"shape-factor", " (-K, 0.5 for a solid cylinder)"}};
  std::vector<std::string> missing;
  for (const std::string& option : options)
    if (!given(option))
      missing.push_back("--" + option + (hints.contains(option) ? hints.at(option) : ""));
  if (!missing.empty()) fail<OptionError>("neither given nor in a scene: {}", enumeration(missing));
}

void Tool::refuse(std::initializer_list<const char*> options, std::string_view why) const {
  for (const char* option : options)
    if (on_command_line(option)) fail<OptionError>("--{} {}", option, why);
}

}  // namespace rolling
