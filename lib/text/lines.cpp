// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/lines.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "text/delimiters.h"
#include "text/number.h"

namespace rolling {
namespace {

/// The error values of spreadsheets.
constexpr std::array<std::string_view, 8> error_values = {
    "#N/A", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#NULL!", "#SPILL!"};

/// A line without the separators with which a spreadsheet fills it up, and without the quotes that
/// some put around each text.
std::string_view only_cell(std::string_view line) {
  const std::string_view text = trim(line.substr(0, line.find_last_not_of(filling) + 1));
  const bool quoted = text.size() > 1 && text.front() == quote &&
                      closing_quote(text.data() + 1, &text.back()) == &text.back() &&
                      text.back() == quote;
  return quoted ? text.substr(1, text.size() - 2) : text;
}

constexpr std::string_view ended_with_an_error = ": ended with an error";

bool begins_with_error_value(std::string_view line) {
  return std::any_of(error_values.begin(), error_values.end(), [line](std::string_view value) {
    return line.starts_with(value) && (line.size() == value.size() || line[value.size()] == ' ' ||
                                       is_separator(line[value.size()]));
  });
}

}  // namespace

LineKind Lines::kind_of(std::string_view line) const {
  const std::size_t first = line.find_first_not_of(" \t");
  if (first == std::string_view::npos || line == "\x1A" || is_blank_row(line.substr(first)))
    return LineKind::blank;
  const bool is_field = separators_ == "\t" && line.find('\t') < first;  // a blank one before it
  if (line[first] == quote && !is_field && only_cell(line).starts_with("##"))
    return LineKind::history;
  if (line[first] != '#' || is_field) return LineKind::row;
  line.remove_prefix(first);
  if (line.starts_with("##")) return LineKind::history;
  return begins_with_error_value(line) ? LineKind::row : LineKind::comment;
}

/// True for a row whose cells are all blank, in quotes perhaps.
bool Lines::is_blank_row(std::string_view line) const {
  if (separators_.empty()) return false;
  for (; !line.empty(); line.remove_prefix(1)) {
    if (line.front() == quote) {  // a second one closes the cell, a third one would be text
      if (!line.starts_with("\"\"") || line.starts_with("\"\"\"")) return false;
      line.remove_prefix(1);
    } else if (!is_blank(line.front()) && separators_.find(line.front()) == std::string::npos) {
      return false;
    }
  }
  return true;
}

bool Lines::another_run() const {
  std::string_view ahead = input_.has_size() ? input_.ahead() : std::string_view();
  for (bool blank = false; !ahead.empty();) {
    const auto end = std::min(ahead.find('\n'), ahead.size());
    std::string_view line = ahead.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    const LineKind kind = kind_of(line);
    if (blank && kind == LineKind::row) return true;
    blank |= kind == LineKind::blank;
    ahead.remove_prefix(std::min(end + 1, ahead.size()));
  }
  return false;
}

std::string history_line(std::string_view line) {
  std::string text(only_cell(line));
  if (text.size() > 2 && is_separator(text[2])) std::ranges::replace(text, char(text[2]), ' ');
  return text;
}

void Lines::join_quoted() {
  if (text_.find(quote) == std::string_view::npos || kind() != LineKind::row ||
      !outside_quotes(text_, separators_).ends_within)
    return;
  joined_ = text_;
  for (bool open = true; open;) {
    if (joined_.size() > longest_line || !input_.next(text_))
      fail<InputError>("{}:{}: a quote that is not closed", name(), number_);
    (joined_ += '\n') += text_;
    const char *const end = text_.data() + text_.size(), *close = closing_quote(text_.data(), end);
    open = close == end || outside_quotes({close + 1, end}, separators_, false).ends_within;
  }
  text_ = joined_;
}

void Lines::check_bytes() const {
  const char* const wrong =
      text_.find('\0') < text_.size()
          ? "a NUL byte: this is no text of columns; export a spreadsheet as CSV, unpack what is "
            "packed, make UTF-16 UTF-8 (iconv -f UTF-16)"
      : text_.find('\r') < text_.size()
          ? "a carriage return within the line; make the line ends LF first (tr '\\r' '\\n')"
          : nullptr;
  if (wrong) fail<InputError>("{}:{}: {}", name(), number_, wrong);
}

void refuse_error_line(const Lines& lines) {
  const std::string line = history_line(lines.text());
  const std::string_view text = trim(std::string_view(line).substr(2));
  if (text.ends_with(ended_with_an_error) && text.find(' ') == text.find(':') + 1)
    fail<InputError>("{}:{}: {} ended with an error: the rows are not complete", lines.name(),
                     lines.number(), shown(text.substr(0, text.find(':'))));
}

std::string error_line(std::string_view tool) {
  return fmt::format("## {}{}", tool, ended_with_an_error);
}

}  // namespace rolling
