// SPDX-License-Identifier: GPL-3.0-or-later
// Text that grows at its end.
#pragma once

#include <string_view>

#include "base/growing.h"

namespace rolling {

class Bytes : public Growing<char> {
 public:
  using Growing::append;
  void append(std::string_view text) { append(text.data(), text.data() + text.size()); }
};

}  // namespace rolling
