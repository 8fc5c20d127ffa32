// SPDX-License-Identifier: GPL-3.0-or-later
// std::from_chars for doubles; where the C++ library has none (libc++ before its version 20), that
// of fast_float.
#pragma once

#include <charconv>

#ifndef __cpp_lib_to_chars
#include <fast_float/fast_float.h>
#endif

namespace rolling {

#ifdef __cpp_lib_to_chars
using std::from_chars;
#else
using fast_float::from_chars;
#endif

}  // namespace rolling
