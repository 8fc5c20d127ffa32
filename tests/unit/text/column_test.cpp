// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/column.h"

#include <string>

#include "unit/text/files.h"
#include "text/number.h"
#include "unit/catch.h"

using namespace rolling;

TEST_CASE("column: a name says its quantity and its unit", "[text]") {
  struct Case {
    const char* text;
    Column column;
  };
  const Case cases[] = {
      {"v[m/s]", {"v", "m/s", ""}},
      {"v", {"v", "", ""}},
      {" v[m/s] ", {"v", "m/s", ""}},
      {"Velocity (m/s)", {"v", "m/s", ""}},
      {"Velocity(m/s)", {"v", "m/s", ""}},
      {"velocity [m/s]", {"v", "m/s", ""}},
      {"Speed (km/h)", {"v", "km/h", ""}},
      {"Time (s)", {"t", "s", ""}},
      {"Time(s)", {"t", "s", ""}},
      {"TIME", {"t", "", ""}},
      {"Time\n(s)", {"t", "s", ""}},
      {"Time\xC2\xA0(\xC2\xA0s\xC2\xA0)", {"t", "s", ""}},
      {"Time\xE2\x80\xAF(\xE2\x80\x89ms)", {"t", "ms", ""}},  // thin blanks
      {"Position (m)", {"x", "m", ""}},
      {"Distance (cm)", {"x", "cm", ""}},
      {"DISPLACEMENT", {"x", "", ""}},
      {"Trip Distance (km)", {"Trip_Distance", "km", ""}},
      {"Acceleration (m/s^2)", {"a", "m/s^2", ""}},
      {"Acceleration (m/s2)", {"a", "m/s^2", ""}},
      {"Acceleration (m/s\xC2\xB2)", {"a", "m/s^2", ""}},
      {"Acceleration (m/s\xB2)", {"a", "m/s^2", ""}},
      {"Acceleration (m/s/s)", {"a", "m/s/s", ""}},
      {"Time (\xC2\xB5s)", {"t", "us", ""}},
      {"Time (\xCE\xBCs)", {"t", "us", ""}},
      {"Time (\xB5s)", {"t", "us", ""}},
      {"Latest: Time (s)", {"t", "s", "Latest"}},
      {"Data Set 1:Time(s)", {"t", "s", "1"}},
      {"Data Set 12: Velocity (m/s)", {"v", "m/s", "12"}},
      {"Velocity (m/s) Run #2", {"v", "m/s", "2"}},
      {"Zeit (s) Durchgang #2", {"Zeit", "s", "2"}},
      {"Position [cm] Essai n. #13", {"x", "cm", "13"}},
      {"Speed (km/h) #", {"Speed_(km/h)_#", "", ""}},
      {"Time (s) Run 3", {"t", "s", "3"}},
      {"D[m]", {"D", "m", ""}},
      {"d[m]", {"d", "m", ""}},
      {"T", {"T", "", ""}},
      {"V [V]", {"V", "V", ""}},
      {"X", {"X", "", ""}},
      {"Angular Velocity (rad/s)", {"Angular_Velocity", "rad/s", ""}},
      {"E_diss[J]", {"E_diss", "J", ""}},
      {"Runway (m)", {"Runway", "m", ""}},
      {"Run", {"Run", "", ""}},
      {"TestRun 2", {"TestRun_2", "", ""}},
      {"Speed (OBD)(km/h)", {"Speed_(OBD)", "km/h", ""}},
      {"Speed (OBD) [km/h]", {"Speed_(OBD)", "km/h", ""}},
      {"a[m (s/m)^b]", {"a", "m (s/m)^b", ""}},
      {"a (m (s/m)^b)", {"a", "m (s/m)^b", ""}},
      {"v)", {"v)", "", ""}},
      {"(a)(b", {"(a)(b", "", ""}},
      {"Time in ms", {"t", "ms", ""}},
      {"Geschwindigkeit in m/s", {"Geschwindigkeit", "m/s", ""}},
      {"Weg in m/s\xC2\xB2", {"Weg", "m/s^2", ""}},
      {"Latest: Time in min", {"t", "min", "Latest"}},
      {"Time in seconds", {"t", "seconds", ""}},
      {"Mass in kg", {"Mass_in_kg", "", ""}},
      {"in s", {"in_s", "", ""}},
      {"TIME (S)", {"t", "s", ""}},
      {"SPEED [KM/H]", {"v", "KM/H", ""}},
      {"POSITION (MM) RUN", {"POSITION_(MM)_RUN", "", ""}},
      {"POSITION (MM)", {"x", "mm", ""}},
      {"D (M)", {"D", "m", ""}},
      {"Time (S)", {"t", "S", ""}},
      {"t[S]", {"t", "S", ""}},
      {"CONDUCTANCE (S)", {"CONDUCTANCE", "S", ""}},
      {"TIME (H)", {"t", "h", ""}},
      {"", {"", "", ""}},
      {"(s)", {"(s)", "", ""}},
  };
  for (const Case& c : cases) {
    INFO(c.text);
    const Column column = read_column(c.text);
    CHECK(column.name == c.column.name);
    CHECK(column.unit == c.column.unit);
    CHECK(column.run == c.column.run);
  }
}

TEST_CASE("column: what goes out is read back as the same", "[text]") {
  for (const char* text : {"Velocity (m/s)", "Acceleration (m/s\xC2\xB2)",
                           "Angular Velocity (rad/s)", "w", "Time (ms)"}) {
    const Column column = read_column(text);
    CHECK(read_column(to_text(column)) == column);
  }
  CHECK(to_text(Column{"v", "m/s", ""}) == "v[m/s]");
  CHECK(to_text(Column{"closure", "", ""}) == "closure");
}

