// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities that a column may hold, in SI units, and one value for each of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace rolling {

/// Time, position, speed, acceleration, and the shift of the normal force.
enum class Quantity { t, x, v, a, D };

inline constexpr std::array all_quantities{Quantity::t, Quantity::x, Quantity::v, Quantity::a,
                                           Quantity::D};
inline constexpr std::array<std::string_view, 5> names_of_quantities{"t", "x", "v", "a", "D"};

constexpr std::string_view name_of(Quantity q) {
  return names_of_quantities[static_cast<std::size_t>(q)];
}

constexpr std::optional<Quantity> quantity_named(std::string_view name) {
  const auto found = std::ranges::find(names_of_quantities, name);
  if (found == names_of_quantities.end()) return {};
  return static_cast<Quantity>(found - names_of_quantities.begin());
}

/// The derivative by time of x and of v.
constexpr std::optional<Quantity> derivative_of(Quantity q) {
  if (q == Quantity::x) return Quantity::v;
  if (q == Quantity::v) return Quantity::a;
  return {};
}

/// One value for each quantity: `column[Quantity::v]`.
template <typename Value>
struct PerQuantity : std::array<Value, names_of_quantities.size()> {
  constexpr Value& operator[](Quantity q) { return this->begin()[static_cast<std::size_t>(q)]; }
  constexpr const Value& operator[](Quantity q) const {
    return this->begin()[static_cast<std::size_t>(q)];
  }
};

}  // namespace rolling
