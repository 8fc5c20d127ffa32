// SPDX-License-Identifier: GPL-3.0-or-later
// A double as text: the shortest decimal number that reads back to it.
#pragma once

namespace rolling {

/// Writes the shortest text that reads back to the same double and, of several that short, the one
/// closest to it, in the form of fmt's "{}": 0.001, 1.5, 1e-04, 1e+16. The value is finite.
/// Returns the end of the text, at most 24 bytes behind `to`; writes up to 32 bytes.
char* write_shortest(char* to, double value);

}  // namespace rolling
