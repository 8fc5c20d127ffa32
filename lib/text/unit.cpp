// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/unit.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <sstream>
#include <vector>

#include "text/number.h"

namespace rolling {
namespace {

constexpr std::string_view ratio;  // the quantity of a slope

/// A unit with a name of its own, by its spellings. Those of SI units may have a prefix.
struct NamedUnit {
  Conversion to_si;
  std::array<std::string_view, 5> spellings;
  std::string_view quantity;
  bool prefixed = false;
};
constexpr NamedUnit units[] = {
    {{}, {"m", "meter", "meters", "metre", "metres"}, "x", true},
    {{127, 5000}, {"in", "inch", "inches"}, "x"},
    {{381, 1250}, {"ft", "foot", "feet"}, "x"},
    {{1143, 1250}, {"yd", "yard", "yards"}, "x"},
    {{201168, 125}, {"mi", "mile", "miles"}, "x"},
    {{}, {"s", "sec", "secs", "second", "seconds"}, "t", true},
    {{60, 1}, {"min", "mins", "minute", "minutes"}, "t"},
    {{3600, 1}, {"h", "hr", "hrs", "hour", "hours"}, "t"},
    {{}, {"mps"}, "v"},
    {{5, 18}, {"km/h", "kmh", "kph", "kmph"}, "v"},
    {{1397, 3125}, {"mph"}, "v"},
    {{381, 1250}, {"fps"}, "v"},
    {{463, 900}, {"kn", "kt", "kts", "knot", "knots"}, "v"},
    {{1, 100}, {"%", "percent"}, ratio},
};
struct Prefix {
  std::string_view letter, word;
  Conversion size;
};
constexpr Prefix prefixes[] = {{"k", "kilo", {1e3, 1}},  {"d", "deci", {1, 1e1}},
                               {"c", "centi", {1, 1e2}}, {"m", "milli", {1, 1e3}},
                               {"u", "micro", {1, 1e6}}, {"n", "nano", {1, 1e9}}};

constexpr std::string_view lengths = "m, mm, cm, dm, um, km, in, ft";
constexpr KnownQuantity quantities[] = {
    {"t", "s", "s, sec, ms, us, ns, min, h", "a time"},
    {"x", "m", lengths, "a length"},
    {"v", "m/s", "m/s, mm/s, cm/s, km/h, mph, ft/s", "a speed"},
    {"a", "m/s^2", "m/s^2, m/s/s, mm/s^2, cm/s^2", "an acceleration", "differentiate"},
    {"D", "m", lengths, "a length", "shift-from-accel"},
};

std::optional<Unit> spelled(std::string_view word) {
  for (const NamedUnit& unit : units)
    for (const std::string_view spelling : unit.spellings) {
      if (spelling.empty() || !word.ends_with(spelling)) continue;
      const std::string_view front = word.substr(0, word.size() - spelling.size());
      if (front.empty()) return Unit{unit.quantity, unit.to_si};
      for (const Prefix& prefix : prefixes)
        if (unit.prefixed && (front == prefix.word || front == prefix.letter))
          return Unit{unit.quantity, prefix.size};
    }
  return {};
}

/// Products with a power of time, `m s^-1`, `cm*s-1` and `ms-2`, and squares as quotients: `m/s/s`.
std::string as_quotient(std::string_view unit) {
  std::string text = replace_all(unit, {{" per ", "/"},
                                        {"s^-", "/s^"},
                                        {"s-", "/s^"},
                                        {"h^-", "/h^"},
                                        {"h-", "/h^"},
                                        {"\xC2\xB7", " "},
                                        {"\xE2\x8B\x85", " "},
                                        {"*", " "},
                                        {".", " "}});
  const bool square = text.ends_with("^2");
  if (square || text.ends_with("^1")) text.resize(text.size() - 2);
  const auto slash = text.rfind('/');
  return square && slash != std::string::npos ? text + text.substr(slash) : text;
}

/// Units that are words of English, or signs in the names of columns.
constexpr std::array ambiguous = {"in", "min", "mins", "us", "um", "h", "cm", "foot", "feet"};

}  // namespace

std::string plain_unit(std::string_view text) {
  return replace_all(with_plain_blanks(text), {{"\xE2\x81\xBB\xC2\xB9", "^-1"},
                                               {"\xE2\x81\xBB\xC2\xB2", "^-2"},
                                               {"\xC2\xB2", "^2"},
                                               {"\xB2", "^2"},
                                               {"s2", "s^2"},
                                               {"\xC2\xB5", "u"},
                                               {"\xCE\xBC", "u"},
                                               {"\xB5", "u"},
                                               {"\n", " "}});
}

std::string bare_unit(std::string_view text) {
  if ((text.starts_with('[') && text.ends_with(']')) ||
      (text.starts_with('(') && text.ends_with(')')))
    text = text.substr(1, text.size() - 2);
  return std::string(trim(plain_unit(text)));
}

const KnownQuantity* known_quantity(std::string_view name) {
  const auto found = std::ranges::find(quantities, name, &KnownQuantity::name);
  return found == std::end(quantities) ? nullptr : found;
}

std::string_view si_unit(std::string_view quantity) {
  const KnownQuantity* q = known_quantity(quantity);
  return q ? q->si : std::string_view();
}

std::optional<Unit> read_unit(std::string_view text) {
  const std::string quotient = as_quotient(plain_unit(text));
  const std::string_view unit = trim(quotient);
  if (const auto found = spelled(unit)) return found;
  if (const auto found = spelled(lower(unit)); found && (unit.size() > 2 || found->quantity == "v"))
    return found;
  const auto slash = unit.rfind('/');
  constexpr std::string_view in = "in ";  // Zeit (in s)
  if (slash == std::string_view::npos)
    return unit.starts_with(in) ? read_unit(unit.substr(in.size())) : std::nullopt;
  const auto above = read_unit(unit.substr(0, slash));
  const auto below = read_unit(unit.substr(slash + 1));
  if (!above || !below) return {};
  const Conversion& of = above->to_si;
  const Conversion& per = below->to_si;
  const Conversion to_si{of.multiply * per.divide, of.divide * per.multiply};
  if (above->quantity == "x" && below->quantity == "x") return Unit{ratio, to_si};
  if (below->quantity != "t") return {};
  if (above->quantity == "x") return Unit{"v", to_si};
  if (above->quantity == "v") return Unit{"a", to_si};
  return {};
}

std::optional<Conversion> unit_of(std::string_view quantity, std::string_view unit) {
  const auto found = read_unit(unit);
  if (!found || found->quantity != (quantity == "D" ? "x" : quantity)) return {};
  return found->to_si;
}

std::string_view measured_by(std::string_view unit) {
  constexpr std::string_view angles[] = {"rad",    "deg",     "degree", "degrees",
                                         "radian", "radians", "rev",    "\xC2\xB0"};
  if (std::ranges::count(angles, lower(unit)) > 0) return "an angle";
  const auto found = read_unit(unit);
  if (!found) return {};
  const KnownQuantity* const quantity = known_quantity(found->quantity);
  return quantity ? quantity->in_words : "a ratio";
}

bool is_unit(std::string_view text) { return read_unit(bare_unit(text)).has_value(); }

std::string unit_at_end(std::string_view quantity, std::string_view name) {
  if (!known_quantity(quantity)) return {};
  constexpr std::string_view between = "_/";
  for (auto at = name.find_first_of(between); at != std::string_view::npos;
       at = name.find_first_of(between, at + 1)) {
    std::string end(name.substr(at + 1));
    std::ranges::replace(end, '_', ' ');
    std::string unit = bare_unit(trim(end));
    if (unit != "in" && unit_of(quantity, unit)) return unit;
  }
  const auto slash = name.rfind('/');
  if (slash == std::string_view::npos) return {};
  const auto before = name.find_last_of('_', slash);
  return std::string(name.substr(before == std::string_view::npos ? 0 : before + 1));
}

std::string unit_in_name(std::string_view name) {
  if (is_unit(name)) return std::string(name.size() > 2 ? name : "");
  for (auto at = name.find('/'); at != std::string_view::npos; at = name.find('/', at + 1)) {
    std::string unit = bare_unit(trim(name.substr(at + 1)));
    if (!read_unit(unit)) continue;
    const std::string_view before = trim(name.substr(0, at));
    const bool is_letter = before.size() < 2;  // s of the way
    return is_letter || measured_by(before).empty() ? unit : "";
  }
  return {};
}

void note_units(std::string_view comment, std::size_t line, SaidUnits& said) {
  if (comment.starts_with("##")) return;
  std::string text =
      replace_all(plain_unit(comment), {{" per ", "/"}, {" / ", "/"}, {"(", " [ "}, {"[", " [ "}});
  const auto is_other = [](unsigned char c) {
    return c < 0x80 && !std::isalnum(c) &&
           std::string_view("/^[").find(static_cast<char>(c)) == std::string_view::npos;
  };
  std::ranges::replace_if(text, is_other, ' ');
  std::istringstream in(text);
  const std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool in_bracket = i > 0 && words[i - 1] == "[";
    const bool of_value =
        (i > 0 && is_number(words[i - 1])) || (i + 1 < words.size() && is_number(words[i + 1]));
    if (of_value || (std::ranges::count(ambiguous, words[i]) > 0 && !in_bracket)) continue;
    const auto found = read_unit(words[i]);
    if (!found || !found->to_si.changes()) continue;
    said[std::string(found->quantity)] = fmt::format("line {} says {}", line, shown(words[i]));
    if (found->quantity == "x") said["D"] = said["x"];
  }
}

}  // namespace rolling
