#include "text/reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "text/number.h"

namespace rolling {
namespace {

constexpr std::size_t npos = static_cast<std::size_t>(-1);

}  // namespace

Reader::Reader(ReaderOptions options, std::vector<std::string> order)
    : options_(std::move(options)), order_(std::move(order)) {
  if (options_.files.empty()) options_.files = {"-"};
  for (const std::string& use : options_.use) {
    const auto equals = use.find('=');
    if (equals == 0 || equals == npos || equals + 1 == use.size())
      fail("--use: '{}' is not NAME=COLUMN", shown(use));
    const std::string quantity = read_column(use.substr(0, equals)).name;
    if (si_unit(quantity).empty()) fail("--use: '{}' is not about t, x, v, a or D", shown(use));
    if (!use_.emplace(quantity, use.substr(equals + 1)).second)
      fail("--use: '{}' comes after another for {}", shown(use), quantity);
  }
  open_next();
  history_changed_ = false;
}

// ----------------------------------------------------------------------------------------
// columns

void Reader::open_next() {
  begun_ = false;
  const bool first_file = next_file_ == 0, named = header_.named;
  lines_ = std::make_unique<Lines>(options_.files[next_file_++], options_.on_block);
  history_changed_ = !history_.empty();
  history_.clear();
  // A column that --use names by its number is one of the line: then the line is one record.
  const bool by_number =
      std::any_of(use_.begin(), use_.end(), [](const auto& use) { return is_number(use.second); });
  header_ = read_header(*lines_, dialect_, order_,
                        options_.run ? fmt::format("{}", *options_.run) : "", by_number);
  if (header_.layout.runs.size() > 1) lines_->keep();
  side_ = 0;
  if (first_file) {
    columns_ = columns_as_read_ = header_.layout.columns;
    if (!header_.named)
      for (Column& column : columns_) column.unit = si_unit(column.name);
  } else if (header_.layout.columns != columns_as_read_ || named != header_.named) {
    fail<InputError>("{}: its columns are not those of {}", lines_->name(), options_.files.front());
  }
  want_numbers();
  in_header_ = first_file;
  for (const std::string& text : header_.comments) comment(text);
  in_header_ = false;
  line_waits_ = true;
  first_record_ = lines_->number();
}

std::optional<std::size_t> Reader::find(std::string_view name) const {
  const auto use = use_.find(read_column(name).name);
  if (use == use_.end()) return find_column(name, columns_);
  const auto at = find_column(use->second, columns_as_read_);
  if (!at)
    fail<InputError>("{}: --use {}={}: there is no column '{}' among {}", lines_->name(),
                     use->first, shown(use->second), shown(use->second), column_list());
  return at;
}

std::optional<std::size_t> Reader::find_column(std::string_view name,
                                               const std::vector<Column>& columns) const {
  if (double number; name.find_first_not_of("0123456789") == npos && parse_number(name, number))
    return number >= 1 && number <= static_cast<double>(columns.size())
               ? std::optional(static_cast<std::size_t>(number) - 1)
               : std::nullopt;
  const std::string plain = read_column(name).name;
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name == plain) {
      if (found)
        fail<InputError>("{}: columns {} and {} are both {}; say --use {}=N", lines_->name(),
                         *found + 1, i + 1, plain, plain);
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
  return header_.named ? list : fmt::format("{} without names", columns_.size());
}

std::size_t Reader::require(std::string_view name) const {
  const auto column = find(name);
  if (!column)
    fail<InputError>("{}: there is no column '{}' among {}{}", lines_->name(), shown(name),
                     column_list(),
                     options_.has_use && !si_unit(read_column(name).name).empty()
                         ? fmt::format("; say --use {}=COLUMN", name)
                         : "");
  return *column;
}

std::size_t Reader::add(std::size_t column, const std::string& name, Conversion to_si) {
  for (std::size_t slot = 0; slot < needed_.size(); ++slot)
    if (needed_[slot].column == column) return slot;
  needed_.push_back({column, name, to_si});
  converts_ |= to_si.changes();
  values_.push_back(0);
  want_numbers();
  return needed_.size() - 1;
}

void Reader::want_numbers() {
  for (const Layout::Run& run : header_.layout.runs)
    for (const Needed& needed : needed_) dialect_.want(run.fields[needed.column]);
}

std::size_t Reader::need(std::string_view name) {
  const std::size_t column = require(name);
  // A column asked for by its number is what its name says; one asked for by name serves as that.
  const bool by_number = name.find_first_not_of("0123456789") == npos;
  const std::string quantity = by_number ? columns_[column].name : read_column(name).name;
  for (const Needed& other : needed_)
    if (other.column == column && other.name != quantity)
      fail<InputError>("{}: column {} cannot serve as both {} and {}", lines_->name(), column + 1,
                       other.name, quantity);
  const Conversion to_si = conversion_to_si(quantity, columns_as_read_[column]);
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (i != column && columns_[i].name == quantity) {
      if (header_.named) columns_[i].name += "_in";
      else columns_[i] = {fmt::format("c{}", i + 1)};
    }
  columns_[column].name = quantity;
  if (const auto unit = si_unit(quantity); !unit.empty()) columns_[column].unit = unit;
  return add(column, quantity, to_si);
}

std::size_t Reader::want(std::string_view name) {
  const std::size_t known = needed_.size(), slot = need(name);
  if (slot == known) needed_[slot].may_miss = true;  // not one that is needed already
  return slot;
}

std::size_t Reader::need_as_is(std::string_view name) {
  return add(require(name), std::string(name), {});
}

std::size_t Reader::need_time() { return time_slot_ = need("t"); }

// ----------------------------------------------------------------------------------------
// records

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

Reader::Event Reader::advance() {
  for (;;) {
    if (!lines_->next()) {
      if (side_ + 1 < header_.layout.runs.size()) {
        ++side_;
        lines_->again();
        return Event::run_break;
      }
      if (std::exchange(file_ended_, false)) {
        open_next();  // up to its first record
        return Event::record;
      }
      file_ended_ = next_file_ < options_.files.size();
      return file_ended_ ? Event::run_break : Event::end;
    }
    const char mark = first_mark(lines_->text());
    if (mark == no_mark) {
      run_begins_ = true;
      return Event::run_break;
    }
    if (mark == comment_mark) {
      if (!skipping_ && side_ == 0) comment(lines_->text());
    } else if (std::exchange(run_begins_, false) && names_again()) {
      continue;  // each run under its own names line
    } else if (!header_.layout.side_by_side || has_own_reading()) {
      return Event::record;
    }
  }
}

/// The line names the columns once more; only the label of the run may differ.
bool Reader::names_again() {
  if (header_.names_line.empty()) return false;
  if (lines_->text() == header_.names_line) return true;
  const auto names = names_in(lines_->text(), dialect_),
             first = names_in(header_.names_line, dialect_);
  if (names.size() != first.size() || is_number(names.front())) return false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Column column = read_column(names[i]), known = read_column(first[i]);
    if (column.name != known.name || column.unit != known.unit) return false;
    if (!header_.layout.side_by_side && !column.run.empty())
      header_.layout.runs.front().label = column.run;
  }
  return true;
}

