// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/row_pipe.h"

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace rolling {

RowPipe::RowPipe(Reader& in, Output& out, std::string history)
    : in_(in), out_(out), history_(history.empty() ? "" : "## " + std::move(history)) {}

/// The columns of the present run in the output.
std::vector<Column> RowPipe::columns() const {
  std::vector<Column> all = in_.columns();
  for (const Column& column : appended_) {
    for (Column& old : all)
      if (old.name == column.name) old.name = free_name(all, old.name);
    all.push_back(column);
  }
  return all;
}

void RowPipe::hold(std::string_view text, Kind kind) {
  texts_.append(text);
  lines_.push_back({static_cast<std::uint32_t>(text.size()), 0, kind});
}

void RowPipe::take_comments(const std::vector<std::string>& comments) {
  for (const std::string& comment : comments) hold(comment, Kind::comment);
  write_rows();
}

bool RowPipe::next_run() {
  write_rows();
  run_begins_ = read_;
  if (in_.next_run()) {
    hold(names_line(columns()), Kind::names);
    take_comments(in_.comments());
    if (in_.renames() && !in_.history().empty())
      hold(fmt::format("## {}", columns_renamed), Kind::comment);
    if (replaced_ != Reader::no_column) cut_ = in_.column_of(replaced_);
    return true;
  }
  if (!any_row_) fail("no rows are left{}", why_none_ ? why_none_() : "");
  take_comments(in_.comments());
  std::erase_if(comments_, is_history);
  write_comments();
  return false;
}

bool RowPipe::next() {
  if (!std::exchange(ahead_, false) && !next_row()) return false;
  if (in_.equal_times() != EqualTimes::refused) join_rows();
  return true;
}

/// Joins the rows of the time of the present one with it.
void RowPipe::join_rows() {
  joined_time_ = in_.time();
  joined_value_ = in_[replaced_];
  double sum = joined_value_;
  for (std::size_t count = 1; next_row(); ++count) {
    ahead_ = in_.time() != joined_time_;
    if (ahead_) return;
    texts_.resize(texts_.size() - lines_.back().size);
    lines_.pop_back();
    --read_;
    sum += in_[replaced_];
    if (in_.equal_times() == EqualTimes::mean) joined_value_ = sum / static_cast<double>(count + 1);
  }
}

bool RowPipe::next_row() {
  const bool more = in_.next();
  if (!in_.remarks().empty()) take_comments(in_.remarks());
  if (!more) return false;
  const std::size_t begin = texts_.size();
  const std::size_t place = in_.append_text(texts_, cut_);
  lines_.push_back({static_cast<std::uint32_t>(texts_.size() - begin),
                    static_cast<std::uint32_t>(place), Kind::row});
  ++read_;
  return true;
}

void RowPipe::drop(std::size_t i) {
  dropped_.push(run_begins_ + i);
  write_rows();
}

void RowPipe::split(std::size_t i, const std::string& name) {
  splits_.emplace(run_begins_ + i, "## run " + name);
}

/// Writes the head of a run before its first row.
void RowPipe::write_head() {
  if (!std::exchange(head_waits_, false)) return;
  if (any_row_) out_.end_line();
  write_comments();
  if (!history_.empty()) out_.line(history_);
  out_.header(names_);
}

/// Prepares the head of a part of a run: the history of the run, the name of the part.
void RowPipe::begin_part() {
  if (splits_.empty() || splits_.front().first > done_) return;
  if (std::exchange(head_waits_, true)) {
    history_of_run_.clear();
    for (const std::string& comment : comments_)
      if (is_history(comment) && !comment.starts_with("## run "))
        history_of_run_.push_back(comment);
  }
  std::erase_if(comments_, is_history);
  comments_.push_back(splits_.front().second);
  comments_.insert(comments_.end(), history_of_run_.begin(), history_of_run_.end());
  while (!splits_.empty() && splits_.front().first <= done_) splits_.pop();
}

void RowPipe::write_comments() {
  for (const std::string& comment : std::exchange(comments_, {})) out_.line(comment);
}

/// Writes all lines before the first row that lacks a number. The comments of a run without rows,
/// but for its history, are written with the head of the next run.
void RowPipe::write_rows() {
  const std::size_t each = std::max<std::size_t>(appended_.size(), 1);
  for (; !lines_.empty(); lines_.pop_front()) {
    const Line& line = lines_.front();
    const std::string_view text(texts_.data() + front_, line.size);
    if (line.kind == Kind::names) {
      std::erase_if(comments_, is_history);
      names_ = text;
      head_waits_ = true;
    } else if (line.kind == Kind::comment) {
      comments_.emplace_back(text);
      if (!head_waits_) write_comments();
    } else if (!dropped_.empty() && dropped_.front() == done_) {
      dropped_.pop();
      ++done_;
    } else {
      if (numbers_.size() < each) break;
      begin_part();
      write_head();
      out_.text(text.substr(0, line.place));
      for (const double number : numbers_) {
        if (!appended_.empty()) out_.text('\t');
        out_.number(number);
      }
      out_.text(text.substr(line.place));
      out_.end_line();
      numbers_.clear();
      any_row_ = true;
      ++done_;
    }
    front_ += line.size;
  }
  if (2 * front_ >= texts_.size()) {  // amortised, each line is moved at most once
    const std::size_t left = texts_.size() - front_;
    std::copy_n(texts_.data() + std::exchange(front_, 0), left, texts_.data());
    texts_.resize(left);
  }
}

}  // namespace rolling
