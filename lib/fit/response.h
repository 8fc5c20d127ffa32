// The columns of a run as linear maps of the one raw column that the sensor recorded.
#pragma once

#include "fit/filter.h"
#include "fit/filter_matrix.h"

#include <map>
#include <string>

namespace rolling {

/// The matrix of a filter on these times, found by feeding it combs of unit impulses.
BandMatrix probe(const LinearFilter&, std::span<const double> t);

/// What a chain of filters makes of its one raw column.
struct Response {
  std::string source;     ///< the raw column; its noise is taken as white
  std::vector<double> t;  ///< times of the raw records: the run's, and those that were cut away
                          ///< after filters had used them
  /// Each column, the source included: a row for each record of the run.
  std::map<std::string, FilterMatrix> of;
};

/// Records that were cut away are taken as spaced like those at that end of the run. Throws Error
/// for a chain that starts from more than one raw column.
Response response_of(const FilterChain&, std::span<const double> t);

}  // namespace rolling
