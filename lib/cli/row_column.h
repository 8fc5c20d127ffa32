// SPDX-License-Identifier: GPL-3.0-or-later
// The columns of a row of fitpower.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "text/reader.h"

namespace rolling {

/// A column of a row of fitpower. In a file of readings its name may mean another quantity (a is an
/// acceleration there), so it is read without conversion and converted here.
class RowColumn {
 public:
  /// `quantity`: the known one in whose unit it is; nothing for a number of this unit alone.
  RowColumn(Reader& in, const std::string& name, std::string_view quantity = {},
            std::string unit = {})
      : in_(in), name_(name), quantity_(quantity), unit_(std::move(unit)),
        slot_(in.need_as_is(name)) {
    value_of(0);
  }
  double value() const { return value_of(in_[slot_]); }

 private:
  double value_of(double number) const {
    const Column& column = in_.columns()[in_.column_of(slot_)];
    if (!quantity_.empty()) return conversion_to_si(quantity_, column)(number);
    if (column.unit != unit_)
      fail("column '{}': {} is a number {}", shown(to_text(column)), name_,
           unit_.empty() ? "without a unit" : "in " + unit_);
    return number;
  }

  Reader& in_;
  std::string name_;
  std::string_view quantity_;
  std::string unit_;
  std::size_t slot_;
};

}  // namespace rolling
