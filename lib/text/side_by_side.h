// Runs that stand side by side, taken apart: each becomes records of its own, one under another.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "text/bytes.h"
#include "text/dialect.h"
#include "text/layout.h"
#include "text/lines.h"

namespace rolling {

/// The tab-separated lines of one of the runs, and the comments that stood among them.
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
  friend std::vector<Side> take_apart(Lines&, Dialect&, const Layout&, const std::vector<bool>&);
  struct Entry {
    std::size_t number, begin, end;
    LineKind kind;
  };
  void take(LineKind, std::size_t number);

  Bytes text_;
  std::vector<Entry> lines_;
  std::size_t with_readings_ = 0;  // lines up to the last that is no padding
};

/// Reads the records up to a blank line, a history line or the end of the file, and gives those of
/// each run that is `wanted`. A run ends with its last reading: the blanks below it, which longer
/// runs leave beside them, are no records. Throws InputError for a line with more fields than there
/// are names.
std::vector<Side> take_apart(Lines&, Dialect&, const Layout&, const std::vector<bool>& wanted);

}  // namespace rolling
