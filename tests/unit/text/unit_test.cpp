// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/unit.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

/// Value in SI units of 1 in this unit, or NaN-like -1 if it is none of the quantity.
double size_of(std::string_view quantity, std::string_view unit) {
  const auto found = unit_of(quantity, unit);
  return found ? (*found)(1) : -1;
}

}  // namespace

TEST_CASE("unit: every spelling of lengths and times, and of their quotients", "[text]") {
  struct Spelled {
    const char* text;
    double size;
  };
  const Spelled times[] = {{"s", 1},
                           {"sec", 1},
                           {"seconds", 1},
                           {"ms", 1e-3},
                           {"msec", 1e-3},
                           {"milliseconds", 1e-3},
                           {"Milliseconds", 1e-3},
                           {"millis", 1e-3},
                           {"micros", 1e-6},
                           {"us", 1e-6},
                           {"usec", 1e-6},
                           {"\xC2\xB5s", 1e-6},
                           {"ns", 1e-9},
                           {"min", 60},
                           {"Minutes", 60},
                           {"h", 3600},
                           {"hrs", 3600}};
  const Spelled lengths[] = {{"m", 1},          {"meters", 1},         {"metre", 1},
                             {"mm", 1e-3},      {"cm", 0.01},          {"dm", 0.1},
                             {"um", 1e-6},      {"km", 1000},          {"in", 0.0254},
                             {"feet", 0.3048},  {"centimetres", 0.01}, {"yd", 0.9144},
                             {"mile", 1609.344}};
  const auto close = [](double a, double b) { return std::abs(a / b - 1) < 1e-15; };
  for (const Spelled& length : lengths) {
    INFO(length.text);
    CHECK(close(size_of("x", length.text), length.size));
    CHECK(close(size_of("D", std::string("in ") + length.text), length.size));
    CHECK(size_of("t", length.text) == -1);
    for (const Spelled& time : times) {
      const std::string l = length.text, t = time.text;
      INFO(t);
      CHECK(close(size_of("t", t), time.size));
      CHECK(close(size_of("v", l + "/" + t), length.size / time.size));
      CHECK(close(size_of("v", l + " per " + t), length.size / time.size));
      CHECK(close(size_of("a", l + " / " + t + "^2"), length.size / time.size / time.size));
      CHECK(close(size_of("a", l + "/" + t + "/" + t), length.size / time.size / time.size));
      CHECK(size_of("x", l + "/" + t) == -1);
      CHECK(size_of("a", l + "/" + t) == -1);
      CHECK(size_of("v", l + "/" + t + "/" + t) == -1);
    }
  }
}

TEST_CASE("unit: speeds with a name, and products with a power of time", "[text]") {
  for (const char* unit : {"km/h", "KM/H", "kmh", "kph", "kmph", "km h^-1", "kmh-1", "km/hr"})
    CHECK(size_of("v", unit) == 5 / 18.);
  for (const char* unit :
       {"m s^-1", "m*s-1", "ms-1", "m.s-1", "m\xC2\xB7s\xE2\x81\xBB\xC2\xB9", "mps"})
    CHECK(size_of("v", unit) == 1);
  // Beyond the range of integers, too.
  CHECK(unit_of("a", "km/ns^2") == Conversion{1e21, 1});
  CHECK(unit_of("v", "km/h") == Conversion{5, 18});
  CHECK(size_of("v", "mms-1") == 1e-3);
  CHECK(size_of("v", "mph") == 0.44704);
  CHECK(size_of("v", "knots") == 1852 / 3600.);
  CHECK(size_of("v", "KN") == 1852 / 3600.);
  CHECK(size_of("v", "fps") == 0.3048);
  CHECK(size_of("a", "cms-2") == 0.01);
  for (const char* unit : {"ms", "M/S", "rpm", "furlong/s", "m", "", "1/s", "/s", "m/", "mms"})
    CHECK(size_of("v", unit) == -1);
  for (const char* unit : {"Ms", "MS", "S", "mm:ss", "hh:mm:ss", "m", "days", "in"})
    CHECK(size_of("t", unit) == -1);
  CHECK(size_of("w", "s") == -1);
}

TEST_CASE("unit: kinds of it", "[text]") {
  for (const char* unit : {"s", "[m]", "(m/s)", "m/s/s", "ms", "[cm]", "(km/h)"})
    CHECK(is_unit(unit));
  for (const char* unit : {"N", "", "[", "-", "(mm", "[mm)", "mm)"}) CHECK(!is_unit(unit));
}

TEST_CASE("unit: ratios of lengths", "[text]") {
  CHECK(read_unit("%") == Unit{"", {1, 100}});
  CHECK(read_unit("mm/m") == Unit{"", {1, 1000}});
  CHECK(read_unit("cm per km") == Unit{"", {1, 100'000}});
  CHECK(read_unit("m/m") == Unit{"", {1, 1}});
  CHECK_FALSE(read_unit("s/s").has_value());
  CHECK_FALSE(read_unit("m/m/m").has_value());
}

TEST_CASE("unit: at the end of a name", "[text]") {
  struct Case {
    const char *quantity, *name, *unit;
  };
  const Case cases[] = {
      {"t", "t_ms", "ms"},
      {"t", "Zeit_in_ms", "in ms"},
      {"t", "Zeit_/_ms", "ms"},
      {"x", "Weg/cm", "cm"},
      {"v", "v_km/h", "km/h"},
      {"v", "v/km/h", "km/h"},
      {"v", "speed_cm_s-1", "cm s-1"},
      {"v", "v_m_per_s", "m per s"},
      {"a", "a_cm/s^2", "cm/s^2"},
      {"v", "v_ms", ""},
      {"v", "v_min", ""},
      {"x", "x_in", ""},
      {"t", "t_in_s", "in s"},
      {"t", "times", ""},
      {"v", "v_smoothed", ""},
      {"v", "Velocidad_cm/seg", "cm/seg"},
      {"v", "n_1/s", "1/s"},
      {"w", "w_ms", ""},
  };
  for (const Case& c : cases) {
    INFO(c.quantity << " of " << c.name);
    CHECK(unit_at_end(c.quantity, c.name) == c.unit);
  }
}

TEST_CASE("unit: other than SI in comments, the last one counts", "[text]") {
  SaidUnits said;
  std::size_t line = 0;
  for (const char* comment : {"# times are in us, us all", "# units: ms, cm/s, N, m", "# D in mm",
                              "# 40 ns", "## x in km", "# radius in dm: 4",
                              "# speed in kilometers per hour", "# v in m/s, t in s, in a min"})
    note_units(comment, ++line, said);
  std::string all;
  for (const auto& [quantity, unit] : said) all += fmt::format("{}: {}, ", quantity, unit);
  CHECK(
      all ==
      "D: line 3 says mm, t: line 2 says ms, v: line 7 says kilometers/hour, x: line 3 says mm, ");
}
