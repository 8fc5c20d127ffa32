// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers with an uncertainty as text: 0.50+-0.005.
#pragma once

#include <string>
#include <string_view>

#include "base/estimate.h"

namespace rolling {

/// Reads the whole of `text`: a number, or a number, `+-` and the standard uncertainty, which has
/// no sign. Blanks may stand around `+-`. Both numbers have the syntax of number.h. Returns false
/// for any other text and then leaves `estimate` unchanged.
bool parse_estimate(std::string_view text, Estimate& estimate);

/// The shortest text that reads back to the same numbers: `0.5+-0.005`, or `0.5` if sigma is 0.
std::string to_text(const Estimate&);

}  // namespace rolling
