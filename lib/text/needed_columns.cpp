// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/needed_columns.h"

#include <algorithm>
#include <utility>

#include "base/enumeration.h"
#include "base/error.h"
#include "text/clock.h"
#include "text/number.h"

namespace rolling {
namespace {

/// A word of the name begins with Time, or the name is t and a number.
bool says_time(const std::string& name) {
  std::string small = "_" + lower(name);
  std::ranges::replace_if(
      small, [](char c) { return c < 'a' || c > 'z'; }, '_');
  return small.find("_time") != std::string::npos ||
         (name.starts_with("t") && name.find_first_not_of("0123456789._", 1) == std::string::npos);
}

/// What the unit of the coefficient of a power law has more than that of the law: `m (s/m)^b`.
constexpr std::string_view of_power_law = " (s/m)^b";

/// The column is to have the name and the unit of the quantity that it serves as.
bool serves(const NeededColumns::Needed& needed) {
  return needed.column != NeededColumns::no_column && needed.kind != NeededColumns::Kind::as_is;
}

}  // namespace

NeededColumns::NeededColumns(const std::vector<std::string>& use, bool has_use)
    : has_use_(has_use) {
  for (const std::string& text : use) {
    const auto equals = text.find('=');
    const Column of = read_column(text.substr(0, equals));
    const std::string& quantity = of.name;
    if (equals == std::string::npos || equals + 1 == text.size() || !known_quantity(quantity) ||
        !of.unit.empty() || !of.run.empty())
      fail("--use: '{}' is not NAME=COLUMN or NAME=COLUMN[UNIT], with t, x, v, a or D as NAME",
           shown(text));
    if (!use_.emplace(quantity, text.substr(equals + 1)).second)
      fail("--use: '{}' comes after another for {}", shown(text), quantity);
  }
}

std::vector<std::string> NeededColumns::names_without_use(std::vector<std::string> order) const {
  for (std::size_t i = 0; i < order.size(); ++i)
    if (const auto use = use_.find(order[i]);
        use != use_.end() && read_column(use->second).name != fmt::format("{}", i + 1))
      order.resize(i);
  return order;
}

bool NeededColumns::use_has_numbers() const {
  return std::ranges::any_of(
      use_, [](const auto& use) { return is_number(read_column(use.second).name); });
}

void NeededColumns::begin_run(std::vector<Column> as_read, bool named, SaidUnits said) {
  as_read_ = std::move(as_read);
  named_ = named;
  said_ = std::move(said);
  quantities_.clear();
  for (const Column& column : as_read_) quantities_.push_back(column.name);
  auto served = quantities_;
  for (const auto& [quantity, use] : use_)
    std::ranges::replace(served, quantity, free_name(as_read_, quantity));
  for (const auto& [quantity, use] : use_) {
    const auto at = take_use(use);
    if (!at)
      fail("--use {}={}: there is no column '{}' among {}", quantity, shown(use), shown(use),
           list());
    if (use_.contains(served[*at]))
      fail("--use: column {} cannot serve as both {} and {}", *at + 1, served[*at], quantity);
    served[*at] = quantity;
  }
  quantities_ = std::move(served);
  serve_by_units();
  for (Needed& needed : needed_) resolve(needed);
  name_columns();
}

/// Headers in other languages: the only column in a unit of time serves as t, else the only one in
/// that of a clock; and where none is x or v by its name, the only speed as v, or else the only
/// length as x. (A length beside a speed may be its accuracy.)
void NeededColumns::serve_by_units() {
  if (!named_) return;
  const auto names = [&](const std::string& quantity) {
    return std::ranges::count(quantities_, quantity) > 0;
  };
  const auto serve = [&](const std::string& quantity, const auto& has_its_unit) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < as_read_.size(); ++i)
      if (has_its_unit(as_read_[i]) && !known_quantity(quantities_[i])) found.push_back(i);
    if (found.size() == 1) quantities_[found.front()] = quantity;
  };
  for (const std::string quantity : {"t", "v", "x"})
    if (quantity == "t" ? !names("t") : !names("x") && !names("v"))
      serve(quantity, [&](const Column& c) {
        return unit_of(quantity, c.unit.empty() ? unit_in_name(c.written) : c.unit).has_value();
      });
  if (!names("t")) serve("t", [](const Column& c) { return is_clock_unit(c.unit); });
}

