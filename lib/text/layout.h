// Which fields of a line make a record: one run to a line, or several runs side by side.
#pragma once

#include <string>
#include <vector>

#include "text/column.h"

namespace rolling {

struct Layout {
  struct Run {
    std::string
        label;  ///< what its names print: 2 for `Run #2`, Latest for `Latest:`; may be empty
    std::vector<std::size_t> fields;  ///< where its columns stand in a line
    std::vector<Column> columns;
  };
  std::vector<Run> runs;
  std::size_t width = 0;     ///< fields of a line
  std::vector<bool> shared;  ///< fields that belong to every run
  bool side_by_side() const { return runs.size() > 1; }

  /// One run, whatever the names say.
  static Layout one(const std::vector<Column>& line);
  /// From the columns of a names line. They stand for several runs if they print more than one
  /// label, or if there is more than one t; a column without a label, or that stands but once, is
  /// shared.
  static Layout of(const std::vector<Column>& line);
};

}  // namespace rolling
