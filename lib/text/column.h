// The name of a column: its quantity, its unit and its run.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rolling {

struct Column {
  /// t, x, v, a or D for a known quantity; else the name of the file, with underscores for blanks.
  std::string name{};
  /// The unit of the file, with ^2 for a superscript; empty if the name has no unit.
  std::string unit{};
  /// The number in `Run #2` or `Data Set 1:`, the word in `Latest:`; empty if the name has neither.
  std::string run{};

  bool operator==(const Column&) const = default;
};

/// Value in SI units = value * multiply / divide. Both factors are exact in a double, so that a
/// decimal unit adds one rounding error only.
struct Conversion {
  double multiply = 1, divide = 1;
  bool changes() const { return multiply != divide; }
  double operator()(double value) const { return value * multiply / divide; }
};

/// Reads `v[m/s]`, `Velocity (m/s)`, `Time(s)`, `Latest: Time (s)`, `Data Set 1:Time(s)`, `Velocity
/// (m/s) Run #2`, or a bare name.
Column read_column(std::string_view text);

/// The form in which the tools write names: `v[m/s]`.
std::string to_text(const Column&);

/// The new name of a column whose name is given to a computed one: `name_in`; `name_in_in` and so
/// on if that name exists too.
std::string free_name(const std::vector<Column>&, std::string name);

std::string replace_all(std::string text, std::string_view from, std::string_view to);

/// A unit in ASCII: superscripts in UTF-8 or Latin-1 become ^2 and ^-1, micro signs become u.
std::string plain_unit(std::string unit);

/// The same without the brackets around it.
std::string bare_unit(std::string_view text);

/// A text in which products are quotients: `cm s^-1`, `cm*s-1`, `cm.s^-1` and the same with a
/// raised dot become cm/s, and other signs of a product become blanks.
std::string as_quotients(std::string text);

/// Whether a text is a unit, perhaps in brackets, in which t, x, v, a or D can be read.
enum class UnitKind { none, si, other };
UnitKind unit_kind(std::string_view text);

/// The SI unit of a known quantity (t, x, v, a, D); empty for any other name.
std::string_view si_unit(std::string_view quantity);

/// Whether a column is t, x, v, a or D.
bool is_known(const Column&);

/// Whether the tools convert `unit`, spelled as in rolling-columns(5), to the SI unit of
/// `quantity`.
bool is_unit_of(std::string_view quantity, std::string_view unit);

/// The conversion to SI of a column that serves as `quantity`. Units may be spelled as common
/// programs spell them: `MPH`, `Km/h`, `m s^-1`. A column without a unit is in SI units. Throws
/// Error for a unit that is not one of this quantity.
Conversion conversion_to_si(std::string_view quantity, const Column&);

/// The names in a line, one for each field; a name may stand in quotes. With `separator` 0 blanks
/// separate the names; a unit in brackets, which may contain blanks, then belongs to the name
/// before it.
std::vector<std::string> split_names(std::string_view line, char separator);

}  // namespace rolling
