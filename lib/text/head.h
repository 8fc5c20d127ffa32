// SPDX-License-Identifier: GPL-3.0-or-later
// The head of a run: the comments, history and names before its first row.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "text/dialect.h"
#include "text/layout.h"
#include "text/lines.h"
#include "text/unit.h"

namespace rolling {

struct Head {
  /// Comments and history lines with their marks, in order. Other lines before the names have been
  /// made comments. The header and the line `## run NAME` are not among them.
  std::vector<std::string> comments;
  std::vector<std::string> history;  ///< the `##` lines among them, without their marks
  std::string run;                   ///< NAME of the line `## run NAME`; empty without one
  std::size_t line = 0;              ///< number of the header, else of the first row
  bool named = false;                ///< the columns have names, from this head or an earlier one
  SaidUnits said;                    ///< by comments, since the names
  Layout layout;                     ///< without runs if the file has no further row
};

/// The `##` line that stands at the end of a history whose lines have been put in another order.
inline constexpr std::string_view lines_sorted = "lines sorted";

/// Reads up to the next row, which is then the present line again. `before` is the previous head
/// of the file: its names and units hold until there are others. It is null for the first head,
/// where the dialect is chosen by the row and `order` names the columns if the file does not.
/// Throws InputError, also for the line that a tool writes when it ends with an error.
Head read_head(Lines&, Dialect&, const Head* before, const std::vector<std::string>& order, Sides);

}  // namespace rolling
