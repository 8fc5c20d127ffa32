// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/command_line.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <list>
#include <utility>

#include "base/error.h"
#include "text/number.h"

namespace rolling {
namespace {

constexpr std::size_t page_width = 79, help_column = 30;

/// CLI11 reads `[a,g]` as a list of two values. To prevent that, this mark is put before a word
/// that begins with a bracket (or with the mark) and is removed behind CLI11.
constexpr char mark = '\x01';

std::string marked(const char* word) {
  return *word == '[' || *word == mark ? mark + std::string(word) : word;
}

std::string unmarked(const std::string& word) {
  return !word.empty() && word.front() == mark ? word.substr(1) : word;
}

/// Appends the line of an option or operand, with its explanation from help_column on, wrapped.
void append_item(std::string& page, const std::string& names, std::string_view words) {
  std::string line = "  " + names;
  if (line.size() + 2 > help_column) {
    page += line + '\n';
    line.clear();
  }
  line.resize(help_column, ' ');
  while (line.size() + words.size() > page_width) {
    const std::size_t blank = words.rfind(' ', page_width - line.size());
    (page += line) += words.substr(0, blank);
    page += '\n';
    line.assign(help_column, ' ');
    words.remove_prefix(blank + 1);
  }
  ((page += line) += words) += '\n';
}

bool may_repeat(const CLI::Option& option) { return option.get_items_expected_max() > 1; }

/// `-w,--width N`, with ` ...` behind where the option may be repeated.
std::string synopsis(const CLI::Option& option) {
  std::string text;
  for (const std::string& name : option.get_snames()) text += '-' + name + ',';
  text += "--" + option.get_lnames().front();
  if (option.get_type_size() == 0) return text;
  text += ' ' + option.get_type_name();
  if (may_repeat(option)) text += " ...";
  return text;
}

/// What is wrong with the number of values of an option. CLI11's message begins with its long name,
/// that of a flag without hyphens.
std::string wrong_count(const CLI::App& app, const std::string& message) {
  const auto begin = message.find_first_not_of('-');
  const std::string name = "--" + message.substr(begin, message.find_first_of(": ", begin) - begin);
  const CLI::Option* const option = app.get_option_no_throw(name);
  if (!option) return shown(message) + " ";
  if (option->count() > 1 && !may_repeat(*option)) return name + " is given more than once ";
  if (option->get_items_expected_max() == 0) return name + " takes no value ";
  return name + " needs a value, " + option->get_type_name() + ' ';
}

}  // namespace

struct CommandLine::Parser {
  CLI::App app;
  /// The setters of lists are called after parsing.
  std::list<std::pair<const CLI::Option*, Set>> lists;
  std::vector<std::string> unused;  ///< the values that CLI11 writes itself still have the mark
};

CommandLine::CommandLine(const std::string& name, const std::string& purpose)
    : parser_(new Parser{CLI::App(purpose, name), {}, {}}) {
  CLI::App& app = parser_->app;
  app.set_help_flag("-h,--help", "print this and exit")->disable_flag_override();
  app.set_version_flag("--version", "", "print the version and exit")->disable_flag_override();
}

CommandLine::~CommandLine() = default;

void CommandLine::option(const std::string& names, const std::string& type, const std::string& help,
                         Set set) {
  parser_->app
      .add_option_function<std::string>(
          names, [set = std::move(set)](const std::string& text) { set(unmarked(text)); }, help)
      ->type_name(type);
}

void CommandLine::flag(const std::string& names, const std::string& help,
                       std::function<void()> set) {
  parser_->app
      .add_flag_function(
          names, [set = std::move(set)](std::int64_t) { set(); }, help)
      ->multi_option_policy(CLI::MultiOptionPolicy::Throw)
      ->disable_flag_override();
}

void CommandLine::list(const std::string& names, const std::string& type, const std::string& help,
                       Set set) {
  CLI::Option* option = parser_->app.add_option(names, parser_->unused, help)->type_name(type);
  if (option->nonpositional()) option->allow_extra_args(false);
  parser_->lists.emplace_back(option, std::move(set));
}

CommandLine::Asked CommandLine::parse(int argc, const char* const* argv) {
  std::vector<std::string> words;  // from the last to the first, as CLI11 takes them
  for (int i = argc - 1; i > 0; --i) words.push_back(marked(argv[i]));
  try {
    parser_->app.parse(std::move(words));
  } catch (const CLI::CallForHelp&) {
    return Asked::help;
  } catch (const CLI::CallForVersion&) {
    return Asked::version;
  } catch (const CLI::ArgumentMismatch& error) {
    fail("{}(see --help)", wrong_count(parser_->app, error.what()));
  } catch (const CLI::ExtrasError&) {
    for (const std::string& word : parser_->app.remaining())
      if (word.starts_with('-')) fail("there is no option {} (see --help)", shown(unmarked(word)));
    fail("there are no operands (see --help)");
  } catch (const CLI::ParseError& error) {
    fail("{} (see --help)", shown(error.what()));
  }
  for (const auto& [option, set] : parser_->lists)
    for (const std::string& word : option->results()) set(unmarked(word));
  return Asked::work;
}

bool CommandLine::given(std::string_view option) const {
  return parser_->app.get_option("--" + std::string(option))->count() > 0;
}

std::string CommandLine::help(const std::string& name) const {
  const CLI::App& app = parser_->app;
  std::string operands = "\n", options = "\nOptions:\n";
  for (const CLI::Option* option : app.get_options()) {
    if (option->nonpositional()) append_item(options, synopsis(*option), option->get_description());
    else append_item(operands, option->get_name() + "...", option->get_description());
  }
  const bool reads = operands.size() > 1;
  return "Usage: " + name + " [OPTION...]" + (reads ? " [FILE...]" : "") + "\n" +
         app.get_description() + '\n' + (reads ? operands : "") + options + "\nIn full: man " +
         name + ". A tutorial: man rolling.\n";
}

}  // namespace rolling
