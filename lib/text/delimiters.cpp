// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/delimiters.h"

#include <algorithm>

#include "text/number.h"

namespace rolling {

const char* closing_quote(const char* at, const char* end) {
  for (;; at += 2) {
    at = std::find(at, end, quote);
    if (at == end || at + 1 == end || at[1] != quote) return at;
  }
}

std::optional<std::string> take_quoted(std::string_view& line, char separator) {
  if (!line.starts_with(quote)) return {};
  const char *const first = line.data() + 1, *const end = line.data() + line.size(),
                    *const close = closing_quote(first, end);
  if (close == end) return {};
  std::string_view behind(close + 1, end);
  while (separator && !behind.empty() && behind.front() != separator && is_blank(behind.front()))
    behind.remove_prefix(1);
  if (!behind.empty() && (separator ? behind.front() != separator : !is_blank(behind.front())))
    return {};
  line = behind;
  return replace_all(trim({first, close}), {{"\"\"", "\""}});
}

Unquoted outside_quotes(std::string_view text, std::string_view between, bool within) {
  Unquoted outside;
  const char *at = text.data(), *const end = at + text.size();
  for (bool begins = true; within || at != end; ++at) {
    if (within || (begins && *at == quote)) {
      at = closing_quote(within ? at : at + 1, end);
      if (at == end) return {outside.text, true};
      begins = within = false;
    } else {
      outside.text += *at;
      begins = between.find(*at) != std::string_view::npos || (begins && is_blank(*at));
    }
  }
  return outside;
}

bool needs_quotes(std::string_view field) {
  return field.starts_with('#') ||
         std::ranges::any_of(field, [](char c) { return c == quote || c == '\t' || c == '\n'; });
}

void append_field(Bytes& line, std::string_view field) {
  if (!needs_quotes(field)) return line.append(field);
  line.push_back(quote);
  for (const char c : field) {
    if (c == quote) line.push_back(quote);
    line.push_back(c);
  }
  line.push_back(quote);
}

}  // namespace rolling
