// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/number.h"

#include <fmt/compile.h>
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "text/from_chars.h"

namespace rolling {

const char* read_number(const char* const begin, const char* const end, double& value) {
  // from_chars accepts no plus, but it does inf and nan.
  const char* const digits = begin + (begin != end && (*begin == '+' || *begin == '-'));
  if (digits == end || !((*digits >= '0' && *digits <= '9') || *digits == '.')) return begin;
  double read;
  const auto [behind, status] = from_chars(*begin == '+' ? digits : begin, end, read);
  if (status != std::errc() || !std::isfinite(read)) return begin;
#ifndef __cpp_lib_to_chars  // fast_float has no error for what is too small
  const std::string_view text(begin, behind);
  if (read == 0 && text.find_first_of("123456789") < text.find_first_of("eE")) return begin;
#endif
  value = read;
  return behind;
}

bool parse_number(std::string_view field, double& value) {
  const char* const end = field.data() + field.size();
  return !field.empty() && read_number(field.data(), end, value) == end;
}

bool is_missing(std::string_view field) {
  return field.empty() || (field.size() == 3 && lower(field) == "nan");
}

void append_number(Bytes& to, double value, int digits) {
  if (digits > 0) {
    const std::string rounded = fmt::format("{:.{}g}", value, digits);
    if (std::abs(value) < 1e308 || is_number(rounded)) return to.append(rounded);
  }
  fmt::format_to(fmt::appender(to), FMT_COMPILE("{}"), value);
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::string replace_all(
    std::string_view text,
    std::initializer_list<std::pair<std::string_view, std::string_view>> pairs) {
  std::string out;
  while (!text.empty()) {
    const auto found = std::find_if(pairs.begin(), pairs.end(),
                                    [&](const auto& pair) { return text.starts_with(pair.first); });
    const auto& [from, to] =
        found == pairs.end() ? std::pair(text.substr(0, 1), text.substr(0, 1)) : *found;
    out += to;
    text.remove_prefix(from.size());
  }
  return out;
}

std::string with_plain_blanks(std::string_view text) {
  return replace_all(text, {{"\xC2\xA0", " "}, {"\xE2\x80\x89", " "}, {"\xE2\x80\xAF", " "}});
}

std::string shown(std::string_view text) {
  std::string out = with_plain_blanks(text);
  if (out.size() > 40) out.replace(40, std::string::npos, "...");
  for (char& c : out)
    if (c < ' ' || c > '~') c = '?';
  return out;
}

bool parse_estimate(std::string_view as_typed, Estimate& estimate) {
  const std::string text =
      replace_all(as_typed, {{"\xC2\xB1", "+-"}, {"\xB1", "+-"}, {"+/-", "+-"}});
  const auto sign = std::min(text.find("+-"), text.size());
  const std::string sigma = sign < text.size() ? text.substr(sign + 2) : "0";
  Estimate read;
  // Blanks are allowed around +-, but not around the whole.
  if (trim(text) != text || !parse_number(trim(text.substr(0, sign)), read.value) ||
      !parse_number(trim(sigma), read.sigma) || std::signbit(read.sigma))
    return false;
  estimate = read;
  return true;
}

std::string to_text(const Estimate& estimate) {
  return estimate.sigma > 0 ? fmt::format("{}+-{}", estimate.value, estimate.sigma)
                            : fmt::format("{}", estimate.value);
}

}  // namespace rolling