TEST_CASE("column: each unit against its exact size", "[text]") {
  struct Case {
    const char *quantity, *unit;
    double value, si;
  };
  const Case cases[] = {
      {"t", "s", 0.3, 0.3},      {"t", "sec", 0.3, 0.3},     {"t", "ms", 40, 0.04},
      {"t", "us", 5, 5e-6},      {"t", "min", 1.5, 90},      {"t", "h", 0.5, 1800},
      {"x", "m", 0.7, 0.7},      {"x", "mm", 1, 0.001},      {"x", "cm", 7, 0.07},
      {"x", "dm", 3, 0.3},       {"x", "um", 3, 3e-6},       {"x", "km", 0.25, 250},
      {"x", "in", 1, 0.0254},    {"x", "ft", 1, 0.3048},     {"v", "m/s", 0.1, 0.1},
      {"v", "mm/s", 1, 0.001},   {"v", "cm/s", 7, 0.07},     {"v", "km/h", 72, 20},
      {"v", "km/h", 3.6, 1},     {"v", "mph", 1, 0.44704},   {"v", "ft/s", 1, 0.3048},
      {"v", "MPH", 1, 0.44704},  {"v", "Km/h", 72, 20},      {"v", "kph", 72, 20},
      {"v", "m s^-1", 2, 2},     {"v", "cm / s", 7, 0.07},   {"v", "cm*s-1", 7, 0.07},
      {"a", "m s^-2", 2, 2},     {"a", "m/s^2", 9.81, 9.81}, {"a", "m/s/s", 9.81, 9.81},
      {"a", "mm/s^2", 1, 0.001}, {"a", "cm/s^2", 981, 9.81}, {"D", "m", 1e-3, 1e-3},
      {"D", "mm", 1.5, 0.0015},  {"D", "um", 1500, 0.0015},
  };
  for (const Case& c : cases) {
    INFO(c.quantity << " in " << c.unit);
    CHECK(unit_of(c.quantity, c.unit).value()(c.value) == c.si);
  }
}

TEST_CASE("column: a whole number of a decimal unit is the double that one would have typed in SI",
          "[text]") {
  const Conversion mm = *unit_of("x", "mm"), us = *unit_of("t", "us");
  int different = 0;
  for (int n = 0; n < 20000; ++n) {
    double typed;
    REQUIRE(parse_number(std::to_string(n) + "e-3", typed));
    different += mm(n) != typed;
    REQUIRE(parse_number(std::to_string(n) + "e-6", typed));
    different += us(n) != typed;
  }
  CHECK(different == 0);
}

TEST_CASE("column: SI changes nothing, so that its text can pass", "[text]") {
  for (const char* unit : {"s", "sec"}) CHECK_FALSE(unit_of("t", unit)->changes());
  CHECK(unit_of("t", "ms")->changes());
  CHECK_FALSE(unit_of("w", "rpm"));  // not a known quantity: no claim about its unit
}

TEST_CASE("column: a unit that the quantity cannot have is none", "[text]") {
  for (const char* unit : {"m", "furlong/s", "M/S", "m/s^2", "bananas"}) {
    INFO(unit);
    CHECK_FALSE(unit_of("v", unit));
  }
}

TEST_CASE("column: the SI unit of each quantity", "[text]") {
  CHECK(si_unit("t") == "s");
  CHECK(si_unit("x") == "m");
  CHECK(si_unit("v") == "m/s");
  CHECK(si_unit("a") == "m/s^2");
  CHECK(si_unit("D") == "m");
  CHECK(si_unit("w").empty());
}

TEST_CASE("column: a header is one name a field", "[text]") {
  using Names = std::vector<std::string>;
  CHECK(split_names("t[s]\tv[m/s]", '\t') == Names{"t[s]", "v[m/s]"});
  CHECK(split_names("Time (s),Velocity (m/s)", ',') == Names{"Time (s)", "Velocity (m/s)"});
  CHECK(split_names(" Time (s) ; v ;", ';') == Names{"Time (s)", "v", ""});
  CHECK(split_names("t v  a", '\0') == Names{"t", "v", "a"});
  CHECK(split_names("Time (s)  Velocity (m/s)", '\0') == Names{"Time (s)", "Velocity (m/s)"});
  CHECK(split_names("Time [s]\tv", '\0') == Names{"Time [s]", "v"});
  CHECK(split_names("[s] [m / s] (cm)", '\0') == Names{"[s]", "[m / s]", "(cm)"});
  CHECK(split_names("", '\0').empty());
  CHECK(split_names(" \"Time (s)\" , \"v, of \"\"it\"\"\" ,\"\"", ',') ==
        Names{"Time (s)", "v, of \"it\"", ""});
  CHECK(split_names("\"Time (s)\"  \"v\" (m/s) t", '\0') == Names{"Time (s)", "v (m/s)", "t"});
  CHECK(split_names("\"t\"s,\"v", ',') == Names{"\"t\"s", "\"v"});
  CHECK(split_names("\"t\"s \"v", '\0') == Names{"\"t\"s", "\"v"});
}

// In a time that grows with the line: if it grew with its square, this would take hours.
TEST_CASE("column: brackets that stay open, and many words in one, are no work", "[text]") {
  std::string open, words = "[a";
  for (int i = 0; i < 1000000; ++i) open += "[a ", words += " b";
  CHECK(split_names(open, '\0').size() == 1000000);
  CHECK(split_names(words + "]", '\0').size() == 1);
  CHECK(split_names("[a b) c] d [e", '\0') == std::vector<std::string>{"[a b)", "c]", "d [e"});
}
