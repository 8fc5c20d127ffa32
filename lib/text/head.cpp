// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/head.h"

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "base/enumeration.h"
#include "base/error.h"
#include "text/delimiters.h"
#include "text/header.h"
#include "text/number.h"

namespace rolling {
namespace {

/// The names in a line that is not a comment.
std::vector<std::string> names_in(std::string_view line, char separator) {
  auto names = split_names(line, separator);
  if (separator && names.front().starts_with("# ")) names.front().erase(0, 2);  // quoted
  return names;
}

/// Refuses a line that begins with a number and has another one, between other separators than
/// those of the file: it is no heading, and the run would be lost.
void refuse_other_separator(std::string_view line) {
  Dialect other;
  if (!other.choose(line)) return;
  const auto fields = other.split(line);
  const auto is_reading = [](const Field& f) { return is_number(f.text) || is_missing(f.text); };
  if (is_reading(fields.front()) && std::ranges::count_if(fields, is_reading) > 1)
    fail("'{}' is not separated as the rows before; if it is a heading, begin it with #",
         shown(line));
}

/// Refuses a row without names, `1,5, 2,5`, whose commas without a blank behind them may be
/// decimal ones.
void refuse_two_readings(const std::string& line) {
  const std::string other = replace_all(line, {{", ", "; "}});
  if (other == line || other.find(',') == std::string::npos) return;
  Dialect dialect;
  dialect.choose(other);
  if (std::ranges::all_of(dialect.split(other), [](const Field& f) { return is_number(f.text); }))
    fail(
        "'{}' can be read in two ways: if its commas without a blank are decimal ones, make them "
        "points first, else take the blanks away",
        shown(line));
}

/// The comments and other lines in front of the first row.
class HeadReader {
 public:
  HeadReader(Lines& lines, Dialect& dialect, const Head* before)
      : lines_(lines), dialect_(dialect), before_(before) {}

  Head read(const std::vector<std::string>& order, Sides sides) {
    const bool found = find_row();
    if (!found) {
      if (!before_) refuse_without_rows();
      return finish();
    }
    lines_.put_back();
    lines_.separate_by(dialect_.separator());
    head_.line = lines_.number();
    const auto fields = dialect_.split(lines_.text());
    std::size_t width = fields.size();
    const bool blank_end = width > 1 && fields.back().text.empty();
    std::vector<std::string> units;
    const auto names = take_names(
        {width, blank_end, before_ ? before_->layout.runs.front().columns : std::vector<Column>()},
        units);
    if (names.empty() && before_) {
      head_.said = before_->said;
      head_.named = before_->named;
      head_.layout = before_->layout;
      return finish();
    }
    head_.named = !names.empty();
    if (!head_.named && dialect_.separator() == ',')
      refuse_two_readings(std::string(lines_.text()));
    if (blank_end && names.size() + 1 == width) --width;
    std::vector<Column> columns;
    for (std::size_t i = 0; i < std::max(width, names.size()); ++i) {
      if (i < names.size()) columns.push_back(read_column(names[i]));
      else if (i < order.size() && !head_.named) columns.push_back({order[i]});
      else columns.emplace_back();
      if (columns.back().name.empty()) columns.back().name = fmt::format("c{}", i + 1);
      if (i < units.size())
        add_unit(columns.back(), units[i], fmt::format("{}:{}", lines_.name(), head_.line));
    }
    head_.layout = Layout::of(columns, sides);
    const bool side_by_side = head_.layout.side_by_side();
    if (head_.named && (side_by_side ? width > names.size() : width != names.size()))
      fail(
          "{} under a line of {}: begin that with # if it is no header, put quotes around names "
          "that hold a separator, and make decimal commas points",
          counted(width, "field"), counted(names.size(), "name"));
    return finish();
  }

 private:
  void take_history() {
    refuse_error_line(lines_);
    const std::string line = history_line(lines_.text());
    const std::string_view text = trim(std::string_view(line).substr(2));
    if (text.starts_with("run ")) {  // the `##` lines above belong to a run without rows
      head_.run = trim(text.substr(4));
      std::erase_if(above_, std::mem_fn(&Comment::is_history));
    } else {
      keep(line);
    }
  }

  void keep(std::string line) {
    tabs_.insert(std::ranges::count(line, '\t'));
    above_.push_back({std::move(line), lines_.number()});
  }

