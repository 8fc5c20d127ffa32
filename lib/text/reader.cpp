#include "text/reader.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "text/number.h"

namespace rolling {
namespace {

constexpr std::size_t npos = static_cast<std::size_t>(-1);
constexpr std::size_t longest_preamble = 100;  // lines; more without a number is not a file of columns

bool is_comment(std::string_view line) {
  const auto at = line.find_first_not_of(" \t");
  return at != std::string_view::npos && line[at] == '#';
}

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t") == std::string_view::npos; }

bool is_number(std::string_view field) {
  double value;
  return parse_number(field, value);
}

/// `1,5` as `1.5`; empty if the field is no number with one decimal comma.
std::string with_point(std::string_view field) {
  std::string text(field);
  const auto comma = text.find(',');
  if (comma == std::string::npos || text.find('.') != std::string::npos) return {};
  text[comma] = '.';
  return is_number(text) ? text : std::string();
}

}  // namespace

Reader::Reader(ReaderOptions options, std::vector<std::string> order) : options_(std::move(options)), order_(std::move(order)) {
  if (options_.files.empty()) options_.files = {"-"};
  for (const std::string& use : options_.use) {
    const auto equals = use.find('=');
    if (equals == 0 || equals == npos || equals + 1 == use.size()) fail("--use: '{}' is not NAME=COLUMN", shown(use));
    const std::string quantity = read_column(use.substr(0, equals)).name;
    if (si_unit(quantity).empty()) fail("--use: '{}' is not about t, x, v, a or D", shown(use));
    if (!use_.emplace(quantity, use.substr(equals + 1)).second) fail("--use: '{}' comes after another for {}", shown(use), quantity);
  }
  open_next();
  history_changed_ = false;
}

// ---------------------------------------------------------------------------------------------------------------- header

void Reader::open_next() {
  begun_ = false;
  input_ = std::make_unique<Input>(options_.files[next_file_++]);
  history_changed_ = !history_.empty();
  history_.clear();
  read_header();
}

/// The form of a line: the first of tab ; , that it has outside quotes, else blanks. A line of numbers in which tabs and
/// blanks both separate is one of blanks.
void Reader::choose_separator(std::string_view line) {
  bool tab = false, semicolon = false, comma = false, quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    tab |= c == '\t';
    semicolon |= c == ';';
    comma |= c == ',';
  }
  separator_ = tab ? '\t' : semicolon ? ';' : comma ? ',' : '\0';
  if (!tab) return;
  split(line);
  const bool blanks_inside = std::any_of(fields_.begin(), fields_.end(), [](auto f) { return f.find(' ') != npos; });
  if (!blanks_inside) return;
  separator_ = '\0';
  split(line);
  if (!std::all_of(fields_.begin(), fields_.end(), is_number)) separator_ = '\t';
}

bool Reader::is_data(std::string_view line) {
  choose_separator(line);
  decimal_mark_ = separator_ == '\t' || separator_ == ';' ? '\0' : '.';
  split(line);
  return std::any_of(fields_.begin(), fields_.end(),
                     [this](auto field) { return is_number(field) || (decimal_mark_ != '.' && !with_point(field).empty()); });
}

void Reader::read_header() {
  const bool first_file = next_file_ == 1;
  std::vector<std::string> comments, preamble;
  in_header_ = true;
  header_line_.clear();
  bool found = false;
  while (!found && input_->next(line_)) {
    if (is_blank(line_)) continue;
    if (is_comment(line_)) comments.emplace_back(trim(line_));
    else if (is_data(line_)) found = true;
    else preamble.emplace_back(line_);
    if (preamble.size() > longest_preamble) fail<InputError>("{}: no numbers in the first {} lines", input_->name(), longest_preamble);
  }
  if (!found) fail<InputError>("{}: no records", input_->name());

  const std::size_t width = fields_.size();
  std::vector<std::string> names;
  if (!preamble.empty()) {
    header_line_ = preamble.back();
    preamble.pop_back();
    if (separator_ == '\0') {
      names = split_names(header_line_, separator_);
    } else {
      split(header_line_);
      names.assign(fields_.begin(), fields_.end());
    }
    if (names.size() != width)
      fail<InputError>("{}:{}: {} field{} under a line of {} names", input_->name(), input_->line_number(), width, width == 1 ? "" : "s", names.size());
  } else {
    const auto last = std::find_if(comments.rbegin(), comments.rend(), [](const auto& c) { return !c.starts_with("##"); });
    if (last != comments.rend()) {
      const std::string_view text = trim(std::string_view(*last).substr(1));
      for (const char separator : {'\t', separator_, '\0'})
        if (names.size() != width) names = split_names(text, separator);
      if (names.size() == width) comments.erase(std::next(last).base());
      else names.clear();
    }
  }
  for (std::string& line : preamble) comments.push_back("# " + std::move(line));

  std::vector<Column> columns;
  for (std::size_t i = 0; i < width; ++i) {
    if (i < names.size()) columns.push_back(read_column(names[i]));
    else columns.push_back({i < order_.size() ? order_[i] : ""});
    if (columns.back().name.empty()) columns.back().name = fmt::format("c{}", i + 1);
  }
  if (first_file) {
    named_ = !names.empty();
    columns_ = columns_as_read_ = std::move(columns);
    if (!named_)
      for (Column& column : columns_) column.unit = si_unit(column.name);
    for (const std::string& text : comments) comment(text);
    in_header_ = false;
  } else {
    if (columns != columns_as_read_ || named_ == names.empty())
      fail<InputError>("{}: its columns are not those of {}", input_->name(), options_.files.front());
    in_header_ = false;
    for (const std::string& text : comments) comment(text);
  }
  line_waits_ = true;
}

