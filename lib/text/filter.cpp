#include "text/filter.h"

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace rolling {
namespace {
constexpr std::size_t npos = static_cast<std::size_t>(-1);
}

Filter::Filter(Reader& in, Output& out, std::string history)
    : in_(in), out_(out), columns_(in.columns()), enough_(rows_at_once()) {
  if (!history.empty()) history_ = "## " + std::move(history);
  in_.on_comment = [this](std::string_view text) { comment(text); };
}

Filter::~Filter() {
  try {
    if (!writing_) write_rows();
  } catch (...) {  // an error is on its way already
  }
}

void Filter::tell(std::string history) {
  history_ = history.empty() ? "" : "## " + std::move(history);
  write_header();
  write_rows();
}

void Filter::append(Column column) {
  const auto taken = [this](const std::string& name) {
    return std::any_of(columns_.begin(), columns_.end(),
                       [&](const Column& c) { return c.name == name; });
  };
  for (Column& old : columns_)
    if (old.name == column.name) {
      std::string name = old.name;
      do name += "_in";
      while (taken(name));
      old.name = name;
    }
  columns_.push_back(std::move(column));
  enough_ = rows_at_once() * ++appended_;
}

void Filter::write_header() {
  for (const std::string& text : in_.comments()) out_.text(text), out_.end_line();
  if (!history_.empty()) out_.text(history_), out_.end_line();
  out_.names(columns_);
  header_written_ = true;
}

bool Filter::next_run() {
  if (!header_written_ && !history_.empty()) write_header();
  write_rows();
  break_due_ = any_row_;
  gone_ = -std::count_if(rows_.begin() + static_cast<std::ptrdiff_t>(front_), rows_.end(),
                         [](const Row& row) { return row.kind != Kind::comment; });
  if (in_.next_run()) return true;
  if (!any_row_ && any_dropped_) fail("no records are left");
  if (!any_row_) fail("no records: a needed reading is missing in every one");
  return false;
}

bool Filter::next() {
  if (!in_.next()) return false;
  if (in_.history_changed() && header_written_ && !history_.empty()) comment(history_);
  Row& row = rows_.emplace_back();
  const std::string_view text = in_.text(cut_, row.first, row.last);
  row.size = text.size();
  if (cut_ == npos) row.first = row.last = row.size;
  held_.append(text);
  return true;
}

void Filter::comment(std::string_view text) {
  held_.append(text);
  rows_.push_back({Kind::comment, text.size()});
  write_rows();
}

void Filter::drop(std::size_t i) {
  auto row = rows_.begin() + static_cast<std::ptrdiff_t>(front_);
  for (auto records = gone_;
       row->kind == Kind::comment || records++ < static_cast<std::ptrdiff_t>(i);)
    ++row;
  row->kind = Kind::dropped;
  any_dropped_ = true;
  write_rows();
}

void Filter::write_break() {
  if (std::exchange(break_due_, false)) out_.end_line();
}

/// Up to the first that has not all its numbers.
void Filter::write_rows() {
  if (!header_written_) return;
  writing_ = true;
  const auto each = static_cast<std::ptrdiff_t>(std::max<std::size_t>(appended_, 1));
  auto number = numbers_.cbegin();
  for (; front_ < rows_.size(); front_begin_ += rows_[front_++].size) {
    const Row& row = rows_[front_];
    const char* const text = held_.data() + front_begin_;
    if (row.kind == Kind::dropped) {
      ++gone_;
      continue;
    }
    if (row.kind == Kind::record && numbers_.cend() - number < each) break;
    write_break();
    out_.text({text, row.first});
    if (row.kind == Kind::record) {
      for (const auto end = number + each; number != end; ++number) {
        if (appended_ > 0) out_.text('\t');
        out_.number(*number);
      }
      any_row_ = true;
      ++gone_;
    }
    if (row.last < row.size) out_.text({text + row.last, row.size - row.last});
    out_.end_line();
  }
  numbers_.erase(numbers_.cbegin(), number);
  if (front_ == rows_.size() || (front_ >= 1024 && 2 * front_ > rows_.size())) forget_rows();
  writing_ = false;
}

/// Those before the front one; amortised, at most one move a row.
void Filter::forget_rows() {
  rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(front_));
  held_.drop(front_begin_);
  front_ = front_begin_ = 0;
}

}  // namespace rolling
