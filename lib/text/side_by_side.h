// Separates runs that are side by side in a file: each becomes a list of records.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "text/bytes.h"
#include "text/dialect.h"
#include "text/layout.h"
#include "text/lines.h"

namespace rolling {

/// The tab-separated lines of one of the runs, and the comments among them.
class Side {
 public:
  struct Line {
    std::string_view text;
    std::size_t number;  ///< in the file
    LineKind kind;
  };
  std::size_t size() const { return lines_.size(); }
  Line operator[](std::size_t i) const;

 private:
  friend std::vector<Side> take_apart(Lines&, Dialect&, const Layout&);
  struct Entry {
    std::size_t number, begin, end;
    LineKind kind;
  };
  void take(LineKind, std::size_t number);

  Bytes text_;
  std::vector<Entry> lines_;
  std::size_t with_readings_ = 0;  // number of lines up to the last one with a reading
};

/// Reads up to a blank line, a history line or the end of the file, and returns the records of each
/// run. A run ends with its last reading: blank cells below it, beside a longer
/// run, are not records. Throws InputError for a line with more fields than there are names.
std::vector<Side> take_apart(Lines&, Dialect&, const Layout&);

}  // namespace rolling