std::optional<std::size_t> Reader::find(std::string_view name) const {
  const auto use = use_.find(read_column(name).name);
  if (use == use_.end()) return find_column(name, columns_);
  if (const auto at = find_column(use->second, columns_as_read_)) return at;
  fail<InputError>("{}: --use {}={}: there is no column '{}' among {}", input_->name(), use->first, shown(use->second), shown(use->second), column_list());
}

std::optional<std::size_t> Reader::find_column(std::string_view name, const std::vector<Column>& columns) const {
  if (double number; name.find_first_not_of("0123456789") == npos && parse_number(name, number))
    return number >= 1 && number <= static_cast<double>(columns.size()) ? std::optional(static_cast<std::size_t>(number) - 1) : std::nullopt;
  const std::string plain = read_column(name).name;
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name == plain) {
      if (found) fail<InputError>("{}: columns {} and {} are both {}; say --use {}=N", input_->name(), *found + 1, i + 1, plain, plain);
      found = i;
    }
  return found;
}

std::string Reader::column_list() const {
  std::string list;
  for (const Column& column : columns_) {
    if (!list.empty()) list += ", ";
    list += shown(to_text(column));
    if (list.size() > 200) return list + ", ...";
  }
  return named_ ? list : fmt::format("{} without names", columns_.size());
}

std::size_t Reader::require(std::string_view name) const {
  if (const auto column = find(name)) return *column;
  fail<InputError>("{}: there is no column '{}' among {}{}", input_->name(), shown(name), column_list(),
                   si_unit(read_column(name).name).empty() ? "" : fmt::format("; say --use {}=COLUMN", name));
}

std::size_t Reader::add(std::size_t column, const std::string& name, Conversion to_si) {
  for (std::size_t slot = 0; slot < needed_.size(); ++slot)
    if (needed_[slot].column == column) return slot;
  needed_.push_back({column, name, to_si});
  values_.push_back(0);
  return needed_.size() - 1;
}

std::size_t Reader::need(std::string_view name) {
  const std::size_t column = require(name);
  // A column asked for by its number is what its name says; one asked for by name serves as that.
  const bool by_number = name.find_first_not_of("0123456789") == npos;
  const std::string quantity = by_number ? columns_[column].name : read_column(name).name;
  for (const Needed& other : needed_)
    if (other.column == column && other.name != quantity)
      fail<InputError>("{}: column {} cannot serve as both {} and {}", input_->name(), column + 1, other.name, quantity);
  const Conversion to_si = conversion_to_si(quantity, columns_as_read_[column]);
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (i != column && columns_[i].name == quantity) {
      if (named_) columns_[i].name += "_in";
      else columns_[i] = {fmt::format("c{}", i + 1)};
    }
  columns_[column].name = quantity;
  if (const auto unit = si_unit(quantity); !unit.empty()) columns_[column].unit = unit;
  return add(column, quantity, to_si);
}

std::size_t Reader::need_as_is(std::string_view name) { return add(require(name), std::string(name), {}); }

std::size_t Reader::need_time() { return time_slot_ = need("t"); }

// --------------------------------------------------------------------------------------------------------------- records

void Reader::comment(std::string_view line) {
  const std::string_view text = trim(line);
  if (text.starts_with("##")) {
    if (history_ended_) history_.clear();
    history_ended_ = false;
    history_changed_ = true;
    history_.emplace_back(trim(text.substr(2)));
  }
  if (in_header_) comments_.emplace_back(text);
  else if (on_comment) on_comment(text);
}

void Reader::split(std::string_view line) {
  fields_.clear();
  if (separator_ == '\0') {
    const char* at = line.data();
    const char* const end = at + line.size();
    for (;;) {
      while (at != end && (*at == ' ' || *at == '\t')) ++at;
      if (at == end) return;
      const char* const first = at;
      while (at != end && *at != ' ' && *at != '\t') ++at;
      fields_.emplace_back(first, static_cast<std::size_t>(at - first));
    }
  }
  if (line.find('"') != npos) return split_quoted(line);
  for (std::size_t at = 0;;) {
    const auto end = std::min(line.find(separator_, at), line.size());
    fields_.push_back(trim(line.substr(at, end - at)));
    if (end == line.size()) break;
    at = end + 1;
  }
}

