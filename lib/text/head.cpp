#include "text/head.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "text/delimiters.h"
#include "text/number.h"

namespace rolling {
namespace {

constexpr std::size_t npos = static_cast<std::size_t>(-1);
constexpr std::size_t longest_preamble =
    100;  // lines without a number; more means that the file has no columns
constexpr std::string_view ended_with_an_error = ": ended with an error";

/// A `##` line without the separators with which a spreadsheet fills it up.
std::string_view history_line(std::string_view line) {
  return trim(line.substr(0, line.find_last_not_of("\t;, ") + 1));
}

std::string name_of(char separator) {
  return separator == '\0' ? "blanks" : separator == '\t' ? "tabs" : fmt::format("'{}'", separator);
}

/// The comments and other lines in front of the first record.
class HeadReader {
 public:
  HeadReader(Lines& lines, Dialect& dialect, const Head* before)
      : lines_(lines), dialect_(dialect), before_(before) {}

  Head read(const std::vector<std::string>& order, Sides sides);

 private:
  bool find_record();
  void take_history();
  void forget_history();
  void check_bytes() const;
  bool is_record(std::string_view line);
  bool is_missing_record(std::string_view line);
  void refuse_other_separator() const;
  void take_units();
  void add_unit(Column& column, std::string_view unit) const;
  std::vector<std::string> take_names(std::size_t width);
  enum class Proof { known, known_or_tabs, none };
  std::vector<std::string> take_commented_names(std::size_t width, Proof);
  static std::vector<Column> units_in(const std::string& comment);
  void refuse_other_names(std::size_t width) const;
  void note_other_units(std::vector<Column>& columns) const;
  void refuse_units(const std::vector<std::string>& fields, std::size_t line) const;
  void refuse_lines_of_units(std::size_t width) const;
  std::vector<Column> known_columns() const;

