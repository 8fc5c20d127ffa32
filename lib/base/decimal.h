// SPDX-License-Identifier: GPL-3.0-or-later
// A number in decimal notation, read in whatever locale the program runs.
#pragma once

#include <algorithm>
#include <cerrno>
#include <charconv>
#ifndef __cpp_lib_to_chars
#include <stdlib.h>

#include <string>
#include <string_view>
#if defined(__APPLE__) || defined(__FreeBSD__)
#include <xlocale.h>
#else
#include <locale.h>
#endif
#endif

namespace rolling {

/// Reads the double that begins at `begin`, as std::from_chars does. Returns the place behind it,
/// or `begin` if there is none or it is out of range.
inline const char* read_decimal(const char* const begin, const char* const end, double& value) {
#ifdef __cpp_lib_to_chars
  const auto [behind, status] = std::from_chars(begin, end, value);
  return status == std::errc() ? behind : begin;
#else
  // libc++ has from_chars of integers alone up to its version 19. strtod rounds correctly in
  // glibc, macOS and FreeBSD. What it reads beyond from_chars, a plus in front, blanks, hexadecimal
  // digits, has other signs.
  constexpr std::string_view signs = "+-.0123456789eE";
  static const locale_t plain = ::newlocale(LC_ALL_MASK, "C", nullptr);
  const std::string text(begin, std::find_if(begin, end, [&](char c) {
                           return signs.find(c) == std::string_view::npos;
                         }));
  if (text.starts_with('+')) return begin;
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

}  // namespace rolling
