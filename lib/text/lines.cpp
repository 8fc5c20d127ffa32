// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/lines.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "text/number.h"

namespace rolling {
namespace {

/// Bytes. A row of motion data has tens of bytes; a file with longer lines is not one of columns.
constexpr std::size_t longest_line = 1 << 20;
constexpr std::size_t block = 1 << 18;

/// read(2), repeated after a signal, and waiting if another process has made the descriptor
/// non-blocking.
ssize_t read_some(int fd, char* to, std::size_t size) {
  for (;;) {
    const ssize_t count = ::read(fd, to, size);
    if (count >= 0 || (errno != EINTR && errno != EAGAIN)) return count;
    pollfd ready{fd, POLLIN, 0};
    if (errno == EAGAIN) ::poll(&ready, 1, -1);
  }
}

int open_for_reading(const std::string& name) {
  struct stat in;
  struct stat out;  // before open(), which may return the number of a closed standard output
  if ((name == "-" ? ::fstat(STDIN_FILENO, &in) : ::stat(name.c_str(), &in)) == 0 &&
      ::fstat(STDOUT_FILENO, &out) == 0 && S_ISREG(in.st_mode) && in.st_dev == out.st_dev &&
      in.st_ino == out.st_ino)
    fail<InputError>("{}: this input is the output too", name);
  return name == "-" ? STDIN_FILENO : ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
}

/// The error values of spreadsheets.
constexpr std::array<std::string_view, 8> error_values = {
    "#N/A", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#NULL!", "#SPILL!"};

/// A line without the separators with which a spreadsheet fills it up, and without the quotes that
/// some put around each text.
std::string_view only_cell(std::string_view line) {
  const std::string_view text = trim(line.substr(0, line.find_last_not_of(filling) + 1));
  const bool quoted =
      text.size() > 1 && text.front() == quote && closing_quote(text.substr(1)) == text.size() - 2;
  return quoted ? text.substr(1, text.size() - 2) : text;
}

/// Takes the first line from the text.
std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line.substr(0, line.size() - line.ends_with('\r'));
}

constexpr std::string_view ended_with_an_error = ": ended with an error";

}  // namespace

Lines::Lines(std::string name)
    : name_(std::move(name)), fd_(open_for_reading(name_)), kept_(buffer_.data()), at_(kept_),
      end_(kept_) {
  if (fd_ < 0) fail<InputError>("{}: {}", name_.empty() ? "''" : name_, std::strerror(errno));
#ifdef F_SETPIPE_SZ
  // A larger pipe lets the tools of a chain wait less for each other. Failure does no harm.
  ::fcntl(fd_, F_SETPIPE_SZ, 1 << 20);
#endif
  struct stat status;
  has_size_ = ::fstat(fd_, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0;
}

Lines::~Lines() {
  if (fd_ > STDIN_FILENO) ::close(fd_);
}

/// Reads the next block; false at the end of the file.
bool Lines::fill() {
  const std::size_t size = ahead().size();  // of the line so far
  if (size >= longest_line)
    fail<InputError>("{}:{}: a line of more than {} bytes", name_, count_ + 1, longest_line);
  const auto in_use = static_cast<std::size_t>(end_ - kept_);
  std::memmove(buffer_.data(), kept_, in_use);
  buffer_.resize(in_use + block);
  kept_ = buffer_.data();
  end_ = kept_ + in_use;
  at_ = end_ - size;
  const ssize_t count =
      read_some(fd_, buffer_.data() + in_use, std::min(block, longest_line - size));
  if (count < 0) fail<InputError>("{}: {}", name_, std::strerror(errno));
  end_ += count;
  return count > 0;
}

bool Lines::next() {
  if (!held_) {
    kept_ = at_;
    kept_count_ = count_;
  }
  if (!next_in_file()) return false;
  number_ = count_;
  if (!separators_.empty()) join_quoted();
  check_bytes();
  return true;
}

/// Goes to the next line of the file, whether a quoted field goes on in it or not.
bool Lines::next_in_file() {
  const void* feed = std::memchr(at_, '\n', ahead().size());
  while (!feed && !at_end_) {
    const std::size_t searched = ahead().size();
    at_end_ = !fill();
    feed = std::memchr(at_ + searched, '\n', ahead().size() - searched);
  }
  if (!feed && at_ == end_) return false;
  const char* const end = feed ? static_cast<const char*>(feed) : end_;
  text_ = {at_, end};
  at_ = end == end_ ? end : end + 1;
  if (text_.ends_with('\r')) text_.remove_suffix(1);
  ++count_;
  // Joined files have a byte order mark each, and one that has nothing else leaves two together.
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  while (text_.starts_with(mark)) text_.remove_prefix(mark.size());
  return true;
}

LineKind Lines::kind_of(std::string_view line) const {
  const std::size_t first = line.find_first_not_of(" \t");
  if (first == std::string_view::npos || line == "\x1A" || is_blank_row(line.substr(first)))
    return LineKind::blank;
  const bool is_field = separators_ == "\t" && line.find('\t') < first;  // a blank one before it
  if (line[first] == quote && !is_field && is_history(only_cell(line))) return LineKind::history;
  if (line[first] != '#' || is_field) return LineKind::row;
  line.remove_prefix(first);
  if (is_history(line)) return LineKind::history;
  const std::string_view word = line.substr(0, line.find_first_of(filling));
  return std::ranges::count(error_values, word) > 0 ? LineKind::row : LineKind::comment;
}

/// True for a row whose cells are all blank, in quotes perhaps.
bool Lines::is_blank_row(std::string_view line) const {
  if (separators_.empty() || line.find_first_not_of(separators_ + " \t\"") < line.size())
    return false;
  // Two quotes are a blank cell, and a third one would be text.
  return replace_all(line, {{"\"\"\"", "\""}, {"\"\"", ""}}).find(quote) == std::string::npos;
}

bool Lines::is_title() const {
  const auto is_divided = [](std::string_view line) {
    return line.find_first_of(separators) != std::string_view::npos;
  };
  if (is_divided(text_) || is_number(text_.substr(0, text_.find(' ')))) return false;
  std::string_view ahead = this->ahead();
  int divided = 0;
  for (int i = 0; i < 6; ++i) divided += is_divided(take_line(ahead));
  return divided >= 3;
}

bool Lines::another_run() const {
  if (!has_size_) return false;
  std::string_view ahead = this->ahead();
  for (bool blank = false; !ahead.empty();) {
    const LineKind kind = kind_of(take_line(ahead));
    if (blank && kind == LineKind::row) return true;
    blank |= kind == LineKind::blank;
  }
  return false;
}

std::string history_line(std::string_view line) {
  std::string text(only_cell(line));
  if (text.size() > 2 && is_separator(text[2])) std::ranges::replace(text, char(text[2]), ' ');
  return text;
}

void Lines::join_quoted() {
  if (text_.find(quote) == std::string_view::npos || kind() != LineKind::row) return;
  bool within = false;
  outside_quotes(text_, separators_, within);
  if (!within) return;
  joined_ = text_;
  while (within) {
    if (joined_.size() > longest_line || !next_in_file())
      fail<InputError>("{}:{}: a quote that is not closed", name(), number_);
    (joined_ += '\n') += text_;
    outside_quotes(text_, separators_, within);
  }
  text_ = joined_;
}

/// The kind of a file by its beginning, if it is none of columns; empty for any other.
std::string_view other_kind(std::string_view first_line) {
  const std::string_view text = trim(first_line);
  if (text.starts_with("%PDF")) return "a PDF";
  if (text.starts_with("<!") || text.starts_with("<?") || lower(text).starts_with("<html"))
    return "HTML or XML";
  const std::string_view inside = trim(text.substr(std::min<std::size_t>(text.size(), 1)));
  const bool opens = inside.empty() || std::string_view("{[\"").find(inside.front()) < 3;
  if (text.starts_with('{') || (text.starts_with('[') && opens)) return "JSON";
  return {};
}

void Lines::check_bytes() const {
  if (const std::string_view kind = number_ == 1 && !separators_.empty() ? other_kind(text_) : "";
      !kind.empty())
    fail<InputError>("{}:1: this is {} ({}): export its table as CSV", name(), kind, shown(text_));
  if (text_.find('\0') < text_.size())
    fail<InputError>(
        "{}:{}: a NUL byte: this is no text of columns; export a spreadsheet as CSV, unpack what "
        "is packed, make UTF-16 UTF-8 (iconv -f UTF-16)",
        name(), number_);
  if (text_.find('\r') < text_.size())
    fail<InputError>(
        "{}:{}: a carriage return within the line; make the line ends LF first (tr '\\r' '\\n')",
        name(), number_);
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
