// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/estimate.h"

#include <fmt/core.h>

#include <cmath>

#include "text/number.h"

namespace rolling {
bool parse_estimate(std::string_view text, Estimate& estimate) {
  const auto sign = text.find("+-");
  const auto value_text = text.substr(0, sign);
  Estimate read;
  if (sign == std::string_view::npos) {
    if (!parse_number(text, read.value)) return false;
  } else {
    // Blanks are allowed around +-, but not around the whole.
    const auto sigma_text = text.substr(sign + 2);
    if (trim(text) != text || !parse_number(trim(value_text), read.value) ||
        !parse_number(trim(sigma_text), read.sigma) || std::signbit(read.sigma))
      return false;
  }
  estimate = read;
  return true;
}

std::string to_text(const Estimate& estimate) {
  return estimate.sigma > 0 ? fmt::format("{}+-{}", estimate.value, estimate.sigma)
                            : fmt::format("{}", estimate.value);
}

}  // namespace rolling
