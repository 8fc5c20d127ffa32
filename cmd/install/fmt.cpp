// SPDX-License-Identifier: GPL-3.0-or-later
// What the tools call of fmt, compiled here: Debian 12 has no static library of it.
#ifndef FMT_HEADER_ONLY
#define FMT_HEADER_ONLY
#endif
#include <fmt/format.h>

extern std::string (*const formatter)(fmt::string_view, fmt::format_args);
std::string (*const formatter)(fmt::string_view, fmt::format_args) = fmt::vformat;
