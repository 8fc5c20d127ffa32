#include "text/dialect.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "text/number.h"

namespace rolling {
namespace {

constexpr std::size_t npos = std::string_view::npos;
constexpr std::string_view minus = "\xE2\x88\x92";  // U+2212

/// Where a number may be of another form.
struct Marks {
  std::size_t first_minus, comma, point;
};
Marks marks_in(std::string_view field) {
  return {field.find(minus[0]), field.find(','), field.find('.')};
}

/// Appends `1,5` as `1.5`, U+2212 as `-`; returns what it has appended.
std::string_view append_plain(std::string& to, std::string_view field, Marks marks) {
  const auto from = to.size();
  to += field;
  if (marks.comma != npos && marks.point == npos) to[from + marks.comma] = '.';
  if (marks.first_minus != npos)
    for (auto at = to.find(minus, from); at != npos; at = to.find(minus, at))
      to.erase(at + 1, minus.size() - 1)[at] = '-';
  return std::string_view(to).substr(from);
}

constexpr auto plain = [] {
  std::array<bool, 256> is{};
  for (std::size_t c = '-'; c <= 'z'; ++c) is[c] = c != ';';
  return is;
}();

/// Up to the first character that may separate fields, quote one, or stand in a number of another
/// form.
const char* skip_plain(const char* at, const char* end) {
  while (at != end && plain[static_cast<unsigned char>(*at)]) ++at;
  return at;
}

/// Reads a number, if it is wanted, or passes over plain text; returns its end.
const char* read_plain(const char* at, const char* end, Field& field) {
  return field.wanted ? read_number(at, end, field.number) : skip_plain(at, end);
}

}  // namespace

bool Dialect::choose(std::string_view line) {
  bool tab = false, semicolon = false, comma = false, quoted = false, field_begins = true,
       closed = false;
  for (const char c : line) {
    if (c == '"' && (quoted || field_begins ||
                     closed)) {  // a quote behind one that seemed to close was one of two
      closed = quoted;
      quoted = !quoted;
      field_begins = false;
      continue;
    }
    closed = false;
    if (quoted) continue;
    tab |= c == '\t';
    semicolon |= c == ';';
    comma |= c == ',';
    field_begins = c == '\t' || c == ';' || c == ',' || (c == ' ' && field_begins);
  }
  separator_ = tab ? '\t' : semicolon ? ';' : comma ? ',' : '\0';
  foreign_numbers_ = tab || semicolon;
  decimal_mark_ = '\0';
  fields_.clear();
  auto fields = split(line);
  const auto numeric = [](const Field& field) { return is_number(field.text); };
  if (tab && std::any_of(fields.begin(), fields.end(),
                         [](const Field& field) { return field.text.find(' ') != npos; })) {
    separator_ = '\0';  // a line of numbers in which tabs and blanks both separate is one of blanks
    fields = split(line);
    if (!std::all_of(fields.begin(), fields.end(), numeric))
      separator_ = '\t', fields = split(line);
  }
  // A quoted decimal comma among commas makes a record too, which is then refused with the way out.
  return std::any_of(fields.begin(), fields.end(), [](const Field& field) {
    std::string text;
    return is_number(append_plain(text, field.text, marks_in(field.text)));
  });
}

void Dialect::want(std::size_t field) {
  if (fields_.size() <= field) fields_.resize(field + 1);
  fields_[field].wanted = true;
}

// A number is read, or passed over, where it stands, which shows where its field ends: no other
// search, no second pass.

std::span<const Field> Dialect::split(std::string_view line) {
  count_ = 0;
  made_.clear();
  if (made_.capacity() < 2 * line.size())
    made_.reserve(2 * line.size());  // a text without its quotes, and then in plain form
  as_it_stands_ = separator_ == '\t';
  const char *at = line.data(), *const end = at + line.size();
  if (separator_ == '\0') {
    split_blanks(at, end);
    return {fields_.data(), count_};
  }
  for (;; ++at) {
    Field& field = next_field();
    const char* const first = at;
    if (!foreign()) at = read_plain(at, end, field);
    if (at != first && (at == end || *at == separator_)) {
      field.text = {first, at};
    } else {
      at = take_text(first, end, field);
    }
    if (at == end) return {fields_.data(), count_};
  }
}

const char* Dialect::split_plain(std::string_view text, std::span<const Field>& fields) {
  if (separator_ == '\0' || foreign()) return nullptr;
  const char *at = text.data(), *const end = at + text.size();
  as_it_stands_ = separator_ == '\t';
  for (Field* field = fields_.data(); field != fields_.data() + fields_.size(); ++field, ++at) {
    const char* first = at;
    at = read_plain(at, end, *field);
    if (at == first) {  // perhaps a quoted one, which costs the others nothing
      if (at == end || *at != '"') return nullptr;
      first = ++at;
      at = read_plain(at, end, *field);
      field->text = {first, at};
      if (at == first || at == end || *at++ != '"') return nullptr;
      as_it_stands_ = false;
    } else {
      field->text = {first, at};
    }
    if (at == end) return nullptr;
    if (*at == separator_) continue;
    if (*at != '\n' && (*at != '\r' || end - at < 2 || at[1] != '\n')) return nullptr;
    fields = {fields_.data(), field + 1};
    return at;
  }
  return nullptr;
}

void Dialect::split_blanks(const char* at, const char* end) {
  for (;;) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return;
    Field& field = next_field();
    const char* const first = at;
    if (field.wanted) at = read_number(at, end, field.number);
    if (at != end && !is_blank(*at)) {
      field.number = Field().number;
      while (at != end && !is_blank(*at)) ++at;
    }
    field.text = {first, at};
  }
}