/// True for a column that is a time by its name or its unit, but for one that a tool has renamed.
bool NeededColumns::may_be_time(std::size_t i) const {
  const Column& column = as_read_[i];
  return quantities_[i] == "t" ||
         (!known_quantity(quantities_[i]) && !column.name.ends_with("_in") &&
          (says_time(column.name) || unit_of("t", column.unit)));
}

/// Refuses t in `column` where another one may be it too.
void NeededColumns::refuse_other_times(std::size_t column) const {
  if (!named_ || use_.contains("t")) return;
  for (std::size_t i = 0; i < as_read_.size(); ++i)
    if (const auto [one, other] = std::minmax({i, column}); one != other && may_be_time(i))
      fail("columns {}, '{}', and {}, '{}', may both be t; say --use t=N", one + 1,
           shown(to_text(as_read_[one])), other + 1, shown(to_text(as_read_[other])));
}

/// The column that --use names, by COLUMN or by COLUMN[UNIT], which then is its unit.
std::optional<std::size_t> NeededColumns::take_use(const std::string& column) {
  if (const auto found = written_as(column)) return found;
  const Column use = read_column(column);
  const auto found = find(use.run.empty() ? use.name : column);
  if (found && !use.unit.empty()) as_read_[*found].unit = use.unit;
  return found;
}

/// The only column whose name is this text, as it stands in the file or as it is printed.
std::optional<std::size_t> NeededColumns::written_as(std::string_view name) const {
  const std::string asked = with_underscores(trim(with_plain_blanks(name)));
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < as_read_.size(); ++i) {
    const Column& column = as_read_[i];
    if (asked != with_underscores(column.written) && asked != to_text(column) &&
        (asked != column.name || is_known(column)))
      continue;
    if (found) return {};
    found = i;
  }
  return found;
}

std::optional<std::size_t> NeededColumns::find(std::string_view name) const {
  if (double number; is_whole(name) && parse_number(name, number))
    return number >= 1 && number <= static_cast<double>(as_read_.size())
               ? std::optional(static_cast<std::size_t>(number) - 1)
               : std::nullopt;
  if (const auto found = written_as(name); found && !known_quantity(name)) return found;
  const Column asked = read_column(name);
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < as_read_.size(); ++i) {
    const Column& read = as_read_[i];
    if (asked.run.empty() || read.name != labelled_name(asked)) {
      // A column that serves as a quantity has its own name too, if that is none of another.
      if (quantities_[i] != asked.name && (is_known(asked) || read.name != asked.name)) continue;
      if (!asked.run.empty() && asked.run != read.run) continue;
    }
    if (found)
      fail("columns {} and {} are both {}; say --use {}=N", *found + 1, i + 1, asked.name,
           asked.name);
    found = i;
  }
  return found;
}

/// A name with its unit, as a message can show it: one of another script is a number.
std::string NeededColumns::shown_name(std::size_t column) const {
  const auto is_readable = [](char c) { return c > ' ' && c <= '~' && c != '_'; };
  if (std::ranges::none_of(as_read_[column].name, is_readable))
    return fmt::format("column {}", column + 1);
  return shown(to_text(as_read_[column]));
}

std::string NeededColumns::list() const {
  if (!named_) return counted(as_read_.size(), "column") + " without names";
  std::string list;
  for (std::size_t i = 0; i < as_read_.size(); ++i) {
    add_item(list, shown_name(i));
    if (list.size() > 200 && i + 1 < as_read_.size()) return list + ", ...";
  }
  return list;
}

