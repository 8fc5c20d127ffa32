#include "text/unit_lines.h"

#include <algorithm>

#include "base/error.h"
#include "text/number.h"

namespace rolling {
namespace {

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

}  // namespace rolling
