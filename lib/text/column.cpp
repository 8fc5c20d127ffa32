// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/column.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "text/delimiters.h"
#include "text/number.h"

namespace rolling {
namespace {

constexpr std::pair<std::string_view, std::string_view> long_names[] = {
    {"time", "t"},  {"position", "x"},     {"velocity", "v"},
    {"speed", "v"}, {"acceleration", "a"}, {"shift", "D"}};

/// Removes `Run #2` or `Run 2` from the end of a name, and `Latest:` or `Data Set 1:` from its
/// beginning; returns the number, or the word if there is no number. A colon in brackets, or behind
/// them, is none of a label: `Clock (hh:mm:ss)`.
std::string take_run(std::string_view& name) {
  const auto number_at_end = [](std::string_view text) {
    return text.substr(text.find_last_not_of(decimal_digits) + 1);
  };
  std::string_view prefix;
  if (const auto colon = name.find(':'); colon < name.find_first_of("([")) {
    prefix = trim(name.substr(0, colon));
    name = trim(name.substr(colon + 1));
  }
  const std::string_view number = number_at_end(name);
  const auto at = name.rfind("Run");
  if (!number.empty() && at != std::string_view::npos && at > 0 && name[at - 1] == ' ') {
    const std::string_view between =
        trim(name.substr(at + 3, name.size() - number.size() - (at + 3)));
    if (between.empty() || between == "#") {
      name = trim(name.substr(0, at));
      return std::string(number);
    }
  }
  return std::string(number_at_end(prefix).empty() ? prefix : number_at_end(prefix));
}

}  // namespace

std::string short_name(std::string_view name) {
  const auto found = std::ranges::find(long_names, lower(name), [](auto& of) { return of.first; });
  return std::string(found == std::end(long_names) ? name : found->second);
}

Column read_column(std::string_view text) {
  Column column;
  // Brackets of full width; and a quoted name may go over two lines.
  const std::string line = replace_all(with_plain_blanks(text),
                                       {{"\xEF\xBC\x88", "("}, {"\xEF\xBC\x89", ")"}, {"\n", " "}});
  std::string_view name = trim(line);
  column.run = take_run(name);
  const char close = name.empty() ? '\0' : name.back();
  const auto open = close == ')'   ? name.rfind('(')
                    : close == ']' ? name.rfind('[')
                                   : std::string_view::npos;
  if (open != std::string_view::npos && open > 0) {
    column.unit = plain_unit(trim(name.substr(open + 1, name.size() - open - 2)));
    name = trim(name.substr(0, open));
  }
  const auto slash = column.unit.empty() ? name.find('/') : std::string_view::npos;
  const std::string quantity = short_name(trim(name.substr(0, slash)));
  if (slash == std::string_view::npos) {
    column.name = quantity;
  } else if (const std::string below = bare_unit(trim(name.substr(slash + 1)));
             unit_of(quantity, below)) {  // t/ms
    column.name = quantity, column.unit = below;
  } else {
    column.name = name;
  }
  std::ranges::replace_if(column.name, is_blank, '_');
  return column;
}

std::string labelled_name(const Column& column) {
  std::string name = is_number(column.run) ? fmt::format("{}_Run_{}", column.name, column.run)
                                           : fmt::format("{}:{}", column.run, column.name);
  std::ranges::replace_if(name, is_blank, '_');
  return name;
}

std::string to_text(const Column& column) {
  return column.unit.empty() ? column.name : fmt::format("{}[{}]", column.name, column.unit);
}

std::string free_name(const std::vector<Column>& columns, std::string name) {
  do name += "_in";
  while (std::ranges::count(columns, name, &Column::name) > 0);
  return name;
}

bool is_known(const Column& column) { return known_quantity(column.name) != nullptr; }

std::vector<std::string> split_names(std::string_view line, char separator) {
  std::vector<std::string> names;
  constexpr std::string_view opening = "([";
  const auto last_bracket = line.find_last_of(")]") + 1;
  for (std::size_t at = 0;; at += separator != '\0') {
    while (at < line.size() && line[at] != separator && is_blank(line[at])) ++at;
    if (separator ? at > line.size() : at == line.size()) return names;
    std::string_view rest = line.substr(at);
    if (auto quoted = take_quoted(rest, separator)) {
      names.push_back(std::move(*quoted));
      at = line.size() - rest.size();
      continue;
    }
    const auto begin = at;
    for (; at < line.size() && (separator ? line[at] != separator : !is_blank(line[at])); ++at)
      if (opening.find(line[at]) != std::string_view::npos && at < last_bracket)
        at = line.find_first_of(")]", at);
    const std::string_view name = trim(line.substr(begin, at - begin));
    // Behind a name that is a bracket itself, as in a line of units, another name begins.
    if (!separator && name.find_first_of(opening) == 0 && !names.empty() &&
        names.back().find_first_of(opening) != 0)
      names.back().append(" ").append(name);
    else names.emplace_back(name);
  }
}

}  // namespace rolling
