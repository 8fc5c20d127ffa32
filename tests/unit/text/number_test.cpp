// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "unit/catch.h"

using namespace rolling;

namespace {

std::string written(double value, int digits = 0) {
  Bytes text;
  append_number(text, value, digits);
  return fmt::to_string(text);
}

bool same_bits(double x, double y) {
  return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
}

std::size_t significant_digits(std::string_view text) {
  std::string digits;
  for (const char c : text.substr(0, text.find_first_of("eE")))
    if (c >= '0' && c <= '9' && (c != '0' || !digits.empty())) digits += c;
  while (!digits.empty() && digits.back() == '0') digits.pop_back();
  return digits.size();
}

}  // namespace

TEST_CASE("number: every form of the grammar is read", "[text]") {
  const std::pair<const char*, double> forms[] = {
      {"0", 0},
      {"7", 7},
      {"007", 7},
      {"+7", 7},
      {"-7", -7},
      {"7.", 7},
      {"+7.", 7},
      {".5", .5},
      {"+.5", .5},
      {"-.5", -.5},
      {"0.5", .5},
      {"1e3", 1000},
      {"1E3", 1000},
      {"1e+3", 1000},
      {"1e-3", 1e-3},
      {"1.e3", 1000},
      {".5e1", 5},
      {"+1.25E-2", 0.0125},
      {"1e03", 1000},
      {"0e999", 0},
      {"123456789012345678901234567890", 123456789012345678901234567890.},
      {"0.1", 0.1},
      {"1.7976931348623157e308", std::numeric_limits<double>::max()},
      {"2.2250738585072014e-308", std::numeric_limits<double>::min()},
      {"4.9e-324", std::numeric_limits<double>::denorm_min()}};
  for (const auto& [text, expected] : forms) {
    double value = -99;
    INFO(text);
    CHECK(parse_number(text, value));
    CHECK(same_bits(value, expected));
  }
}

TEST_CASE("number: whatever is not wholly a number is refused", "[text]") {
  for (const char* text : {"",
                           " ",
                           "+",
                           "-",
                           ".",
                           "+.",
                           "-.",
                           "e5",
                           ".e5",
                           "1e",
                           "1e+",
                           "1e-",
                           "1e5.",
                           "1e5e5",
                           "--1",
                           "++1",
                           "+-1",
                           "-+1",
                           "1,5",
                           "1 5",
                           " 1",
                           "1 ",
                           "1\t",
                           "0x10",
                           "0x1p3",
                           "1p3",
                           "0.5abc",
                           "1.2.3",
                           "1..2",
                           "inf",
                           "-inf",
                           "+inf",
                           "INF",
                           "Infinity",
                           "nan",
                           "NaN",
                           "-nan",
                           "1_000",
                           "1'000",
                           "1d5",
                           "1f",
                           "0b1",
                           "\xC2\xB2",
                           "1\xE2\x88\x92",
                           "\xE2\x88\x92"
                           "1",
                           "1e400",
                           "-1e400",
                           "1e-400",
                           "1.8e308",
                           "one"}) {
    double value;
    INFO(text);
    CHECK_FALSE(parse_number(text, value));
  }
  double value;
  CHECK_FALSE(parse_number(std::string_view("1\0", 2), value));
  CHECK_FALSE(parse_number(std::string_view("\0", 1), value));
}

TEST_CASE("number: only the field is read, not what stands behind it", "[text]") {
  double value;
  CHECK(parse_number(std::string_view("1.55", 3), value));
  CHECK(value == 1.5);
  CHECK(parse_number(std::string_view("1e5", 1), value));
  CHECK(value == 1);
}

TEST_CASE("number: a field of 100000 digits is rounded right", "[text]") {
  double value;
  CHECK(parse_number("1." + std::string(100000, '0') + "1", value));
  CHECK(value == 1);
  CHECK(parse_number("0." + std::string(99999, '0') + "1e100000", value));
  CHECK(value == 1);
  // Half an ulp above 1, and a bit more: up, not to even.
  CHECK(parse_number("1.00000000000000011102230246251565404236316680908203125", value));
  CHECK(value == 1);
  CHECK(parse_number(
      "1.00000000000000011102230246251565404236316680908203125" + std::string(1000, '0') + "1",
      value));
  CHECK(value == 1 + std::numeric_limits<double>::epsilon());
}

