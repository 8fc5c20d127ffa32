// SPDX-License-Identifier: GPL-3.0-or-later
// The columns that a tool can compute: one list of quantities, each with its name, its unit and its
// function. Only the columns that the user chooses are computed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/enumeration.h"
#include "base/error.h"
#include "text/column.h"
#include "text/number.h"

namespace rolling {

template <typename Function>
struct Computed {
  std::string_view name, unit;
  Function of;

  Column column() const { return {std::string(name), std::string(unit)}; }
};

/// The quantities of a list like `t,x,v`, in its order. Throws Error for an unknown name and for a
/// name that occurs twice.
template <typename Function, std::size_t count>
std::vector<Computed<Function>> chosen(const std::string& list,
                                       const Computed<Function> (&all)[count]) {
  std::vector<Computed<Function>> chosen;
  for (const std::string& name : split_names(list, ',')) {
    const auto same = [&](const auto& quantity) { return quantity.name == name; };
    const auto found = std::ranges::find_if(all, same);
    if (found == std::end(all)) {
      std::string names;
      for (const auto& quantity : all) add_item(names, quantity.name);
      fail("--columns: '{}' is none of {}", shown(name), names);
    }
    if (std::ranges::any_of(chosen, same)) fail("--columns: {} is there twice", name);
    chosen.push_back(*found);
  }
  return chosen;
}

}  // namespace rolling