/// Says why there is no such column.
void NeededColumns::refuse(std::string_view name) const {
  const bool is_time = named_ && quantities_.front() == "t";
  if (as_read_.size() == 1 && is_time && name != "t")
    fail("t is the only column, but {} is needed too", shown(name));
  if (as_read_.size() == 1 && (name == "t" || name == "v" || name == "x"))
    fail(
        "one column alone, but t is needed too: if a row comes every 0.04 s, "
        "awk '{}{{ print NR * 0.04, $1 }}' adds t{}",
        named_ ? "NR == 1 { print \"t\", $1; next } " : "",
        named_ ? "" : "; if this line is a heading, begin it with #");
  for (std::size_t i = 0; i < as_read_.size(); ++i)
    if (as_read_[i].name == name)
      fail("column {} cannot serve as both {} and {}", i + 1, quantities_[i], name);
  std::string way_out;
  if (const KnownQuantity* asked = known_quantity(name); asked && !asked->appended_by.empty())
    way_out = fmt::format("; {} appends it", asked->appended_by);
  if (!named_) way_out += "; if this line is a heading, begin it with #";
  if (has_use_ && known_quantity(name))
    way_out += fmt::format("{} say --use {}=COLUMN", way_out.empty() ? ";" : ", or", name);
  const bool none_is_known =
      std::ranges::none_of(quantities_, [](const auto& q) { return known_quantity(q); });
  if (has_use_ && name == "t" && none_is_known) way_out += ", and --use x=COLUMN or v=COLUMN";
  fail("there is no column '{}' among {}{}", shown(name), list(), way_out);
}

std::optional<std::size_t> NeededColumns::find_beside(std::string_view name) const {
  if (std::ranges::count(quantities_, name) != 1) return {};
  const auto found =
      static_cast<std::size_t>(std::ranges::find(quantities_, name) - quantities_.begin());
  if (as_read_[found].unit.empty()) return found;
  const auto unit = read_unit(as_read_[found].unit);
  const bool serves = unit && (!known_quantity(name) || si_unit(unit->quantity) == si_unit(name));
  return serves ? std::optional(found) : std::nullopt;
}

void NeededColumns::resolve(Needed& needed) {
  const auto found = needed.kind == Kind::beside ? find_beside(needed.name) : find(needed.name);
  if (!found && needed.kind < Kind::wanted) refuse(needed.name);
  needed.column = found.value_or(no_column);
  needed.to_si = {};
  needed.clock.clear();
  if (!found) return;
  if (needed.name == "t") refuse_other_times(*found);
  const bool first = needed.quantity.empty();
  const Column& read = as_read_[*found];
  const std::string& quantity = quantities_[*found];
  const bool as_is = needed.kind == Kind::as_is;
  if (first) needed.quantity = quantity;
  if (first && !as_is) needed.unit = read.unit;
  if (quantity != needed.quantity || (needed.kind != Kind::beside && !as_is &&
                                      !known_quantity(quantity) && read.unit != needed.unit))
    fail("column {} is '{}', and '{}' in the runs before", *found + 1,
         shown(to_text({quantity, read.unit})), shown(to_text({needed.quantity, needed.unit})));
  const bool said = quantity == read.name || use_.contains(quantity);
  if (known_quantity(quantity) && quantity == needed.name && !said)
    assume(*found, quantity, ", by its unit");
  needed.to_si = conversion(needed);
}

/// Notes what is assumed of a column that serves as `quantity`, once for all runs.
void NeededColumns::assume(std::size_t at, std::string_view quantity, std::string_view what) {
  std::string line = fmt::format("{} is column {}", quantity, at + 1);
  const Column& column = as_read_[at];
  if (named_ && !shown_name(at).starts_with("column "))
    line += fmt::format(", '{}'", shown(column.name == quantity ? column.written : column.name));
  line += what;
  if (assumed_.find(line) == std::string::npos) add_item(assumed_, line, "; ");
}

