// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/filter.h"

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace rolling {
namespace {

/// The lines of `comments` that do not begin with ##.
std::string remarks_of(const std::string& comments) {
  std::string remarks;
  for (std::size_t at = 0; at < comments.size();) {
    const auto end = comments.find('\n', at) + 1;
    if (comments.compare(at, 2, "##") != 0) remarks.append(comments, at, end - at);
    at = end;
  }
  return remarks;
}

}  // namespace

Filter::Filter(Reader& in, Output& out, std::string history)
    : in_(in), out_(out), history_(history.empty() ? "" : "## " + std::move(history) + '\n'),
      enough_(rows_at_once()) {}

Filter::~Filter() {
  try {
    if (!writing_) write_rows();
  } catch (...) {  // the error that ended the work is reported, not this one
  }
}

void Filter::append(Column column) {
  appended_.push_back(std::move(column));
  enough_ = rows_at_once() * appended_.size();
}

/// The columns of the present run in the output.
std::vector<Column> Filter::columns() const {
  std::vector<Column> all = in_.columns();
  for (const Column& column : appended_) {
    for (Column& old : all)
      if (old.name == column.name) old.name = free_name(all, old.name);
    all.push_back(column);
  }
  return all;
}

/// The head of the present run waits like a row.
void Filter::take_head() {
  std::string comments;
  for (const std::string& comment : in_.comments()) (comments += comment) += '\n';
  if (in_.renames() && !in_.history().empty()) comments += fmt::format("## {}\n", columns_renamed);
  above_.push({read_, std::move(comments), names_line(columns())});
  if (replaced_ != Reader::no_column) cut_ = in_.column_of(replaced_);
}

void Filter::take_remarks(const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) above_.push({read_, remark, {}});
  if (!remarks.empty()) write_rows();
}

bool Filter::next_run() {
  write_rows();
  run_begins_ = read_;
  if (in_.next_run()) {
    take_head();
    return true;
  }
  if (!any_row_) fail("no rows are left{}", why_none_ ? why_none_() : "");
  take_remarks(in_.comments());
  out_.text(remarks_of(comments_));
  return false;
}

bool Filter::next() {
  const bool more = in_.next();
  if (!in_.remarks().empty()) take_remarks(in_.remarks());
  if (!more) return false;
  const std::size_t begin = texts_.size(), place = in_.append_text(texts_, cut_);
  rows_.append(
      {static_cast<std::uint32_t>(texts_.size() - begin), static_cast<std::uint32_t>(place)});
  ++read_;
  return true;
}

void Filter::drop(std::size_t i) {
  dropped_.push(run_begins_ + i);
  write_rows();
}

/// Writes the head of a run before its first row. The comments of a run without rows are written
/// with the head of the next run.
void Filter::write_head() {
  if (names_.empty()) return;
  if (any_row_) out_.end_line();
  out_.text(std::exchange(comments_, {}));
  out_.text(history_);
  out_.text(std::exchange(names_, {})), out_.end_line();
}

/// Writes a row with its numbers, which are finite, at this place of its text.
inline void Filter::write_row(std::string_view text, std::size_t place,
                              std::span<const double> numbers) {
  char* to = out_.reserve(text.size() + numbers.size() * (1 + longest_number));
  to = std::copy_n(text.begin(), place, to);
  for (const double number : numbers) {
    if (!appended_.empty()) *to++ = '\t';
    to = write_number(to, number, out_.digits);
  }
  out_.set_end(std::copy(text.begin() + static_cast<std::ptrdiff_t>(place), text.end(), to));
  out_.end_line();
}

/// Writes the remarks above the next row, unless a head waits for a row of its run.
void Filter::take_above() {
  for (; !above_.empty() && above_.front().row == done_; above_.pop()) {
    const Above& above = above_.front();
    if (!above.names.empty())
      comments_ = remarks_of(comments_) + above.comments, names_ = above.names;
    else if (!names_.empty()) (comments_ += above.comments) += '\n';
    else out_.text(above.comments), out_.end_line();
  }
}

/// Writes all rows before the first one that lacks a number.
void Filter::write_rows() {
  writing_ = true;
  const std::size_t each = std::max<std::size_t>(appended_.size(), 1);
  std::span<const double> numbers(numbers_.data(), numbers_.size());
  for (take_above(); first_ < rows_.size(); take_above()) {
    const Row& row = rows_[first_];
    if (!dropped_.empty() && dropped_.front() == done_) {
      dropped_.pop();
    } else {
      if (numbers.size() < each) break;
      write_head();
      write_row({texts_.data() + front_, row.size}, row.place, numbers.first(each));
      numbers = numbers.subspan(each);
      any_row_ = true;
    }
    front_ += row.size;
    ++first_, ++done_;
  }
  numbers_.erase_front(numbers_.size() - numbers.size());
  // Amortised, each row is moved at most once.
  if (2 * first_ >= rows_.size()) {
    rows_.erase_front(std::exchange(first_, 0));
    texts_.erase_front(std::exchange(front_, 0));
  }
  writing_ = false;
}

}  // namespace rolling
