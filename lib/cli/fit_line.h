// SPDX-License-Identifier: GPL-3.0-or-later
// The `##` line of fitpower: of what its rows were made.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "contact/law.h"
#include "fit/input.h"
#include "text/reader.h"

namespace rolling {

/// The line of fitpower above its rows: `fitpower VERSION ROUTE [LAW] K 0.5+-0.005 R 0.04 g 9.81
/// slope 0 [wind 0] [exact]`, with a list where the runs differ, and `slope fit` where the slope is
/// in the rows. Without the numbers if those of a run are not known.
std::string line_of_fit(const std::string& route, const FitOptions&,
                        const std::vector<std::optional<ShiftOf>>& of_runs);

/// The body, the slope and the geometry behind each of `rows` rows, as told by the line of
/// fitpower above them; NaN for a slope and a wind that are in the rows. None if there is no such
/// line, if it has no numbers, or if its numbers are those of more runs than rows. Throws Error for
/// a line that fitpower does not write.
std::vector<ShiftOf> contacts_of_rows(const std::vector<std::string>& lines, std::size_t rows);

/// The same for the rows of a run of the file that a reader reads. Rows without numbers, of runs
/// that were not fitted, have a place in the line too, and are passed over by the reader.
class ContactsOfRun {
 public:
  explicit ContactsOfRun(const Reader& in) : in_(in), left_out_(in.left_out()) {}
  /// Notes the present row.
  void take_row() { places_.push_back(places_.size() + in_.left_out() - left_out_); }
  /// One for each row that was noted, behind the last row of the run; none if they are not known.
  std::vector<ShiftOf> contacts() const {
    const auto all = contacts_of_rows(in_.history(), places_.size() + in_.left_out() - left_out_);
    std::vector<ShiftOf> of_rows;
    for (const std::size_t place : places_)
      if (!all.empty()) of_rows.push_back(all[place]);
    return of_rows;
  }

 private:
  const Reader& in_;
  std::size_t left_out_;
  std::vector<std::size_t> places_;
};

}  // namespace rolling
