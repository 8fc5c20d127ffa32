// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/unit.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <sstream>
#include <utility>
#include <vector>

#include "text/column.h"
#include "text/number.h"

namespace rolling {
namespace {

/// A unit with a name of its own, by its spellings. Those of SI units may have a prefix.
struct Unit {
  Conversion to_si;
  std::array<std::string_view, 5> spellings;
  std::string_view quantity;
  bool prefixed = false;
};
constexpr Unit units[] = {
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
};
struct Prefix {
  std::string_view letter, word;
  Conversion size;
};
constexpr Prefix prefixes[] = {{"k", "kilo", {1e3, 1}},  {"d", "deci", {1, 1e1}},
                               {"c", "centi", {1, 1e2}}, {"m", "milli", {1, 1e3}},
                               {"u", "micro", {1, 1e6}}, {"n", "nano", {1, 1e9}}};

struct KnownQuantity {
  std::string_view name, si, units;
};
constexpr std::string_view lengths = "m, mm, cm, dm, um, km, in, ft";
constexpr KnownQuantity quantities[] = {
    {"t", "s", "s, sec, ms, us, min, h"},
    {"x", "m", lengths},
    {"v", "m/s", "m/s, mm/s, cm/s, km/h, mph, ft/s"},
    {"a", "m/s^2", "m/s^2, m/s/s, mm/s^2, cm/s^2"},
    {"D", "m", lengths},
};

const KnownQuantity* known(std::string_view name) {
  const auto found = std::ranges::find(quantities, name, &KnownQuantity::name);
  return found == std::end(quantities) ? nullptr : found;
}

std::optional<Conversion> spelled(std::string_view quantity, std::string_view word) {
  const auto is_one_of = [](const Unit& unit, std::string_view text) {
    return !text.empty() && std::ranges::count(unit.spellings, text) > 0;
  };
  for (const Unit& unit : units) {
    if (unit.quantity != quantity) continue;
    if (is_one_of(unit, word)) return unit.to_si;
    for (const Prefix& prefix : prefixes)
      for (const std::string_view front : {prefix.word, prefix.letter})
        if (unit.prefixed && word.starts_with(front) && is_one_of(unit, word.substr(front.size())))
          return prefix.size;
  }
  return {};
}

/// Products with a power of time, `m s^-1`, `cm*s-1` and `ms-2`, and squares as quotients: `m/s/s`.
std::string as_quotient(std::string text) {
  for (const auto& [from, to] : {std::pair{" per ", "/"},
                                 {"s^-", "/s^"},
                                 {"s-", "/s^"},
                                 {"h^-", "/h^"},
                                 {"h-", "/h^"},
                                 {"^1", ""}})
    text = replace_all(std::move(text), from, to);
  for (const std::string_view times : {"\xC2\xB7", "\xE2\x8B\x85", "*", "."})
    text = replace_all(std::move(text), times, " ");
  if (const auto slash = text.rfind('/'); slash != std::string::npos && text.ends_with("^2")) {
    text.resize(text.size() - 2);
    text += text.substr(slash);
  }
  return text;
}

/// A unit with a name, or one of length or speed over one of time. Case does not matter in words
/// and in the names of speeds, but in letters: Ms is no millisecond.
std::optional<Conversion> conversion(std::string_view quantity, std::string_view text) {
  text = trim(text);
  if (const auto found = spelled(quantity, text)) return found;
  if (text.size() > 2 || quantity == "v")
    if (const auto found = spelled(quantity, lower(text))) return found;
  const auto slash = text.rfind('/');
  if (slash == std::string_view::npos || (quantity != "v" && quantity != "a")) return {};
  const auto above = conversion(quantity == "a" ? "v" : "x", text.substr(0, slash)),
             below = conversion("t", text.substr(slash + 1));
  if (!above || !below) return {};
  return Conversion{above->multiply * below->divide, above->divide * below->multiply};
}

/// Words of English, and signs in the names of columns.
bool is_ambiguous(std::string_view word) {
  constexpr std::array words = {"in", "min", "mins", "us", "um", "h", "cm", "foot", "feet"};
  return std::ranges::count(words, word) > 0;
}

}  // namespace

std::string plain_unit(std::string_view text) {
  std::string unit = with_plain_blanks(text);
  for (const auto& [from, to] : {std::pair{"\xE2\x81\xBB\xC2\xB9", "^-1"},
                                 {"\xE2\x81\xBB\xC2\xB2", "^-2"},
                                 {"\xC2\xB2", "^2"},
                                 {"\xB2", "^2"},
                                 {"\xC2\xB5", "u"},
                                 {"\xCE\xBC", "u"},
                                 {"\xB5", "u"},
                                 {"\n", " "}})
    unit = replace_all(std::move(unit), from, to);
  return replace_all(std::move(unit), "s2", "s^2");
}

std::string bare_unit(std::string_view text) {
  if (text.size() > 1 && (text.front() == '[' || text.front() == '('))
    text = text.substr(1, text.size() - 2);
  return std::string(trim(plain_unit(text)));
}

bool is_quantity(std::string_view name) { return known(name) != nullptr; }

std::string_view si_unit(std::string_view quantity) {
  const KnownQuantity* q = known(quantity);
  return q ? q->si : std::string_view();
}

std::string_view known_units(std::string_view quantity) { return known(quantity)->units; }

std::optional<Conversion> unit_of(std::string_view quantity, std::string_view unit) {
  if (!is_quantity(quantity)) return {};
  const auto found = conversion(quantity == "D" ? "x" : quantity, as_quotient(plain_unit(unit)));
  constexpr std::string_view in = "in ";  // Zeit (in s)
  return !found && unit.starts_with(in) ? unit_of(quantity, unit.substr(in.size())) : found;
}

bool is_unit(std::string_view text) {
  return std::ranges::any_of(quantities, [unit = bare_unit(text)](const KnownQuantity& of) {
    return unit_of(of.name, unit).has_value();
  });
}

std::string unit_at_end(std::string_view quantity, std::string_view name) {
  if (!is_quantity(quantity)) return {};
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

void note_units(std::string_view comment, std::size_t line, SaidUnits& said) {
  if (comment.starts_with("##")) return;
  std::string text = plain_unit(comment);
  for (const auto& [from, to] : {std::pair{" per ", "/"}, {" / ", "/"}, {"(", " [ "}, {"[", " [ "}})
    text = replace_all(std::move(text), from, to);
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
    if (of_value || (is_ambiguous(words[i]) && !in_bracket)) continue;
    const std::string unit = as_quotient(words[i]);
    for (const KnownQuantity& of : quantities)
      if (const auto found = conversion(of.name == "D" ? "x" : of.name, unit);
          found && found->changes())
        said[std::string(of.name)] = {words[i], line};
  }
}

}  // namespace rolling
