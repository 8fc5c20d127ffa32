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

/// A comment without the # or ## before it.
std::string_view without_marks(std::string_view comment) {
  return comment.substr(std::min(comment.find_first_not_of('#'), comment.size()));
}

/// The names of as many columns between these separators, 0 for blanks; none if there are not as
/// many, or if words between blanks end as in a sentence.
CommentedNames names_between(char separator, std::string_view text, const UnnamedColumns& columns) {
  CommentedNames found{split_names(text, separator), {}, separator};
  auto& names = found.names;
  fit_end(names, columns);
  while (names.size() > columns.count && names.front().empty()) names.erase(names.begin());
  const bool words = separator == '\0';
  const auto ends_a_phrase = [](const std::string& word) {
    return !word.empty() && std::string_view(",;:").find(word.back()) != std::string_view::npos;
  };
  if (!columns.fit(names.size()) || (words && std::ranges::any_of(names, ends_a_phrase))) return {};
  for (const std::string& name : names) {
    const Column& column = found.columns.emplace_back(read_column(name));
    const bool article = words && names.size() > 1 && name == "a";  // perhaps
    found.known += !article && (is_known(column) ||
                                std::ranges::count(columns.before, column.name, &Column::name) > 0);
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
bool agree(const std::vector<Column>& one, const std::vector<Column>& other) {
  for (std::size_t i = 0; i < std::min(one.size(), other.size()); ++i)
    if (one[i].name != other[i].name && (is_known(one[i]) || is_known(other[i]))) return false;
  return true;
}

/// A date or a time of day, in digits: `24/11/2026`, `10:15:00.5`, `2026-11-24T10:15:00Z`.
bool is_date(std::string_view text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) &&
         text.find_first_not_of("0123456789+-.:/ TZ") == std::string_view::npos;
}

}  // namespace

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

void fit_end(std::vector<std::string>& names, const UnnamedColumns& columns) {
  while (names.size() > columns.count - columns.blank_end && names.back().empty()) names.pop_back();
}

CommentedNames names_in_comment(std::string_view comment, const UnnamedColumns& columns) {
  std::string_view text = without_marks(comment);
  text = text.substr(0, text.find_last_not_of(filling) + 1);
  CommentedNames unknown;
  for (const char separator : std::string(separators) + '\0') {
    auto found = names_between(separator, text, columns);
    if (found.known > 0) return found;
    if (unknown.names.empty()) unknown = std::move(found);
  }
  return unknown;
}

const Comment* choose_names(std::span<const Comment> comments, const UnnamedColumns& columns,
                            bool first, std::string_view file) {
  const Comment* chosen = nullptr;
  CommentedNames names;  // in it
  const auto is_figure = [](const std::string& s) { return is_number(s) || is_date(s); };
  for (std::size_t i = comments.size(); i-- > 0 && names.known == 0;) {
    if (comments[i].is_bare() || comments[i].is_history()) continue;
    CommentedNames found = names_in_comment(comments[i].text, columns);
    if (found.known > 0 ||
        (first && !chosen && !found.names.empty() && std::ranges::none_of(found.names, is_figure)))
      chosen = &comments[i], names = std::move(found);
  }
  if (names.known > 0 && (names.separator == '\t' || names.known == names.names.size()))
    return chosen;
  const auto refuse = [&](const Comment& comment) {
    fail<InputError>(
        "{}:{}: '{}' may be the names of the columns, or a sentence: put tabs between names, one "
        "for each of {}, behind one #; or give the sentence another number of words",
        file, comment.line, shown(comment.text), counted(columns.count, "column"));
  };
  for (const Comment& comment : comments) {
    if (&comment == chosen || comment.is_bare()) continue;
    const CommentedNames other = names_in_comment(comment.text, columns);
    const bool may_be_meant = looks_like_names(comment.text) ||
                              (other.known > comment.is_history() && other.known >= names.known);
    if (may_be_meant && (!chosen || other.names.empty() || !agree(other.columns, names.columns)))
      refuse(comment);
  }
  const bool article = names.known == 0 && std::ranges::count(names.names, "a") > 0;
  if (chosen && names.separator == '\0' && (article || !agree(names.columns, columns.before)))
    refuse(*chosen);
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