TEST_CASE(
    "number: 100000 random doubles are written in the fewest digits and read back to the same bits",
    "[text]") {
  std::mt19937_64 random(20240229);
  int failures = 0, longer = 0, denormals = 0;
  for (int i = 0; i < 100000; ++i) {
    std::uint64_t bits = random();
    if (i % 10 == 0)
      bits &=
          0x800fffffffffffffULL >> (random() % 52) | 0x8000000000000000ULL;  // denormals, and -0
    const double value = i % 3 == 0 ? std::ldexp(std::floor(std::ldexp(1, 40) * std::sin(i)), -30)
                                    : std::bit_cast<double>(bits);
    if (!std::isfinite(value)) continue;
    denormals += value != 0 && std::abs(value) < std::numeric_limits<double>::min();
    const std::string text = written(value);
    double again;
    if (!parse_number(text, again) || !same_bits(value, again)) ++failures;
    char shortest[64];
    const auto end =
        std::to_chars(shortest, shortest + sizeof shortest, value, std::chars_format::scientific)
            .ptr;
    if (significant_digits(text) >
        significant_digits({shortest, static_cast<std::size_t>(end - shortest)}))
      ++longer;
  }
  CHECK(failures == 0);
  CHECK(longer == 0);
  CHECK(denormals > 1000);
}

TEST_CASE("number: the text of a double, by hand", "[text]") {
  CHECK(written(0.1) == "0.1");
  CHECK(written(-0.0) == "-0");
  CHECK(written(0) == "0");
  CHECK(written(100) == "100");
  CHECK(written(1. / 3) == "0.3333333333333333");
  CHECK(written(5e-324) == "5e-324");
  CHECK(written(-1.7976931348623157e308) == "-1.7976931348623157e+308");
}

TEST_CASE("number: a double has the text that fmt gives it, for 300000 of all sizes and lengths",
          "[text]") {
  std::mt19937_64 random(20250406);
  std::vector<double> values = {0,
                                -0.0,
                                std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::min(),
                                std::numeric_limits<double>::denorm_min(),
                                0x1p53,
                                0x1p53 + 2};
  for (int e = -330; e <= 308; ++e) {  // every power of ten, and its neighbours
    const double power = std::strtod(("1e" + std::to_string(e)).c_str(), nullptr);
    for (const double value : {power, std::nextafter(power, 1),
                               std::nextafter(power, std::numeric_limits<double>::infinity())})
      values.push_back(value);
  }
  for (int i = 0; i < 100000; ++i) {
    const double any = std::bit_cast<double>(random()),
                 whole = static_cast<double>(random() % 1'000'000'000'000'000'000 >> random() % 60);
    for (const double value : {any, whole * std::pow(10, -static_cast<int>(random() % 25)), whole})
      values.push_back(random() % 2 ? value : -value);
  }
  int compared = 0, other = 0;
  for (const double value : values)
    if (std::isfinite(value)) ++compared, other += written(value) != fmt::format("{}", value);
  CHECK(compared > 299000);
  CHECK(other == 0);
}

TEST_CASE("number: digits are read wherever they end, in fields of every length", "[text]") {
  std::mt19937_64 random(20250407);
  int other = 0;
  for (int i = 0; i < 200000; ++i) {
    std::string text(random() % 2, '-');
    for (auto n = random() % 20; n-- > 0;) text += static_cast<char>('0' + random() % 10);
    if (random() % 4) text += '.';
    for (auto n = random() % 20; n-- > 0;) text += static_cast<char>('0' + random() % 10);
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    if (std::none_of(text.begin(), text.end(), digit)) continue;
    const std::string behind = std::string(1, "\t;, x-/:"[random() % 8]) + std::to_string(random());
    const std::string line = text + behind.substr(0, random() % 10);
    double value = 0;
    const char* const end = read_number(line.data(), line.data() + line.size(), value);
    other +=
        end != line.data() + text.size() || !same_bits(value, std::strtod(text.c_str(), nullptr));
  }
  CHECK(other == 0);
}

TEST_CASE("number: digits round to as many significant ones", "[text]") {
  CHECK(written(2. / 3, 3) == "0.667");
  CHECK(written(1234.5678, 6) == "1234.57");
  CHECK(written(-2. / 3, 1) == "-0.7");
  CHECK(written(0.5, 17) == "0.5");
  CHECK(written(0.1, 17) == "0.10000000000000001");
  CHECK(written(-1.2345678901234567e-308, 17).size() < 32);
}

TEST_CASE("number: a number that is rounded is a number again, up to the largest", "[text]") {
  CHECK(written(1.44e308, 1) == "1e+308");
  CHECK(written(1.79e308, 1) == "1.79e+308");  // 2e308 is beyond a double
  CHECK(written(-1.79e308, 2) == "-1.79e+308");
  CHECK(written(1.79e308, 3) == "1.79e+308");
  using limits = std::numeric_limits<double>;
  for (const double value : {limits::max(), limits::lowest(), limits::min(), limits::denorm_min()})
    for (int digits = 1; digits <= 17; ++digits) {
      INFO(written(value, digits));
      CHECK(std::isfinite(std::strtod(written(value, digits).c_str(), nullptr)));
      CHECK(std::strtod(written(value, digits).c_str(), nullptr) != 0);
    }
}