/// Takes the field that begins at `at`, whatever it holds; returns its end.
const char* Dialect::take_text(const char* at, const char* end, Field& field) {
  const char* const first = at;
  while (at != end && is_blank(*at) && *at != separator_) ++at;
  if (at != end && *at == '"') {
    field.text = trim(take_quoted(at, end));
    as_it_stands_ = false;
  } else {
    at += std::min(std::string_view(at, end).find(separator_), static_cast<std::size_t>(end - at));
    field.text = trim({first, at});
    as_it_stands_ &= field.text.size() == static_cast<std::size_t>(at - first);
  }
  if (foreign_numbers_ && rewrite(field)) return at;
  if (field.wanted && !parse_number(field.text, field.number)) field.number = Field().number;
  return at;
}

/// The field whose quote opens at `at`, which goes to its end. What stands behind the closing quote
/// belongs to it too.
std::string_view Dialect::take_quoted(const char*& at, const char* end) {
  const char *const first = ++at, *const close = std::find(first, end, '"');
  if (close != end && (close + 1 == end || close[1] == separator_)) {
    at = close + 1;
    return {first, close};
  }
  const auto from = made_.size();
  for (bool quoted = true; at != end && (quoted || *at != separator_); ++at) {
    if (*at != '"') made_ += *at;
    else if (quoted && at + 1 != end && at[1] == '"') made_ += *at++;
    else quoted = !quoted;
  }
  return std::string_view(made_).substr(from);
}

/// A number with a decimal comma or U+2212 takes its plain form, and is read; false for any other
/// text, which stays as it is.
bool Dialect::rewrite(Field& field) {
  const Marks marks = marks_in(field.text);
  const bool other_minus = marks.first_minus != npos, comma = marks.comma != npos,
             point = marks.point != npos;
  if (!other_minus && (decimal_mark_ == '.' || (!comma && !point))) return false;
  const bool is_plain = !other_minus && !comma;
  const std::string_view text = is_plain ? field.text : append_plain(made_, field.text, marks);
  double number;
  if (!parse_number(text, number)) return false;
  if (comma || point) {
    const char mark = comma ? ',' : '.';
    if (decimal_mark_ == '\0') decimal_mark_ = mark;
    if (decimal_mark_ != mark)
      fail("field {}: '{}' has another decimal mark than the numbers before it", count_,
           shown(field.text));
  }
  if (field.wanted) field.number = number;
  as_it_stands_ &= is_plain;
  field.text = text;
  return true;
}

}  // namespace rolling
