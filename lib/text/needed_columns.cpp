#include "text/needed_columns.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "text/number.h"
#include "text/unit_words.h"

namespace rolling {
namespace {

bool is_column_number(std::string_view name) {
  return name.find_first_not_of("0123456789") == std::string_view::npos;
}

/// The column is to have the name and the unit of the quantity that it serves as.
bool serves(const NeededColumns::Needed& needed) {
  return needed.column != NeededColumns::no_column && needed.kind != NeededColumns::Kind::as_is;
}

}  // namespace

NeededColumns::NeededColumns(const std::vector<std::string>& use, bool has_use,
                             std::map<std::string, std::string> appended_by)
    : has_use_(has_use), appended_by_(std::move(appended_by)) {
  for (const std::string& text : use) {
    const auto equals = text.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
      fail("--use: '{}' is not NAME=COLUMN", shown(text));
    const Column of = read_column(text.substr(0, equals));
    const std::string &quantity = of.name, &unit = of.unit;
    if (!unit.empty() || !of.run.empty())
      fail("--use: '{}': a unit goes behind the column: {}=COLUMN[{}]", shown(text), quantity,
           shown(unit));
    if (si_unit(quantity).empty()) fail("--use: '{}' is not about t, x, v, a or D", shown(text));
    const std::string whole = text.substr(equals + 1);
    const Column column = read_column(whole);
    if (!use_.emplace(quantity, Use{column.run.empty() ? column.name : whole, column.unit}).second)
      fail("--use: '{}' comes after another for {}", shown(text), quantity);
  }
}

std::vector<std::string> NeededColumns::names_without_use(std::vector<std::string> order) const {
  for (std::size_t i = 0; i < order.size(); ++i)
    if (const auto use = use_.find(order[i]);
        use != use_.end() && use->second.column != fmt::format("{}", i + 1))
      order.resize(i);
  return order;
}

bool NeededColumns::use_has_numbers() const {
  return std::any_of(use_.begin(), use_.end(),
                     [](const auto& use) { return is_number(use.second.column); });
}

void NeededColumns::begin_run(std::vector<Column> as_read, bool named, SaidUnits said,
                              std::string place) {
  as_read_ = std::move(as_read);
  named_ = named;
  said_ = std::move(said);
  place_ = std::move(place);
  quantities_.clear();
  for (const Column& column : as_read_) quantities_.push_back(column.name);
  for (const auto& [quantity, use] : use_) {
    const auto at = find_column(use.column);
    if (!at)
      fail<InputError>("{}: --use {}={}: there is no column '{}' among {}", place_, quantity,
                       shown(use.column), shown(use.column), list());
    std::ranges::replace(quantities_, quantity, free_name(as_read_, quantity));
    quantities_[*at] = quantity;
  }
  for (const auto& [quantity, use] : use_)
    if (const auto at = find_column(use.column); quantities_[*at] != quantity)
      fail<InputError>("{}: --use: column {} cannot serve as both {} and {}", place_, *at + 1,
                       quantity, quantities_[*at]);
    else if (!use.unit.empty()) as_read_[*at].unit = with_unit(*at, quantity).unit;
  resolve();
}

std::optional<std::size_t> NeededColumns::find(std::string_view name) const {
  const std::string quantity = read_column(name).name;
  if (const auto use = use_.find(quantity); use != use_.end())
    return find_column(use->second.column);
  const auto at = find_column(name);
  // The column of this name serves as another quantity.
  if (at && !si_unit(quantity).empty() && quantities_[*at] != quantity) return {};
  return at;
}

std::optional<std::size_t> NeededColumns::find_column(std::string_view name) const {
  if (double number; is_column_number(name) && parse_number(name, number))
    return number >= 1 && number <= static_cast<double>(as_read_.size())
               ? std::optional(static_cast<std::size_t>(number) - 1)
               : std::nullopt;
  const Column asked = read_column(name);
  std::optional<std::size_t> found;
  bool of_another_run = false;
  for (std::size_t i = 0; i < as_read_.size(); ++i)
    if (as_read_[i].name == asked.name) {
      if (!asked.run.empty() && asked.run != as_read_[i].run) {
        of_another_run = true;
        continue;
      }
      if (found)
        fail<InputError>("{}: columns {} and {} are both {}; say --use {}=N", place_, *found + 1,
                         i + 1, asked.name, asked.name);
      found = i;
    }
  if (of_another_run && !found)
    fail<InputError>("{}: '{}' is a column of another run: choose that with --run", place_,
                     shown(name));
  return found;
}

std::string NeededColumns::list() const {
  const std::size_t n = as_read_.size();
  if (!named_) return fmt::format("{} column{} without names", n, n == 1 ? "" : "s");
  std::string list;
  for (const Column& column : as_read_) {
    if (!list.empty()) list += ", ";
    list += shown(to_text(column));
    if (list.size() > 200) return list + ", ...";
  }
  return list;
}

std::size_t NeededColumns::require(std::string_view name) const {
  const auto column = find(name), of_name = column ? column : find_column(name);
  if (!column && of_name)
    fail<InputError>("{}: column {} cannot serve as both {} and {}", place_, *of_name + 1,
                     quantities_[*of_name], name);
  if (!column) {
    std::string way_out;
    if (const auto by = appended_by_.find(std::string(name)); by != appended_by_.end())
      way_out = fmt::format("; {} appends it", by->second);
    if (has_use_ && !si_unit(read_column(name).name).empty())
      way_out += fmt::format("{} say --use {}=COLUMN", way_out.empty() ? ";" : ", or", name);
    fail<InputError>("{}: there is no column '{}' among {}{}", place_, shown(name), list(),
                     way_out);
  }
  return *column;
}

/// A column with the unit of its name, or with the unit that --use gives.
Column NeededColumns::with_unit(std::size_t column, const std::string& quantity) const {
  Column read = as_read_[column];
  if (!named_) read.unit.clear();  // Layout has the SI unit of the tool's order
  const auto use = use_.find(quantity);
  if (use == use_.end() || use->second.unit.empty()) return read;
  // The unit that --use gives stands for one that no tool knows.
  if (named_ && unit_kind(read.unit) != UnitKind::none && read.unit != use->second.unit)
    fail<InputError>("{}: --use {} says {}, but the column's name {}", place_, quantity,
                     shown(use->second.unit), shown(to_text(read)));
  read.unit = use->second.unit;
  return read;
}

void NeededColumns::resolve(Needed& needed) const {
  const auto found = needed.kind == Kind::wanted ? find(needed.name) : require(needed.name);
  needed.column = found.value_or(no_column);
  needed.to_si = {};
  if (!found) return;
  const bool first = needed.quantity.empty();
  const Column read = with_unit(*found, needed.quantity);
  const std::string& quantity = quantities_[*found];
  if (first) needed.quantity = quantity, needed.unit = read.unit;
  if (quantity != needed.quantity)
    fail<InputError>("{}: column {} is {}, and {} in the runs before", place_, *found + 1,
                     shown(quantity), shown(needed.quantity));
  if (needed.kind == Kind::as_is) return;
  if (si_unit(quantity).empty() && read.unit != needed.unit)
    fail<InputError>("{}: column {} is in {}, and in {} in the runs before", place_,
                     shown(quantity), read.unit.empty() ? "no unit" : shown(read.unit),
                     needed.unit.empty() ? "no unit" : shown(needed.unit));
  const Column meant = with_unit(*found, quantity);
  if (const std::string asked = read_column(needed.name).unit;
      first && !asked.empty() && asked != meant.unit && asked != si_unit(quantity))
    fail<InputError>("{}: '{}' is asked for, but column {} is '{}'", place_, shown(needed.name),
                     *found + 1, shown(to_text(meant)));
  const auto way_out = [&] {
    return has_use_ ? fmt::format(" or say --use '{}={}[UNIT]'", quantity, *found + 1) : "";
  };
  if (meant.unit.empty()) {
    std::string unit = unit_in_name(quantity, meant.name), by;
    if (const auto said = said_.find(quantity); unit.empty() && said != said_.end())
      unit = said->second.unit, by = fmt::format(", as line {} says", said->second.line);
    if (!unit.empty())
      fail<InputError>(
          "{}: column '{}' cannot serve as {}: is it in '{}'{}? Write the unit in brackets{}",
          place_, shown(meant.name), quantity, unit, by, way_out());
  }
  try {
    needed.to_si = conversion_to_si(quantity, meant);
  } catch (const Error& error) {
    fail<InputError>("{}: {}{}", place_, error.what(), way_out());
  }
}

void NeededColumns::resolve() {
  converts_ = false;
  for (Needed& needed : needed_) {
    resolve(needed);
    converts_ |= needed.to_si.changes();
  }
  name_columns();
}

void NeededColumns::name_columns() {
  in_output_ = as_read_;
  for (const Needed& needed : needed_) {
    if (!serves(needed)) continue;
    for (std::size_t i = 0; i < as_read_.size(); ++i)
      if (i != needed.column && as_read_[i].name == needed.quantity)
        in_output_[i].name = free_name(in_output_, needed.quantity);
  }
  for (const Needed& needed : needed_) {
    if (!serves(needed)) continue;
    Column& column = in_output_[needed.column];
    column.name = needed.quantity;
    if (const auto unit = si_unit(needed.quantity); !unit.empty()) column.unit = unit;
  }
}

bool NeededColumns::renames() const {
  return std::any_of(needed_.begin(), needed_.end(), [&](const Needed& needed) {
    return serves(needed) && as_read_[needed.column].name != needed.quantity;
  });
}

std::size_t NeededColumns::add(std::string_view name, Kind kind) {
  Needed asked{std::string(name), {}, kind};
  resolve(asked);
  for (std::size_t slot = 0; slot < needed_.size(); ++slot)
    if (Needed& known = needed_[slot]; known.column == asked.column &&
                                       known.quantity == asked.quantity &&
                                       known.column != no_column) {
      if (known.kind == Kind::wanted) known.kind = kind;
      return slot;
    }
  needed_.push_back(std::move(asked));
  resolve();
  return needed_.size() - 1;
}

}  // namespace rolling