TEST_CASE("number: the locale has no say", "[text]") {
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "nl_NL.UTF-8"})
    if (std::setlocale(LC_ALL, name)) break;  // one with a decimal comma, if the system has any
  double value;
  CHECK(parse_number("1.5", value));
  CHECK_FALSE(parse_number("1,5", value));
  CHECK(written(1.5) == "1.5");
  CHECK(written(1234567.5, 9) == "1234567.5");
  std::setlocale(LC_ALL, "C");
}

TEST_CASE("number: a missing reading is nothing, or NaN in any case", "[text]") {
  for (const char* text : {"", "nan", "NaN", "NAN", "nAn"}) CHECK(is_missing(text));
  for (const char* text : {" ", "-", "na", "NA", "nann", "-nan", "+nan", "nan(1)", "n", "0", "null",
                           "\x0e\x01n", "NaN "}) {
    INFO(text);
    CHECK_FALSE(is_missing(text));
  }
}

TEST_CASE("number: a message shows printable ASCII, cut at 40 characters", "[text]") {
  CHECK(shown("abc") == "abc");
  CHECK(shown("a\tb\x7f\xC2\xB2\n") == "a?b????");
  CHECK(shown(std::string(40, 'x')) == std::string(40, 'x'));
  CHECK(shown(std::string(41, 'x')) == std::string(40, 'x') + "...");
  CHECK(shown("1\xE2\x80\xAF"
              "000\xC2\xA0m") == "1 000 m");
}

TEST_CASE("number: blanks and tabs are trimmed, nothing else", "[text]") {
  CHECK(trim(" \t a b\t ") == "a b");
  CHECK(trim(" \t ").empty());
  CHECK(trim("\xA0"
             "1") ==
        "\xA0"
        "1");
}

TEST_CASE(
    "number: short decimals are rounded as strtod rounds them, on both sides of what is exact",
    "[text]") {
  std::mt19937_64 random(7);
  int wrong = 0;
  for (int i = 0; i < 200000; ++i) {
    std::string text =
        std::to_string(i % 3 == 0 ? (1ULL << 53) - 5 + random() % 10 : random() >> random() % 64);
    const auto point = random() % (text.size() + 3);
    text = point < text.size() ? text.substr(0, point) + '.' + text.substr(point)
                               : "0." + std::string(point - text.size(), '0') + text;
    if (random() % 2) text = '-' + text;
    double value = 0;
    wrong += !parse_number(text, value) || !same_bits(value, std::strtod(text.c_str(), nullptr));
  }
  CHECK(wrong == 0);
}

TEST_CASE(
    "number: decimals in the middle between two doubles, and next to it, are rounded as strtod "
    "rounds them",
    "[text]") {
  std::mt19937_64 random(8);
  int wrong = 0;
  for (int i = 0; i < 200000; ++i) {
    const int power =
        static_cast<int>(random() % 10);  // of the last bit of a double; the middle is half of it
    const std::uint64_t middle = ((1ULL << 52 | random() >> 12) << 1 | 1) << power >> 1;
    std::string text = std::to_string(power == 0 ? middle : middle + random() % 3 - 1);
    if (power == 0) text += ".5" + std::string(random() % 2, "01"[random() % 2]);
    if (random() % 2) text = std::string(random() % 8, '0') + text;
    double value = 0;
    wrong += !parse_number(text, value) || !same_bits(value, std::strtod(text.c_str(), nullptr));
  }
  CHECK(wrong == 0);
}

TEST_CASE("number: read_number ends where the number does", "[text]") {
  const auto rest = [](std::string_view text) {
    double value = -99;
    const char* const end = read_number(text.data(), text.data() + text.size(), value);
    CHECK((end == text.data()) == (value == -99));
    return std::string(end, text.data() + text.size());
  };
  CHECK(rest("1.5\t2") == "\t2");
  CHECK(rest("+1.5e3,") == ",");
  CHECK(rest("-.5abc") == "abc");
  CHECK(rest("12345678901234567890.5 x") == " x");
  for (const char* none : {"", "x", "-", "+-1", ".e5", "1e400 ", "inf"}) CHECK(rest(none) == none);
}

// Digits behind the point are read eight at a time where there are so many.
TEST_CASE("number: any count of digits before and behind the point, and what stands behind it",
          "[text]") {
  for (const std::string behind : {"", "\t1", "/:", "e2", "x", "12345\n"})
    for (std::size_t whole = 0; whole < 12; ++whole)
      for (std::size_t decimals = 1; decimals < 26; ++decimals) {
        const std::string digits = "90817263540918273645",
                          text = digits.substr(0, whole) + "." +
                                 (digits + "67890").substr(25 - decimals) + behind;
        double value = -1;
        char* by_library = nullptr;
        const double expected = std::strtod(text.c_str(), &by_library);
        CAPTURE(text);
        CHECK(read_number(text.data(), text.data() + text.size(), value) == by_library);
        CHECK(value == expected);
      }
}
