// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/enumeration.h"
#include "text/number.h"

namespace rolling {

Reader::Reader(ReaderOptions options, std::vector<std::string> order)
    : options_(std::move(options)), needed_(options_.use, options_.has_use),
      order_(needed_.names_without_use(std::move(order))) {
  if (options_.files.empty()) options_.files = {"-"};
  find_run();
}

// Runs: which one is read, its name, and its head.

/// What --run calls the present run: the number in its header or at the end of its name, which is
/// the same behind a tool (2 of `NAME roll 2 of 6`), else its label beside such numbers (`Latest`),
/// else its place.
std::string Reader::called() const {
  std::string number = layout().label;
  if (!is_number(number)) number = run_is_named() ? run_name() : "";
  if (number.find(" roll ") != std::string::npos)
    number.erase(std::min(number.size(), number.rfind(" of ")));
  number.erase(0, number.rfind(' ') + 1);
  const auto is_label = [](const Layout::Run& run) { return is_number(run.label); };
  if (is_whole(number)) return number;
  if (std::ranges::any_of(head_.layout.runs, is_label)) return layout().label;
  return fmt::format("{}", run_);
}

/// True if the present run is to be read. Its label and its name are known as well.
bool Reader::asked_for() {
  const std::string& asked = options_.run;
  const std::string name = called();
  add_item(runs_, shown(name));
  return asked == name || asked == layout().label || (run_is_named() && asked == run_name());
}

bool Reader::next_run() {
  if (state_ == State::in_run)
    while (next_line()) continue;
  bool passed = false;
  while (state_ == State::found || find_run()) {
    state_ = State::in_run;
    if (options_.run.empty()) return true;
    if (asked_for()) {
      if (run_found_)
        fail<InputError>("{}:{}: another run {}; give the file of one of them alone",
                         lines_->name(), head_.line, shown(options_.run));
      return run_found_ = true;
    }
    const std::pair kept(left_out_, row_found_);
    while (next()) continue;
    std::tie(left_out_, row_found_) = kept;
    passed = true;
  }
  if (passed) comments_.clear();  // of the run that was passed over last
  return false;
}

/// Goes to the next run, and reads its head.
bool Reader::find_run() {
  remarks_.clear();
  comments_.clear();
  place_.clear();
  if (next_head()) {
    begin_run();
    return true;
  }
  if (!options_.run.empty() && !run_found_)
    fail("there is no run {} (runs: {})", shown(options_.run), runs_);
  if (left_out_ > 0 && !row_found_)
    fail<InputError>("{}no rows: a needed reading is missing in every one",
                     options_.files.size() == 1 ? lines_->name() + ": " : "");
  return false;
}

/// Reads the head of the next run. Comments behind the last run of a file are added to those of the
/// next run.
bool Reader::next_head() {
  if (file_open_ && side_ + 1 < head_.layout.runs.size()) {
    ++side_;
    return true;
  }
  // Column numbers in --use count the fields of a line: the line is then one row.
  const Sides sides = needed_.use_has_numbers() ? Sides::one : Sides::by_names;
  while (file_open_ || next_file_ < options_.files.size()) {
    if (!std::exchange(file_open_, true)) {
      run_in_file_ = 0;
      lines_.emplace(options_.files[next_file_++]);
    }
    const bool first = run_in_file_ == 0;
    Head head = read_head(*lines_, dialect_, first ? nullptr : &head_, order_, sides);
    const std::size_t width = head.layout.width();
    const std::size_t before = head_.layout.width();
    if (width > 0) {  // there is another run
      if (first && next_file_ > 1 && !head.named && (head_.named || width != before))
        fail<InputError>(
            "{}: its columns are not those of {}: {}; give it a header", lines_->name(),
            options_.files.front(),
            head_.named ? "those have names" : fmt::format("{}, not {}", width, before));
      head_ = std::move(head);
      side_ = 0;
      return true;
    }
    for (std::string& comment : head.comments) {
      if (!head_.named && are_names(comment))
        fail<InputError>(
            "{}: the names of the columns stand behind the last row; put them above the first",
            lines_->name());
      if (!is_history(comment)) comments_.push_back(std::move(comment));
    }
    file_open_ = false;
  }
  return false;
}

/// True if the file has several runs.
bool Reader::one_of_several() const {
  return head_.layout.side_by_side() || run_in_file_ > 1 || lines_->another_run();
}

/// True if there are several runs, or if the run has a name or a number in the input.
bool Reader::run_is_named() const {
  return !head_.run.empty() || is_number(layout().label) || options_.files.size() > 1 ||
         one_of_several();
}

std::string Reader::run_name() const {
  if (!head_.run.empty()) return head_.run;
  const std::string& file = options_.files[next_file_ - 1];
  std::string name = file == "-" ? "" : file.substr(file.rfind('/') + 1);
  for (char& c : name)
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  name = trim(name);
  const std::string& label = layout().label;
  if (!label.empty()) name += ' ' + label;
  else if (name.empty()) name = fmt::format("{}", run_);
  else if (one_of_several()) name += fmt::format(" {}", run_in_file_);
  return std::string(trim(name));
}

/// What a refusal of the columns begins with.
std::string Reader::of_head() const {
  return run_in_file_ > 1 || !head_.named ? fmt::format("{}:{}", lines_->name(), head_.line)
                                          : lines_->name();
}

/// Prepares for the rows of the run whose head has been read.
void Reader::begin_run() {
  ++run_;
  ++run_in_file_;
  blank_rows_ = 0;
  last_time_ = last_step_ = std::numeric_limits<double>::quiet_NaN();
  clock_ = {};
  reads_clock_ = false;
  if (head_.layout.side_by_side()) {
    lines_->put_back();
    lines_->hold(side_ + 1 < head_.layout.runs.size());
  }
  state_ = State::found;
  place_ = lines_->name();
  if (run_is_named()) {
    place_ = "run " + run_name();
    comments_.push_back("## " + place_);
  }
  for (const std::string& comment : head_.comments)
    if (side_ == 0 || is_history(comment)) comments_.push_back(comment);
  located([&] { return of_head(); },
          [&] { needed_.begin_run(layout().columns, head_.named, head_.said); });
  read_needed();
}

std::optional<std::size_t> Reader::find(std::string_view name) const {
  return located([&] { return of_head(); }, [&] { return needed_.find(name); });
}

std::size_t Reader::add(std::string_view name, NeededColumns::Kind kind, std::string_view unit) {
  const std::size_t slot =
      located([&] { return of_head(); }, [&] { return needed_.add(name, kind, unit); });
  if (kind != NeededColumns::Kind::as_is && needed_.all()[slot].quantity == "t") time_slot_ = slot;
  read_needed();
  return slot;
}

/// Declares to the dialect the fields whose numbers are read.
void Reader::read_needed() {
  values_.resize(needed_.all().size());
  dialect_.want_none();
  for (const NeededColumns::Needed& needed : needed_.all())
    if (needed.column != no_column) dialect_.want(layout().fields[needed.column]);
}

}  // namespace rolling