  struct Line {
    std::string text;
    std::size_t number;
  };
  Lines& lines_;
  Dialect& dialect_;
  const Head* before_;
  Head head_;
  std::vector<std::size_t> numbers_;  // of the lines of the comments
  std::vector<Line> preamble_;        // lines that are neither comments nor records
  std::vector<std::string> units_;    // of the line between names and records, if there is one
};

std::vector<Column> HeadReader::known_columns() const {
  return before_ ? before_->layout.runs.front().columns : std::vector<Column>();
}

void HeadReader::check_bytes() const {
  const std::string_view line = lines_.text();
  if (line.find('\0') != npos)
    fail<InputError>(
        "{}:{}: a NUL byte: this is no text of columns; export a spreadsheet as CSV, unpack what "
        "is packed, make UTF-16 UTF-8 (iconv -f UTF-16)",
        lines_.name(), lines_.number());
  if (line.find('\r') != npos)
    fail<InputError>(
        "{}:{}: a carriage return within the line; make the line ends LF first (tr '\\r' '\\n')",
        lines_.name(), lines_.number());
}

void HeadReader::take_history() {
  refuse_error_line(lines_);
  const std::string_view line = history_line(lines_.text()), text = trim(line.substr(2));
  if (text.starts_with("run ")) {
    head_.run = trim(text.substr(4));
    forget_history();
    return;
  }
  head_.history.emplace_back(text);
  head_.comments.emplace_back(line);
  numbers_.push_back(lines_.number());
}

/// Drops the `##` lines above the line `## run NAME`: they belong to a run without records.
void HeadReader::forget_history() {
  head_.history.clear();
  for (std::size_t i = head_.comments.size(); i-- > 0;) {
    if (!head_.comments[i].starts_with("##")) continue;
    head_.comments.erase(head_.comments.begin() + static_cast<std::ptrdiff_t>(i));
    numbers_.erase(numbers_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// True for a first record with missing readings: a field is NaN, which is no name of a column; or
/// fields are blank below a line of names.
bool HeadReader::is_missing_record(std::string_view line) {
  const auto fields = dialect_.split(line);
  const auto is_blank_field = [](const Field& field) { return field.text.empty(); };
  if (std::any_of(fields.begin(), fields.end(),
                  [](const Field& field) { return !field.text.empty() && is_missing(field.text); }))
    return true;
  const std::size_t width = fields.size();
  const bool all_blank = std::all_of(fields.begin(), fields.end(), is_blank_field);
  if (before_ && !all_blank) {  // a names line has no blanks where the one before had names
    const auto last = before_->blank_end ? fields.end() - 1 : fields.end();
    return width == before_->layout.width && std::any_of(fields.begin(), last, is_blank_field);
  }
  if (before_) return all_blank;
  if (preamble_.empty())  // blanks under the names of a comment; beside text, if these are certain
    return std::any_of(fields.begin(), fields.end(), is_blank_field) &&
           std::any_of(head_.comments.begin(), head_.comments.end(), [&](const auto& comment) {
             const auto [names, tabs, is_known] = names_in_comment(comment, width, {});
             return !names.empty() && (all_blank || tabs || is_known);
           });
  if (!all_blank) return false;
  const auto names = names_in(preamble_.back().text, dialect_);
  return names.size() == width &&
         std::none_of(names.begin(), names.end(),
                      [](const std::string& name) { return name.empty(); });
}

bool HeadReader::is_record(std::string_view line) {
  return (before_ ? dialect_.holds_number(line) : dialect_.choose(line)) || is_missing_record(line);
}

/// Refuses a line that begins with a number and has another one, between other separators than
/// those of the file: it is no heading, and the run would be lost.
void HeadReader::refuse_other_separator() const {
  Dialect other;
  if (!other.choose(lines_.text())) return;
  const auto fields = other.split(lines_.text());
  const auto is_reading = [](const Field& field) {
    return is_number(field.text) || is_missing(field.text);
  };
  if (is_reading(fields.front()) && std::ranges::count_if(fields, is_reading) > 1)
    fail<InputError>(
        "{}:{}: '{}' is separated by {}, and the records before by {}; if it is a heading, begin "
        "it with #",
        lines_.name(), lines_.number(), shown(lines_.text()), name_of(other.separator()),
        name_of(dialect_.separator()));
}

/// Goes to the first record; false if there is none.
bool HeadReader::find_record() {
  while (lines_.next()) {
    check_bytes();
    switch (kind_of(lines_.text())) {
      case LineKind::blank:
        break;
      case LineKind::history:
        take_history();
        break;
      case LineKind::comment:
        head_.comments.emplace_back(lines_.text().substr(lines_.text().find('#')));
        numbers_.push_back(lines_.number());
        break;
      case LineKind::record:
        if (is_record(lines_.text())) return true;
        if (before_) refuse_other_separator();
        preamble_.push_back({std::string(lines_.text()), lines_.number()});
        if (preamble_.size() > longest_preamble)
          fail<InputError>("{}: no numbers in the first {} lines", lines_.name(), longest_preamble);
    }
  }
  return false;
}

/// The names of the last comment that has as many names as there are columns, and as much proof
/// that they are names.
std::vector<std::string> HeadReader::take_commented_names(std::size_t width, Proof proof) {
  std::size_t found = npos;
  const std::vector<Column> known = known_columns();
  for (std::size_t i = head_.comments.size(); found == npos && i-- > 0;) {
    const auto [names, tabs, is_known] = names_in_comment(head_.comments[i], width, known);
    const bool proven = is_known || (tabs && proof != Proof::known) || proof == Proof::none;
    if (!names.empty() && proven) found = i;
  }
  if (found == npos) return {};
  auto names = names_in_comment(head_.comments[found], width, known).names;
  head_.line = numbers_[found];
  head_.comments.erase(head_.comments.begin() + static_cast<std::ptrdiff_t>(found));
  return names;
}

/// The known quantities with their units in a comment, `t [ms]: time, x [cm]`.
std::vector<Column> HeadReader::units_in(const std::string& comment) {
  std::vector<Column> all;
  if (comment.starts_with("##")) return all;
  for (std::string& name : split_names(trim(std::string_view(comment).substr(1)),
                                       comment.find('\t') == npos ? '\0' : '\t')) {
    name.erase(name.find_last_not_of(",;:=") + 1);
    const Column column = read_column(name);
    if (!si_unit(column.name).empty() && !column.unit.empty()) all.push_back(column);
  }
  return all;
}

/// Refuses a comment that contains units but not as many names as there are columns: columns
/// without names are read in SI units, which would contradict it.
void HeadReader::refuse_other_names(std::size_t width) const {
  for (std::size_t i = 0; i < head_.comments.size(); ++i) {
    const auto units = units_in(head_.comments[i]);
    if (units.size() > 1 || std::ranges::any_of(units, [](const Column& column) {
          return column.unit != si_unit(column.name);
        }))
      fail<InputError>("{}:{}: a comment with units, but not the names of {} column{}",
                       lines_.name(), numbers_[i], width, width == 1 ? "" : "s");
  }
}

/// Notes the units other than SI that comments give to columns whose names have none.
void HeadReader::note_other_units(std::vector<Column>& columns) const {
  for (const std::string& comment : head_.comments)
    for (const Column& said : units_in(comment))
      for (Column& column : columns)
        if (column.name == said.name && column.unit.empty() &&
            unit_kind(said.unit) == UnitKind::other)
          column.elsewhere = said.unit;
}

void HeadReader::refuse_units(const std::vector<std::string>& fields, std::size_t line) const {
  bool all_units = true, other = false;
  for (const std::string& field : fields) {
    const UnitKind kind = unit_kind(field);
    all_units = all_units && (field.empty() || kind != UnitKind::none);
    other = other || kind == UnitKind::other;
  }
  if (all_units && other)
    fail<InputError>("{}:{}: a line of units: put each behind the name of its column, as in t[ms]",
                     lines_.name(), line);
}

/// Takes the line of units below the line of names: of two lines of equal width the lower one,
/// above the records, has no known name, and the upper one has or the lower one has two known
/// units.
void HeadReader::take_units() {
  if (preamble_.size() < 2) return;
  const auto known = [](const std::string& name) {
    return !si_unit(read_column(name).name).empty();
  };
  const auto is_unit = [](const std::string& text) { return unit_kind(text) != UnitKind::none; };
  const auto names = names_in(preamble_[preamble_.size() - 2].text, dialect_);
  auto units = names_in(preamble_.back().text, dialect_);
  if (names.size() != units.size() || std::ranges::any_of(units, known) ||
      (std::ranges::none_of(names, known) && std::ranges::count_if(units, is_unit) < 2))
    return;
  units_ = std::move(units);
  preamble_.pop_back();
}

/// Gives a column its unit from that line.
void HeadReader::add_unit(Column& column, std::string_view unit) const {
  if (unit.size() > 2 && (unit.front() == '[' || unit.front() == '('))
    unit = trim(unit.substr(1, unit.size() - 2));
  if (unit.empty()) return;
  const std::string below = read_column(fmt::format("{}[{}]", column.name, unit)).unit;
  if (!column.unit.empty() && column.unit != below)
    fail<InputError>("{}:{}: the column '{}' has another unit in the line below, '{}'",
                     lines_.name(), head_.line, shown(to_text(column)), shown(unit));
  column.unit = below;
}

/// Refuses other lines of units, which the tools do not read: columns are not taken as SI if a line
/// says otherwise.
void HeadReader::refuse_lines_of_units(std::size_t width) const {
  if (width < 2) return;
  for (std::size_t i = 0; i < head_.comments.size(); ++i)
    refuse_units(names_in_comment(head_.comments[i], width, {}).names, numbers_[i]);
  for (const Line& line : preamble_)
    if (const auto fields = names_in(line.text, dialect_); fields.size() == width)
      refuse_units(fields, line.number);
}

/// The names of `width` columns; empty if there are none here.
std::vector<std::string> HeadReader::take_names(std::size_t width) {
  const bool blank_end = dialect_.split(lines_.text()).back().text.empty();
  if (preamble_.empty()) {
    auto names = take_commented_names(width, Proof::known_or_tabs);
    if (names.empty() && blank_end &&  // a nameless column stands behind the others
        !(names = take_commented_names(width - 1, Proof::known)).empty())
      names.emplace_back();
    if (names.empty() && !before_) names = take_commented_names(width, Proof::none);
    if (names.empty()) refuse_other_names(width);
    return names;
  }
  auto names = names_in(preamble_.back().text, dialect_);
  head_.line = preamble_.back().number;
  preamble_.pop_back();
  for (Line& line : preamble_) {
    std::replace(line.text.begin(), line.text.end(), '\n', ' ');
    head_.comments.push_back("# " + std::move(line.text));
  }
  if (names.size() == width + 1 && names.back().empty()) names.pop_back();
  else if (names.size() + 1 == width && blank_end) names.emplace_back();
  return names;
}

Head HeadReader::read(const std::vector<std::string>& order, Sides sides) {
  if (!find_record()) {
    if (!before_) fail<InputError>("{}: no records", lines_.name());
    for (const Line& line : preamble_) head_.comments.push_back("# " + line.text);
    return std::move(head_);
  }
  lines_.put_back();
  lines_.separate_by(dialect_.separator());
  head_.line = lines_.number();
  const auto fields = dialect_.split(lines_.text());
  const std::size_t width = fields.size();
  const bool blank_field = fields.back().text.empty();
  take_units();
  refuse_lines_of_units(width);
  const auto names = take_names(width);
  if (names.empty() && before_) {
    head_.named = before_->named;
    head_.blank_end = before_->blank_end;
    head_.layout = before_->layout;
    return std::move(head_);
  }
  head_.named = !names.empty();
  head_.blank_end =
      blank_field && width > 1 && (names.size() < width ? !head_.named : names.back().empty());
  std::vector<Column> columns;
  for (std::size_t i = 0; i < std::max(width, names.size()); ++i) {
    if (i < names.size()) columns.push_back(read_column(names[i]));
    else if (i < order.size() && !head_.named)
      columns.push_back({order[i], std::string(si_unit(order[i]))});
    else columns.emplace_back();
    if (i < units_.size()) add_unit(columns.back(), units_[i]);
    if (columns.back().name.empty()) columns.back().name = fmt::format("c{}", i + 1);
  }
  note_other_units(columns);
  head_.layout = sides == Sides::one ? Layout::one(columns) : Layout::of(columns);
  if (head_.named && (head_.layout.side_by_side() ? width > names.size() : width != names.size()))
    fail<InputError>("{}:{}: {} field{} under a line of {} name{}{}", lines_.name(),
                     lines_.number(), width, width == 1 ? "" : "s", names.size(),
                     names.size() == 1 ? "" : "s",
                     before_ ? fmt::format("; if line {} is a heading, begin it with #", head_.line)
                     : dialect_.separator() == ','
                         ? "; if some of its commas are decimal ones, make them points first"
                         : "");
  return std::move(head_);
}

}  // namespace

std::vector<std::string> names_in(std::string_view line, Dialect& dialect) {
  if (dialect.separator() == '\0') return split_names(line, '\0');
  std::vector<std::string> names;
  for (const Field& field : dialect.split(line)) names.emplace_back(field.text);
  return names;
}

CommentedNames names_in_comment(std::string_view comment, std::size_t width,
                                const std::vector<Column>& known) {
  if (comment.starts_with("##")) return {};
  const std::string_view text = comment.substr(1);
  const auto in_force = [&](const std::string& name) {
    const std::string plain = read_column(name).name;
    return !si_unit(plain).empty() || std::any_of(known.begin(), known.end(),
                                                  [&](const Column& c) { return c.name == plain; });
  };
  for (const char separator : std::string(separators) + '\0')
    for (const std::string_view words : {text, trim(text)}) {  // a tab at an end may be a separator
      auto names = split_names(words, separator);
      if (names.size() != width) continue;
      const bool is_known = std::any_of(names.begin(), names.end(), in_force);
      return {names, separator == '\t' && width > 1, is_known};
    }
  return {};
}

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

void refuse_error_line(const Lines& lines) {
  const std::string_view text = trim(history_line(lines.text()).substr(2));
  if (text.ends_with(ended_with_an_error) && text.find(' ') == text.find(':') + 1)
    fail<InputError>("{}:{}: {} ended with an error: the records are not complete", lines.name(),
                     lines.number(), shown(text.substr(0, text.find(':'))));
}

std::string error_line(std::string_view tool) {
  return fmt::format("## {}{}", tool, ended_with_an_error);
}

}  // namespace rolling