/// A run beside longer ones ends in blanks; columns that the runs share do not count.
bool Reader::has_own_reading() {
  const auto fields = split_line();
  const auto& own = header_.layout.runs[side_].fields;
  return std::any_of(own.begin(), own.end(), [&](std::size_t i) {
    return !header_.layout.shared[i] && i < fields.size() && !fields[i].text.empty();
  });
}

bool Reader::next_run() {
  for (;;) {
    if (!line_waits_) {
      const Event event = advance();
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
    const std::string& label = header_.layout.runs[side_].label;
    const bool by_label = is_number(label),
               picked = header_.layout.side_by_side;  // the layout has seen to it
    if (!options_.run || picked ||
        (by_label ? label == fmt::format("{}", *options_.run) : run_ == *options_.run))
      return run_found_ = true;
    line_waits_ = false;
    skipping_ = true;
    Event event;
    do event = advance();
    while (event == Event::record);
    skipping_ = false;
    at_end_ = event == Event::end;
  }
}

/// What most lines are, a record like the one before it in this run, is found and split in one
/// pass; all else is advance()'s.
inline bool Reader::take_plain_line() {
  if (run_begins_ || header_.layout.side_by_side) return false;
  const std::string_view ahead = lines_->ahead();
  const char* const end = dialect_.split_plain(ahead, fields_);
  if (end) lines_->take(static_cast<std::size_t>(end - ahead.data()), *end == '\r' ? 2 : 1);
  return end;
}

bool Reader::next() {
  for (;;) {
    if (line_waits_ || !take_plain_line()) {
      const Event event = std::exchange(line_waits_, false) ? Event::record : advance();
      at_end_ = event == Event::end;
      if (event != Event::record) return false;
      begun_ = true;
      fields_ = split_line();
    }
    history_ended_ = true;
    if (take_record()) return true;
    ++left_out_;
  }
}

std::span<const Field> Reader::split_line() {
  try {
    return dialect_.split(lines_->text());
  } catch (const Error& error) {
    fail<InputError>("{}: {}", where(), error.what());
  }
}

/// The fields of the line that make this run's record, and the needed numbers in them; false if one
/// is missing.
bool Reader::take_record() {
  if (fields_.size() != header_.layout.width) {
    if (fields_.size() == header_.layout.width + 1 && fields_.back().text.empty() && header_.named)
      fields_ = fields_.first(header_.layout.width);  // a delimiter that ends the line
    else if (!header_.layout.side_by_side ||
             fields_.size() > header_.layout.width)  // beside it longer runs may have ended
      fail<InputError>("{}: {} field{} where the first record has {}", where(), fields_.size(),
                       fields_.size() == 1 ? "" : "s", header_.layout.width);
  }
  if (header_.layout.side_by_side) {
    own_fields_.clear();
    for (const std::size_t i : header_.layout.runs[side_].fields)
      own_fields_.push_back(i < fields_.size() ? fields_[i] : Field());
    fields_ = own_fields_;
  }

  double* to = values_.data();
  for (const Needed& needed : needed_) {
    const Field& field = fields_[needed.column];
    double value = field.number;
    if (std::isnan(value)) {
      if (!is_missing(field.text)) reject(needed.column, "is not a number" + way_out(field.text));
      if (options_.strict && !needed.may_miss)
        fail<InputError>("{}: field {} ({}): a reading is missing", where(),
                         header_.layout.runs[side_].fields[needed.column] + 1, shown(needed.name));
      if (!needed.may_miss) return false;
    } else if (converts_) {
      value = needed.to_si(value);
      if (!std::isfinite(value))
        reject(needed.column, "is beyond the range of a double in SI units");
    }
    *to++ = value;
  }
  if (time_slot_ != npos) {
    const double t = values_[time_slot_];
    if (!first_of_run_) {
      if (!(t > last_time_))
        reject(needed_[time_slot_].column, fmt::format("does not come after {}", last_time_));
      coarse_time_ |=
          t - last_time_ < 0x1p-39 * std::abs(t);  // two roundings of 2^-53 t are 2^-13 of it
    }
    last_time_ = t;
  }
  first_of_run_ = false;
  return true;
}

/// text() of a record that does not go out as it came.
std::string_view Reader::made_text(std::size_t cut, std::size_t& first, std::size_t& last) {
  text_.cut(0);
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (i) text_.append('\t');
    const auto from = text_.size();
    const auto converted = !converts_
                               ? needed_.end()
                               : std::find_if(needed_.begin(), needed_.end(), [i](const Needed& n) {
                                   return n.column == i && n.to_si.changes();
                                 });
    if (converted == needed_.end()) text_.append(fields_[i].text);
    else
      text_.end(write_number(text_.room(longest_number),
                             values_[static_cast<std::size_t>(converted - needed_.begin())]));
    if (i == cut) first = from, last = text_.size();
  }
  return {text_.data(), text_.size()};
}

void Reader::reject(std::size_t column, std::string_view why) const {
  fail<InputError>("{}: field {} ({}): '{}' {}", where(),
                   header_.layout.runs[side_].fields[column] + 1, shown(columns_[column].name),
                   shown(fields_[column].text), why);
}

/// After a field that is no number, what to do about what it often is: a decimal comma, a minus
/// sign of print, a heading.
std::string Reader::way_out(std::string_view field) const {
  const bool in_field = std::count(field.begin(), field.end(), ',') == 1 && field.find('.') == npos;
  const bool beside = dialect_.separator() == ',' && field.find(' ') != npos &&
                      is_number(field.substr(0, field.find(' ')));
  if (in_field || beside) return "; if a comma here is a decimal one, make it a point first";
  if (field.starts_with("\xE2\x88\x92")) return "; make its minus sign (U+2212) a hyphen first";
  const bool word = !field.empty() && std::string_view("+-.0123456789").find(field.front()) == npos;
  return word && !header_.named && lines_->number() == first_record_
             ? "; if this line is no record, begin it with #"
             : "";
}

std::string Reader::where() const {
  return begun_ && !at_end_ ? fmt::format("{}:{}", lines_->name(), lines_->number())
                            : std::string();
}

}  // namespace rolling
