#include "text/unit_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <vector>

#include "base/error.h"
#include "text/column.h"
#include "text/number.h"

namespace rolling {
namespace {

constexpr std::size_t longest_unit = 32;  // letters, where it is spelled in words

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
constexpr std::array unknown = {"ns",    "mi", "yd", "px",  "deg",  "rpm",
                                "knots", "kn", "kt", "kts", "days", "ticks"};
/// Units of one quantity that are words or signs in the names of the others; cm is the centre of
/// mass.
constexpr std::array ambiguous = {"in", "min", "us", "um", "h", "cm"};

/// True for a unit that is spelled in whatever language, as Millisekunden and centimetros are: a
/// metre or a second behind a prefix, or a minute.
bool is_spelled_out(std::string_view word) {
  if (word.starts_with("minut")) return true;
  for (const std::string_view prefix :
       {"milli", "mili", "mikro", "micro", "centi", "zenti", "santi", "kilo", "nano"})
    for (const std::string_view unit : {"met", "se", "sa"})
      if (word.starts_with(prefix) && word.substr(prefix.size()).starts_with(unit)) return true;
  return false;
}

/// The unit that a word of a name is, `letters` in the letters of units; empty if it is none.
std::string unit_of_word(std::string_view quantity, const std::string& word,
                         const std::string& letters) {
  if (word != "in" && is_unit_of(quantity, letters)) return letters;
  if (std::string unit = quotient(letters); !unit.empty()) return unit;
  const bool is_other =
      std::ranges::count(ambiguous, word) == 0 && unit_kind(letters) != UnitKind::none;
  if (is_other || std::ranges::count(unknown, letters) > 0) return letters;
  return is_spelled_out(word) ? word : std::string();
}

/// Units that no word of a name or a sentence ends in by accident (`sum`, `left`, `status` end in
/// others).
bool is_sure(std::string_view unit) {
  constexpr std::array sure = {"ms", "mm", "cm", "km", "mph"};
  return std::ranges::count(sure, unit) > 0 || unit.find('/') != std::string_view::npos;
}

/// The unit of `quantity` at the end of a word: behind its name any, as in tus and speedfps, behind
/// other letters one that is sure, as in posmm.
std::string glued_unit(std::string_view quantity, const std::string& word) {
  const auto is_quantity = [&](const std::string& front) {
    return read_column(front).name == quantity ||
           (front.size() == 1 && front[0] == std::tolower(quantity[0]));
  };
  for (std::size_t n = std::max(word.size(), longest_unit + 1) - longest_unit; n + 1 < word.size();
       ++n) {
    const std::string rest = word.substr(n);
    std::string unit = unit_of_word(quantity, rest, in_letters(rest));
    if (is_unit_of(quantity, unit) && (is_sure(unit) || is_quantity(word.substr(0, n))))
      return unit;
  }
  return {};
}

/// What stands about the last slash of a name: cm/seg of Velocidad_cm/seg, Std of t_/_Std.
std::string about_slash(std::string_view name) {
  const auto slash = name.rfind('/'), blank = name.find_last_of(" _", slash);
  const auto begin = blank == std::string_view::npos ? 0 : blank + 1;
  if (begin != slash) return std::string(name.substr(begin));
  return std::string(name.substr(std::min(name.find_first_not_of(" _", slash + 1), name.size())));
}

/// The words of a comment, with their capitals: a quotient is one word (cm/s^2), and `in` stands
/// for an equals sign or a colon.
std::vector<std::string> words_of_comment(std::string_view comment) {
  std::string text = as_quotients(plain_unit(std::string(comment)));
  constexpr std::pair<std::string_view, std::string_view> spelled[] = {
      {"_", " "}, {" per ", "/"}, {" / ", "/"}, {"=", " in "}, {":", " in "}};
  for (const auto& [from, to] : spelled) text = replace_all(std::move(text), from, to);
  std::replace_if(
      text.begin(), text.end(),
      [](unsigned char c) { return !std::isalnum(c) && c != '/' && c != '^'; }, ' ');
  return split_names(text, '\0');
}

/// The known quantity of which a word tells, one or several: time, times, velocities; else empty.
std::string quantity_of(const std::string& word) {
  const auto known = [](const std::string& text) {
    const std::string name = read_column(text).name;
    return si_unit(name).empty() ? "" : name;
  };
  if (word.size() < 4 || !word.ends_with('s')) return known(word);
  if (word.ends_with("ies")) return known(word.substr(0, word.size() - 3) + 'y');
  return known(word.substr(0, word.size() - 1));
}

/// The units that a word of a comment may be; capitals are those of a short word.
std::array<std::string, 3> as_units(std::string word) {
  if (word.size() > longest_unit) return {};
  if (word.size() > 2)
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::string letters = in_letters(word);
  return {word, letters, quotient(letters)};
}

/// The place of the list of units that ends a comment, two or more or one behind `in`: there `in`
/// is an inch and `min` a minute. Behind the last word if there is none.
std::size_t list_of_units(const std::vector<std::string>& words) {
  const std::size_t end = words.size();
  const auto is_unit = [](const std::string& word) {
    const auto units = as_units(word);
    return !units.back().empty() || std::ranges::any_of(units, [](const std::string& unit) {
      return unit_kind(unit) != UnitKind::none;
    });
  };
  std::size_t begin = end;
  while (begin > 0 && is_unit(words[begin - 1]) && (begin < 2 || !is_number(words[begin - 2])))
    --begin;
  while (begin + 1 < end && words[begin] == "in") ++begin;
  return begin + 1 < end || (begin > 0 && words[begin - 1] == "in") ? begin : end;
}

}  // namespace

std::string unit_in_name(std::string_view quantity, std::string_view name) {
  if (si_unit(quantity).empty() || name == quantity) return {};
  const std::vector<std::string> words = words_of(name);
  std::vector<std::string> letters;
  for (const std::string& word : words) letters.push_back(in_letters(word));
  constexpr std::size_t longest = 5;  // cm per s per s
  bool divides = false;               // there is a slash, and no known unit in it or behind it
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool is_with = i > 0 && words[i - 1].starts_with("with");  // without g, which is no unit
    if (quantity == "a" && words[i] == "g" && !is_with) return words[i];
    divides |= words[i] == "per" && name.find('/') != std::string_view::npos;
    for (std::size_t end = std::min(i + longest, words.size()); end > i; --end) {
      std::string unit;
      if (end == i + 1) {
        unit = unit_of_word(quantity, words[i], letters[i]);
        if (unit.empty()) unit = glued_unit(quantity, words[i]);
      } else {
        std::string run;
        for (std::size_t k = i; k < end; ++k) run += letters[k];
        unit = quotient(run);
      }
      if (unit.empty()) continue;
      const bool is_own = is_unit_of(quantity, unit);
      const bool is_quotient = unit.find('/') != std::string::npos;
      if (unit_kind(unit) != UnitKind::si || (is_quotient && !is_own)) return unit;
      i = end - 1;
      divides &= !is_own;
      break;
    }
  }
  return divides ? about_slash(name) : std::string();
}

