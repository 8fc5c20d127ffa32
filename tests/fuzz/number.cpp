// SPDX-License-Identifier: GPL-3.0-or-later
// parse_number against the grammar of rolling-columns(5), written out, and strtod; append_number
// against parse_number.
#include "text/number.h"

#include <cmath>
#include <cstdint>
#include <cstring>

#include "streams.h"

namespace {

/// [+-]? (digits [. digits?] | . digits) ([eE] [+-]? digits)?
bool is_of_the_grammar(const std::string& s) {
  std::size_t i = 0;
  const auto digits = [&] {
    const std::size_t from = i;
    while (i < s.size() && s[i] >= '0' && s[i] <= '9') ++i;
    return i - from;
  };
  const auto sign = [&] { i += i < s.size() && (s[i] == '+' || s[i] == '-'); };
  sign();
  const std::size_t whole = digits();
  std::size_t fraction = 0;
  if (i < s.size() && s[i] == '.') ++i, fraction = digits();
  if (whole + fraction == 0) return false;
  if (i < s.size() && (s[i] == 'e' || s[i] == 'E')) {
    ++i;
    sign();
    if (digits() == 0) return false;
  }
  return i == s.size();
}

std::uint64_t bits(double x) {
  std::uint64_t b;
  std::memcpy(&b, &x, sizeof b);
  return b;
}

std::string written(double value, int digits) {
  rolling::Bytes text;
  rolling::append_number(text, value, digits);
  return fmt::to_string(text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  double value = 0;
  const bool read = rolling::parse_number(text, value);
  if (is_of_the_grammar(text)) {
    const double right = std::strtod(text.c_str(), nullptr);
    const bool zero = text.find_first_of("123456789") >=
                      text.find_first_of("eE");  // else it is too small for a double
    require(read == (std::isfinite(right) && (right != 0 || zero)),
            "a number is not read, or one beyond the range is", text);
    if (read) require(bits(value) == bits(right), "another number than strtod reads", text);
  } else {
    require(!read, "what is no number is read", text);
  }
  if (read) {
    const std::string again = written(value, 0);
    double same = 0;
    require(rolling::parse_number(again, same) && bits(same) == bits(value), "does not read back",
            again);
  }
  if (size == sizeof(double)) {
    std::memcpy(&value, data, size);
    if (!std::isfinite(value)) return 0;
    for (int digits = 0; digits <= 17; ++digits) {
      const std::string out = written(value, digits);
      double back = 0;
      const bool overflows = digits > 0 && digits < 17 &&
                             std::isinf(std::strtod(out.c_str(), nullptr));  // 1.6e308 in one digit
      require(overflows || rolling::parse_number(out, back) || std::abs(value) < 2.3e-308,
              "what is written is no number", out);
      if (digits == 0 || digits == 17)
        require(bits(back) == bits(value), "does not read back", out);
    }
  }
  const std::string shown = rolling::shown(text);
  require(shown.size() <= 43, "a token is not cut", shown);
  for (const char c : shown) require(c >= ' ' && c <= '~', "a token is shown raw", shown);
  return 0;
}
