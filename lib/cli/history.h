// SPDX-License-Identifier: GPL-3.0-or-later
// The `##` lines, in which the tools describe what they did to the columns: the filters that these
// have gone through, and the bodies behind which numbers were made. And the filters that the
// software of a sensor may have applied.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "noise/run.h"
#include "text/column.h"

namespace rolling {

/// The column of a derivative: v of x, a of v, dNAME of any other.
Column derivative_of(const Column&);

/// The line of shift-from-accel: the numbers from which D was computed, with their uncertainties.
std::string line_of(const Body&);

/// The bodies in the line of fitpower above so many rows; NaN for a slope and a wind that are in
/// the rows. Empty if there is no such line, or if it has no numbers, or those of more runs than
/// rows. Throws Error for a line that fitpower does not write.
std::vector<Body> bodies_of_rows(const std::vector<std::string>& lines, std::size_t rows);

/// The content of the `##` lines of a run.
struct History {
  FilterChain filters = {};  ///< empty if the filters are not known
  std::optional<Body> shift_of = {};
  std::string doubt = {};    ///< the reason why the lines are not trusted; otherwise empty
  bool cut_begin = false;    ///< rows were removed at the begin after a filter
  bool cut_end = false;      ///< rows were removed at the end after a filter
  std::size_t left_out = 0;  ///< number of rows that give_filters() left out
};

/// The filters in the `##` lines of a run (smooth, differentiate, shift-from-accel), for rows at
/// times t [s]. Lines of other programs are ignored. The chain is unknown if there are no times or
/// if a filter is not linear. A line that names one of these tools but is not, word by word, what
/// the tool writes is not trusted.
History history_of(const std::vector<std::string>& lines, std::span<const double> t);

/// "K 0.6 (here 0.5)": the numbers that D was computed with, where those of the body are others, or
/// have an uncertainty that D's do not have; empty if there are none. A number of the body that is
/// NaN is not known.
std::string other_body(const std::optional<Body>& shift_of, const Body&);

/// Whether D was computed in the exact geometry: by the last line of shift-from-accel or of
/// simulate, if there is one.
std::optional<bool> shifts_are_exact(const std::vector<std::string>& lines);

/// True if, by the lines, D was computed from the derivative of the speeds in the file.
bool shifts_of_speeds(const std::vector<std::string>& lines);

/// The lines of windows through which v went, or the x whose derivative it is.
std::vector<std::string> windows_of_v(const std::vector<std::string>& lines);

/// True if some of the filters do not return what they read.
bool change_numbers(const FilterChain&);

/// Gives the run the filters of these columns, those that are fitted, as far as its columns are
/// what the filters make of each other, and as far as they were made of positions alone or of
/// speeds alone: of these alone a roll explains what filters make. If they differ only at an end,
/// rows were removed there after the filters, as the lines may tell, too: the readings whose
/// windows may have reached to them become NaN in x, v and D. If they differ elsewhere, or if fewer
/// than 10 readings of the columns that are fitted remain, the lines are not trusted. Returns the
/// history as far as it is.
History give_filters(History, Run&, const std::vector<Quantity>& columns);

/// The filters that the software of sensors may apply to speeds: the differences of positions to
/// the row before and to the row after (of spreadsheets, gates and encoders; where times are even,
/// those in the middle between them differ in the clock alone), the central one, and those of
/// Vernier's and PASCO's programs; and means of 2, 3 or 5 speeds, whose noise is similar to some of
/// these.
std::vector<LinearFilter> filters_of_sensors();

}  // namespace rolling
