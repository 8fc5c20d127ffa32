// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/number.h"

#include <fmt/compile.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#ifndef __cpp_lib_to_chars
#include <stdlib.h>

#include <cerrno>
#if defined(__APPLE__) || defined(__FreeBSD__)
#include <xlocale.h>
#else
#include <locale.h>
#endif
#endif

#include "base/double_double.h"

namespace rolling {
namespace {

constexpr auto power_of_ten = [] {
  std::array<double, 23> powers{};  // all that are exact
  double power = 1;
  for (double& entry : powers) entry = power, power *= 10;
  return powers;
}();

/// digits / 10^decimals, correctly rounded; false if this method cannot decide the rounding. The
/// remainder of the quotient is exact, so the sum of both has an error of 2^-52 of its last bit:
/// only a value that is so close to the middle of two doubles is undecided.
bool divide(std::uint64_t digits, std::size_t decimals, double& value) {
  const double power = power_of_ten[decimals], most = static_cast<double>(digits),
               quotient = most / power;
  const DoubleDouble product = two_product(quotient, power);
  const auto lost =
      static_cast<double>(static_cast<std::int64_t>(digits - static_cast<std::uint64_t>(most)));
  const double rest = (((most - product.hi) - product.lo) + lost) / power;
  value = quotient + rest * (1 + 0x1p-40);
  return value == quotient + rest * (1 - 0x1p-40);
}

// Reads eight digits at a time (Lemire 2021, Software: Practice and Experience 51, 1700): digit by
// digit, each step would wait for the one before. The first digit is the lowest byte.
std::uint64_t load_eight(const char* from) {
  std::uint64_t bytes;
  std::memcpy(&bytes, from, sizeof bytes);
  if constexpr (std::endian::native == std::endian::big) bytes = __builtin_bswap64(bytes);
  return bytes;
}
bool is_digits(std::uint64_t eight) {
  constexpr std::uint64_t high = 0xF0F0F0F0F0F0F0F0, zeros = 0x3030303030303030;
  return ((eight & high) == zeros) && (((eight + 0x0606060606060606) & high) == zeros);
}
/// Combines digits to pairs, then pairs to fours, then fours to eight.
std::uint64_t number_of(std::uint64_t eight) {
  eight = (eight & 0x0F0F0F0F0F0F0F0F) * (10 * 256 + 1) >> 8;
  eight = (eight & 0x00FF00FF00FF00FF) * (100 * 65536 + 1) >> 16;
  return (eight & 0x0000FFFF0000FFFF) * (10000 * (1ULL << 32) + 1) >> 32;
}

/// For the numbers that the two exact methods below cannot read: with an exponent, with more than
/// 19 digits, or close to the middle of two doubles.
[[gnu::noinline]] const char* read_any_number(const char* const begin, const char* const end,
                                              double& value) {
#ifdef __cpp_lib_to_chars
  // from_chars does not accept a plus in front.
  const auto [behind, status] = std::from_chars(begin + (*begin == '+'), end, value);
  return status == std::errc() ? behind : begin;
#else
  // libc++ has from_chars of integers alone up to its version 19. strtod rounds correctly in
  // glibc, macOS and FreeBSD. It reads more than from_chars does, as hexadecimal digits, but
  // nothing more that is written with these characters alone.
  static const locale_t plain = ::newlocale(LC_ALL_MASK, "C", nullptr);
  const std::string_view rest(begin, end);
  const std::string text(rest.substr(0, rest.find_first_not_of("+-.0123456789eE")));
  char* behind = nullptr;
  errno = 0;
  const double read = ::strtod_l(text.c_str(), &behind, plain);
  const bool too_large = errno == ERANGE && (read > 1 || read < -1),
             too_small = read == 0 && text.find_first_of("123456789") < text.find_first_of("eE");
  if (too_large || too_small) return begin;
  value = read;
  return begin + (behind - text.c_str());
#endif
}

}  // namespace

const char* read_number(const char* const begin, const char* const end, double& value) {
  const char* at = begin;
  const bool negative = at != end && *at == '-', sign = negative || (at != end && *at == '+');
  at += sign;
  std::uint64_t digits = 0;
  const auto take_digits = [&] {
    const char* const from = at;
    for (unsigned digit; at != end && (digit = static_cast<unsigned>(*at) - '0') <= 9; ++at)
      digits = 10 * digits + digit;
    return static_cast<std::size_t>(at - from);
  };
  std::size_t count = take_digits(), decimals = 0;
  if (at != end && *at == '.') {
    const char* const point = at++;
    for (std::uint64_t eight; end - at >= 8 && is_digits(eight = load_eight(at)); at += 8)
      digits = 100'000'000 * digits + number_of(eight);
    take_digits();
    count += decimals = static_cast<std::size_t>(at - point - 1);
  }
  if (count == 0) return begin;  // inf, nan and +-1 too
  if (at != end && (*at | 32) == 'e') return read_any_number(begin, end, value);
  if (count > 19)  // `digits` holds 19 digits at least; leading zeros do not count
    for (const char* zero = begin + sign; zero != at && (*zero == '0' || *zero == '.'); ++zero)
      count -= *zero == '0';
  if (count > 19 || decimals >= power_of_ten.size()) return read_any_number(begin, end, value);
  double size;
  if (digits <= 1ULL << 53)
    size = static_cast<double>(static_cast<std::int64_t>(digits)) /
           power_of_ten[decimals];  // of exact numbers: rounds once
  else if (!divide(digits, decimals, size)) return read_any_number(begin, end, value);
  value = negative ? -size : size;
  return at;
}

bool parse_number(std::string_view field, double& value) {
  const char* const end = field.data() + field.size();
  return !field.empty() && read_number(field.data(), end, value) == end;
}

bool is_missing(std::string_view field) {
  return field.empty() || (field.size() == 3 && (field[0] | 32) == 'n' && (field[1] | 32) == 'a' &&
                           (field[2] | 32) == 'n');
}

char* write_number(char* to, double value, int digits) {
  if (digits > 0) {
    char* const end =
        std::to_chars(to, to + longest_number, value, std::chars_format::general, digits).ptr;
    if (std::abs(value) < 1e308 || is_number({to, end})) return end;
  }
  return write_shortest(to, value);
}

char* write_shortest(char* to, double value) {
  return fmt::format_to(to, FMT_COMPILE("{}"), value);
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

bool parse_estimate(std::string_view text, Estimate& estimate) {
  const auto sign = std::min(text.find("+-"), text.size());
  const std::string_view sigma = sign < text.size() ? text.substr(sign + 2) : "0";
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
