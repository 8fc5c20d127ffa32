// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/enumeration.h"
#include "text/delimiters.h"
#include "text/number.h"

namespace rolling {
namespace {

/// Why a field is refused that is no number, and what to do.
std::string not_a_number(std::string_view text) {
  const bool digits =  // not of #DIV/0!
      !text.starts_with('#') && text.find_first_of(decimal_digits) != std::string_view::npos;
  return std::string("is not a number; ") +
         (digits ? "write it with digits and a decimal point alone, a time in seconds"
                 : "write NaN for a missing reading, # before a line that is no row, and a blank "
                   "line before another run");
}

}  // namespace

Reader::Reader(ReaderOptions options, std::vector<std::string> order)
    : options_(std::move(options)), needed_(options_.use, options_.has_use),
      order_(needed_.names_without_use(std::move(order))) {
  if (options_.files.empty()) options_.files = {"-"};
  find_run();
}

// Runs: which one is read, its name, and its head.

/// True if the present run is to be read: by the number in its header or at the end of its name,
/// which is the same behind a tool (2 of `NAME roll 2 of 6`), else by its place.
bool Reader::asked_for() {
  std::string number = layout().label;
  if (!is_number(number)) number = run_is_named() ? run_name() : "";
  if (number.find(" roll ") != std::string::npos)
    number.erase(std::min(number.size(), number.rfind(" of ")));
  number.erase(0, number.rfind(' ') + 1);
  const auto is_label = [](const Layout::Run& run) { return is_number(run.label); };
  if (!is_whole(number)) {
    if (std::ranges::any_of(head_.layout.runs, is_label)) return false;
    number = fmt::format("{}", run_);
  }
  add_item(runs_, number);
  return number == fmt::format("{}", *options_.run);
}

bool Reader::next_run() {
  if (state_ == State::in_run)
    while (next_line()) continue;
  bool passed = false;
  while (state_ == State::found || find_run()) {
    state_ = State::in_run;
    if (!options_.run) return true;
    if (asked_for()) {
      if (run_found_)
        fail<InputError>("{}:{}: another run {}; give the file of one of them alone",
                         lines_->name(), head_.line, *options_.run);
      return run_found_ = true;
    }
    const std::pair kept(left_out_, row_found_);
    while (next()) continue;
    std::tie(left_out_, row_found_) = kept;
    passed = true;
  }
  if (passed) comments_.clear();  // of the run that was passed over last
  return false;
}

/// Goes to the next run, and reads its head.
bool Reader::find_run() {
  remarks_.clear();
  comments_.clear();
  place_.clear();
  if (state_ != State::ended && next_head()) {
    begin_run();
    return true;
  }
  state_ = State::ended;
  if (options_.run && !run_found_) fail("there is no run {} (runs: {})", *options_.run, runs_);
  if (left_out_ > 0 && !row_found_)
    fail<InputError>("{}no rows: a needed reading is missing in every one",
                     options_.files.size() == 1 ? lines_->name() + ": " : "");
  return false;
}

/// Reads the head of the next run. Comments behind the last run of a file are added to those of the
/// next run.
bool Reader::next_head() {
  if (file_open_ && side_ + 1 < head_.layout.runs.size()) {
    ++side_;
    return true;
  }
  // Column numbers in --use count the fields of a line: the line is then one row.
  const Sides sides = needed_.use_has_numbers() ? Sides::one : Sides::by_names;
  while (file_open_ || next_file()) {
    const bool first = run_in_file_ == 0;
    Head head = read_head(*lines_, dialect_, first ? nullptr : &head_, order_, sides);
    if (!head.layout.runs.empty()) {
      take_head(std::move(head));
      return true;
    }
    for (std::string& comment : head.comments) {
      if (!head_.named && are_names(comment))
        fail<InputError>(
            "{}: the names of the columns stand behind the last row; put them above the first",
            lines_->name());
      if (!is_history(comment)) comments_.push_back(std::move(comment));
    }
    file_open_ = false;
  }
  return false;
}

bool Reader::next_file() {
  if (next_file_ == options_.files.size()) return false;
  run_in_file_ = 0;
  lines_.emplace(options_.files[next_file_++]);
  return file_open_ = true;
}

void Reader::take_head(Head head) {
  const std::size_t width = head.layout.width, before = head_.layout.width;
  if (run_in_file_ == 0 && next_file_ > 1 && !head.named && (head_.named || width != before))
    fail<InputError>("{}: its columns are not those of {}: {}; give it a header", lines_->name(),
                     options_.files.front(),
                     head_.named ? "those have names" : fmt::format("{}, not {}", width, before));
  head_ = std::move(head);
  side_ = 0;
}

/// True if the file has several runs.
bool Reader::one_of_several() const {
  return head_.layout.side_by_side() || run_in_file_ > 1 || lines_->another_run();
}

/// True if there are several runs, or if the run has a name or a number in the input.
bool Reader::run_is_named() const {
  return !head_.run.empty() || is_number(layout().label) || options_.files.size() > 1 ||
         one_of_several();
}

std::string Reader::run_name() const {
  if (!head_.run.empty()) return head_.run;
  const std::string& file = options_.files[next_file_ - 1];
  std::string name = file == "-" ? "" : file.substr(file.rfind('/') + 1);
  for (char& c : name)
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  name = trim(name);
  const std::string& label = layout().label;
  if (!label.empty()) name += ' ' + label;
  else if (name.empty()) name = fmt::format("{}", run_);
  else if (one_of_several()) name += fmt::format(" {}", run_in_file_);
  return std::string(trim(name));
}

/// Prepares for the rows of the run whose head has been read.
void Reader::begin_run() {
  ++run_;
  ++run_in_file_;
  blank_rows_ = 0;
  last_time_ = std::numeric_limits<double>::quiet_NaN();
  if (head_.layout.side_by_side()) {
    lines_->put_back();
    lines_->hold(side_ + 1 < head_.layout.runs.size());
  }
  state_ = State::found;
  place_ = lines_->name();
  if (run_is_named()) {
    place_ = "run " + run_name();
    comments_.push_back("## " + place_);
  }
  for (const std::string& comment : head_.comments)
    if (side_ == 0 || is_history(comment)) comments_.push_back(comment);
  needed_.begin_run(layout().columns, head_.named, head_.said,
                    run_in_file_ > 1 || !head_.named
                        ? fmt::format("{}:{}", lines_->name(), head_.line)
                        : lines_->name());
  read_needed();
}

std::size_t Reader::add(std::string_view name, NeededColumns::Kind kind, std::string_view unit) {
  const std::size_t slot = needed_.add(name, kind, unit);
  if (kind != NeededColumns::Kind::as_is && needed_.all()[slot].quantity == "t") time_slot_ = slot;
  read_needed();
  return slot;
}

/// Declares to the dialect the fields whose numbers are read.
void Reader::read_needed() {
  values_.resize(needed_.all().size());
  dialect_.want_none();
  for (const NeededColumns::Needed& needed : needed_.all())
    if (needed.column != no_column) dialect_.want(layout().fields[needed.column]);
}

// Rows.

/// Goes to the next line of this run that is a row; false at its end.
bool Reader::next_line() {
  while (lines_->next()) {
    const LineKind kind = lines_->kind();
    if (kind == LineKind::row) return true;
    if (kind == LineKind::comment) {
      const std::string_view comment = lines_->text().substr(lines_->text().find('#'));
      if (state_ == State::in_run && are_names(comment))
        fail<InputError>(
            "{}: names among the rows; where another run begins, put a blank line before it",
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

/// True for a comment that has a name for each column, of which two are known ones or those of this
/// run.
bool Reader::are_names(std::string_view comment) const {
  const std::vector<Column>& columns = layout().columns;
  return names_in_comment(comment, {columns.size(), !head_.named, columns}).known >=
         std::min<std::size_t>(2, columns.size());
}

/// Fast path for most lines: a row of the same form as the one before it in this run is found
/// and split in one pass. False for any other line, which is left to next_line().
inline bool Reader::take_plain_line() {
  const std::string_view ahead = lines_->ahead();
  const char* const end = dialect_.split_plain(ahead, fields_);
  if (!end) return false;
  lines_->take(static_cast<std::size_t>(end - ahead.data()), *end == '\r' ? 2 : 1);
  return true;
}

bool Reader::next() {
  remarks_.clear();
  if (state_ != State::in_run) return false;
  for (;;) {
    if (!take_plain_line()) {
      if (!next_line()) return left_out_ -= std::exchange(blank_rows_, 0), false;
      fields_ = split();
    }
    if (take_row()) return row_found_ = true;
    ++left_out_;
  }
}

std::span<const Field> Reader::split() {
  try {
    return dialect_.split(lines_->text());
  } catch (const Error& error) {
    fail<InputError>("{}: {}", here(), error.what());
  }
}

/// Leaves of the fields of a line those of the present run. A line may have a separator at its end;
/// with runs side by side it may end early. Refuses any other number of fields. False if all that
/// this run does not share is blank: where no reading follows, beside a longer run, that is no row.
bool Reader::take_fields() {
  const std::size_t width = head_.layout.width;
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
  if (blank) return ++blank_rows_, false;
  if (std::exchange(blank_rows_, 0) > 0 && options_.strict)
    fail<InputError>("{}: the readings of the row above are missing", here());
  return true;
}

/// The number in a needed column of the present row [SI]; NaN for a missing reading.
inline double Reader::read(const NeededColumns::Needed& needed) const {
  if (needed.column == no_column) return std::numeric_limits<double>::quiet_NaN();
  const Field& field = fields_[needed.column];
  if (std::isnan(field.number)) {
    if (!is_missing(field.text)) refuse(needed, not_a_number(field.text));
    if (options_.strict && needed.kind != NeededColumns::Kind::wanted)
      refuse(needed, "is a missing reading");
    return field.number;
  }
  if (!needed.to_si.changes()) return field.number;
  const double value = needed.to_si(field.number);
  if (!std::isfinite(value)) refuse(needed, "is beyond the range of a double in SI units");
  return value;
}

/// Reads the needed numbers of the row; false if one is missing.
inline bool Reader::take_row() {
  fields_changed_ = fields_.size() != head_.layout.width || head_.layout.side_by_side();
  if (fields_changed_ && !take_fields()) return false;
  double* to = values_.data();
  for (const NeededColumns::Needed& needed : needed_.all()) {
    *to = read(needed);
    if (std::isnan(*to++) && needed.kind != NeededColumns::Kind::wanted) return false;
  }
  if (time_slot_ != no_column) check_time(needed_.all()[time_slot_], values_[time_slot_]);
  return true;
}

inline void Reader::check_time(const NeededColumns::Needed& needed, double t) {
  if (t <= last_time_)
    refuse(needed,
           fmt::format("does not come after {}{}{}", last_time_, needed.to_si.changes() ? " s" : "",
                       t < last_time_ ? "; put a blank line before another run" : ""));
  // The roundings of two times, 2^-53 t each, are then more than 2^-13 of the step between them; or
  // the times are beyond 3000 years, where milliseconds since 1970 are.
  large_time_ |= t - last_time_ < 0x1p-39 * std::abs(t) || std::abs(t) > 1e11;
  last_time_ = t;
}

/// append_text() of a row that is not written as it was read.
std::size_t Reader::append_made(Bytes& to, std::size_t column) {
  const std::vector<NeededColumns::Needed>& needed = needed_.all();
  const std::size_t begin = to.size();
  std::size_t place = no_column;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (i) to.push_back('\t');
    if (i == column) {
      place = to.size() - begin;
      continue;
    }
    const auto is_it = [i](const auto& one) { return one.column == i && one.to_si.changes(); };
    const auto converted = needed_.converts() ? std::ranges::find_if(needed, is_it) : needed.end();
    if (converted != needed.end() && !std::isnan(fields_[i].number))
      set_end(to, write_number(space(to, longest_number),
                               values_[static_cast<std::size_t>(converted - needed.begin())]));
    else if (dialect_.may_need_quotes()) append_field(to, fields_[i].text);
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
        "they are in ms or us, write that in brackets behind the name of their column");
  return all;
}

std::string Reader::here() const { return fmt::format("{}:{}", lines_->name(), lines_->number()); }

std::string Reader::where() const {
  if (state_ == State::between) return place_;
  return state_ == State::in_run ? here() : std::string();
}

}  // namespace rolling
