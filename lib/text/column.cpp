// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/column.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "text/dialect.h"
#include "text/number.h"

namespace rolling {
namespace {

constexpr std::pair<std::string_view, std::string_view> long_names[] = {
    {"time", "t"},     {"position", "x"}, {"distance", "x"},     {"displacement", "x"},
    {"velocity", "v"}, {"speed", "v"},    {"acceleration", "a"}, {"shift", "D"}};

/// t for Time, x for Position or Distance and so on, in any case; any other name as it is.
std::string short_name(std::string_view name) {
  const auto found = std::ranges::find(long_names, lower(name), [](auto& of) { return of.first; });
  return std::string(found == std::end(long_names) ? name : found->second);
}

/// Removes `Run #2` or `Run 2` from the end of a name, any words and #2 behind a unit in brackets,
/// and `Latest:` or `Data Set 1:` from its beginning; returns the number, or the word if there is
/// no number. A colon in brackets, or behind them, is none of a label: `Clock (hh:mm:ss)`.
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
  std::string_view before = trim(name.substr(0, name.size() - number.size()));
  if (before.ends_with('#')) {
    before = trim(before.substr(0, before.size() - 1));
    if (const auto unit = before.find_last_of(")]") + 1; unit > 0 && !number.empty()) {
      name = before.substr(0, unit);
      return std::string(number);
    }
  }
  constexpr std::string_view run = " Run";
  if (!number.empty() && before.ends_with(run)) {
    name = trim(before.substr(0, before.size() - run.size()));
    return std::string(number);
  }
  return std::string(number_at_end(prefix).empty() ? prefix : number_at_end(prefix));
}

/// Where the bracket opens that the last character of a name closes, if it closes one. It may hold
/// others: `a (m (s/m)^b)`.
std::size_t begin_of_bracket(std::string_view name) {
  if (!name.ends_with(')') && !name.ends_with(']')) return std::string_view::npos;
  const char close = name.back();
  const char open = close == ')' ? '(' : '[';
  std::size_t depth = 0;
  for (std::size_t i = name.size(); i-- > 0;) {
    if (name[i] == close) ++depth;
    if (name[i] == open && --depth == 0) return i;
  }
  return std::string_view::npos;
}

/// The unit behind `in` at the end of a name: `Time in ms`. Removes both from the name.
std::string take_unit_in_words(std::string_view& name) {
  constexpr std::string_view in = " in ";
  const auto at = name.rfind(in);
  if (at == std::string_view::npos || !is_unit(name.substr(at + in.size()))) return {};
  std::string unit = plain_unit(trim(name.substr(at + in.size())));
  name = trim(name.substr(0, at));
  return unit;
}

}  // namespace

std::string with_underscores(std::string_view name) {
  std::string text(name);
  std::ranges::replace_if(text, is_blank, '_');
  return text;
}

Column read_column(std::string_view text) {
  Column column;
  // Brackets of full width; and a quoted name may go over two lines.
  const std::string line = replace_all(with_plain_blanks(text),
                                       {{"\xEF\xBC\x88", "("}, {"\xEF\xBC\x89", ")"}, {"\n", " "}});
  std::string_view name = trim(line);
  column.written = name;
  column.run = take_run(name);
  const auto open = begin_of_bracket(name);
  if (open != std::string_view::npos && open > 0) {
    column.unit = plain_unit(trim(name.substr(open + 1, name.size() - open - 2)));
    name = trim(name.substr(0, open));
    if (name.size() > 1 && name.ends_with('/')) name = trim(name.substr(0, name.size() - 1));
  } else {
    column.unit = take_unit_in_words(name);
  }
  column.name = with_underscores(short_name(name));
  if (const auto slash = name.find('/'); slash < name.size() && column.unit.empty()) {
    const std::string quantity = short_name(trim(name.substr(0, slash)));
    const std::string below = bare_unit(trim(name.substr(slash + 1)));
    if (unit_of(quantity, below)) {  // t/ms
      column.name = quantity;
      column.unit = below;
    }
  }
  // In capitals alone a unit may be one in small letters: `TIME (S)`.
  const bool in_capitals = std::ranges::none_of(line, [](char c) { return c >= 'a' && c <= 'z'; });
  if (in_capitals && !is_unit(column.unit) && unit_of(column.name, lower(column.unit)))
    column.unit = lower(column.unit);
  return column;
}

std::string labelled_name(const Column& column) {
  return with_underscores(is_number(column.run) ? fmt::format("{}_Run_{}", column.name, column.run)
                                                : fmt::format("{}:{}", column.run, column.name));
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
      if (at < last_bracket && opening.find(line[at]) != std::string_view::npos)
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
