// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/dialect.h"

#include <algorithm>

#include "base/error.h"
#include "text/number.h"

namespace rolling {
namespace {

constexpr std::size_t npos = std::string_view::npos;
constexpr std::string_view minus = "\xE2\x88\x92";  // U+2212

bool holds(std::string_view text, char c) { return text.find(c) != npos; }

/// Appends a number with a decimal point and a hyphen: `1,5` as `1.5`, U+2212 as `-`. Returns the
/// appended text.
std::string_view append_plain(std::string& to, std::string_view field) {
  const auto from = to.size();
  to += field;
  if (const auto comma = field.find(','); comma != npos && !holds(field, '.'))
    to[from + comma] = '.';
  for (auto at = to.find(minus, from); at != npos; at = to.find(minus, at))
    to.erase(at + 1, minus.size() - 1)[at] = '-';
  return std::string_view(to).substr(from);
}

std::string_view without_sign(std::string_view field) {
  for (const std::string_view sign : {minus, std::string_view("-"), std::string_view("+")})
    if (field.starts_with(sign)) return field.substr(sign.size());
  return field;
}

/// True for `1,002`, whose mark may separate thousands: one to three digits before the mark, the
/// first of them not 0, and three behind it.
bool may_be_thousands(std::string_view field, char mark) {
  field = without_sign(field);
  const auto at = field.find(mark);
  return at >= 1 && at <= 3 && field.size() == at + 4 && field.front() != '0' &&
         is_whole(field.substr(0, at)) && is_whole(field.substr(at + 1));
}

/// The characters of plain text: no separator, no quote, and none that only numbers with a decimal
/// comma or U+2212 have.
constexpr bool is_plain_text(char c) { return c >= '-' && c <= 'z' && c != ';'; }

/// Reads the number of the field if it is wanted, else skips plain text; returns the end of either.
/// Reading a number finds its end, and so the end of its field: the line is passed over only once.
const char* read_plain(const char* at, const char* end, Field& field) {
  if (field.wanted) return read_number(at, end, field.number);
  while (at != end && is_plain_text(*at)) ++at;
  return at;
}

}  // namespace

std::size_t closing_quote(std::string_view text) {
  for (std::size_t at = text.find(quote); at < text.size(); at = text.find(quote, at + 2))
    if (at + 1 == text.size() || text[at + 1] != quote) return at;
  return text.size();
}

std::optional<std::string> take_quoted(std::string_view& line, char separator) {
  if (!line.starts_with(quote)) return {};
  const std::string_view inside = line.substr(1);
  const std::size_t close = closing_quote(inside);
  if (close == inside.size()) return {};
  std::string_view behind = inside.substr(close + 1);
  while (separator && !behind.empty() && behind.front() != separator && is_blank(behind.front()))
    behind.remove_prefix(1);
  if (!behind.empty() && (separator ? behind.front() != separator : !is_blank(behind.front())))
    return {};
  line = behind;
  return replace_all(trim(inside.substr(0, close)), {{"\"\"", "\""}});
}

std::string outside_quotes(std::string_view text, std::string_view between, bool& within) {
  std::string outside;
  for (bool begins = true; within || !text.empty();) {
    const bool opens = !within && begins && text.front() == quote;
    if (within || opens) {
      text.remove_prefix(opens ? 1 : 0);
      const std::size_t close = closing_quote(text);
      within = close == text.size();
      if (within) return outside;
      text.remove_prefix(close + 1);
      begins = false;
    } else {
      const char next = text.front();
      outside += next;
      begins = holds(between, next) || (begins && is_blank(next));
      text.remove_prefix(1);
    }
  }
  return outside;
}

std::string quoted(std::string_view text) {
  return fmt::format("\"{}\"", replace_all(text, {{"\"", "\"\""}}));
}

void append_field(Bytes& line, std::string_view field) {
  const auto is_special = [](char c) { return c == quote || c == '\t' || c == '\n'; };
  if (!field.starts_with('#') && std::ranges::none_of(field, is_special)) return line.append(field);
  for (const char c : quoted(field)) line.push_back(c);
}

bool Dialect::choose(std::string_view line, bool tabs) {
  bool within = false;
  const std::string outside = outside_quotes(line, separators, within);
  const auto first = std::ranges::find_if(separators, [&](char c) { return holds(outside, c); });
  *this = Dialect();
  separator_ = first == separators.end() ? '\0' : *first;
  if (separator_ == '\t' && !tabs) {
    const auto fields = split(line);
    const bool has_blanks =
        std::ranges::any_of(fields, [](const Field& field) { return holds(field.text, ' '); });
    separator_ = '\0';  // where tabs and blanks both separate numbers, any blank separates
    const auto words = has_blanks ? split(line) : std::span<const Field>();
    if (words.empty() || !std::ranges::all_of(words, is_number, &Field::text)) separator_ = '\t';
  }
  return holds_number(line);
}

bool Dialect::holds_number(std::string_view line) {
  // A decimal comma counts here even between commas: the line is then refused as a row, with a
  // message that says what to do, and not taken for a header.
  // So does a number in quotes that are none here.
  return std::ranges::any_of(split(line), [](const Field& field) {
    std::string_view bare = field.text;
    while (!bare.empty() && (bare.front() == quote || bare.front() == '\'')) bare.remove_prefix(1);
    while (!bare.empty() && (bare.back() == quote || bare.back() == '\'')) bare.remove_suffix(1);
    std::string text;
    return is_number(append_plain(text, bare)) || (is_missing(bare) && !bare.empty());
  });
}

void Dialect::want(std::size_t field) {
  if (fields_.size() <= field) fields_.resize(field + 1);
  fields_[field].wanted = true;
}

std::span<const Field> Dialect::split(std::string_view line) {
  count_ = 0;
  made_.clear();
  made_.reserve(2 * line.size());  // a text without its quotes, and then in plain form
  if (separator_ == '\0') line = trim(line);
  const char* at = line.data();
  const char* const end = at + line.size();
  if (separator_ == '\0' && at == end) return {};
  for (;; ++at) {
    if (count_ == fields_.size()) fields_.emplace_back();
    at = take_text(at, end, fields_[count_++]);
    if (at == end) return {fields_.data(), count_};
  }
}

const char* Dialect::split_plain(std::string_view text, std::span<const Field>& fields) {
  if (allows_foreign() && decimal_mark_ == '\0') return nullptr;
  return decimal_mark_ == ',' ? split_with_commas(text, fields) : split_with_points(text, fields);
}

/// Splits a copy of the line with decimal points.
const char* Dialect::split_with_commas(std::string_view text, std::span<const Field>& fields) {
  made_ = text.substr(0, text.find('\n') + 1);
  if (made_.find('.') != npos) return nullptr;
  std::ranges::replace(made_, ',', '.');
  const char* const end = split_with_points(made_, fields);
  // A comma in a text is not a decimal one.
  const auto is_changed_text = [](const Field& field) {
    return !field.wanted && field.text.find('.') != npos && !is_number(field.text);
  };
  if (!end || std::ranges::any_of(fields, is_changed_text)) return nullptr;
  return text.data() + (end - made_.data());
}

const char* Dialect::split_with_points(std::string_view text, std::span<const Field>& fields) {
  const char* at = text.data();
  const char* const end = at + text.size();
  const bool blanks = separator_ == '\0';
  const char separator = blanks ? ' ' : separator_;
  for (Field& field : fields_) {
    while (at != end && is_blank(*at) && *at != separator_) ++at;
    const char* first = at;
    at = read_plain(first, end, field);
    const bool quoted = at == first && at != end && *at == quote && !blanks;
    if (quoted) at = read_plain(++first, end, field);
    field.text = {first, at};
    if (at == first || at == end) return nullptr;
    if (quoted && (*at++ != quote || at == end)) return nullptr;
    if (*at == separator) {
      ++at;
      continue;
    }
    if (*at != '\n' && (*at != '\r' || end - at < 2 || at[1] != '\n')) return nullptr;
    fields = {fields_.data(), &field + 1};
    return at;
  }
  return nullptr;
}

/// Reads the field that begins at `at`, with any content; returns its end.
const char* Dialect::take_text(const char* at, const char* end, Field& field) {
  while (at != end && is_blank(*at) && *at != separator_) ++at;
  if (separator_ != '\0' && at != end && *at == quote) {
    std::string_view rest(at, end);
    const auto text = take_quoted(rest, separator_);
    if (!text) fail("field {}: text behind the quotes of '{}'", count_, shown(rest));
    made_ += *text;
    field.text = std::string_view(made_).substr(made_.size() - text->size());
    at = rest.data();
  } else {
    const char* const first = at;
    at = separator_ == '\0' ? std::find_if(at, end, is_blank) : std::find(at, end, separator_);
    field.text = trim({first, at});
  }
  if (allows_foreign() && rewrite(field)) return at;
  if (field.wanted && !parse_number(field.text, field.number)) field.number = Field().number;
  return at;
}

/// True for `1.000`, which is read as 1 as long as its column says nothing else. Refuses it beside
/// a whole number below 1000: neither one number of decimals nor the fewest would give both.
bool Dialect::may_be_grouped(const Field& field) {
  if (seen_.size() < count_) seen_.resize(count_);
  const std::string_view size = without_sign(field.text);
  const bool is_grouped = may_be_thousands(field.text, '.');
  const bool is_small = size.size() <= 3 && is_whole(size);
  if (!field.wanted || !(is_grouped || is_small)) return is_grouped;
  Seen& seen = seen_[count_ - 1];
  seen.whole |= is_small;
  seen.three_digits |= is_small && size.size() == 3;
  seen.grouped |= is_grouped;
  seen.zero_at_the_end |= is_grouped && size.ends_with('0');
  if (seen.whole && seen.grouped && (seen.three_digits || seen.zero_at_the_end))
    fail(
        "field {}: '{}' can be read in two ways in a column where whole numbers stand beside such "
        "as 1.000: if its points separate thousands, remove them, else give all numbers decimals",
        count_, shown(field.text));
  return is_grouped;
}

/// Reads a number with a decimal comma or U+2212 and puts its form with point and hyphen into the
/// field. False for any other text, which is left unchanged.
bool Dialect::rewrite(Field& field) {
  if (asks_ && decimal_mark_ == '\0' && may_be_grouped(field)) {
    passed_thousands_ |= field.wanted;
    return field.wanted && parse_number(field.text, field.number);
  }
  const bool other_minus = holds(field.text, minus[0]);
  const bool comma = holds(field.text, ',');
  const bool point = holds(field.text, '.');
  if (!other_minus && (decimal_mark_ == '.' || (!comma && !point))) return false;
  if (separator_ == '\t' && decimal_mark_ == '\0' && may_be_thousands(field.text, ',')) {
    if (field.wanted)
      fail(
          "field {}: '{}' can be read in two ways: if its comma is a decimal one, replace it by a "
          "point, else remove it",
          count_, shown(field.text));
    passed_thousands_ = true;
    return false;
  }
  const bool is_plain = !other_minus && !comma;
  const std::string_view text = is_plain ? field.text : append_plain(made_, field.text);
  double number;
  if (!parse_number(text, number)) return false;
  if (comma || point) {
    const char mark = comma ? ',' : '.';
    if (comma && passed_thousands_)
      fail(
          "field {}: '{}' has a decimal comma, and the mark of a number before it could be read in "
          "two ways: replace each decimal comma by a point, and remove each other mark",
          count_, shown(field.text));
    if (decimal_mark_ == '\0') decimal_mark_ = mark;
    if (decimal_mark_ != mark)
      fail("field {}: the decimal mark of '{}' is not that of the numbers before it", count_,
           shown(field.text));
  }
  if (field.wanted) field.number = number;
  field.text = text;
  return true;
}

}  // namespace rolling
