// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/number.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

#include "unit/catch.h"

namespace {

std::string written(double value) {
  rolling::Bytes text;
  rolling::append_number(text, value);
  return fmt::to_string(text);
}

/// The digits of a number without sign, point, exponent and zeros around them.
std::string digits_of(std::string text) {
  text.erase(std::min(text.find('e'), text.size()));
  text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return c == '.' || c == '-'; }),
             text.end());
  text.erase(0, text.find_first_not_of('0'));
  return text.erase(text.find_last_not_of('0') + 1);
}

/// Reads back to the same double, and has the digits of std::to_chars, another algorithm (Ryu).
bool is_shortest(double value) {
  const std::string text = written(value);
  char other[32];
  const std::string reference(
      other, std::to_chars(other, other + sizeof other, value, std::chars_format::scientific).ptr);
  char* end = nullptr;
  const double back = std::strtod(text.c_str(), &end);
  return end == text.data() + text.size() &&
         std::bit_cast<std::uint64_t>(back) == std::bit_cast<std::uint64_t>(value) &&
         digits_of(text) == digits_of(reference);
}

TEST_CASE("shortest: every exponent, at random and beside each power of two", "[text]") {
  std::mt19937_64 random(7);
  constexpr std::uint64_t mask = (std::uint64_t{1} << 52) - 1;
  std::size_t wrong = 0;
  for (std::uint64_t exponent = 0; exponent < 2047; ++exponent)
    for (std::uint64_t i = 0; i < 200; ++i) {
      const std::uint64_t fraction = i < 8 ? i : i < 16 ? ~i : random();
      wrong +=
          !is_shortest(std::bit_cast<double>(random() << 63 | exponent << 52 | (fraction & mask)));
    }
  CHECK(wrong == 0);
}

TEST_CASE("shortest: numbers of few digits, beside powers of ten, and between two decimals",
          "[text]") {
  std::size_t wrong = 0;
  for (int e = -320; e <= 305; ++e)
    for (int digits = 1; digits < 300; ++digits) {
      const std::string text = std::to_string(digits) + 'e' + std::to_string(e);
      const double value = std::strtod(text.c_str(), nullptr);
      if (value == 0) continue;
      for (const double near : {value, std::nextafter(value, 0.0), std::nextafter(value, INFINITY)})
        wrong += !is_shortest(near);
    }
  // Whole numbers beyond 2^53 lie half-way between decimals of 16 and 17 digits.
  for (std::uint64_t n = std::uint64_t{1} << 53; n < (std::uint64_t{1} << 53) + 100000; n += 2)
    for (const double scale : {1.0, 0.5, 2.0, 1024.0})
      wrong += !is_shortest(scale * static_cast<double>(n));
  CHECK(wrong == 0);
}

TEST_CASE("shortest: in the form that columns have", "[text]") {
  CHECK(written(0) == "0");
  CHECK(written(-0.0) == "-0");
  CHECK(written(0.1) == "0.1");
  CHECK(written(-1.5) == "-1.5");
  CHECK(written(123456.75) == "123456.75");
  CHECK(written(0.000123) == "0.000123");
  CHECK(written(0.0000123) == "1.23e-05");
  CHECK(written(1234567890123456) == "1234567890123456");
  CHECK(written(12345678901234568) == "1.2345678901234568e+16");
  CHECK(written(3e16) == "3e+16");
  CHECK(written(5e-324) == "5e-324");
  CHECK(written(1.7976931348623157e308) == "1.7976931348623157e+308");
  CHECK(written(9007199254740993.0 * 8) == "7.205759403792794e+16");
}

}  // namespace
