// SPDX-License-Identifier: GPL-3.0-or-later
// The header of a run: the names of its columns, in a comment or in a line of their own, and the
// units that may stand in a line below them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "text/column.h"

namespace rolling {

/// A line above the first row that is no row.
struct Comment {
  std::string text;  ///< with its marks; bare if it is no comment
  std::size_t line;  ///< its number in the file

  bool is_history() const { return text.starts_with("##"); }
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

/// Leaves out blank names at the end that are too many.
void fit_end(std::vector<std::string>& names, const UnnamedColumns&);

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

/// True if t, x, v, a or D is a word of the line, by its short name or its long one.
bool holds_known_name(std::string_view line);

/// The last comment that has one name for each column, one of them known; in the first head of a
/// file (`first`), else the last without known names. Null if there is none. Throws InputError,
/// unless tabs separate the names or all are known, if another comment may be meant, or if words
/// between blanks would move known columns of the run before.
const Comment* choose_names(std::span<const Comment>, const UnnamedColumns&, bool first,
                            std::string_view file);

/// Whether the fields of the line above the rows are the units of the names in the line above
/// it, which has as many: none of them is a known name, and two are known units, or one under names
/// of which one is known.
bool are_units_of(const std::vector<std::string>& names, const std::vector<std::string>& fields);

/// Gives a column the unit that stands below its name. Refuses one other than that of the name.
void add_unit(Column&, std::string_view unit, std::string_view place);

}  // namespace rolling
