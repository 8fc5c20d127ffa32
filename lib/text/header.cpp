// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/header.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "base/enumeration.h"
#include "base/error.h"
#include "text/delimiters.h"
#include "text/number.h"

namespace rolling {
namespace {

bool is_known_name(const std::string& text) { return is_known(read_column(text)); }

/// The text without separators at its end.
std::string_view without_end(std::string_view text) {
  return text.substr(0, text.find_last_not_of(filling) + 1);
}

/// The names of as many columns between these separators, 0 for blanks; none if there are not as
/// many, or if words between blanks end as in a sentence.
CommentedNames names_between(char separator, std::string_view text, const UnnamedColumns& columns) {
  CommentedNames found{split_names(text, separator), separator};
  auto& names = found.names;
  while (names.size() > columns.count && names.back().empty()) names.pop_back();
  while (names.size() > columns.count && names.front().empty()) names.erase(names.begin());
  const bool words = separator == '\0';
  const auto ends_a_phrase = [](const std::string& word) {
    return !word.empty() && std::string_view(",;:").find(word.back()) != std::string_view::npos;
  };
  if (names.size() != columns.count || (words && std::ranges::any_of(names, ends_a_phrase)))
    return {};
  for (const std::string& name : names) {
    if (words && names.size() > 1 && name == "a") continue;  // the article, perhaps
    const Column column = read_column(name);
    found.known +=
        is_known(column) || std::ranges::count(columns.before, column.name, &Column::name);
  }
  return found;
}

/// The words of a line, whatever separates them: `t [ms]`, `time` and `x [cm]` of `t [ms]: time, x
/// [cm]`.
std::vector<Column> words_of(std::string_view line) {
  std::string text(line);
  for (const char separator : separators) std::ranges::replace(text, separator, ' ');
  std::vector<Column> words;
  for (std::string& word : split_names(text, '\0')) {
    word.erase(word.find_last_not_of(",;:=") + 1);
    words.push_back(read_column(word));
  }
  return words;
}

/// True for a comment of nothing but known quantities, or that gives two of them units. One word
/// without a unit may be a label.
bool looks_like_names(std::string_view comment) {
  const std::vector<Column> words = words_of(without_marks(comment));
  const auto units = std::ranges::count_if(
      words, [](const Column& word) { return is_known(word) && !word.unit.empty(); });
  return units > 1 || ((words.size() > 1 || units > 0) && std::ranges::all_of(words, is_known));
}

/// True if each known quantity is in the same place in both, as far as both go.
bool agree(const std::vector<std::string>& names, const std::vector<Column>& columns) {
  for (std::size_t i = 0; i < std::min(names.size(), columns.size()); ++i) {
    const Column read = read_column(names[i]);
    if (read.name != columns[i].name && (is_known(read) || is_known(columns[i]))) return false;
  }
  return true;
}

}  // namespace

std::string_view without_marks(std::string_view comment) {
  return comment.substr(std::min(comment.find_first_not_of('#'), comment.size()));
}

bool is_date(std::string_view text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) &&
         text.find_first_not_of("0123456789+-.:/ TZ") == std::string_view::npos;
}

bool holds_known_name(std::string_view line) {
  const auto is_letter = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  for (auto at = line.begin(); at != line.end();) {
    const auto end = std::find_if_not(at, line.end(), is_letter);
    if (known_quantity(short_name({at, end}))) return true;
    at = end == line.end() ? end : end + 1;
  }
  return false;
}

CommentedNames names_in_comment(std::string_view comment, const UnnamedColumns& columns) {
  const std::string_view text = without_marks(comment);
  CommentedNames with_blanks;  // names of which some are blank and none is known
  for (const char separator : std::string(separators) + '\0')
    for (const std::string_view part : {without_end(text), text}) {
      auto found = names_between(separator, part, columns);
      if (found.names.empty()) continue;
      if (found.known > 0 || std::ranges::count(found.names, "") == 0) return found;
      if (with_blanks.names.empty()) with_blanks = std::move(found);
    }
  if (!with_blanks.names.empty() || !columns.blank_end) return with_blanks;
  CommentedNames found = names_in_comment(comment, {columns.count - 1, false, columns.before});
  if (found.known == 0) return {};
  found.names.emplace_back();
  return found;
}

std::optional<std::size_t> choose_names(const std::vector<Comment>& comments,
                                        const UnnamedColumns& columns, bool first,
                                        std::string_view file) {
  std::optional<std::size_t> chosen;
  CommentedNames names;  // in it
  const auto is_figure = [](const std::string& s) { return is_number(s) || is_date(s); };
  for (std::size_t i = comments.size(); i-- > 0 && names.known == 0;) {
    if (comments[i].is_bare() || comments[i].is_history()) continue;
    CommentedNames found = names_in_comment(comments[i].text, columns);
    if (found.known > 0 ||
        (first && !chosen && !found.names.empty() && std::ranges::none_of(found.names, is_figure)))
      chosen = i, names = std::move(found);
  }
  if (names.known > 0 &&
      (names.separator == '\t' || names.known + columns.blank_end >= columns.count))
    return chosen;
  std::vector<Column> read;
  for (const std::string& name : names.names) read.push_back(read_column(name));
  for (std::size_t i = 0; i < comments.size(); ++i) {
    if (i == chosen || comments[i].is_bare()) continue;
    const CommentedNames other = names_in_comment(comments[i].text, columns);
    const bool may_be_meant =
        looks_like_names(comments[i].text) ||
        (other.known > comments[i].is_history() && other.known >= names.known);
    if (may_be_meant && (!chosen || other.names.empty() || !agree(other.names, read)))
      fail<InputError>(
          "{}:{}: '{}' may be the names of the columns, {}", file, comments[i].line,
          shown(comments[i].text),
          comments[i].is_history() ? "but it begins with ##, as history does; leave one # there"
          : chosen
              ? fmt::format("and so may line {}: give one of them another number of words",
                            comments[*chosen].line)
              : fmt::format("but has not one for each of {}", counted(columns.count, "column")));
  }
  const bool article = names.known == 0 && std::ranges::count(names.names, "a") > 0;
  if (chosen && names.separator == '\0' && (article || !agree(names.names, columns.before)))
    fail<InputError>(
        "{}:{}: '{}' can be names of the columns or a sentence: put tabs between names, or give "
        "the sentence another number of words",
        file, comments[*chosen].line, shown(comments[*chosen].text));
  return chosen;
}

bool are_units_of(const std::vector<std::string>& names, const std::vector<std::string>& fields) {
  const auto units = std::ranges::count_if(fields, is_unit);
  return names.size() == fields.size() && std::ranges::none_of(fields, is_known_name) &&
         units + std::ranges::any_of(names, is_known_name) > 1;
}

void add_unit(Column& column, std::string_view unit, std::string_view place) {
  const std::string below = bare_unit(unit);
  if (below.empty()) return;
  if (!column.unit.empty() && column.unit != below)
    fail<InputError>("{}: the column '{}' has another unit in the line below, '{}'", place,
                     shown(to_text(column)), shown(below));
  column.unit = below;
}

}  // namespace rolling
