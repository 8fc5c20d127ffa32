// Which fields of a line make a record: one run to a file, or several runs side by side.
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
  };
  std::vector<Column> columns;  ///< of each run
  std::vector<Run> runs;
  std::size_t width = 0;     ///< fields of a line
  std::vector<bool> shared;  ///< fields that belong to every run
  bool side_by_side =
      false;  ///< the names line stands for several runs, though --run may have picked one

  /// One run, whatever the names say.
  static Layout one(const std::vector<Column>& line);
  /// From the columns of a names line. They stand for several runs if they print more than one
  /// label, or if each has its own t; a column without a label, or that stands but once, is shared.
  /// Throws Error where the runs differ in their columns, unless `run` picks one: by its label,
  /// else by its place.
  static Layout of(const std::vector<Column>& line, const std::string& run);
};

}  // namespace rolling
