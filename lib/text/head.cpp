// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/head.h"

#include <algorithm>
#include <functional>
#include <utility>

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
  const std::string other = replace_all(line, ", ", "; ");
  if (other == line || other.find(',') == std::string::npos) return;
  Dialect dialect;
  dialect.choose(other);
  if (std::ranges::all_of(dialect.split(other), [](const Field& f) { return is_number(f.text); }))
    fail(
        "'{}' can be read in two ways: if its commas without a blank are decimal ones, make them "
        "points first, else take the blanks away",
        shown(line));
}

/// True if the comment has names for these columns, one of them known.
bool holds_names(const Comment& comment, const UnnamedColumns& columns) {
  return !comment.is_history() && names_in_comment(comment.text, columns).known > 0;
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
      comment_preamble();
      return finish();
    }
    lines_.put_back();
    lines_.separate_by(dialect_.separator());
    head_.line = lines_.number();
    const auto fields = dialect_.split(lines_.text());
    const std::size_t width = fields.size();
    const bool blank_field = fields.back().text.empty();
    auto units = take_units();
    const auto names = take_names(width, blank_field, units);
    if (names.empty() && before_) head_.said = before_->said;
    for (const Comment& comment : comments_) note_units(comment.text, comment.line, head_.said);
    if (names.empty() && before_) {
      head_.named = before_->named;
      head_.blank_end = before_->blank_end;
      head_.layout = before_->layout;
      return finish();
    }
    head_.named = !names.empty();
    if (!head_.named && dialect_.separator() == ',')
      refuse_two_readings(std::string(lines_.text()));
    head_.blank_end =
        blank_field && width > 1 && (names.size() < width ? !head_.named : names.back().empty());
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
      fail("{} field{} under a line of {} name{}{}", width, width == 1 ? "" : "s", names.size(),
           names.size() == 1 ? "" : "s", way_out(width, names.size()));
    return finish();
  }

 private:
  void take_history() {
    refuse_error_line(lines_);
    const std::string line = history_line(lines_.text());
    const std::string_view text = trim(std::string_view(line).substr(2));
    if (text.starts_with("run ")) {  // the `##` lines above belong to a run without rows
      head_.run = trim(text.substr(4));
      std::erase_if(comments_, std::mem_fn(&Comment::is_history));
    } else {
      keep(line);
    }
  }

  void keep(std::string comment) { comments_.push_back({std::move(comment), lines_.number()}); }

  /// True for a first row with missing readings: a field is NaN, which is no name of a column; or
  /// all are blank, dates or times below known names; or one is blank below those of a comment.
  bool is_missing_row(std::string_view line) {
    const auto fields = dialect_.split(line);
    const auto any = [&](auto&& is) { return std::ranges::any_of(fields, is); };
    if (any([](const Field& f) { return is_missing(f.text) && !f.text.empty(); })) return true;
    if (preamble_.empty() && !before_)
      return any([](const Field& f) { return f.text.empty(); }) && !holds_known_name(line) &&
             std::ranges::any_of(comments_, [&](const Comment& comment) {
               return holds_names(comment, {fields.size()});
             });
    if (any([](const Field& f) { return !f.text.empty() && !is_date(f.text); })) return false;
    if (before_) return fields.size() == before_->layout.width;
    const std::string& above = preamble_.back().text;
    return holds_known_name(above) && names_in(above, dialect_.separator()).size() == fields.size();
  }

  /// True if a comment, or the last other line, has as many tabs as this line.
  bool has_tabs_above(std::string_view line) const {
    const auto tabs = std::ranges::count(line, '\t');
    const auto agrees = [tabs](const Comment& above) {
      return std::ranges::count(above.text, '\t') == tabs;
    };
    return std::ranges::any_of(comments_, agrees) ||
           (!preamble_.empty() && agrees(preamble_.back()));
  }

  /// True for a first row with a blank cell and behind it one that begins with #.
  bool is_row_from_blank(std::string_view line) {
    if (lines_.kind() != LineKind::comment || line.find('\t') >= line.find('#')) return false;
    const bool tabs = has_tabs_above(line);
    return dialect_.choose(line, tabs) || (tabs && is_missing_row(line));
  }

  /// Goes to the first row; false if there is none.
  bool find_row() {
    while (lines_.next()) {
      const std::string line(lines_.text());
      if (!before_ && is_row_from_blank(line)) return true;
      switch (lines_.kind()) {
        case LineKind::blank:
          break;
        case LineKind::history:
          take_history();
          break;
        case LineKind::comment:
          keep(line.substr(line.find('#')));
          break;
        case LineKind::row:
          if ((before_ ? dialect_.holds_number(line)
                       : dialect_.choose(line, has_tabs_above(line))) ||
              is_missing_row(line))
            return true;
          if (before_) refuse_other_separator(line);
          preamble_.push_back({line, lines_.number()});
      }
    }
    return false;
  }

  /// True if no line of the preamble has a known name, and a comment below it has some.
  bool is_named_below(const UnnamedColumns& columns) const {
    const auto has_name = [](const Comment& line) { return holds_known_name(line.text); };
    const auto names_columns = [&](const Comment& comment) {
      return comment.line > preamble_.back().line && holds_names(comment, columns);
    };
    return std::ranges::none_of(preamble_, has_name) &&
           std::ranges::any_of(comments_, names_columns);
  }

  /// The names in a comment, and the units if another one below it has them.
  std::vector<std::string> take_commented_names(const UnnamedColumns& columns,
                                                std::vector<std::string>& units) {
    const auto chosen = choose_names(comments_, columns, !before_, lines_.name());
    if (!chosen) return {};
    const Comment header = comments_[*chosen];
    if (header.text.starts_with("# ") && header.text.find('\t') != std::string::npos)
      dialect_.has_points();
    head_.line = header.line;
    note_sorted_history(*chosen);
    const auto names = names_in_comment(header.text, columns).names;
    std::erase_if(comments_, [&](const Comment& comment) {
      if (comment.line <= header.line) return comment.line == header.line;
      auto below = names_in_comment(comment.text, columns).names;
      const bool has_units = units.empty() && are_units_of(names, below);
      if (has_units) units = std::move(below);
      return has_units;
    });
    return names;
  }

  /// Notes that several `##` lines were sorted, if one stands below the comment with the names: the
  /// tools write the names last, and what sorts rows by a column puts `# t` before `##`.
  void note_sorted_history(std::size_t names) {
    const auto count = [&](std::size_t from) {
      return std::count_if(comments_.begin() + static_cast<std::ptrdiff_t>(from), comments_.end(),
                           std::mem_fn(&Comment::is_history));
    };
    if (count(names) > 0 && count(0) > 1)
      comments_.push_back({fmt::format("## {}", lines_sorted), comments_.back().line});
  }

  /// The units in the line below the header; empty if there is none.
  std::vector<std::string> take_units() {
    if (preamble_.size() < 2) return {};
    auto units = names_in(preamble_.back().text, dialect_.separator());
    if (!are_units_of(names_in(preamble_[preamble_.size() - 2].text, dialect_.separator()), units))
      return {};
    preamble_.pop_back();
    return units;
  }

  /// The names of `width` columns, empty if there are none here. `blank_end`: the row ends blank.
  std::vector<std::string> take_names(std::size_t width, bool blank_end,
                                      std::vector<std::string>& units) {
    const UnnamedColumns columns{
        width, blank_end, before_ ? before_->layout.runs.front().columns : std::vector<Column>()};
    if (preamble_.empty() || is_named_below(columns)) {
      auto names = take_commented_names(columns, units);
      comment_preamble();
      return names;
    }
    auto names = names_in(preamble_.back().text, dialect_.separator());
    head_.line = preamble_.back().line;
    preamble_.pop_back();
    comment_preamble();
    if (names.size() == width + 1 && names.back().empty()) names.pop_back();
    else if (names.size() + 1 == width && blank_end) names.emplace_back();
    return names;
  }

  [[noreturn]] void refuse_without_rows() const {
    if (!preamble_.empty())
      fail<InputError>("{}:{}: no rows: no field of '{}' is a number", lines_.name(),
                       preamble_.back().line, shown(preamble_.back().text));
    if (lines_.name() == "-" && comments_.empty())
      fail<InputError>("standard input is empty: did the tool before this one fail?");
    fail<InputError>("{}: no rows", lines_.name());
  }

  /// Makes comments of the lines that are neither names nor units.
  void comment_preamble() {
    for (Comment& line : preamble_) {
      std::replace(line.text.begin(), line.text.end(), '\n', ' ');
      comments_.push_back({"# " + std::move(line.text), line.line});
    }
  }

  Head finish() {
    for (Comment& comment : comments_) {
      if (comment.is_history())
        head_.history.emplace_back(trim(std::string_view(comment.text).substr(2)));
      head_.comments.push_back(std::move(comment.text));
    }
    return std::move(head_);
  }

  /// What to do about a row of another number of fields than there are names.
  std::string way_out(std::size_t width, std::size_t names) const {
    if (before_) return fmt::format("; if line {} is a heading, begin it with #", head_.line);
    if (names > width)
      return dialect_.separator() == '\0' ? "; if a name has blanks in it, put it in quotes" : "";
    return way_out_of_commas(dialect_.separator());
  }

  Lines& lines_;
  Dialect& dialect_;
  const Head* before_;
  Head head_;
  std::vector<Comment> comments_;
  std::vector<Comment> preamble_;  // lines that are neither comments nor rows
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
