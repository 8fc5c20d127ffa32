// SPDX-License-Identifier: GPL-3.0-or-later
// The columns of a run as linear functions of the one raw column that the sensor recorded.
#pragma once

#include "noise/filter.h"
#include "noise/filter_matrix.h"

#include <map>
#include <string>

namespace rolling {

/// The matrix of a filter for rows at the times t, measured as its response to combs of unit
/// impulses. Throws Error if the filter does not return one value for each row.
BandMatrix probe(const LinearFilter&, std::span<const double> t);

/// The response of a chain of filters to its raw column.
struct Response {
  std::string source;  ///< name of the raw column, whose noise is assumed white
  /// The matrix of each column, the raw one included: one row for each reading of the run.
  std::map<std::string, FilterMatrix> of;
};

/// The response of a chain on the times t of a run. Throws Error for a chain that starts from more
/// than one raw column.
Response response_of(const FilterChain&, std::span<const double> t);

}  // namespace rolling
