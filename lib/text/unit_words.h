// Units that words say: the name of a column without brackets, or a comment.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace rolling {

/// A unit other than SI that the name of a column says without brackets, as in `t_ms`, `x/mm`,
/// `Weg_in_cm`, `Speed cm s-1`, `speedKmh`, `posmm` and `dist centimeters`; empty if there is none.
/// `v_ms` is in m/s, and what is a word too counts only for the quantity that has this unit:
/// `v_min`, `v_cm`. `in` never does; it ends the names that free_name() makes. A slash divides a
/// unit: if it is no known one, as in `cm/seg`, it comes as it stands there. So does a unit that is
/// spelled out in another language.
std::string unit_in_name(std::string_view quantity, std::string_view name);

/// The units other than SI in the words of a comment, as in `# times are in ms` and `# units: ms
/// cm/s`, for each known quantity the first that it may be in. A number before or behind it makes a
/// value of it, and what is a word too counts only behind `in`, `unit`, an equals sign or a colon,
/// and in a list of units at the end: `time: min`, `units: s ft`. A length belongs to the one of x
/// and D that the comment has named last, if any.
using UnitsOf = std::map<std::string, std::string>;  // by quantity
UnitsOf units_in_comment(std::string_view comment);

}  // namespace rolling
