// SPDX-License-Identifier: GPL-3.0-or-later
// Text that grows at its end: fmt's buffer, which hands out space that is not initialised.
#pragma once

#include <fmt/format.h>

#include <cstddef>

namespace rolling {

using Bytes = fmt::memory_buffer;

/// Space for so many more characters. What is written there ends at the argument of set_end().
inline char* space(Bytes& text, std::size_t count) {
  text.reserve(text.size() + count);
  return text.end();
}
inline void set_end(Bytes& text, const char* end) {
  text.resize(static_cast<std::size_t>(end - text.data()));
}

}  // namespace rolling
