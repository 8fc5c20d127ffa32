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
  std::size_t width = 0;     ///< number of fields of a line
  std::vector<bool> shared;  ///< for each field: it belongs to every run
  bool side_by_side() const { return runs.size() > 1; }

  /// The runs in a header. There are several if more than one label brings a t, or the same
  /// needed quantity beside a common t, or if there is more than one t. A column of none of these
  /// labels, or whose name occurs only once, is shared.
  static Layout of(const std::vector<Column>& line, Sides);
};

/// A line above the first row of a run: a comment, a `##` line, names, units or a line of a
/// preamble.
struct HeadLine {
  std::string text;  ///< with its marks, if it is a comment
  std::size_t line;  ///< its number in the file

  bool is_history() const { return rolling::is_history(text); }
  bool is_bare() const { return !text.starts_with('#'); }
};

/// The columns of the rows that comments may name.
struct UnnamedColumns {
  std::size_t count = 0;
  bool blank_end = false;           ///< the last field is blank: a separator may end each line
  std::vector<Column> before = {};  ///< those of the run before
  /// Whether that many names can be theirs.
  bool fit(std::size_t names) const { return names == count || names + blank_end == count; }
};

/// A comment that is read as the names of columns.
struct CommentedNames {
  std::vector<std::string> names = {};  ///< empty if the comment has another number of words
  std::vector<Column> columns = {};     ///< as these names tell them
  char separator = '\0';                ///< of the names; 0 for blanks, as in a sentence
  std::size_t known = 0;  ///< number that are t, x, v, a, D or names of the run before
};
/// The names are separated by the first of tabs, ; , and blanks that gives one for each column, a
/// known one among them; else by the first that gives one for each.
CommentedNames names_in_comment(std::string_view comment, const UnnamedColumns&);

/// The last comment that has one name for each column, one of them known; in the first head of a
/// file (`first`), else the last without known names. Null if there is none. Throws InputError,
/// unless tabs separate the names or all are known, if another comment may be meant, or if words
/// between blanks would move known columns of the run before.
const HeadLine* choose_names(std::span<const HeadLine>, const UnnamedColumns&, bool first,
                             std::string_view file);

/// Whether the fields of a line are the units of as many names in the line above or below it: none
/// of them is a known name, and two are known units, or one if a name is known.
bool are_units_of(const std::vector<std::string>& names, const std::vector<std::string>& fields);

/// Gives a column the unit in a line of units. Refuses one other than that of the name.
void add_unit(Column&, std::string_view unit, std::string_view place);

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
