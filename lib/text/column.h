// What a column's name says: which quantity it is, and in which unit.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rolling {

struct Column {
  std::string
      name{};  ///< short name (t, x, v, a, D), or the name as it stands with blanks as underscores
  std::string unit{};  ///< as it stands, m/s² as m/s^2; empty if the name says none
  std::string run{};   ///< the number in `Run #2` or `Data Set 1:`, the word in `Latest:`; empty if
                       ///< the name says none

  bool operator==(const Column&) const = default;
};

/// Value in SI units = value * multiply / divide, each exact, so that a decimal unit costs one
/// rounding.
struct Conversion {
  double multiply = 1, divide = 1;
  bool changes() const { return multiply != divide; }
  double operator()(double value) const { return value * multiply / divide; }
};

/// Reads `v[m/s]`, `Velocity (m/s)`, `Time(s)`, `Latest: Time (s)`, `Data Set 1:Time(s)`, `Velocity
/// (m/s) Run #2`, or a bare name.
Column read_column(std::string_view text);

/// The style in which names go out: `v[m/s]`.
std::string to_text(const Column&);

/// The name that a column takes when another one gets its name: `name_in`, or with more of them if
/// that is taken too.
std::string free_name(const std::vector<Column>&, std::string name);

/// The SI unit of a known quantity (t, x, v, a, D); empty for any other name.
std::string_view si_unit(std::string_view quantity);

/// How a column that serves as `quantity` becomes SI. Units are read as programs write them: `MPH`,
/// `Km/h`, `m s^-1`. Throws Error for a unit that the quantity cannot have; no unit is SI.
Conversion conversion_to_si(std::string_view quantity, const Column&);

/// The names of a line, one a field: `separator` 0 stands for blanks, where a unit in brackets,
/// which may hold blanks, belongs to the name before it.
std::vector<std::string> split_names(std::string_view line, char separator);

}  // namespace rolling
