#include "text/number.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <charconv>
#include <cstdint>

namespace rolling {

namespace {

/// The powers of ten up to the last one that 19 digits can ask for; each is exact.
constexpr double power_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,
                                   1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19};

}  // namespace

const char* read_number(const char* const begin, const char* const end, double& value) {
  const char* at = begin;
  const bool negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  const char* const first = at;
  std::uint64_t digits = 0;
  const auto take_digits = [&] {
    const char* const from = at;
    for (unsigned digit; at != end && (digit = static_cast<unsigned char>(*at - '0')) <= 9; ++at) digits = 10 * digits + digit;
    return static_cast<std::size_t>(at - from);
  };
  std::size_t count = take_digits(), decimals = 0;
  if (at != end && *at == '.') {
    ++at;
    count += decimals = take_digits();
  }
  if (count == 0) return begin;  // inf, nan, +-1 as well
  if (count <= 19 && digits <= 1ULL << 53 && (at == end || (*at | 32) != 'e')) {
    // A short decimal: two exact numbers, so that one division rounds once.
    value = static_cast<double>(static_cast<std::int64_t>(digits)) / power_of_ten[decimals];
    if (negative) value = -value;
    return at;
  }
  const auto [behind, status] = std::from_chars(negative ? first - 1 : first, end, value);  // which knows no plus
  return status == std::errc() ? behind : begin;
}

bool parse_number(std::string_view field, double& value) {
  const char* const end = field.data() + field.size();
  return !field.empty() && read_number(field.data(), end, value) == end;
}

bool is_missing(std::string_view field) {
  return field.empty() || (field.size() == 3 && (field[0] | 32) == 'n' && (field[1] | 32) == 'a' && (field[2] | 32) == 'n');
}

char* write_number(char* to, double value, int digits) {
  return digits > 0 ? fmt::format_to(to, FMT_COMPILE("{:.{}g}"), value, digits) : fmt::format_to(to, FMT_COMPILE("{}"), value);
}

void append_number(std::string& to, double value, int digits) {
  char text[longest_number];
  to.append(text, write_number(text, value, digits));
}

std::string shown(std::string_view text) {
  std::string out(text.substr(0, 40));
  for (char& c : out)
    if (c < ' ' || c > '~') c = '?';
  if (text.size() > 40) out += "...";
  return out;
}

}  // namespace rolling
