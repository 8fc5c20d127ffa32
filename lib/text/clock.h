// SPDX-License-Identifier: GPL-3.0-or-later
// Times as clocks show them: 12:34:56.789, 1:02.5 (min:s), 2026-11-24T12:34:56+01:00.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rolling {

/// True for a unit that describes a clock: `hh:mm:ss`, `mm:ss.fff`, `HHMMSS`.
bool is_clock_unit(std::string_view unit);

/// The unit of a clock whose hours, minutes and seconds are digits of one number: 101259.5
inline constexpr std::string_view digits_of_clock = "hhmmss";
/// Such a number as `10:12:59.5`; zeros at its beginning may be missing. Any other text as it is.
std::string with_colons(std::string_view digits);

/// The times of a run, one after the other.
class Clock {
 public:
  /// The seconds since the midnight before the first time; of min:s, since 0. A clock without a
  /// date that passes midnight goes on. Before a clock may stand a date of ISO 8601, or another one
  /// that is the same in all rows. Nothing for a text that is no such time, or is of another form
  /// than the first one.
  std::optional<double> seconds(std::string_view text);

 private:
  struct Moment {
    // What the times of a run have in common: the words of a day, T for a date of ISO 8601, a colon
    // for each part of the clock, Z for an offset.
    std::string form = {};
    bool begins_anew = false;        // at midnight, without a date
    std::int64_t midnight = 0;       // before it, of its time zone; seconds since an epoch
    std::int64_t seconds = 0;        // whole ones since then
    std::string_view fraction = {};  // the digits of a part of a second
  };
  static std::optional<Moment> read(std::string_view text);

  std::string form_;           // empty before the first time
  std::int64_t midnight_ = 0;  // before it
  std::int64_t last_ = 0;      // whole seconds since then
};

}  // namespace rolling