/// The conversion of a column to the SI unit of the quantity that it serves as, or to that in which
/// it is needed as it is. The unit of a quantity may stand at the end of its name; a column without
/// one is in SI units, which is noted where its name does not say so. Refuses any other unit.
Conversion NeededColumns::conversion(Needed& needed) {
  Column meant = as_read_[needed.column];
  const bool as_is = needed.kind == Kind::as_is;
  const std::string& quantity = needed.quantity;
  const KnownQuantity* const known = as_is ? nullptr : known_quantity(quantity);
  if (const auto unit = read_unit(meant.unit); !known && needed.kind == Kind::beside && unit)
    return unit->to_si;
  if (!known && !as_is) return {};
  // A name that is a unit itself, as `kph`, or ends with one.
  if (known && named_ && meant.unit.empty())
    meant.unit = unit_of(quantity, meant.name) ? meant.name : unit_at_end(quantity, meant.name);
  if (as_is && meant.unit.ends_with(of_power_law))
    meant.unit.resize(meant.unit.size() - of_power_law.size());
  // A letter is that of the formulas, in SI units; a word such as Speed is not. Times may be
  // clocks.
  const bool is_letter = quantity == "t" || !meant.run.empty() || meant.written == quantity;
  if (const auto said = said_.find(quantity);
      known && meant.unit.empty() && needed.kind != Kind::beside &&
      (!named_ || !is_letter || meant.name != quantity || said != said_.end()))
    assume(needed.column, quantity,
           fmt::format(", taken in {}{}", known->si,
                       said == said_.end() ? "" : " although " + said->second));
  if (known && quantity == "t" && is_clock_unit(meant.unit)) needed.clock = lower(meant.unit);
  if (!needed.clock.empty()) return {};
  const std::string_view si = known ? known->si : needed.unit;
  if (meant.unit.empty() || meant.unit == si) return {};
  if (const auto found = read_unit(meant.unit); found && si_unit(found->quantity) == si)
    return found->to_si;
  refuse_unit(needed, meant);
}

/// Refuses a column for its unit: one of another quantity, or one that is not known.
void NeededColumns::refuse_unit(const Needed& needed, const Column& meant) const {
  const bool as_is = needed.kind == Kind::as_is;
  const KnownQuantity* const known = as_is ? nullptr : known_quantity(needed.quantity);
  std::string name = shown_name(needed.column);
  if (!name.starts_with("column ")) name = fmt::format("column '{}'", shown(to_text(meant)));
  const std::string_view measured = measured_by(meant.unit);
  if (known && measured == "an angle" && known->si == "m")
    fail(
        "{} is an angle, and {} needs a length: multiply it by R first "
        "(rolling-recipes(7))",
        name, needed.quantity);
  const auto is_error = [&](const Column& column) { return column.name == "sigma_" + meant.name; };
  if (std::ranges::any_of(as_read_, is_error))
    fail("{} has its uncertainty beside it: these are results of a fit, not readings", name);
  if (known && !measured.empty()) {
    const auto unit = read_unit(meant.unit);
    const bool may_be_used = has_use_ && unit && !unit->quantity.empty();
    fail("{} is {}, and {} needs {}{}", name, measured, needed.quantity, known->in_words,
         may_be_used ? fmt::format(": use it as {0}, --use {0}={1}, or another column as {2}",
                                   unit->quantity, needed.column + 1, needed.quantity)
                     : "");
  }
  std::string_view units = known ? known->units : needed.unit;
  if (units.empty()) units = "none";
  fail(
      "{} cannot serve as {}: its unit '{}' is not one of those known ({}); "
      "convert it first (rolling-recipes(7)){}",
      name, as_is ? needed.name : needed.quantity, shown(meant.unit), units,
      has_use_ ? fmt::format(" or say --use '{}={}[UNIT]'", needed.quantity, needed.column + 1)
               : "");
}

void NeededColumns::name_columns() {
  in_output_ = as_read_;
  for (Column& column : in_output_)
    if (!named_ && column.unit.empty()) column.unit = si_unit(column.name);
  for (const Needed& needed : needed_) {
    if (!serves(needed)) continue;
    // The next tool of a pipe has no --use that tells one t of two.
    const bool chosen = named_ && needed.quantity == "t" && use_.contains("t");
    for (std::size_t i = 0; i < as_read_.size(); ++i)
      if (std::string& name = in_output_[i].name;
          i != needed.column && (name == needed.quantity || (chosen && may_be_time(i))))
        name = free_name(in_output_, name);
    Column& column = in_output_[needed.column];
    column.name = needed.quantity;
    if (const auto unit = si_unit(needed.quantity); !unit.empty()) column.unit = unit;
  }
}

bool NeededColumns::renames() const {
  return std::ranges::any_of(needed_, [&](const Needed& needed) {
    return serves(needed) && as_read_[needed.column].name != needed.quantity;
  });
}

std::size_t NeededColumns::add(std::string_view name, Kind kind, std::string_view unit) {
  Needed needed{std::string(name), {}, kind, std::string(unit)};
  resolve(needed);
  needed_.push_back(std::move(needed));
  name_columns();
  return needed_.size() - 1;
}

}  // namespace rolling
