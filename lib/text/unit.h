// SPDX-License-Identifier: GPL-3.0-or-later
// Units: lengths and times as programs spell them; speeds and accelerations are quotients of these.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace rolling {

/// Value in SI units = value * multiply / divide. Both factors are whole numbers and exact in a
/// double; one of a decimal unit is 1, so that it adds one rounding error only.
struct Conversion {
  double multiply = 1, divide = 1;
  bool changes() const { return multiply != divide; }
  double operator()(double value) const { return value * multiply / divide; }
  bool operator==(const Conversion&) const = default;
};

/// A unit of t, x, v or a, or one of a ratio of lengths, whose quantity has no name.
struct Unit {
  std::string_view quantity;
  Conversion to_si;
  bool operator==(const Unit&) const = default;
};

/// A unit in ASCII: superscripts in UTF-8 or Latin-1 become ^2 and ^-1, micro signs become u, and
/// no-break blanks plain ones.
std::string plain_unit(std::string_view text);

/// The same without the brackets around it.
std::string bare_unit(std::string_view text);

/// A known quantity: t, x, v, a or D.
struct KnownQuantity {
  std::string_view name, si, units;   ///< its units by common spellings, as a message shows them
  std::string_view in_words;          ///< `a length`
  std::string_view appended_by = {};  ///< the tool that computes it
};
/// Null for any other name.
const KnownQuantity* known_quantity(std::string_view name);

/// The SI unit of a known quantity; empty for any other name.
std::string_view si_unit(std::string_view quantity);

/// A unit with a name, or one of length or speed over one of time, or of length over length;
/// nothing if it is none that is known. Case does not matter in words and in the names of speeds,
/// but in letters: Ms is no millisecond.
std::optional<Unit> read_unit(std::string_view text);

/// The conversion of a unit to the SI unit of a known quantity; nothing if it is not one of this
/// quantity.
std::optional<Conversion> unit_of(std::string_view quantity, std::string_view unit);

/// What a unit measures, in words: `a length`; empty for one that is not known. Angles are known.
std::string_view measured_by(std::string_view unit);

/// Whether a text is a unit, perhaps in brackets, in which t, x, v, a or D can be read.
bool is_unit(std::string_view text);

/// The unit of `quantity` that the name of a column ends with, behind `_` or `/`: `t_ms`, `x/cm`,
/// `Speed_in_km/h`; or else what a slash divides, which may be an unknown unit. Empty without one,
/// and for a unit of another quantity: `v_min`, `x_s`. `in` is none; it ends the names that
/// free_name() makes.
std::string unit_at_end(std::string_view quantity, std::string_view name);

/// The unit that a name tells behind a slash (`Weg / cm`, `v/(m/s)`: ISO 80000-1), or the name
/// itself if it is a unit of three letters or more: `secs`, `kph`; `hr` may be a heart rate. Empty
/// without one, and for an angle or a pace (`rad/s`, `min/km`).
std::string unit_in_name(std::string_view name);

/// By quantity, the unit other than SI that a comment names last, as `line 3 says ms`. A message
/// says that a column without a unit is read in SI units all the same.
using SaidUnits = std::map<std::string, std::string>;

/// Adds those of a comment. The word beside a number is part of a value; what is a word of English
/// too (in, min, us) counts only at the beginning of a bracket.
void note_units(std::string_view comment, std::size_t line, SaidUnits&);

}  // namespace rolling