  /// Goes to the first row; false if there is none.
  bool find_row() {
    while (lines_.next()) {
      const std::string line(lines_.text());
      switch (lines_.kind()) {
        case LineKind::blank:
          break;
        case LineKind::history:
          take_history();
          break;
        case LineKind::comment:
          // In a file separated by tabs, a blank field may stand before one that begins with #.
          if (!before_ && line.find('\t') < line.find('#') && dialect_.choose(line, true))
            return true;
          keep(line.substr(line.find('#')));
          break;
        case LineKind::row:
          if (before_ ? dialect_.holds_number(line)
                      : dialect_.choose(line, tabs_.contains(std::ranges::count(line, '\t'))))
            return true;
          if (before_) refuse_other_separator(line);
          keep(line);
      }
    }
    return false;
  }

  /// The names in a line above the row.
  std::vector<std::string> names_of(const Comment& line, const UnnamedColumns& columns) const {
    return line.is_bare() ? names_in(line.text, dialect_.separator())
                          : names_in_comment(line.text, columns).names;
  }

  /// The header: the last line that is no comment, but for one of units; or a comment where there
  /// is none, or where none has a known name and a comment below has some. Null without one.
  const Comment* find_header(const UnnamedColumns& columns) const {
    std::vector<std::size_t> bare;
    for (std::size_t i = 0; i < above_.size(); ++i)
      if (above_[i].is_bare()) bare.push_back(i);
    if (bare.size() > 1 && are_units_of(names_of(above_[bare.end()[-2]], columns),
                                        names_of(above_[bare.back()], columns)))
      bare.pop_back();
    const Comment* const last = bare.empty() ? nullptr : &above_[bare.back()];
    const auto names_columns = [&](const Comment& line) {
      return !line.is_bare() && !line.is_history() &&
             names_in_comment(line.text, columns).known > 0;
    };
    const auto has_name = [](const Comment& line) {
      return line.is_bare() && holds_known_name(line.text);
    };
    if (last && (std::ranges::any_of(above_, has_name) ||
                 std::none_of(last, above_.data() + above_.size(), names_columns)))
      return last;
    return choose_names(above_, columns, !before_, lines_.name());
  }

  /// The names of the columns, empty if there are none here, and the units in a line below them.
  std::vector<std::string> take_names(const UnnamedColumns& columns,
                                      std::vector<std::string>& units) {
    const Comment* const found = find_header(columns);
    if (!found) return {};
    const Comment header = *found;
    if (header.text.starts_with("# ") && header.text.find('\t') != std::string::npos)
      dialect_.has_points();
    head_.line = header.line;
    note_sorted_history();
    auto names = names_of(header, columns);
    std::erase_if(above_, [&](const Comment& line) {
      if (line.line <= header.line) return line.line == header.line;
      auto below = names_of(line, columns);
      const bool has_units = units.empty() && are_units_of(names, below);
      if (has_units) units = std::move(below);
      return has_units;
    });
    fit_end(names, columns);
    return names;
  }

  /// Notes that several `##` lines were sorted, if one stands below the comment with the names: the
  /// tools write the names last, and what sorts rows by a column puts `# t` before `##`.
  void note_sorted_history() {
    std::size_t all = 0, below = 0;
    for (const Comment& line : above_)
      if (line.is_history()) ++all, below += line.line > head_.line;
    if (below > 0 && all > 1)
      above_.push_back({fmt::format("## {}", lines_sorted), above_.back().line});
  }

  [[noreturn]] void refuse_without_rows() const {
    if (const auto bare =
            std::find_if(above_.rbegin(), above_.rend(), std::mem_fn(&Comment::is_bare));
        bare != above_.rend())
      fail<InputError>("{}:{}: no rows: no field of '{}' is a number", lines_.name(), bare->line,
                       shown(bare->text));
    if (lines_.name() == "-" && above_.empty())
      fail<InputError>("standard input is empty: did the tool before this one fail?");
    fail<InputError>("{}: no rows", lines_.name());
  }

  /// The lines that are neither names nor units are comments.
  Head finish() {
    for (Comment& line : above_) {
      note_units(line.text, line.line, head_.said);
      if (line.is_history())
        head_.history.emplace_back(trim(std::string_view(line.text).substr(2)));
      std::ranges::replace(line.text, '\n', ' ');
      head_.comments.push_back((line.is_bare() ? "# " : "") + std::move(line.text));
    }
    return std::move(head_);
  }

  Lines& lines_;
  Dialect& dialect_;
  const Head* before_;
  Head head_;
  std::vector<Comment> above_;     // the lines above the row, but for blank ones
  std::set<std::ptrdiff_t> tabs_;  // how many each of them has
};

}  // namespace

Head read_head(Lines& lines, Dialect& dialect, const Head* before,
               const std::vector<std::string>& order, Sides sides) {
  try {
    return HeadReader(lines, dialect, before).read(order, sides);
  } catch (const InputError&) {
    throw;
  } catch (const Error& error) {
    fail<InputError>("{}:{}: {}", lines.name(), lines.number(), error.what());
  }
}

}  // namespace rolling
