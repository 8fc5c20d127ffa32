// SPDX-License-Identifier: GPL-3.0-or-later
// What the tools call of fmt, compiled here: Debian 12 has no static library of it.
#ifndef FMT_HEADER_ONLY
#define FMT_HEADER_ONLY
#endif
#include <fmt/format.h>

extern std::string (*const formatter)(fmt::string_view, fmt::format_args);
std::string (*const formatter)(fmt::string_view, fmt::format_args) = fmt::vformat;

// The shortest decimal of a double.
template char fmt::detail::decimal_point_impl<char>(fmt::detail::locale_ref);
template fmt::detail::thousands_sep_result<char> fmt::detail::thousands_sep_impl<char>(
    fmt::detail::locale_ref);
template fmt::detail::dragonbox::decimal_fp<double> fmt::detail::dragonbox::to_decimal<double>(
    double) noexcept;