UnitsOf units_in_comment(std::string_view comment) {
  UnitsOf said;
  if (comment.starts_with("##")) return said;
  const std::vector<std::string> words = words_of_comment(comment.substr(1));
  const auto is_value = [&](std::size_t i) { return i < words.size() && is_number(words[i]); };
  const auto is_in = [&](std::size_t i) {
    constexpr std::array in = {"in", "unit", "units", "Unit", "Units"};
    return i < words.size() && std::ranges::count(in, words[i]) > 0;
  };
  const std::size_t list = list_of_units(words);
  std::string of;  // the known quantity that was named last
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::string word = words[i];
    const auto slash = word.find('/');
    if (const std::string front = quantity_of(word.substr(0, slash)); !front.empty()) {
      of = front;
      if (slash == std::string::npos) continue;
      word.erase(0, slash + 1);  // t/ms
    }
    if ((i > 0 && is_value(i - 1)) || is_value(i + 1) || (is_in(i + 1) && is_value(i + 2)))
      continue;
    const bool behind_in = i > 0 && is_in(i - 1);
    const std::string before = i > 1 && behind_in ? quantity_of(words[i - 2]) : "";
    if (word == "in" && i < list) continue;
    const auto units = as_units(word);
    for (const char* const quantity : {"t", "x", "v", "a", "D"}) {
      const auto found = std::ranges::find_if(
          units, [&](const std::string& unit) { return is_unit_of(quantity, unit); });
      const std::string unit = found != units.end()           ? *found
                               : before != quantity           ? ""
                               : before == "a" && word == "g" ? "g"
                                                              : unit_in_name(quantity, word);
      const bool of_another = of != quantity && is_unit_of(of, unit);
      if (!unit.empty() && unit_kind(unit) != UnitKind::si && !of_another &&
          (behind_in || i >= list || is_sure(unit)))
        said.emplace(quantity, unit);
    }
  }
  return said;
}

}  // namespace rolling
