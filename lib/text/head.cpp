// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/head.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <set>
#include <utility>

#include "base/enumeration.h"
#include "base/error.h"
#include "text/number.h"

namespace rolling {
namespace {

/// A comment without the # or ## before it.
std::string_view without_marks(std::string_view comment) {
  return comment.substr(std::min(comment.find_first_not_of('#'), comment.size()));
}

/// The names between these separators, 0 for blanks, without blank ones at the end that are too
/// many.
Names names_between(char separator, std::string_view text, const UnnamedColumns& columns) {
  Names found{{}, separator};
  auto names = split_names(text, separator);
  while (names.size() > columns.count - columns.blank_end && names.back().empty()) names.pop_back();
  for (const std::string& name : names) {
    const Column& column = found.columns.emplace_back(read_column(name));
    const bool article = separator == '\0' && names.size() > 1 && name == "a";  // perhaps
    found.known += !article && (is_known(column) ||
                                std::ranges::count(columns.before, column.name, &Column::name) > 0);
  }
  return found;
}

/// The words of a line, whatever separates them: `t [ms]`, `time` and `x [cm]` of `t [ms]: time, x
/// [cm]`.
std::vector<Column> words_of(std::string_view line) {
  std::string text(line);
  std::ranges::replace_if(text, is_separator, ' ');
  std::vector<Column> words;
  for (std::string& word : split_names(text, '\0')) {
    word.erase(word.find_last_not_of(",;:=") + 1);
    words.push_back(read_column(word));
  }
  return words;
}

/// True for a comment of nothing but known quantities, or that gives two of them units. One word
/// without a unit may be a label.
bool looks_like_names(std::string_view comment) {
  const std::vector<Column> words = words_of(without_marks(comment));
  const auto units = std::ranges::count_if(
      words, [](const Column& word) { return is_known(word) && !word.unit.empty(); });
  return units > 1 || ((words.size() > 1 || units > 0) && std::ranges::all_of(words, is_known));
}

/// True if each known quantity is in the same place in both, as far as both go.
bool agree(const std::vector<Column>& one, const std::vector<Column>& other) {
  for (std::size_t i = 0; i < std::min(one.size(), other.size()); ++i)
    if (one[i].name != other[i].name && (is_known(one[i]) || is_known(other[i]))) return false;
  return true;
}

/// A number, or a date or a time of day in digits: `24/11/2026`, `10:15:00.5`,
/// `2026-11-24T10:15:00Z`.
bool is_figure(const std::string& text) {
  return is_number(text) ||
         (!text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) &&
          text.find_first_not_of("0123456789+-.:/ TZ") == std::string_view::npos);
}

/// Whether the fields of a line are the units of as many names in the line above or below it: none
/// of them is a known name, and two are known units, or one beside names of which one is known.
bool are_units_of(const std::vector<Column>& names, const std::vector<Column>& fields) {
  const auto units = std::ranges::count_if(fields, is_unit, &Column::written);
  return names.size() == fields.size() && std::ranges::none_of(fields, is_known) &&
         units + std::ranges::any_of(names, is_known) > 1;
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
  if (std::ranges::all_of(dialect.split(other), is_number, &Field::text))
    fail(
        "'{}' can be read in two ways: if its commas without a blank are decimal ones, make them "
        "points first, else take the blanks away",
        shown(line));
}

/// A line above the first row of a run: a comment, a `##` line, names, units or a line of a
/// preamble.
struct HeadLine {
  std::string text;    // with its marks, if it is a comment
  std::size_t number;  // in the file
  Names names = {};    // that it may give the columns

  bool is_bare() const { return !text.starts_with('#'); }
  bool is_history() const { return rolling::is_history(text); }
  bool is_comment() const { return !is_bare() && !is_history(); }
  bool has_names() const { return !names.columns.empty(); }
};

/// The columns; the name of one without a name is c and its number.
std::vector<Column> with_names(std::vector<Column> columns) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name.empty()) columns[i].name = fmt::format("c{}", i + 1);
  return columns;
}

/// The comments and other lines in front of the first row.
class HeadReader {
 public:
  HeadReader(Lines& lines, Dialect& dialect, const Head* before)
      : lines_(lines), dialect_(dialect), before_(before) {}

  Head read(const std::vector<std::string>& order, Sides sides) {
    if (!find_row()) {
      if (!before_) refuse_without_rows();
      return finish();
    }
    lines_.put_back();
    lines_.separate_by(dialect_.separator());
    head_.line = lines_.number();
    const auto fields = dialect_.split(lines_.text());
    row_.count = fields.size();
    row_.blank_end = fields.size() > 1 && fields.back().text.empty();
    if (before_) row_.before = before_->layout.runs.front().columns;
    for (HeadLine& line : above_) line.names = names_in(line);
    const HeadLine* const header = find_header();
    head_.named = header;
    if (header) {
      take_names(*header, sides);
    } else if (before_) {
      head_.said = before_->said;
      head_.named = before_->named;
      head_.layout = before_->layout;
    } else {
      if (dialect_.separator() == ',') refuse_two_readings(std::string(lines_.text()));
      std::vector<Column> columns(row_.count);
      for (std::size_t i = 0; i < std::min(order.size(), row_.count); ++i)
        columns[i].name = order[i];
      head_.layout = Layout::of(with_names(std::move(columns)), sides);
    }
    return finish();
  }

