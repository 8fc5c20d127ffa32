#include "text/unit_lines.h"

#include <algorithm>

#include "base/error.h"
#include "text/delimiters.h"
#include "text/number.h"
#include "text/unit_words.h"

namespace rolling {
namespace {

bool is_known(const Column& column) { return !si_unit(column.name).empty(); }

/// The number of known quantities with units in a comment, `t [ms]: time, x [cm]`.
std::size_t names_with_units(const std::string& comment) {
  std::string text = comment.substr(1);
  for (const char separator : separators) std::ranges::replace(text, separator, ' ');
  auto names = split_names(text, '\0');
  return static_cast<std::size_t>(std::ranges::count_if(names, [](std::string& name) {
    name.erase(name.find_last_not_of(",;:=") + 1);
    const Column column = read_column(name);
    return is_known(column) && !column.unit.empty();
  }));
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

void note_units(const std::string& comment, std::size_t line, SaidUnits& said) {
  for (auto& [quantity, unit] : units_in_comment(comment)) said[quantity] = {unit, line};
}

void refuse_names_of_others(const std::string& comment, std::size_t width, std::string_view place) {
  const std::string text =
      comment.substr(comment.find_last_of('#', comment.find_first_not_of('#')));
  const bool history = text.size() < comment.size();
  const auto known = [&](std::size_t names) {
    return std::ranges::count_if(names_in_comment(text, names, {}).names, is_known_name);
  };
  if (history && (names_with_units(text) > 1 || known(width) > 1 || known(width - 1) > 1))
    fail<InputError>(
        "{}: names of columns in a line that begins with ##, as history does; leave one # there",
        place);
  if (!history && names_with_units(comment) > 1)
    fail<InputError>("{}: a comment with units, but not the names of {} column{}", place, width,
                     width == 1 ? "" : "s");
}

}  // namespace rolling
