#include "text/unit_lines.h"

#include <algorithm>

#include "base/error.h"
#include "text/number.h"

namespace rolling {
namespace {

bool is_known(const Column& column) { return !si_unit(column.name).empty(); }

/// The known quantities with their units in a comment, `t [ms]: time, x [cm]`.
std::vector<Column> units_in(const std::string& comment) {
  std::vector<Column> all;
  if (comment.starts_with("##")) return all;
  for (std::string& name : split_names(trim(std::string_view(comment).substr(1)),
                                       comment.find('\t') == std::string::npos ? '\0' : '\t')) {
    name.erase(name.find_last_not_of(",;:=") + 1);
    const Column column = read_column(name);
    if (is_known(column) && !column.unit.empty()) all.push_back(column);
  }
  return all;
}

bool is_known_name(const std::string& text) { return is_known(read_column(text)); }

/// Two known units are no accident, one may be a word of a sentence.
bool has_two_units(const std::vector<std::string>& fields) {
  const auto is_unit = [](const std::string& text) { return unit_kind(text) != UnitKind::none; };
  return std::ranges::count_if(fields, is_unit) > 1;
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
    if (column.unit.empty() && unit_kind(unit) == UnitKind::other)
      column.elsewhere = bare_unit(unit);
  };
  for (const Column& said : units_in(comment))
    for (Column& column : columns)
      if (column.name == said.name) note(column, said.unit);
  const auto fields = names_in_comment(comment, columns.size(), {}).names;
  if (has_two_units(fields) && std::ranges::none_of(fields, is_known_name))
    for (std::size_t i = 0; i < columns.size(); ++i) note(columns[i], fields[i]);
}

void refuse_units_of_others(const std::string& comment, std::size_t width, std::string_view place) {
  const auto units = units_in(comment);
  const auto is_other = [](const Column& c) { return c.unit != si_unit(c.name); };
  if (units.size() > 1 || std::ranges::any_of(units, is_other))
    fail<InputError>("{}: a comment with units, but not the names of {} column{}", place, width,
                     width == 1 ? "" : "s");
}

void refuse_line_of_units(const std::vector<std::string>& fields, std::string_view place) {
  const auto is_unit = [](const std::string& field) {
    return field.empty() || unit_kind(field) != UnitKind::none;
  };
  const auto is_other = [](const auto& field) { return unit_kind(field) == UnitKind::other; };
  if (std::ranges::all_of(fields, is_unit) && std::ranges::any_of(fields, is_other))
    fail<InputError>("{}: a line of units: put each behind the name of its column, as in t[ms]",
                     place);
}

}  // namespace rolling
