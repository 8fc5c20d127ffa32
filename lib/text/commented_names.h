// The names of columns in a comment. A comment may as well be a sentence: which one it is follows
// from the comments together.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/column.h"

namespace rolling {

struct Comment {
  std::string text;  ///< with its marks
  std::size_t line;  ///< its number in the file

  bool is_history() const { return text.starts_with("##"); }
};

/// A comment without the # or ## before it.
std::string_view without_marks(std::string_view comment);

/// The columns of the records that comments may name.
struct UnnamedColumns {
  std::size_t count = 0;
  /// The last field is blank: the column may have no name, because its separator ends each line.
  bool blank_end = false;
  std::vector<Column> before = {};  ///< those of the run before
};

/// A comment that is read as the names of columns.
struct CommentedNames {
  std::vector<std::string> names = {};  ///< empty if the comment has another number of words
  bool tabs = false;                    ///< tabs separate them
  bool words = false;                   ///< blanks separate them, as in a sentence
  bool article = false;                 ///< one is `a` before a word, as in a sentence
  std::size_t units = 0;                ///< number of known quantities that have a unit
  std::size_t known = 0;  ///< number that are t, x, v, a (no article), D or names of the run before
};
CommentedNames names_in_comment(std::string_view comment, const UnnamedColumns&);

/// A date or a time of day, in digits: `24/11/2026`, `10:15:00.5`, `2026-11-24T10:15:00Z`.
bool is_date(std::string_view text);

/// True if t, x, v, a or D is a word of the line, between any separators.
bool holds_known_name(std::string_view line);

/// The names of the columns and the place of the comment that has them.
struct ChosenNames {
  std::size_t place;
  std::vector<std::string> names;
};

/// The last comment that names known columns, or names between tabs; in the first head of a file
/// (`first`), else the last one of as many words as columns. Nothing if there is none. Throws
/// InputError if another comment may be meant: its names are as likely, or it has names and units,
/// or nothing but known names, but not of these columns, or known names stand in a history line.
/// Throws it for a sentence that may be names, too: with the article `a`, or one that would move
/// known columns of the run before.
std::optional<ChosenNames> choose_names(const std::vector<Comment>&, const UnnamedColumns&,
                                        bool first, std::string_view file);

}  // namespace rolling
