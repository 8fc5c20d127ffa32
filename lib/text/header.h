// What stands before the first record of a file: comments, names, and how the records after it
// look.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "text/dialect.h"
#include "text/layout.h"
#include "text/lines.h"

namespace rolling {

struct Header {
  std::vector<std::string>
      comments;            ///< with their marks; other lines before the names are made comments
  std::string names_line;  ///< as it stands; empty if the names are in a comment, or not given
  bool named = false;      ///< there are names
  Layout layout;
};

/// Reads up to the first record, which is then the present line, and chooses the dialect by it.
/// `order` names the columns of a file without names; `run` picks one of several side by side, or
/// is empty; with `one_run` the line is one record, whatever its names say. Throws InputError.
Header read_header(Lines&, Dialect&, const std::vector<std::string>& order, const std::string& run,
                   bool one_run);

/// The names in a line that is no comment.
std::vector<std::string> names_in(std::string_view line, Dialect&);

}  // namespace rolling
