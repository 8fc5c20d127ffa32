// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of a run: Reader::next() and what it calls.
#include "text/reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/enumeration.h"
#include "text/number.h"

namespace rolling {
namespace {

/// Why a field is refused that is no number, and what to do.
std::string not_a_number(std::string_view text, bool is_time) {
  const bool digits =  // not of #DIV/0!
      !text.starts_with('#') && text.find_first_of(decimal_digits) != std::string_view::npos;
  if (!digits)
    return "is not a number; write NaN for a missing reading, # before a line that is no row, and "
           "a blank line before another run";
  if (is_time && text.find(':') != std::string_view::npos)
    return "is no time, or of another form than those before it; write it as 12:34:56.7, 1:02.5 or "
           "2026-11-24T12:34:56.7Z";
  return "is not a number; write it with digits and a decimal point alone";
}

}  // namespace

/// Goes to the next line of this run that is a row; false at its end.
bool Reader::next_line() {
  while (lines_->next()) {
    const LineKind kind = lines_->kind();
    if (kind == LineKind::row) return true;
    if (kind == LineKind::comment) {
      const std::string_view comment = lines_->text().substr(lines_->text().find('#'));
      if (are_names(comment))
        fail<InputError>(
            "{}: names among the rows; if another run begins here, put a blank line before it",
            here());
      if (side_ == 0) remarks_.emplace_back(comment);
    } else {
      if (kind == LineKind::history) {  // it belongs to the run below it
        refuse_error_line(*lines_);
        lines_->put_back();
      }
      break;
    }
  }
  state_ = State::between;
  return false;
}

/// True for a comment that has a name for each column, if two of them are known or those of this
/// run.
bool Reader::are_names(std::string_view comment) const {
  const std::vector<Column>& columns = layout().columns;
  return names_in_comment(comment, {columns.size(), !head_.named, columns}).known >=
         std::min<std::size_t>(2, columns.size());
}

bool Reader::next() {
  remarks_.clear();
  if (state_ != State::in_run) return false;
  for (;;) {
    // Most lines are rows that are found and split in one pass.
    if (const char* const end = dialect_.split_plain(lines_->ahead(), fields_)) {
      lines_->take_to(end);
    } else if (next_line()) {
      fields_ = located([&] { return here(); }, [&] { return dialect_.split(lines_->text()); });
    } else {
      left_out_ -= std::exchange(blank_rows_, 0);
      return false;
    }
    if (take_row()) return row_found_ = true;
    ++left_out_;
  }
}

/// Leaves of the fields of a line those of the present run. A line may have a separator at its end;
/// with runs side by side it may end early. Refuses any other number of fields. False if all that
/// this run does not share is blank: where no reading follows, beside a longer run, that is no row.
bool Reader::take_fields() {
  const std::size_t width = head_.layout.width();
  const bool side_by_side = head_.layout.side_by_side();
  if (fields_.size() == width + 1 && fields_.back().text.empty()) fields_ = fields_.first(width);
  const std::size_t count = fields_.size();
  if (side_by_side ? count > width : count != width)
    fail<InputError>("{}: {} where the first row has {}{}", here(), counted(count, "field"), width,
                     count > width && dialect_.separator() == ','
                         ? "; if some of its commas are decimal ones, make them points first"
                         : "");
  if (!side_by_side) return true;
  changed_fields_.clear();
  bool blank = true;
  for (const std::size_t i : layout().fields) {
    changed_fields_.push_back(i < count ? fields_[i] : Field());
    blank &= head_.layout.shared[i] || changed_fields_.back().text.empty();
  }
  fields_ = changed_fields_;
  if (blank) {
    ++blank_rows_;
    return false;
  }
  if (std::exchange(blank_rows_, 0) > 0 && options_.strict)
    fail<InputError>("{}: the readings of the row above are missing", here());
  return true;
}

/// The number in a needed column of the present row [SI]; NaN for a missing reading.
inline double Reader::read(const NeededColumns::Needed& needed) {
  if (needed.column == no_column) return std::numeric_limits<double>::quiet_NaN();
  const Field& field = fields_[needed.column];
  if (std::isnan(field.number) || !needed.clock.empty()) return read_text(needed);
  if (!needed.to_si.changes()) return field.number;
  const double value = needed.to_si(field.number);
  if (!std::isfinite(value) && needed.kind != NeededColumns::Kind::beside)
    refuse(needed, "is beyond the range of a double in SI units");
  return value;
}

/// The same for a cell that is no number alone: a time of a clock, or a missing reading.
double Reader::read_text(const NeededColumns::Needed& needed) {
  const std::string_view text = fields_[needed.column].text;
  if (is_missing(text)) {
    if (options_.strict && needed.kind < NeededColumns::Kind::wanted)
      refuse(needed, "is a missing reading");
    return std::numeric_limits<double>::quiet_NaN();
  }
  const bool is_time = needed.quantity == "t";
  if (is_time && !needed.to_si.changes())
    if (const auto time =
            clock_.seconds(needed.clock == digits_of_clock ? with_colons(text) : std::string(text)))
      return *time;
  if (needed.kind == NeededColumns::Kind::beside) return std::numeric_limits<double>::quiet_NaN();
  if (text == layout().columns[needed.column].written)
    refuse(needed, "is the header again; put a blank line before it, or give the files one by one");
  refuse(needed, not_a_number(text, is_time));
}

/// Reads the needed numbers of the row; false if one is missing.
inline bool Reader::take_row() {
  const bool all_are_of_run =
      fields_.size() == head_.layout.width() && !head_.layout.side_by_side();
  if (!all_are_of_run && !take_fields()) return false;
  double* to = values_.data();
  for (const NeededColumns::Needed& needed : needed_.all()) {
    *to = read(needed);
    if (std::isnan(*to++) && needed.kind < NeededColumns::Kind::wanted) return false;
  }
  if (time_slot_ != no_column) check_time(needed_.all()[time_slot_], values_[time_slot_]);
  return true;
}

inline void Reader::check_time(const NeededColumns::Needed& needed, double t) {
  const bool by_clock = std::isnan(fields_[needed.column].number) || !needed.clock.empty();
  if (by_clock != reads_clock_ && !std::isnan(last_time_))
    refuse(needed, "is of another form than the times before it");
  reads_clock_ = by_clock;
  if (t == last_time_ && options_.equal_times != EqualTimes::refused) {
    ++equal_times_;
    return;
  }
  if (t <= last_time_) {
    std::string way_out = "put a blank line before another run, or say --use t=COLUMN";
    if (std::isnan(last_step_))
      way_out = "if all times fall, sort the rows by time; else " + way_out;
    if (t == last_time_)
      way_out = "smooth --equal-times mean (or first) makes one row of rows of one time";
    if (t == last_time_ && !needed_.assumed().empty())
      way_out = "if the times are in another column, --use t=COLUMN; else " + way_out;
    refuse(needed, fmt::format("does not come after {}{}; {}", last_time_,
                               needed.to_si.changes() || by_clock ? " s" : "", way_out));
  }
  note_jump(needed, t);
  // The roundings of two times, 2^-53 t each, are then more than 2^-13 of the step between them; or
  // the times are beyond 3000 years, where milliseconds since 1970 are.
  large_time_ |= t - last_time_ < 0x1p-39 * std::abs(t) || std::abs(t) > 1e11;
  last_time_ = t;
}

/// Notes times that jump as the digits hhmmss of a clock do at the end of a minute or an hour.
inline void Reader::note_jump(const NeededColumns::Needed& needed, double t) {
  const double step = t - last_time_;
  const double jump = step - last_step_;  // 59 s is followed by 100, and 5959 by 10000
  const bool of_minute = std::abs(jump - 40) < last_step_ / 2;
  const bool of_hour = std::abs(jump - 4040) < last_step_ / 2;
  const bool may_be_digits =
      !reads_clock_ && !needed.to_si.changes() && jump_.empty() && last_step_ < 10;
  if ((of_minute || of_hour) && may_be_digits &&
      std::abs(std::fmod(last_time_ + last_step_, 100) - 60) < 1.5 * last_step_)
    jump_ = fmt::format(
        "the times jump from {} to {} where their step is {:.3g}: if they are digits of a clock, "
        "write [hhmmss] behind the name of their column, or say --use 't={}[hhmmss]'",
        last_time_, t, last_step_, needed.column + 1);
  last_step_ = step;
}

std::size_t Reader::append_text(Bytes& to, std::size_t column) {
  const std::vector<NeededColumns::Needed>& needed = needed_.all();
  const std::size_t begin = to.size();
  std::size_t place = no_column;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (i) to.push_back('\t');
    if (i == column) {
      place = to.size() - begin;
      continue;
    }
    const auto is_it = [&](const auto& one) {
      return one.column == i && (one.to_si.changes() || (reads_clock_ && one.quantity == "t"));
    };
    const auto slot =
        static_cast<std::size_t>(std::ranges::find_if(needed, is_it) - needed.begin());
    if (slot < needed.size() && !std::isnan(values_[slot])) append_number(to, values_[slot]);
    else if (std::isnan(fields_[i].number)) append_field(to, fields_[i].text);
    else to.append(fields_[i].text);
  }
  return std::min(place, to.size() - begin);
}

void Reader::refuse(const NeededColumns::Needed& needed, std::string_view why) const {
  fail<InputError>("{}: field {} ({}): '{}' {}", here(), layout().fields[needed.column] + 1,
                   shown(needed.quantity), shown(fields_[needed.column].text), why);
}

std::vector<std::string> Reader::warnings() const {
  std::vector<std::string> all;
  if (!needed_.assumed().empty()) all.push_back(needed_.assumed());
  if (large_time_)
    all.emplace_back(
        "the times are so large that the time between rows loses digits: subtract the first; if "
        "they are in ms, us or ns, write that in brackets behind the name of their column");
  if (!jump_.empty()) all.push_back(jump_);
  if (equal_times_ > 0)
    all.push_back(fmt::format("{} joined with the row before of the same time",
                              counted(equal_times_, "row")));
  return all;
}

std::string Reader::here() const { return fmt::format("{}:{}", lines_->name(), lines_->number()); }

std::string Reader::where() const {
  if (state_ == State::between) return place_;
  return state_ == State::in_run ? here() : std::string();
}

}  // namespace rolling
