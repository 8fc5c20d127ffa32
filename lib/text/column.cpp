#include "text/column.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "base/error.h"
#include "text/delimiters.h"
#include "text/number.h"

namespace rolling {
namespace {

struct Unit {
  std::string_view name;
  Conversion to_si;
};
struct KnownQuantity {
  std::string_view name, long_name, other_name;
  std::vector<Unit> units;  // the SI unit is the first
};

const std::vector<Unit> lengths = {{"m", {}},          {"mm", {1, 1e3}},   {"cm", {1, 1e2}},
                                   {"dm", {1, 10}},    {"um", {1, 1e6}},   {"km", {1e3, 1}},
                                   {"in", {254, 1e4}}, {"ft", {3048, 1e4}}};
const std::array<KnownQuantity, 5> quantities = {{
    {"t",
     "time",
     "time",
     {{"s", {}},
      {"sec", {}},
      {"ms", {1, 1e3}},
      {"us", {1, 1e6}},
      {"min", {60, 1}},
      {"h", {3600, 1}}}},
    {"x", "position", "position", lengths},
    {"v",
     "velocity",
     "speed",
     {{"m/s", {}},
      {"mm/s", {1, 1e3}},
      {"cm/s", {1, 1e2}},
      {"km/h", {5, 18}},
      {"mph", {1397, 3125}},
      {"ft/s", {3048, 1e4}}}},
    {"a",
     "acceleration",
     "acceleration",
     {{"m/s^2", {}}, {"m/s/s", {}}, {"mm/s^2", {1, 1e3}}, {"cm/s^2", {1, 1e2}}}},
    {"D", "shift", "shift", lengths},
}};

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

/// The spelling of a unit in the lists above: a quotient instead of a product, km/h for kph and
/// kmh, and km/h and mph in small letters.
std::string listed_unit(std::string unit) {
  unit = as_quotients(replace_all(std::move(unit), " / ", "/"));
  const std::string small = lower(unit);
  if (small == "km/h" || small == "kph" || small == "kmh" || small == "km/hr") return "km/h";
  return small == "mph" ? small : unit;
}

const KnownQuantity* known(std::string_view name) {
  for (const KnownQuantity& q : quantities)
    if (q.name == name) return &q;
  return nullptr;
}

/// Removes `Run #2` or `Run 2` from the end of a name, and `Latest:` or `Data Set 1:` from its
/// beginning; returns the number, or the word if there is no number.
std::string take_run(std::string_view& name) {
  const auto number_at_end = [](std::string_view text) {
    return text.substr(text.find_last_not_of("0123456789") + 1);
  };
  std::string_view prefix;
  if (const auto colon = name.find(':'); colon != std::string_view::npos) {
    prefix = trim(name.substr(0, colon));
    name = trim(name.substr(colon + 1));
  }
  const std::string_view number = number_at_end(name);
  const auto at = name.rfind("Run");
  if (!number.empty() && at != std::string_view::npos && at > 0 && name[at - 1] == ' ') {
    const std::string_view between =
        trim(name.substr(at + 3, name.size() - number.size() - (at + 3)));
    if (between.empty() || between == "#") {
      name = trim(name.substr(0, at));
      return std::string(number);
    }
  }
  return std::string(number_at_end(prefix).empty() ? prefix : number_at_end(prefix));
}

/// The quoted name that begins at `at`, which is moved behind it; nothing if none does, or if other
/// text stands behind its quote.
std::optional<std::string> take_quoted(std::string_view line, std::size_t& at, char separator) {
  const char* const end = line.data() + line.size();
  if (at == line.size() || line[at] != quote) return {};
  const char* const close = closing_quote(line.data() + at + 1, end);
  if (close == end) return {};
  const char* behind = close + 1;
  while (separator && behind != end && *behind != separator && is_blank(*behind)) ++behind;
  if (behind != end && !(separator ? *behind == separator : is_blank(*behind))) return {};
  const std::string_view inside(line.data() + at + 1, close);
  at = static_cast<std::size_t>(behind - line.data());
  return replace_all(std::string(trim(inside)), "\"\"", "\"");
}

}  // namespace

std::string replace_all(std::string text, std::string_view from, std::string_view to) {
  std::size_t begin = 0, at = text.find(from);
  if (at == std::string::npos) return text;
  std::string replaced;
  for (; at != std::string::npos; at = text.find(from, begin)) {
    replaced.append(text, begin, at - begin).append(to);
    begin = at + from.size();
  }
  return replaced.append(text, begin, std::string::npos);
}

std::string plain_unit(std::string unit) {
  for (const auto& [from, to] : {std::pair{"\xE2\x81\xBB\xC2\xB9", "^-1"},
                                 {"\xE2\x81\xBB\xC2\xB2", "^-2"},
                                 {"\xC2\xB2", "^2"},
                                 {"\xB2", "^2"},
                                 {"\xC2\xB5", "u"},
                                 {"\xCE\xBC", "u"},
                                 {"\xB5", "u"},
                                 {"\xC2\xA0", " "},
                                 {"\n", " "}})
    unit = replace_all(std::move(unit), from, to);
  return replace_all(std::move(unit), "s2", "s^2");
}

std::string as_quotients(std::string text) {
  for (const std::string_view times : {"\xC2\xB7", "\xE2\x8B\x85", "*", "."})
    text = replace_all(std::move(text), times, " ");
  const auto are_blanks = [](char one, char next) { return one == ' ' && next == ' '; };
  text.erase(std::unique(text.begin(), text.end(), are_blanks), text.end());
  for (const std::string_view time : {"s", "min", "h"})
    for (const auto& [power, per] : {std::pair{"^-1", ""}, {"-1", ""}, {"^-2", "^2"}, {"-2", "^2"}})
      text = replace_all(std::move(text), fmt::format(" {}{}", time, power),
                         fmt::format("/{}{}", time, per));
  return text;
}

Column read_column(std::string_view text) {
  Column column;
  std::string line = replace_all(std::string(text), "\xC2\xA0", " ");  // no-break spaces
  std::replace(line.begin(), line.end(), '\n', ' ');  // a quoted name may go over two lines
  std::string_view name = trim(line);
  column.run = take_run(name);
  const char close = name.empty() ? '\0' : name.back();
  const auto open = close == ')'   ? name.rfind('(')
                    : close == ']' ? name.rfind('[')
                                   : std::string_view::npos;
  if (open != std::string_view::npos && open > 0) {
    column.unit = plain_unit(std::string(trim(name.substr(open + 1, name.size() - open - 2))));
    name = trim(name.substr(0, open));
  }
  const std::string small = lower(name);
  for (const KnownQuantity& q : quantities)
    if (small == q.long_name || small == q.other_name) name = q.name;
  column.name = name;
  std::replace_if(
      column.name.begin(), column.name.end(), [](char c) { return c == ' ' || c == '\t'; }, '_');
  return column;
}

std::string to_text(const Column& column) {
  return column.unit.empty() ? column.name : fmt::format("{}[{}]", column.name, column.unit);
}

std::string free_name(const std::vector<Column>& columns, std::string name) {
  const auto taken = [&](const Column& column) { return column.name == name; };
  do name += "_in";
  while (std::any_of(columns.begin(), columns.end(), taken));
  return name;
}

std::string_view si_unit(std::string_view quantity) {
  const KnownQuantity* q = known(quantity);
  return q ? q->units.front().name : std::string_view();
}

std::string bare_unit(std::string_view text) {
  if (text.size() > 1 && (text.front() == '[' || text.front() == '('))
    text = text.substr(1, text.size() - 2);
  return std::string(trim(plain_unit(std::string(text))));
}

UnitKind unit_kind(std::string_view text) {
  const std::string listed = listed_unit(bare_unit(text));
  for (const KnownQuantity& q : quantities)
    for (const Unit& unit : q.units)
      if (unit.name == listed) return unit.to_si.changes() ? UnitKind::other : UnitKind::si;
  return UnitKind::none;
}

bool is_known(const Column& column) { return !si_unit(column.name).empty(); }

bool is_unit_of(std::string_view quantity, std::string_view unit) {
  const KnownQuantity* q = known(quantity);
  return q && std::ranges::count(q->units, unit, &Unit::name) > 0;
}

Conversion conversion_to_si(std::string_view quantity, const Column& column) {
  const KnownQuantity* q = known(quantity);
  if (!q || column.unit.empty()) return {};
  std::string all;
  for (const Unit& unit : q->units) {
    if (unit.name == listed_unit(column.unit)) return unit.to_si;
    (all += all.empty() ? "" : ", ") += unit.name;
  }
  fail(
      "column '{}' cannot serve as {}: its unit '{}' is not one of those known ({}); convert it "
      "first",
      shown(to_text(column)), quantity, shown(column.unit), all);
}

std::vector<std::string> split_names(std::string_view line, char separator) {
  std::vector<std::string> names;
  if (separator) {
    for (std::size_t at = 0; at <= line.size();) {
      while (at < line.size() && line[at] != separator && is_blank(line[at])) ++at;
      if (auto quoted = take_quoted(line, at, separator)) {
        names.push_back(std::move(*quoted));
        ++at;
        continue;
      }
      const auto end = std::min(line.find(separator, at), line.size());
      names.emplace_back(trim(line.substr(at, end - at)));
      at = end + 1;
    }
    return names;
  }
  const auto closing = line.find_last_of(")]");
  bool open = false;  // the last name has an open bracket
  for (std::size_t at = 0; (at = line.find_first_not_of(" \t", at)) != std::string_view::npos;) {
    if (auto quoted = open ? std::nullopt : take_quoted(line, at, separator)) {
      names.push_back(std::move(*quoted));
      continue;
    }
    const auto end = std::min(line.find_first_of(" \t", at), line.size());
    const std::string_view word = line.substr(at, end - at);
    const bool opens = word.front() == '(' || word.front() == '[';
    // Behind a name that is a bracket itself, as in a line of units, another name begins.
    if (!names.empty() && ((opens && names.back().find_first_of("([") != 0) ||
                           (open && closing != std::string_view::npos && closing >= at))) {
      names.back().append(" ").append(word);
    } else {
      names.emplace_back(word);
      open = false;
    }
    if (const auto last = word.find_last_of("(["); last != std::string_view::npos)
      open = word.find_first_of(")]", last) == std::string_view::npos;
    else if (word.find_first_of(")]") != std::string_view::npos) open = false;
    at = end;
  }
  return names;
}

}  // namespace rolling
