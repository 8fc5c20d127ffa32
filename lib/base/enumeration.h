// SPDX-License-Identifier: GPL-3.0-or-later
// Words in a row, as a sentence has them.
#pragma once

#include <fmt/core.h>

#include <string>
#include <string_view>
#include <vector>

namespace rolling {

/// "a, b and c"
inline std::string enumeration(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 < words.size() ? ", " : " and ";
    text += words[i];
  }
  return text;
}

/// Appends an item to a list like "a, b".
inline void add_item(std::string& list, std::string_view item, std::string_view separator = ", ") {
  if (!list.empty()) list += separator;
  list += item;
}

/// `1 row`, `2 rows`.
inline std::string counted(std::size_t count, std::string_view thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

}  // namespace rolling
