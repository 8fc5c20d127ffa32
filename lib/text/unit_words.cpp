#include "text/unit_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <vector>

#include "base/error.h"
#include "text/column.h"

namespace rolling {
namespace {

/// The words of a name in small letters, and `per` for a slash. A word ends at any other sign, and
/// before a capital behind a small letter.
std::vector<std::string> words_of(std::string_view name) {
  std::string words;
  bool small = false;
  for (const char c : plain_unit(std::string(name))) {
    const auto byte = static_cast<unsigned char>(c);
    if (small && std::isupper(byte)) words += ' ';
    if (c == '/') words += " per ";
    else words += std::isalnum(byte) ? static_cast<char>(std::tolower(byte)) : ' ';
    small = std::islower(byte);
  }
  return split_names(words, '\0');
}

/// Words in the letters of units: centimeters is cm, msec and millis are ms, feetpersecond is ftps.
std::string in_letters(std::string text) {
  constexpr std::pair<std::string_view, std::string_view> spelled[] = {
      {"seconds", "s"},  {"second", "s"},  {"secs", "s"},    {"sec", "s"},    {"minutes", "min"},
      {"minute", "min"}, {"mins", "min"},  {"hours", "h"},   {"hour", "h"},   {"hrs", "h"},
      {"hr", "h"},       {"meters", "m"},  {"metres", "m"},  {"meter", "m"},  {"metre", "m"},
      {"milli", "m"},    {"centi", "c"},   {"deci", "d"},    {"micro", "u"},  {"nano", "n"},
      {"kilo", "k"},     {"inches", "in"}, {"inch", "in"},   {"feet", "ft"},  {"miles", "mi"},
      {"mile", "mi"},    {"yards", "yd"},  {"pixels", "px"}, {"pixel", "px"}, {"degrees", "deg"},
      {"degree", "deg"}, {"kph", "kmph"},  {"fps", "ftps"},  {"per", "p"}};
  for (const auto& [word, letters] : spelled) text = replace_all(std::move(text), word, letters);
  return text;
}

/// The unit of a velocity or an acceleration whose letters these are: km/h for kmh and kmph,
/// cm/s^2 for cms2, cmss and cmpsps; empty for any other text.
std::string quotient(std::string_view text) {
  for (const std::string_view length :
       {"m", "mm", "cm", "dm", "um", "km", "in", "ft", "mi", "yd", "px", "deg", "rad"})
    for (const std::string_view time : {"s", "min", "h"}) {
      if (!text.starts_with(length)) continue;
      std::string_view rest = text.substr(length.size());
      const bool per = rest.starts_with('p');
      if (per) rest.remove_prefix(1);
      if (!rest.starts_with(time) || (length == "in" && !per)) continue;  // `t in s` is in seconds
      rest.remove_prefix(time.size());
      if (rest.empty()) return fmt::format("{}/{}", length, time);
      if (per && rest.starts_with('p')) rest.remove_prefix(1);
      if (rest == "2" || rest == time) return fmt::format("{}/{}^2", length, time);
    }
  return {};
}

/// Units that no tool converts.
constexpr std::array unknown = {"ns", "mi", "yd", "px", "deg", "rpm", "knots", "kn", "kt", "kts"};
/// Units of one quantity that are words or signs in the names of the others; cm is the centre of
/// mass.
constexpr std::array ambiguous = {"in", "min", "us", "um", "h", "cm"};

/// The unit that a word of a name is, `letters` in the letters of units; empty if it is none.
std::string unit_of_word(std::string_view quantity, const std::string& word,
                         const std::string& letters) {
  if (word != "in" && is_unit_of(quantity, letters)) return letters;
  if (std::string unit = quotient(letters); !unit.empty()) return unit;
  const bool is_other =
      std::ranges::count(ambiguous, word) == 0 && unit_kind(letters) != UnitKind::none;
  return is_other || std::ranges::count(unknown, letters) > 0 ? letters : std::string();
}

/// The unit of `quantity` that stands behind its own name, as in tms and speedkmh.
std::string unit_behind_quantity(std::string_view quantity, const std::string& word) {
  const auto is_quantity = [&](const std::string& front) {
    return read_column(front).name == quantity ||
           (front.size() == 1 && front[0] == std::tolower(quantity[0]));
  };
  for (std::size_t n = 1; n + 1 < word.size(); ++n)
    if (is_quantity(word.substr(0, n))) {
      const std::string rest = word.substr(n);
      std::string unit = unit_of_word(quantity, rest, in_letters(rest));
      if (is_unit_of(quantity, unit)) return unit;
    }
  return {};
}

}  // namespace

std::string unit_in_name(std::string_view quantity, std::string_view name) {
  if (si_unit(quantity).empty() || name == quantity) return {};
  const std::vector<std::string> words = words_of(name);
  std::vector<std::string> letters;
  for (const std::string& word : words) letters.push_back(in_letters(word));
  constexpr std::size_t longest = 5;  // cm per s per s
  for (std::size_t i = 0; i < words.size(); ++i)
    for (std::size_t end = std::min(i + longest, words.size()); end > i; --end) {
      std::string unit;
      if (end == i + 1) {
        unit = unit_of_word(quantity, words[i], letters[i]);
        if (unit.empty()) unit = unit_behind_quantity(quantity, words[i]);
      } else {
        std::string run;
        for (std::size_t k = i; k < end; ++k) run += letters[k];
        unit = quotient(run);
      }
      if (unit.empty()) continue;
      if (unit_kind(unit) != UnitKind::si) return unit;
      i = end - 1;
      break;
    }
  return {};
}

}  // namespace rolling
