// Numbers with an uncertainty as text: 0.50+-0.005.
#pragma once

#include <string>
#include <string_view>

#include "base/estimate.h"

namespace rolling {

/// Reads the whole of `text`: a number, or two with `+-` between them, of which the second is the
/// standard uncertainty; blanks may stand around the `+-`. Each number is one of number.h, and the
/// second has no minus. False, and `estimate` as it was, for anything else.
bool parse_estimate(std::string_view text, Estimate& estimate);

/// The shortest text that reads back to the same numbers: `0.5+-0.005`, and `0.5` alone where sigma
/// is 0.
std::string to_text(const Estimate&);

}  // namespace rolling
