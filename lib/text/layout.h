// SPDX-License-Identifier: GPL-3.0-or-later
// The fields of a line that form a row: those of one run, or of several runs side by side.
#pragma once

#include <string>
#include <vector>

#include "text/column.h"

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

}  // namespace rolling
