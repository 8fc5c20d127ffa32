// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/head.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <set>
#include <utility>

#include "base/enumeration.h"
#include "base/error.h"
#include "text/delimiters.h"
#include "text/number.h"

namespace rolling {

// Names in comments.

namespace {

bool is_known_name(const std::string& text) { return is_known(read_column(text)); }

/// A comment without the # or ## before it.
std::string_view without_marks(std::string_view comment) {
  return comment.substr(std::min(comment.find_first_not_of('#'), comment.size()));
}

/// Leaves out blank names at the end that are too many.
void fit_end(std::vector<std::string>& names, const UnnamedColumns& columns) {
  while (names.size() > columns.count - columns.blank_end && names.back().empty()) names.pop_back();
}

/// The names of as many columns between these separators, 0 for blanks; none if there are not as
/// many, or if words between blanks end as in a sentence.
CommentedNames names_between(char separator, std::string_view text, const UnnamedColumns& columns) {
  CommentedNames found{split_names(text, separator), {}, separator};
  auto& names = found.names;
  fit_end(names, columns);
  while (names.size() > columns.count && names.front().empty()) names.erase(names.begin());
  const bool words = separator == '\0';
  const auto ends_a_phrase = [](const std::string& word) {
    return !word.empty() && std::string_view(",;:").find(word.back()) != std::string_view::npos;
  };
  if (!columns.fit(names.size()) || (words && std::ranges::any_of(names, ends_a_phrase))) return {};
  for (const std::string& name : names) {
    const Column& column = found.columns.emplace_back(read_column(name));
    const bool article = words && names.size() > 1 && name == "a";  // perhaps
    found.known += !article && (is_known(column) ||
                                std::ranges::count(columns.before, column.name, &Column::name) > 0);
  }
  return found;
}

/// The words of a line, whatever separates them: `t [ms]`, `time` and `x [cm]` of `t [ms]: time, x
/// [cm]`.
std::vector<Column> words_of(std::string_view line) {
  std::string text(line);
  for (const char separator : separators) std::ranges::replace(text, separator, ' ');
  std::vector<Column> words;
  for (std::string& word : split_names(text, '\0')) {
    word.erase(word.find_last_not_of(",;:=") + 1);
    words.push_back(read_column(word));
  }
  return words;
}

/// True if t, x, v, a or D is a word of the line.
bool holds_known_name(std::string_view line) {
  return std::ranges::any_of(words_of(line), is_known);
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

/// A date or a time of day, in digits: `24/11/2026`, `10:15:00.5`, `2026-11-24T10:15:00Z`.
bool is_date(std::string_view text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) &&
         text.find_first_not_of("0123456789+-.:/ TZ") == std::string_view::npos;
}

}  // namespace

CommentedNames names_in_comment(std::string_view comment, const UnnamedColumns& columns) {
  std::string_view text = without_marks(comment);
  text = text.substr(0, text.find_last_not_of(filling) + 1);
  CommentedNames unknown;
  for (const char separator : std::string(separators) + '\0') {
    auto found = names_between(separator, text, columns);
    if (found.known > 0) return found;
    if (unknown.names.empty()) unknown = std::move(found);
  }
  return unknown;
}

const HeadLine* choose_names(std::span<const HeadLine> comments, const UnnamedColumns& columns,
                             bool first, std::string_view file) {
  const HeadLine* chosen = nullptr;
  CommentedNames names;  // in it
  const auto is_figure = [](const std::string& s) { return is_number(s) || is_date(s); };
  for (std::size_t i = comments.size(); i-- > 0 && names.known == 0;) {
    if (comments[i].is_bare() || comments[i].is_history()) continue;
    CommentedNames found = names_in_comment(comments[i].text, columns);
    const bool may_be_names =
        first && !chosen && !found.names.empty() && std::ranges::none_of(found.names, is_figure);
    if (found.known == 0 && !may_be_names) continue;
    chosen = &comments[i];
    names = std::move(found);
  }
  if (names.known > 0 && (names.separator == '\t' || names.known == names.names.size()))
    return chosen;
  const auto refuse = [&](const HeadLine& comment) {
    fail<InputError>(
        "{}:{}: '{}' may be the names of the columns, or a sentence: put tabs between names, one "
        "for each of {}, behind one #; or give the sentence another number of words",
        file, comment.line, shown(comment.text), counted(columns.count, "column"));
  };
  for (const HeadLine& comment : comments) {
    if (&comment == chosen || comment.is_bare()) continue;
    const CommentedNames other = names_in_comment(comment.text, columns);
    const bool may_be_meant = looks_like_names(comment.text) ||
                              (other.known > comment.is_history() && other.known >= names.known);
    if (may_be_meant && (!chosen || other.names.empty() || !agree(other.columns, names.columns)))
      refuse(comment);
  }
  const bool article = names.known == 0 && std::ranges::count(names.names, "a") > 0;
  if (chosen && names.separator == '\0' && (article || !agree(names.columns, columns.before)))
    refuse(*chosen);
  return chosen;
}

bool are_units_of(const std::vector<std::string>& names, const std::vector<std::string>& fields) {
  const auto units = std::ranges::count_if(fields, is_unit);
  return names.size() == fields.size() && std::ranges::none_of(fields, is_known_name) &&
         units + std::ranges::any_of(names, is_known_name) > 1;
}

void add_unit(Column& column, std::string_view unit, std::string_view place) {
  const std::string below = bare_unit(unit);
  if (below.empty()) return;
  if (!column.unit.empty() && column.unit != below)
    fail<InputError>("{}: the column '{}' has another unit in the line of units, '{}'", place,
                     shown(to_text(column)), shown(below));
  column.unit = below;
}

// All lines above the first row.

namespace {

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
    const bool blank_end = fields.size() > 1 && fields.back().text.empty();
    std::vector<std::string> units;
    const auto names =
        take_names({fields.size(), blank_end,
                    before_ ? before_->layout.runs.front().columns : std::vector<Column>()},
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
    std::vector<Column> columns;
    for (std::size_t i = 0; i < (head_.named ? names.size() : fields.size()); ++i) {
      if (head_.named) columns.push_back(read_column(names[i]));
      else columns.push_back({i < order.size() ? order[i] : ""});
      if (columns.back().name.empty()) columns.back().name = fmt::format("c{}", i + 1);
      if (i < units.size())
        add_unit(columns.back(), units[i], fmt::format("{}:{}", lines_.name(), head_.line));
    }
    head_.layout = Layout::of(columns, sides);
    const std::size_t width = fields.size() - (blank_end && names.size() + 1 == fields.size());
    if (head_.named && (head_.layout.side_by_side() ? width > names.size() : width != names.size()))
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
  std::vector<std::string> names_of(const HeadLine& line, const UnnamedColumns& columns) const {
    if (!line.is_bare()) return names_in_comment(line.text, columns).names;
    const char separator = dialect_.separator();
    auto names = split_names(line.text, separator);
    if (separator && names.front().starts_with("# ")) names.front().erase(0, 2);  // quoted
    return names;
  }

  /// The header: the last line that is no comment, but for one of units; or a comment where there
  /// is none, or where none has a known name and a comment below has some. Null without one.
  const HeadLine* find_header(const UnnamedColumns& columns) const {
    std::vector<std::size_t> bare;
    for (std::size_t i = 0; i < above_.size(); ++i)
      if (above_[i].is_bare()) bare.push_back(i);
    if (bare.size() > 1 && are_units_of(names_of(above_[bare.end()[-2]], columns),
                                        names_of(above_[bare.back()], columns)))
      bare.pop_back();
    const HeadLine* const last = bare.empty() ? nullptr : &above_[bare.back()];
    const auto names_columns = [&](const HeadLine& line) {
      return !line.is_bare() && !line.is_history() &&
             names_in_comment(line.text, columns).known > 0;
    };
    const auto has_name = [](const HeadLine& line) {
      return line.is_bare() && holds_known_name(line.text);
    };
    if (last && (std::ranges::any_of(above_, has_name) ||
                 std::none_of(last, above_.data() + above_.size(), names_columns)))
      return last;
    return choose_names(above_, columns, !before_, lines_.name());
  }

  /// The names of the columns, empty if there are none here, and the units in a line below them or
  /// in that above them.
  std::vector<std::string> take_names(const UnnamedColumns& columns,
                                      std::vector<std::string>& units) {
    const HeadLine* const found = find_header(columns);
    if (!found) return {};
    const HeadLine header = *found;
    if (header.text.starts_with("# ") && header.text.find('\t') != std::string::npos)
      dialect_.has_points();
    head_.line = header.line;
    note_sorted_history();
    auto names = names_of(header, columns);
    std::size_t first = header.line;  // of the lines that may be one of units
    for (const HeadLine& line : above_)
      if (line.line < header.line && !line.is_history())
        first = line.text.find(':') == std::string::npos ? line.line : header.line;
    std::erase_if(above_, [&](const HeadLine& line) {
      if (line.line == header.line) return true;
      if (line.line < first || !units.empty() || line.is_history()) return false;
      auto fields = names_of(line, columns);
      const bool has_units = are_units_of(names, fields);
      if (has_units) units = std::move(fields);
      return has_units;
    });
    fit_end(names, columns);
    return names;
  }

  /// Notes that several `##` lines were sorted, if one stands below the comment with the names: the
  /// tools write the names last, and what sorts rows by a column puts `# t` before `##`.
  void note_sorted_history() {
    const auto is_below = [&](const HeadLine& line) {
      return line.is_history() && line.line > head_.line;
    };
    const auto all = std::ranges::count_if(above_, &HeadLine::is_history);
    const auto below = std::ranges::count_if(above_, is_below);
    if (below > 0 && all > 1)
      above_.push_back({fmt::format("## {}", lines_sorted), above_.back().line});
  }

  [[noreturn]] void refuse_without_rows() const {
    if (const auto bare =
            std::find_if(above_.rbegin(), above_.rend(), std::mem_fn(&HeadLine::is_bare));
        bare != above_.rend())
      fail<InputError>("{}:{}: no rows: no field of '{}' is a number", lines_.name(), bare->line,
                       shown(bare->text));
    if (lines_.name() == "-" && above_.empty())
      fail<InputError>("standard input is empty: did the tool before this one fail?");
    fail<InputError>("{}: no rows", lines_.name());
  }

  /// The lines that are neither names nor units are comments.
  Head finish() {
    for (HeadLine& line : above_) {
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
  std::vector<HeadLine> above_;    // the lines above the row, but for blank ones
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