void Reader::split_quoted(std::string_view line) {
  unquoted_.clear();
  std::string field;
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      if (quoted && i + 1 < line.size() && line[i + 1] == '"') field += line[++i];
      else quoted = !quoted;
    } else if (line[i] == separator_ && !quoted) {
      unquoted_.push_back(std::exchange(field, {}));
    } else {
      field += line[i];
    }
  }
  unquoted_.push_back(std::move(field));
  for (const std::string& text : unquoted_) fields_.push_back(trim(text));
}

/// In files that may have decimal commas (delimited by ; or tab): all numbers have one mark, and the comma goes out as a point.
void Reader::read_decimal_marks() {
  with_points_.clear();
  with_points_.reserve(fields_.size());
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    std::string text = with_point(fields_[i]);
    const bool comma = !text.empty();
    if (!comma && (fields_[i].find('.') == npos || !is_number(fields_[i]))) continue;
    if (decimal_mark_ == '\0') decimal_mark_ = comma ? ',' : '.';
    if (decimal_mark_ != (comma ? ',' : '.')) reject(i, "has another decimal mark than the numbers before it");
    if (comma) fields_[i] = with_points_.emplace_back(std::move(text));
  }
}

Reader::Event Reader::advance() {
  if (std::exchange(file_ended_, false)) {
    open_next();  // up to its first record
    return Event::record;
  }
  for (;;) {
    if (!input_->next(line_)) {
      file_ended_ = next_file_ < options_.files.size();
      return file_ended_ ? Event::run_break : Event::end;
    }
    if (is_blank(line_)) {
      run_begins_ = true;
      return Event::run_break;
    }
    if (is_comment(line_)) {
      if (!skipping_) comment(line_);
    } else if (std::exchange(run_begins_, false) && line_ == header_line_) {
      continue;  // each run under its own names line
    } else {
      return Event::record;
    }
  }
}

bool Reader::next_run() {
  for (;;) {
    if (!line_waits_) {
      const Event event = at_end_ ? Event::end : advance();
      if (event == Event::run_break) continue;
      if (event == Event::end) {
        at_end_ = true;
        if (options_.run && !run_found_) fail("there is no run {} (runs: {})", *options_.run, run_);
        return false;
      }
      line_waits_ = true;
    }
    ++run_;
    first_of_run_ = true;
    const int printed = columns_as_read_.front().run;
    if (!options_.run || *options_.run == (printed ? printed : run_)) return run_found_ = true;
    line_waits_ = false;
    skipping_ = true;
    Event event;
    do event = advance();
    while (event == Event::record);
    skipping_ = false;
    at_end_ = event == Event::end;
  }
}

bool Reader::next() {
  for (;;) {
    if (!std::exchange(line_waits_, false)) {
      const Event event = at_end_ ? Event::end : advance();
      at_end_ = event == Event::end;
      if (event != Event::record) return false;
    }
    begun_ = history_ended_ = true;
    split(line_);
    if (fields_.size() != columns_.size())
      fail<InputError>("{}: {} field{} where the first record has {}", where(), fields_.size(), fields_.size() == 1 ? "" : "s", columns_.size());
    if (decimal_mark_ != '.') read_decimal_marks();
    if (parse()) return true;
    ++left_out_;
  }
}

/// The needed numbers; false if one is missing.
bool Reader::parse() {
  for (std::size_t slot = 0; slot < needed_.size(); ++slot) {
    const Needed& needed = needed_[slot];
    const std::string_view field = fields_[needed.column];
    double& value = values_[slot];
    if (!parse_number(field, value)) {
      if (!is_missing(field)) reject(needed.column, "is not a number");
      if (options_.strict) fail<InputError>("{}: field {} ({}): a reading is missing", where(), needed.column + 1, shown(needed.name));
      return false;
    }
    if (needed.to_si.changes()) {
      value = needed.to_si(value);
      if (!std::isfinite(value)) reject(needed.column, "is beyond the range of a double in SI units");
    }
  }
  if (time_slot_ != npos) {
    const double t = values_[time_slot_];
    if (!first_of_run_ && !(t > last_time_)) reject(needed_[time_slot_].column, fmt::format("does not come after {}", last_time_));
    last_time_ = t;
  }
  first_of_run_ = false;
  return true;
}

void Reader::copy(std::string& to, std::size_t cut, std::size_t& first, std::size_t& last) const {
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (i) to += '\t';
    const auto from = to.size();
    const auto needed = std::find_if(needed_.begin(), needed_.end(), [i](const Needed& n) { return n.column == i && n.to_si.changes(); });
    if (needed == needed_.end()) to += fields_[i];
    else append_number(to, values_[static_cast<std::size_t>(needed - needed_.begin())]);
    if (i == cut) first = from, last = to.size();
  }
}

void Reader::reject(std::size_t column, std::string_view why) const {
  fail<InputError>("{}: field {} ({}): '{}' {}", where(), column + 1, shown(columns_[column].name), shown(fields_[column]), why);
}

std::string Reader::where() const {
  return begun_ && !at_end_ ? fmt::format("{}:{}", input_->name(), input_->line_number()) : std::string();
}

}  // namespace rolling
