#include "text/filter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"

namespace rolling {
namespace {
constexpr std::size_t npos = static_cast<std::size_t>(-1);
}

Filter::Filter(Reader& in, Output& out, std::string history)
    : in_(in), out_(out), columns_(in.columns()) {
  if (!history.empty()) history_ = "## " + std::move(history);
  in_.on_comment = [this](std::string_view text) { comment(text); };
}

void Filter::tell(std::string history) {
  history_ = "## " + std::move(history);
  write_header();
  clear_front();
}

void Filter::append(Column column) {
  const auto taken = [this](const std::string& name) {
    return std::any_of(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == name; });
  };
  for (Column& old : columns_)
    if (old.name == column.name) {
      std::string name = old.name;
      do name += "_in";
      while (taken(name));
      old.name = name;
    }
  columns_.push_back(std::move(column));
  ++appended_;
}

void Filter::write_header() {
  for (const std::string& text : in_.comments()) (out_.line() += text), out_.end_line();
  (out_.line() += history_), out_.end_line();
  out_.names(columns_);
  header_written_ = true;
}

bool Filter::next_run() {
  if (!header_written_ && !history_.empty()) write_header();
  break_due_ = any_row_;
  gone_ = 0;
  if (in_.next_run()) return true;
  if (!any_row_ && any_dropped_) fail("no records are left");
  if (!any_row_) fail("no records: a needed reading is missing in every one");
  return false;
}

bool Filter::next() {
  if (!in_.next()) return false;
  if (in_.history_changed() && header_written_) comment(history_);
  const std::size_t from = held_.size();
  std::size_t first = 0, last = 0;
  in_.copy(held_, cut_, first, last);
  hold(from, first, last, Kind::record);
  return true;
}

void Filter::hold(std::size_t from, std::size_t first, std::size_t last, Kind kind) {
  rows_.push_back({held_.size() - from, first - from, last - from, kind});
}

void Filter::comment(std::string_view text) {
  const std::size_t from = held_.size();
  held_ += text;
  hold(from, from, from, Kind::comment);
  if (rows_.size() - first_row_ == 1) clear_front();
}

/// Comments that no record holds back any more go out, dropped records go away.
void Filter::clear_front() {
  while (header_written_ && first_row_ < rows_.size() && rows_[first_row_].kind != Kind::record) {
    if (rows_[first_row_].kind == Kind::comment) {
      write_break();
      out_.line().append(held_, first_byte_, rows_[first_row_].size);
      out_.end_line();
    } else {
      ++gone_;
    }
    remove_row();
  }
}

void Filter::drop(std::size_t i) {
  auto row = rows_.begin() + static_cast<std::ptrdiff_t>(first_row_);
  for (std::size_t records = gone_; row->kind == Kind::comment || records++ < i;) ++row;
  row->kind = Kind::dropped;
  any_dropped_ = true;
  clear_front();
}

/// The oldest record goes out up to its first number.
void Filter::begin_row() {
  write_break();
  const Row& row = rows_[first_row_];
  out_.line().append(held_, first_byte_, cut_ == npos ? row.size : row.first);
}

void Filter::write_break() {
  if (std::exchange(break_due_, false)) out_.end_line();
}

void Filter::remove_row() {
  first_byte_ += rows_[first_row_++].size;
  if (first_row_ == rows_.size()) {
    rows_.clear();
    held_.clear();
    first_row_ = first_byte_ = 0;
  } else if (first_row_ > 1024 && 2 * first_row_ > rows_.size()) {  // amortised: at most one move a row
    rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(first_row_));
    held_.erase(0, first_byte_);
    first_row_ = first_byte_ = 0;
  }
}

void Filter::put(double value) {
  if (!std::isfinite(value)) fail("the result is not a finite number");
  if (numbers_ == 0) begin_row();
  const Row row = rows_[first_row_];
  if (cut_ != npos) {
    out_.number(value);
    out_.line().append(held_, first_byte_ + row.last, row.size - row.last);
  } else {
    out_.line() += '\t';
    out_.number(value);
    if (++numbers_ < appended_) return;
  }
  numbers_ = 0;
  any_row_ = true;
  out_.end_line();
  remove_row();
  ++gone_;
  clear_front();
}

}  // namespace rolling
