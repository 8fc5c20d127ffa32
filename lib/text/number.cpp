#include "text/number.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <charconv>

namespace rolling {

bool parse_number(std::string_view field, double& value) {
  const char* first = field.data();
  const char* const last = first + field.size();
  if (first == last) return false;
  if (*first == '+') ++first;  // from_chars knows no plus
  const char* digit = first;
  if (digit != last && *digit == '-' && digit == field.data()) ++digit;
  if (digit == last || (*digit != '.' && (*digit < '0' || *digit > '9'))) return false;  // inf, nan, +-1
  const auto [end, status] = std::from_chars(first, last, value);
  return status == std::errc() && end == last;
}

bool is_missing(std::string_view field) {
  return field.empty() || (field.size() == 3 && (field[0] | 32) == 'n' && (field[1] | 32) == 'a' && (field[2] | 32) == 'n');
}

void append_number(std::string& to, double value, int digits) {
  char text[32];
  const char* const end = digits > 0 ? fmt::format_to(text, FMT_COMPILE("{:.{}g}"), value, digits)
                               : fmt::format_to(text, FMT_COMPILE("{}"), value);
  to.append(text, static_cast<std::size_t>(end - text));
}

std::string shown(std::string_view text) {
  std::string out(text.substr(0, 40));
  for (char& c : out)
    if (c < ' ' || c > '~') c = '?';
  if (text.size() > 40) out += "...";
  return out;
}

std::string_view trim(std::string_view field) {
  while (!field.empty() && (field.front() == ' ' || field.front() == '\t')) field.remove_prefix(1);
  while (!field.empty() && (field.back() == ' ' || field.back() == '\t')) field.remove_suffix(1);
  return field;
}

}  // namespace rolling
