// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/head.h"

#include "unit/text/files.h"
#include "unit/text/rows.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

/// The first of two columns, v and one of this name above this unit; or what refuses the unit.
std::string with_unit(const std::string& name, const std::string& unit) {
  std::string all;
  const std::string message =
      refusal([&] { all = names(name + "\tv\n" + unit + "\tm/s\n0\t1\n"); });
  return message.empty() ? all.substr(0, all.rfind(' ')) : anonymous(message);
}

}  // namespace

TEST_CASE("unit lines: the line below the names is one of units", "[text]") {
  CHECK(names("t\tx\ns\tfurlong\n0\t1\n") == "t[s] x[furlong]");
  CHECK(names("Zeit\tWeg\n[s]\t(cm)\n0\t1\n") == "Zeit[s] Weg[cm]");
  CHECK(names("Zeit\tWeg\ns\tfurlong\n0\t1\n") == "s furlong");
  CHECK(names("t\tx\nt\tcm\n0\t1\n") == "t cm");
  CHECK_THROWS_AS(names("t\tx\tv\ns\tcm\n0\t1\t2\n"), Error);
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
        "FILE:1: the column 'x[cm]' has another unit in the line of units, 'mm'");
}

TEST_CASE("unit lines: a unit that looks like the label of a run is still the unit", "[text]") {
  CHECK(with_unit("t", "mm:ss") == "t[mm:ss]");
  CHECK(with_unit("t", "s Run 2") == "t[s Run 2]");
}
