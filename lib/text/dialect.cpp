#include "text/dialect.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "text/number.h"

namespace rolling {
namespace {

constexpr std::size_t npos = std::string_view::npos;
constexpr std::string_view minus = "\xE2\x88\x92";  // U+2212

/// `1,5` as `1.5`, U+2212 as `-`; empty if there is nothing to rewrite or no number comes of it.
std::string rewritten(std::string_view field) {
  std::string text(field);
  for (auto at = text.find(minus); at != npos; at = text.find(minus)) {
    text[at] = '-';
    text.erase(at + 1, minus.size() - 1);
  }
  if (const auto at = text.find(','); at != npos && text.find('.') == npos) text[at] = '.';
  return text != field && is_number(text) ? text : std::string();
}

}  // namespace

bool Dialect::choose(std::string_view line) {
  bool tab = false, semicolon = false, comma = false, quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    tab |= c == '\t';
    semicolon |= c == ';';
    comma |= c == ',';
  }
  separator_ = tab ? '\t' : semicolon ? ';' : comma ? ',' : '\0';
  foreign_numbers_ = tab || semicolon;
  decimal_mark_ = '\0';
  split(line);
  if (tab && std::any_of(fields_.begin(), fields_.end(), [](auto f) { return f.find(' ') != npos; })) {
    separator_ = '\0';  // a line of numbers in which tabs and blanks both separate is one of blanks
    split(line);
    if (!std::all_of(fields_.begin(), fields_.end(), is_number)) separator_ = '\t', split(line);
  }
  // A quoted decimal comma among commas makes a record too, which is then refused with the way out.
  return std::any_of(fields_.begin(), fields_.end(), [](auto f) { return is_number(f) || !rewritten(f).empty(); });
}

std::vector<std::string_view>& Dialect::split(std::string_view line) {
  fields_.clear();
  changed_ = false;
  if (separator_ == '\0') {
    split_blanks(line);
  } else if (line.find('"') != npos) {
    split_quoted(line);
  } else {
    for (std::size_t at = 0;;) {
      const auto end = std::min(line.find(separator_, at), line.size());
      fields_.push_back(trim(line.substr(at, end - at)));
      if (end == line.size()) break;
      at = end + 1;
    }
  }
  if (foreign_numbers_ && (decimal_mark_ != '.' || line.find(minus[0]) != npos)) rewrite_numbers();
  return fields_;
}

void Dialect::split_blanks(std::string_view line) {
  const char* at = line.data();
  const char* const end = at + line.size();
  for (;;) {
    while (at != end && (*at == ' ' || *at == '\t')) ++at;
    if (at == end) return;
    const char* const first = at;
    while (at != end && *at != ' ' && *at != '\t') ++at;
    fields_.emplace_back(first, static_cast<std::size_t>(at - first));
  }
}

void Dialect::split_quoted(std::string_view line) {
  changed_ = true;
  unquoted_.clear();
  std::string field;
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      if (quoted && i + 1 < line.size() && line[i + 1] == '"') field += line[++i];
      else quoted = !quoted;
    } else if (line[i] == separator_ && !quoted) {
      unquoted_.push_back(std::exchange(field, {}));
    } else {
      field += line[i];
    }
  }
  unquoted_.push_back(std::move(field));
  for (const std::string& text : unquoted_) fields_.push_back(trim(text));
}

void Dialect::rewrite_numbers() {
  rewritten_.clear();
  rewritten_.reserve(fields_.size());
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    std::string_view& field = fields_[i];
    const bool comma = field.find(',') != npos, point = field.find('.') != npos;
    std::string text = rewritten(field);
    if (text.empty() && !is_number(field)) continue;
    if (decimal_mark_ == '\0' && (comma || point)) decimal_mark_ = comma ? ',' : '.';
    if ((comma || point) && decimal_mark_ != (comma ? ',' : '.'))
      fail("field {}: '{}' has another decimal mark than the numbers before it", i + 1, shown(field));
    changed_ |= !text.empty();
    if (!text.empty()) field = rewritten_.emplace_back(std::move(text));
  }
}

}  // namespace rolling
