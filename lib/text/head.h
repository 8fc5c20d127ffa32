// What stands in front of a run's records: comments, history, names.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/dialect.h"
#include "text/layout.h"
#include "text/lines.h"

namespace rolling {

struct Head {
  /// Remarks and history with their marks, in their order. Other lines before the names have become
  /// remarks; the names, and what names the run, are not among them.
  std::vector<std::string> comments;
  std::vector<std::string> history;  ///< the `##` lines among them, without their marks
  std::string run;                   ///< NAME of a line `## run NAME`; empty without one
  std::size_t line = 0;              ///< the number of the line with the names, else of the record
  bool named = false;                ///< there are names, here or further up in the file
  bool blank_end = false;            ///< a separator without a name ends the line
  Layout layout;                     ///< no runs: the file has ended before a record
};

/// Reads up to the next record, to which the lines go back. `before` is the head before this one in
/// the file, whose names and units hold until others come; without one the dialect is chosen by the
/// record, and `order` names the columns of a file without names. With `one_run` a line is one
/// record, whatever its names say. Throws InputError, also for the line with which a tool says that
/// it has ended with an error.
Head read_head(Lines&, Dialect&, const Head* before, const std::vector<std::string>& order,
               bool one_run);

/// The names in a line that is no comment.
std::vector<std::string> names_in(std::string_view line, Dialect&);

/// The names in a comment, with a name for each of `width` columns.
struct CommentedNames {
  std::vector<std::string> names;  ///< empty if the comment has more or fewer
  bool tabs = false;               ///< these separate them
  bool known = false;              ///< one is t, x, v, a, D or in `known`
};
CommentedNames names_in_comment(std::string_view comment, std::size_t width,
                                const std::vector<Column>& known);

/// The line that a tool leaves behind what it has printed when it ends with an error.
std::string error_line(std::string_view tool);

/// Throws InputError if the present line, which begins with ##, is one of these.
void refuse_error_line(const Lines&);

}  // namespace rolling
