#include "text/unit_lines.h"

#include <algorithm>

#include "base/error.h"
#include "text/number.h"

namespace rolling {
namespace {

bool is_known(const Column& column) { return !si_unit(column.name).empty(); }

bool is_other_unit(const std::string& text) { return unit_kind(text) == UnitKind::other; }
bool is_unit_word(const std::string& text) {
  return unit_kind(text) != UnitKind::none && text != "in";
}

/// The words of a comment, with `in` for an equals sign or a colon, and without other marks.
std::vector<std::string> plain_words(std::string text) {
  for (const std::string_view is : {"=", ":"}) text = replace_all(std::move(text), is, " in ");
  for (const std::string_view mark : {",", ";", "(", ")", "[", "]"})
    text = replace_all(std::move(text), mark, " ");
  return split_names(text, '\0');
}

/// The known quantities with their units in a comment, `t [ms]: time, x [cm]`; or, if no value
/// follows, `time in ms, x = cm`.
std::vector<Column> units_in(const std::string& comment) {
  std::vector<Column> all;
  if (comment.starts_with("##")) return all;
  const std::string text(trim(std::string_view(comment).substr(1)));
  for (std::string& name :
       split_names(text, comment.find('\t') == std::string::npos ? '\0' : '\t')) {
    name.erase(name.find_last_not_of(",;:=") + 1);
    const Column column = read_column(name);
    if (is_known(column) && !column.unit.empty()) all.push_back(column);
  }
  const auto words = plain_words(text);
  for (std::size_t i = 0; i + 2 < words.size(); ++i) {
    Column column = read_column(words[i]);
    column.unit = words[i + 2];
    const bool value = i + 3 < words.size() && (words[i + 3] == "in" || is_number(words[i + 3]));
    if (is_known(column) && words[i + 1] == "in" && is_unit_word(column.unit) &&
        is_other_unit(column.unit) && !value)
      all.push_back(column);
  }
  return all;
}

bool is_known_name(const std::string& text) { return is_known(read_column(text)); }

/// Two known units are no accident, one may be a word of a sentence.
bool has_two_units(const std::vector<std::string>& fields) {
  const auto is_unit = [](const std::string& text) { return unit_kind(text) != UnitKind::none; };
  return std::ranges::count_if(fields, is_unit) > 1;
}

/// The words of a comment from two units side by side on, `# units: ms cm/s N`.
std::vector<std::string> list_of_units(const std::string& comment) {
  auto words = plain_words(comment.substr(1));
  const auto are_units = [](const std::string& one, const std::string& next) {
    return is_unit_word(one) && is_unit_word(next);
  };
  const auto at = std::ranges::adjacent_find(words, are_units);
  if (comment.starts_with("##") || (at != words.begin() && is_number(*(at - 1)))) return {};
  words.erase(words.begin(), at);
  return words;
}

/// The units of the columns in their order.
std::vector<std::string> units_by_place(const std::string& comment, std::size_t width) {
  for (auto fields : {list_of_units(comment), names_in_comment(comment, width, {}).names})
    if (fields.size() == width && has_two_units(fields)) return fields;
  return {};
}

}  // namespace

bool are_units_of(const std::vector<std::string>& names, const std::vector<std::string>& fields) {
  return names.size() == fields.size() && std::ranges::none_of(fields, is_known_name) &&
         (std::ranges::any_of(names, is_known_name) || has_two_units(fields));
}

void add_unit(Column& column, std::string_view unit, std::string_view place) {
  const std::string below = bare_unit(unit);
  if (below.empty()) return;
  if (!column.unit.empty() && column.unit != below)
    fail<InputError>("{}: the column '{}' has another unit in the line below, '{}'", place,
                     shown(to_text(column)), shown(below));
  column.unit = below;
}

void note_other_units(const std::string& comment, std::vector<Column>& columns) {
  const auto note = [](Column& column, const std::string& unit) {
    if (column.unit.empty() && is_other_unit(unit)) column.elsewhere = bare_unit(unit);
  };
  for (const Column& said : units_in(comment))
    for (Column& column : columns)
      if (column.name == said.name) note(column, said.unit);
  const auto fields = units_by_place(comment, columns.size());
  if (std::ranges::none_of(fields, is_known_name))
    for (std::size_t i = 0; i < fields.size(); ++i) note(columns[i], fields[i]);
}

void refuse_units_of_others(const std::string& comment, std::size_t width, bool named,
                            std::string_view place) {
  const auto units = units_in(comment);
  const auto is_other = [](const Column& c) { return c.unit != si_unit(c.name); };
  if (units.size() > 1 || std::ranges::any_of(units, is_other) ||
      (!named && std::ranges::any_of(list_of_units(comment), is_other_unit)))
    fail<InputError>("{}: a comment with units, but not the names of {} column{}", place, width,
                     width == 1 ? "" : "s");
}

void refuse_line_of_units(const std::vector<std::string>& fields, std::string_view place) {
  const auto is_unit = [](const std::string& field) {
    return field.empty() || unit_kind(field) != UnitKind::none;
  };
  if (std::ranges::all_of(fields, is_unit) && std::ranges::any_of(fields, is_other_unit))
    fail<InputError>("{}: a line of units: put each behind the name of its column, as in t[ms]",
                     place);
}

}  // namespace rolling
