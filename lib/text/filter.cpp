#include "text/filter.h"

#include <algorithm>
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
  for (const std::string& text : in_.comments()) out_.text(text), out_.end_line();
  out_.text(history_), out_.end_line();
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
  hold();
  if (!in_.next()) return false;
  if (in_.history_changed() && header_written_) comment(history_);
  text_ = in_.text(cut_, present_.first, present_.last);
  present_.size = text_.size();
  if (cut_ == npos) present_.first = present_.last = present_.size;
  present_waits_ = true;
  return true;
}

/// The text of the present record goes with the next one.
void Filter::hold() {
  if (!std::exchange(present_waits_, false)) return;
  held_ += text_;
  rows_.push_back(present_);
}

void Filter::comment(std::string_view text) {
  held_ += text;
  rows_.push_back({Kind::comment, text.size()});
  if (rows_.size() - front_ == 1) clear_front();
}

/// Comments that no record holds back any more go out, dropped records go away.
void Filter::clear_front() {
  while (header_written_ && front_ < rows_.size() && rows_[front_].kind != Kind::record) {
    if (rows_[front_].kind == Kind::comment) {
      write_break();
      out_.text({held_.data() + front_begin_, rows_[front_].size});
      out_.end_line();
    } else {
      ++gone_;
    }
    remove_row();
  }
}

void Filter::drop(std::size_t i) {
  hold();
  auto row = rows_.begin() + static_cast<std::ptrdiff_t>(front_);
  for (std::size_t records = gone_; row->kind == Kind::comment || records++ < i;) ++row;
  row->kind = Kind::dropped;
  any_dropped_ = true;
  clear_front();
}

void Filter::write_break() {
  if (std::exchange(break_due_, false)) out_.end_line();
}

void Filter::remove_row() {
  front_begin_ += rows_[front_++].size;
  if (front_ == rows_.size()) {
    rows_.clear();
    held_.clear();
    front_ = front_begin_ = 0;
  } else if (front_ >= 1024 && 2 * front_ > rows_.size()) {  // amortised: at most one move a row
    rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(front_));
    held_.erase(0, front_begin_);
    front_ = front_begin_ = 0;
  }
}

void Filter::put(double value) {
  const bool waited = !rows_.empty();
  const Row& row = waited ? rows_[front_] : present_;
  const char* const text = waited ? held_.data() + front_begin_ : text_.data();
  if (numbers_++ == 0) {
    write_break();
    out_.text({text, row.first});
  }
  if (appended_ > 0) out_.text('\t');
  out_.number(value);
  if (numbers_ < appended_) return;
  if (row.last < row.size) out_.text({text + row.last, row.size - row.last});
  out_.end_line();
  numbers_ = 0;
  any_row_ = true;
  ++gone_;
  if (waited) {
    remove_row();
    if (!rows_.empty() && rows_[front_].kind != Kind::record) clear_front();
  } else {
    present_waits_ = false;
  }
}

}  // namespace rolling
