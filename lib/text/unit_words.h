// Units that the name of a column says without brackets.
#pragma once

#include <string>
#include <string_view>

namespace rolling {

/// A unit other than SI that the name of a column says without brackets, as in `t_ms`, `x/mm`,
/// `Weg_in_cm`, `Speed cm s-1`, `speedKmh` and `dist centimeters`; empty if there is none. `v_ms`
/// is in m/s, and what is a word too counts only for the quantity that has this unit: `v_min`,
/// `v_cm`. `in` never does; it ends the names that free_name() makes.
std::string unit_in_name(std::string_view quantity, std::string_view name);

}  // namespace rolling
