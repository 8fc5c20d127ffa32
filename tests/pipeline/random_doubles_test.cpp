// SPDX-License-Identifier: GPL-3.0-or-later
// Every double passes every filter unchanged, to the bit. Needs the tools on PATH.
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "unit/catch.h"
#include "unit/text/files.h"

using namespace rolling;

namespace {

/// Doubles of any bits, every tenth a denormal, every hundredth -0.
std::vector<double> any_doubles(std::size_t n) {
  std::mt19937_64 random(13);
  std::vector<double> values;
  while (values.size() < n) {
    std::uint64_t bits = random();
    if (values.size() % 10 == 0) bits &= 0x800fffffffffffffULL;
    if (values.size() % 100 == 0) bits = 1ULL << 63;
    if (const auto value = std::bit_cast<double>(bits); std::isfinite(value))
      values.push_back(value);
  }
  return values;
}

/// How many of `n` such numbers come out of every filter in the third column, r, with the bits that
/// they had.
void check_filters(std::size_t n) {
  const std::vector<double> values = any_doubles(n);
  std::string text = "# t[s]\tv[m/s]\tr\ta\tD\n";
  for (std::size_t i = 0; i < n; ++i) {
    char number[32];
    const auto end = std::to_chars(number, number + sizeof number, values[i]).ptr;
    text += std::to_string(i) + "\t0.5\t" + std::string(number, end) + "\t-0.1\t1e-3\n";
  }
  const TemporaryFile file(text);
  for (const char* filter :
       {"smooth -w 1 -c r", "smooth -w 1 -c r -M median", "smooth -c v", "differentiate -c v",
        "shift-from-accel -K 0.5 -R 0.04", "energy-ledger -m 1 -K 0.5 -R 0.04"}) {
    const std::string command = std::string(filter) + " " + file.name();
    std::FILE* pipe = ::popen(command.c_str(), "r");
    REQUIRE(pipe);
    std::size_t rows = 0, equal = 0;
    for (char line[1000]; std::fgets(line, sizeof line, pipe);) {
      if (line[0] == '#') continue;
      const std::string_view row(line);
      const auto from = row.find('\t', row.find('\t') + 1) + 1;
      const double value = std::strtod(line + from, nullptr);
      equal += rows < n &&
               std::bit_cast<std::uint64_t>(value) == std::bit_cast<std::uint64_t>(values[rows]);
      ++rows;
    }
    CAPTURE(filter);
    CHECK(::pclose(pipe) == 0);
    CHECK(rows == n);
    CHECK(equal == n);
  }
}

}  // namespace

TEST_CASE("every double passes every filter bit for bit", "[pipeline]") { check_filters(50'000); }
TEST_CASE("a million doubles pass every filter bit for bit", "[.long]") {
  check_filters(1'000'000);
}