 private:
  void take_history() {
    refuse_error_line(lines_);
    const std::string line = history_line(lines_.text());
    const std::string_view text = trim(std::string_view(line).substr(2));
    if (text.starts_with("run ")) {  // the `##` lines above belong to a run without rows
      head_.run = trim(text.substr(4));
      std::erase_if(above_, std::mem_fn(&HeadLine::is_history));
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
      const bool tabs = tabs_.contains(std::ranges::count(line, '\t'));
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
                      : !lines_.is_title() && dialect_.choose(line, tabs))
            return true;
          if (before_) refuse_other_separator(line);
          keep(line);
      }
    }
    return false;
  }

  Names names_in(const HeadLine& line) const {
    if (!line.is_bare()) return names_in_comment(line.text, row_);
    std::string text = line.text;
    if (dialect_.separator() && text.starts_with("\"# ")) text.erase(1, 2);  // a quoted comment
    return names_between(dialect_.separator(), text, row_);
  }

  /// The header: the last line that is no comment, but for one of units; or a comment where there
  /// is none, or where none has a known name and a comment below has some. Null without one.
  const HeadLine* find_header() const {
    std::vector<const HeadLine*> bare;
    for (const HeadLine& line : above_)
      if (line.is_bare()) bare.push_back(&line);
    if (const auto n = bare.size();
        n > 1 && are_units_of(bare[n - 2]->names.columns, bare[n - 1]->names.columns))
      bare.pop_back();
    const auto has_known_word = [](const HeadLine& line) {
      return line.is_bare() && std::ranges::any_of(words_of(line.text), is_known);
    };
    const auto has_known_names = [](const HeadLine& line) {
      return line.is_comment() && line.names.known > 0;
    };
    if (!bare.empty() &&
        (std::ranges::any_of(above_, has_known_word) ||
         std::none_of(bare.back(), above_.data() + above_.size(), has_known_names)))
      return bare.back();
    return choose_comment();
  }

  /// The last comment that has one name for each column, one of them known; in the first head of a
  /// file, else the last without known names. Null if there is none.
  const HeadLine* last_comment_with_names() const {
    const HeadLine* found = nullptr;
    for (auto line = above_.rbegin(); line != above_.rend(); ++line) {
      if (!line->is_comment()) continue;
      if (line->names.known > 0) return &*line;
      if (!before_ && !found && line->has_names() &&
          std::ranges::none_of(line->names.columns, is_figure, &Column::written))
        found = &*line;
    }
    return found;
  }

  /// The same comment. Refuses it, unless tabs separate the names or all are known, if another one
  /// may be meant, or if words between blanks would move known columns of the run before.
  const HeadLine* choose_comment() const {
    const HeadLine* const chosen = last_comment_with_names();
    const Names names = chosen ? chosen->names : Names();
    if (names.known > 0 && (names.separator == '\t' || names.known == names.columns.size()))
      return chosen;
    for (const HeadLine& other : above_) {
      if (&other == chosen || other.is_bare()) continue;
      const std::size_t known = other.names.known;
      const bool may_be_meant =
          looks_like_names(other.text) || (known > other.is_history() && known >= names.known);
      if (may_be_meant &&
          (!chosen || !other.has_names() || !agree(other.names.columns, names.columns)))
        refuse_names(other);
    }
    const bool article =
        names.known == 0 && std::ranges::count(names.columns, "a", &Column::written) > 0;
    if (chosen && names.separator == '\0' && (article || !agree(names.columns, row_.before)))
      refuse_names(*chosen);
    return chosen;
  }

  [[noreturn]] void refuse_names(const HeadLine& comment) const {
    fail<InputError>(
        "{}:{}: '{}' may be the names of the columns, or a sentence: put tabs between names, one "
        "for each of {}, behind one #; or give the sentence another number of words",
        lines_.name(), comment.number, shown(comment.text), counted(row_.count, "column"));
  }

  /// Takes the names and the units, in a line below them or in that above them, from the lines.
  void take_names(HeadLine header, Sides sides) {
    if (header.text.starts_with("# ") && header.text.find('\t') != std::string::npos)
      dialect_.has_points();
    head_.line = header.number;
    note_sorted_history();
    std::size_t first = header.number;  // of the lines that may be one of units
    for (const HeadLine& line : above_)
      if (line.number < header.number && !line.is_history())
        first = line.text.find(':') == std::string::npos ? line.number : header.number;
    std::vector<Column> units;
    std::erase_if(above_, [&](const HeadLine& line) {
      if (line.number == header.number) return true;
      if (line.number < first || !units.empty() || line.is_history() ||
          !are_units_of(header.names.columns, line.names.columns))
        return false;
      units = line.names.columns;
      return true;
    });
    auto columns = with_names(std::move(header.names.columns));
    for (std::size_t i = 0; i < units.size(); ++i) {
      const std::string below = bare_unit(units[i].written);
      if (below.empty()) continue;
      if (!columns[i].unit.empty() && columns[i].unit != below)
        fail<InputError>("{}:{}: the column '{}' has another unit in the line of units, '{}'",
                         lines_.name(), head_.line, shown(to_text(columns[i])), shown(below));
      columns[i].unit = below;
    }
    const std::size_t names = columns.size();
    const std::size_t width = row_.count - (row_.blank_end && names + 1 == row_.count);
    head_.layout = Layout::of(columns, sides);
    if (head_.layout.side_by_side() ? width > names : width != names)
      fail(
          "{} under a line of {}: begin that with # if it is no header, put quotes around names "
          "that hold a separator, and make decimal commas points",
          counted(width, "field"), counted(names, "name"));
  }

  /// Notes that several `##` lines were sorted, if one stands below the comment with the names: the
  /// tools write the names last, and what sorts rows by a column puts `# t` before `##`.
  void note_sorted_history() {
    const auto is_below = [&](const HeadLine& line) {
      return line.is_history() && line.number > head_.line;
    };
    const auto all = std::ranges::count_if(above_, &HeadLine::is_history);
    const auto below = std::ranges::count_if(above_, is_below);
    if (below > 0 && all > 1)
      above_.push_back({fmt::format("## {}", lines_sorted), above_.back().number});
  }

  [[noreturn]] void refuse_without_rows() const {
    if (const auto bare =
            std::find_if(above_.rbegin(), above_.rend(), std::mem_fn(&HeadLine::is_bare));
        bare != above_.rend()) {
      const auto blank = bare->text.find(' ');
      const bool unit = bare->text.find_first_of(decimal_digits) < blank &&
                        blank + 1 < bare->text.size() && is_unit(bare->text.substr(blank + 1, 1));
      fail<InputError>("{}:{}: no rows: no field of '{}' is a number{}", lines_.name(),
                       bare->number, shown(bare->text),
                       unit ? "; a unit stands in the header alone" : "");
    }
    if (lines_.name() == "-" && above_.empty())
      fail<InputError>("standard input is empty: did the tool before this one fail?");
    fail<InputError>("{}: no rows", lines_.name());
  }

  /// The lines that are neither names nor units are comments.
  Head finish() {
    for (HeadLine& line : above_) {
      note_units(line.text, line.number, head_.said);
      const std::string_view words = trim(without_marks(line.text));
      if (line.is_history() && !words.empty()) head_.history.emplace_back(words);
      std::ranges::replace(line.text, '\n', ' ');
      head_.comments.push_back((line.is_bare() ? "# " : "") + std::move(line.text));
    }
    return std::move(head_);
  }

  Lines& lines_;
  Dialect& dialect_;
  const Head* before_;
  Head head_;
  UnnamedColumns row_;
  std::vector<HeadLine> above_;    // the lines above the row, but for blank ones
  std::set<std::ptrdiff_t> tabs_;  // how many each of them has
};

}  // namespace

Names names_in_comment(std::string_view comment, const UnnamedColumns& columns) {
  std::string_view text = without_marks(comment);
  text = text.substr(0, text.find_last_not_of(filling) + 1);
  const auto ends_a_phrase = [](const Column& word) {
    return !word.written.empty() && std::string_view(",;:").find(word.written.back()) < 3;
  };
  Names unknown;
  for (const char separator : std::string(separators) + '\0') {
    Names found = names_between(separator, text, columns);
    auto& names = found.columns;
    while (names.size() > columns.count && names.front().written.empty())
      names.erase(names.begin());
    const bool fit =
        names.size() == columns.count || names.size() + columns.blank_end == columns.count;
    if (!fit || (separator == '\0' && std::ranges::any_of(names, ends_a_phrase))) continue;
    if (found.known > 0) return found;
    if (unknown.columns.empty()) unknown = std::move(found);
  }
  return unknown;
}

Head read_head(Lines& lines, Dialect& dialect, const Head* before,
               const std::vector<std::string>& order, Sides sides) {
  return located([&] { return fmt::format("{}:{}", lines.name(), lines.number()); },
                 [&] { return HeadReader(lines, dialect, before).read(order, sides); });
}

}  // namespace rolling
