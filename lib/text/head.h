// SPDX-License-Identifier: GPL-3.0-or-later
// The head of a run: the comments, history and names before its first row, and the fields of a line
// that form a row.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "text/column.h"
#include "text/dialect.h"
#include "text/lines.h"
#include "text/unit.h"

namespace rolling {

/// Whether the names may tell several runs side by side, or each line is one row.
enum class Sides { by_names, one };

struct Layout {
  struct Run {
    std::string label;                ///< Column::run of its columns: 2 for `Run #2`; may be empty
    std::vector<std::size_t> fields;  ///< of a line, from 0: the places of its columns
    std::vector<Column> columns;
  };
  std::vector<Run> runs;
  std::vector<bool> shared;  ///< for each field of a line: it belongs to every run
  std::size_t width() const { return shared.size(); }
  bool side_by_side() const { return runs.size() > 1; }

  /// The runs in a header. There are several if more than one label brings a t, or the same
  /// needed quantity beside a common t, or if there is more than one t. A column of none of these
  /// labels, or whose name occurs only once, is shared.
  static Layout of(const std::vector<Column>& line, Sides);
};

/// The columns of the rows that the lines above may name.
struct UnnamedColumns {
  std::size_t count = 0;
  bool blank_end = false;           ///< the last field is blank: a separator may end each line
  std::vector<Column> before = {};  ///< those of the run before
};

/// The names in a line.
struct Names {
  std::vector<Column> columns = {};  ///< as these names tell them
  char separator = '\0';             ///< of the names; 0 for blanks, as in a sentence
  std::size_t known = 0;             ///< number that are t, x, v, a, D or names of the run before
};
/// The names in a comment are separated by the first of tabs, ; , and blanks that gives one for
/// each column, a known one among them; else by the first that gives one for each. There are none
/// if the comment has another number of words.
Names names_in_comment(std::string_view comment, const UnnamedColumns&);

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
