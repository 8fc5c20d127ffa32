// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/head.h"

#include "base/error.h"
#include "unit/text/files.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

std::string with_unit(std::string_view name, std::string_view unit) {
  Column column = read_column(name);
  const std::string message = refusal([&] { add_unit(column, unit, "f:2"); });
  return message.empty() ? to_text(column) : message;
}

}  // namespace

TEST_CASE("unit lines: the line below the names is one of units", "[text]") {
  CHECK(are_units_of({"t", "x"}, {"s", "furlong"}));
  CHECK(are_units_of({"Zeit", "Weg"}, {"[s]", "(cm)"}));
  CHECK_FALSE(are_units_of({"Zeit", "Weg"}, {"s", "furlong"}));
  CHECK_FALSE(are_units_of({"t", "x"}, {"t", "cm"}));
  CHECK_FALSE(are_units_of({"t", "x", "v"}, {"s", "cm"}));
}

TEST_CASE("unit lines: a column gets the unit below its name", "[text]") {
  CHECK(with_unit("x", "[cm]") == "x[cm]");
  CHECK(with_unit("a", "(\xC2\xA0m/s\xC2\xB2)") == "a[m/s^2]");
  CHECK(with_unit("x", "") == "x");
  CHECK(with_unit("x", "[]") == "x");
  CHECK(with_unit("x", "(") == "x[(]");
  CHECK(with_unit("x[cm]", "") == "x[cm]");
  CHECK(with_unit("x[cm]", "(cm)") == "x[cm]");
  CHECK(with_unit("x[cm]", "mm") ==
        "f:2: the column 'x[cm]' has another unit in the line of units, 'mm'");
}

TEST_CASE("unit lines: a unit that looks like the label of a run is still the unit", "[text]") {
  CHECK(with_unit("t", "mm:ss") == "t[mm:ss]");
  CHECK(with_unit("t", "s Run 2") == "t[s Run 2]");
}
