#include "text/number.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/double_double.h"

namespace rolling {

namespace {

template <typename T, std::size_t count>
constexpr std::array<T, count> powers_of_ten() {
  std::array<T, count> powers{1};
  for (std::size_t i = 1; i < count; ++i) powers[i] = 10 * powers[i - 1];
  return powers;
}
constexpr auto power_of_ten = powers_of_ten<double, 23>();  // all that are exact
constexpr auto whole_power_of_ten = powers_of_ten<std::uint64_t, 18>();

/// Writes the eight digits of a number below 10^8, each in a byte of one word.
void write_eight_digits(char* to, std::uint64_t number) {
  std::uint64_t word = number / 10000 | number % 10000 << 32;
  std::uint64_t tens = word * 5243 >> 19 & 0x0000007f0000007f;  // / 100
  word = tens | (word - 100 * tens) << 16;
  tens = word * 103 >> 10 & 0x000f000f000f000f;  // / 10
  word = (tens | (word - 10 * tens) << 8) + 0x3030303030303030;
  if constexpr (std::endian::native == std::endian::big)
    word = __builtin_bswap64(word);  // the first one stands lowest
  std::memcpy(to, &word, sizeof word);
}

/// The shortest text that reads back to the same double: fmt's digits (Dragonbox), in the form that
/// fmt gives them.
char* write_shortest(char* to, double value) {
  *to = '-';
  to += std::signbit(value);
  if (value == 0) return *to = '0', to + 1;
  const auto decimal = fmt::detail::dragonbox::to_decimal(std::abs(value));
  int count = static_cast<int>(std::bit_width(decimal.significand)) * 1233 >>
              12;  // of its digits: log10(2) = 0.30103
  count += decimal.significand >= whole_power_of_ten[static_cast<std::size_t>(count)];
  const int point = count + decimal.exponent;  // stands behind so many digits
  const bool scientific = point < -3 || point > 16;
  const int whole = scientific ? 1 : point;

  std::string_view("0.000").copy(to, 5);
  char* const digits = whole > 0 ? to + 1 : to + 2 - whole;
  const std::uint64_t seventeen = decimal.significand *
                                  whole_power_of_ten[static_cast<std::size_t>(17 - count)],
                      nine = seventeen / 100000000;
  digits[0] = static_cast<char>('0' + nine / 100000000);
  write_eight_digits(digits + 1, nine % 100000000);
  if (count > 9 || whole > 9) write_eight_digits(digits + 9, seventeen % 100000000);
  if (whole <= 0) return digits + count;
  std::memmove(to, digits, static_cast<std::size_t>(whole));
  to[whole] = '.';
  to += count > whole ? count + 1 : whole;
  return scientific ? fmt::format_to(to, FMT_COMPILE("e{:+03}"), point - 1) : to;
}

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

/// For the numbers that the two exact methods below cannot read: with an exponent, with more than
/// 19 digits, or close to the middle of two doubles.
[[gnu::noinline]] const char* read_any_number(const char* const begin, const char* const end,
                                              double& value) {
  const auto [behind, status] =
      std::from_chars(*begin == '+' ? begin + 1 : begin, end, value);  // it does not accept a plus
  return status == std::errc() ? behind : begin;
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
    ++at;
    count += decimals = take_digits();
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
  return digits > 0 ? fmt::format_to(to, FMT_COMPILE("{:.{}g}"), value, digits)
                    : write_shortest(to, value);
}

std::string shown(std::string_view text) {
  std::string out(text.substr(0, 40));
  for (char& c : out)
    if (c < ' ' || c > '~') c = '?';
  if (text.size() > 40) out += "...";
  return out;
}

}  // namespace rolling
