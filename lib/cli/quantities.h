// The columns that a tool can compute: one list of quantities, each with its name, its unit and its
// function. Only the columns that the user chooses are computed.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.h"
#include "text/column.h"
#include "text/number.h"

namespace rolling {

template <typename Function>
struct Quantity {
  Column column;
  Function of;
};

/// The quantities of a list like `t,x,v`, in its order. Throws Error for an unknown name and for a
/// name that occurs twice.
template <typename Function>
std::vector<Quantity<Function>> chosen(const std::string& list,
                                       const std::vector<Quantity<Function>>& all) {
  std::vector<Quantity<Function>> chosen;
  for (const std::string& name : split_names(list, ',')) {
    const auto same = [&](const auto& quantity) { return quantity.column.name == name; };
    const auto found = std::find_if(all.begin(), all.end(), same);
    if (found == all.end()) {
      std::string names;
      for (const auto& [column, of] : all) (names += names.empty() ? "" : ", ") += column.name;
      fail("--columns: '{}' is none of {}", shown(name), names);
    }
    if (std::any_of(chosen.begin(), chosen.end(), same)) fail("--columns: {} is there twice", name);
    chosen.push_back(*found);
  }
  return chosen;
}

/// The columns of these quantities.
template <typename Function>
std::vector<Column> columns_of(const std::vector<Quantity<Function>>& quantities) {
  std::vector<Column> columns;
  for (const auto& quantity : quantities) columns.push_back(quantity.column);
  return columns;
}

}  // namespace rolling
