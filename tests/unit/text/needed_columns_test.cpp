// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/needed_columns.h"

#include <algorithm>

#include "text/head.h"
#include "unit/text/files.h"
#include "unit/catch.h"

using namespace rolling;
using Kind = NeededColumns::Kind;

namespace {

using Texts = std::vector<std::string>;

std::vector<Column> columns(const Texts& names) {
  std::vector<Column> all;
  for (const std::string& name : names) all.push_back(read_column(name));
  return all;
}

/// The names and units of the output when `wanted` are needed of a file with these columns, or the
/// message that refuses them.
std::string output(const Texts& names, const Texts& use = {}, const Texts& wanted = {"t", "v"}) {
  std::string all;
  const std::string message = refusal([&] {
    NeededColumns needed(use, true);
    needed.begin_run(columns(names), true, {});
    for (const std::string& name : wanted) needed.add(name, Kind::needed);
    for (const Column& column : needed.in_output())
      all += (all.empty() ? "" : " ") + to_text(column);
  });
  return message.empty() ? all : message;
}

/// A column of this run must be converted.
bool converts(const NeededColumns& needed) {
  return std::ranges::any_of(needed.all(), [](const auto& one) { return one.to_si.changes(); });
}

}  // namespace

TEST_CASE("needed columns: a --use that says nothing, or two things, is refused", "[text]") {
  const Texts file = {"t", "w", "v"};
  for (const std::string text : {"v", "=2", "v=", "w=3", "V=3", "v[m/s]=3"})
    CHECK(output(file, {text}) ==
          "--use: '" + text +
              "' is not NAME=COLUMN or NAME=COLUMN[UNIT], with t, x, v, a or D as NAME");
  CHECK(output(file, {"v=2", "v=3"}) == "--use: 'v=3' comes after another for v");
  CHECK(output(file, {"v=2", "Velocity=3"}) == "--use: 'Velocity=3' comes after another for v");
  CHECK(output(file, {"v=w", "x=2"}) == "--use: column 2 cannot serve as both v and x");
  CHECK(output(file, {"v=1"}) == "column 1 cannot serve as both v and t");
}

TEST_CASE("needed columns: what is asked for may have a unit, and the run of the column",
          "[text]") {
  const Texts file = {"t", "v[km/h]", "F[N] Run #2", "w"};
  for (const char* asked : {"v", "v[km/h]", "Velocity (m/s)", "F", "F[N]", "F Run 2", "2: F", "w"})
    CHECK(output(file, {}, {"t", asked}).starts_with("t[s] v["));
  CHECK(output(file, {}, {"v[cm/s]"}) == "t v[m/s] F[N] w");
  CHECK(output(file, {"v=w[cm/s]"}, {"v[cm/s]"}) == "t v_in[km/h] F[N] v[m/s]");
  for (const std::string asked : {"F Run #3", "v Run 2", "Latest: F"}) {
    const std::string none = "there is no column '" + asked + "' among t, v[km/h], F[N], w";
    CHECK(output(file, {}, {asked}).starts_with(none));
    CHECK(output(file, {"x=" + asked}) == "--use x=" + asked + ": " + none);
  }
}

TEST_CASE("needed columns: --use says which, by name or by number", "[text]") {
  const Texts file = {"t", "v", "v"};
  CHECK(output(file) == "columns 2 and 3 are both v; say --use v=N");
  CHECK(output(file, {"v=2"}) == "t[s] v[m/s] v_in");
  CHECK(output(file, {"v=3"}) == "t[s] v_in v[m/s]");
  CHECK(output(file, {}, {"t"}) == "t[s] v v");  // v is not needed
  // However a column is asked for, it serves as one quantity.
  CHECK(output({"t", "w"}, {"v=w"}, {"w", "2", "v"}) == "t v[m/s]");
  CHECK(output({"t", "v"}, {"x=v"}, {"2"}) == "t x[m]");
  CHECK(output({"t", "v"}, {"x=v"}, {"v"}) == "column 2 cannot serve as both x and v");
  CHECK(output({"t", "w"}, {"v=4"}) == "--use v=4: there is no column '4' among t, w");
  CHECK(output({"t", "v"}, {"x=pos"}) == "--use x=pos: there is no column 'pos' among t, v");
  CHECK(output({"t", "w"}, {"v=0"}) == "--use v=0: there is no column '0' among t, w");
  CHECK(output({"t", "w"}, {"v=1.5"}) == "--use v=1.5: there is no column '1.5' among t, w");
}

TEST_CASE("needed columns: --use takes a name as it stands in the file, or as it is printed",
          "[text]") {
  const Texts file = {"Time (s)", "Speed (OBD)(km/h)", "Speed (GPS)(km/h)"};
  for (const char* name : {"Speed (GPS)(km/h)", "Speed_(GPS)[km/h]", "Speed (GPS)", "Speed_(GPS)",
                           "Speed (GPS)[km/h]", " Speed (GPS) (km/h)", "3"})
    CHECK(output(file, {"v=" + std::string(name)}) == "t[s] Speed_(OBD)[km/h] v[m/s]");
  CHECK(output(file, {"v=Speed (XYZ)"}) ==
        "--use v=Speed (XYZ): there is no column 'Speed (XYZ)' among t[s], "
        "Speed_(OBD)[km/h], Speed_(GPS)[km/h]");
  // Every column by its own name, whatever else has a name that means the same.
  const Texts alike = {"Time", "Time (GPS)", "Speed", "Velocity (m/s)", "v_in"};
  for (std::size_t i = 0; i < alike.size(); ++i) {
    NeededColumns needed({"x=" + alike[i], "D=1"}, true);
    if (i > 0) {
      needed.begin_run(columns(alike), true, {});
      CHECK(needed.find("x") == i);
    }
    NeededColumns other({}, true);
    other.begin_run(columns(alike), true, {});
    CHECK(other.find(alike[i]) == i);
  }
  CHECK(output({"Speed", "Speed", "t"}, {"v=Speed"}).find("are both v") != std::string::npos);
}

TEST_CASE("needed columns: a name that is a unit is that unit, where --use gives it a quantity",
          "[text]") {
  const auto factor = [](const std::string& name, const std::string& quantity) {
    NeededColumns needed({quantity + "=1"}, true);
    needed.begin_run(columns({name, "other"}), true, {});
    needed.add(quantity, Kind::needed);
    const Conversion to_si = needed.all().front().to_si;
    CHECK(needed.assumed().empty() != (to_si.multiply == 0));
    return to_si.multiply / to_si.divide;
  };
  CHECK(factor("secs", "t") == 1);
  CHECK(factor("ms", "t") == 1e-3);
  CHECK(factor("min", "t") == 60);
  CHECK(factor("kph", "v") == 5 / 18.);
  CHECK(factor("KPH", "v") == 5 / 18.);
  CHECK(factor("mph", "v") == 1397 / 3125.);
  CHECK(factor("km/h", "v") == 5 / 18.);
  CHECK(factor("km", "x") == 1000);
  CHECK(factor("m/s", "v") == 1);
  NeededColumns needed({"v=1"}, true);
  needed.begin_run(columns({"ms", "other"}), true, {});
  needed.add("v", Kind::needed);
  CHECK(needed.assumed() == "v is column 1, 'ms', taken in m/s");
}

TEST_CASE("needed columns: a choice that no name made is told", "[text]") {
  const auto told = [](const Texts& names, const Texts& wanted) {
    NeededColumns needed({}, true);
    needed.begin_run(columns(names), true, {});
    for (const std::string& name : wanted) needed.add(name, Kind::needed);
    return needed.assumed();
  };
  CHECK(told({"Zeit (s)", "Weg (m)", "Wind (m/s)"}, {"t", "v"}) ==
        "t is column 1, 'Zeit', by its unit; v is column 3, 'Wind', by its unit");
  CHECK(told({"t", "H\xC3\xB6he (m)"}, {"t", "x"}) == "x is column 2, 'H??he', by its unit");
  CHECK(told({"t", "Altitude (ft)"}, {"t", "x"}) == "x is column 2, 'Altitude', by its unit");
  CHECK(told({"t", "Diameter (mm)"}, {"t", "x"}) == "x is column 2, 'Diameter', by its unit");
  CHECK(told({"Exposure (ms)", "v"}, {"t", "v"}) == "t is column 1, 'Exposure', by its unit");
  // A unit behind a slash, as ISO 80000-1 writes it, and a name that is one.
  CHECK(told({"Zeit/s", "Weg / cm"}, {"t", "x"}) ==
        "t is column 1, 'Zeit/s', by its unit; x is column 2, 'Weg_/_cm', by its unit");
  CHECK(told({"t/s", "s/m"}, {"t", "x"}) == "x is column 2, 's/m', by its unit");
  CHECK(told({"t/s", "v/(m/s)", "w/(rad/s)"}, {"t", "v"}).empty());
  CHECK(told({"secs", "cad", "hr", "km", "kph"}, {"t", "v"}) ==
        "t is column 1, 'secs', by its unit; v is column 5, 'kph', by its unit");
  // What is not needed was not chosen; and what is named, or asked for by its own name, is not
  // told.
  CHECK(told({"Exposure (ms)", "v"}, {"v"}).empty());
  CHECK(told({"Time (s)", "Distance (m)"}, {"t", "x"}).empty());
  CHECK(told({"Time (s)", "Weg (m)"}, {"t", "Weg"}).empty());
}

TEST_CASE("needed columns: a column that is absent", "[text]") {
  // An angle over a time is no time, a pace no length, and two letters may be anything.
  for (const char* name : {"rad/s", "deg/min", "hr", "ms"})
    CHECK(output({name, "x"}, {}, {"t"}).find("there is no column 't'") == 0);
  CHECK(output({"t", "min/km"}, {}, {"x"}).find("there is no column 'x'") == 0);
  CHECK(output({"t[s]", "w[rad/s]"}) ==
        "there is no column 'v' among t[s], w[rad/s]; say --use v=COLUMN");
  // The case of letters matters in short names.
  CHECK(output({"T", "V"}) ==
        "there is no column 't' among T, V; say --use t=COLUMN, and --use x=COLUMN or v=COLUMN");
  CHECK(output({"t"}, {}, {"n"}) == "t is the only column, but n is needed too");
  NeededColumns needed({}, true);
  needed.begin_run(columns({"t"}), false, {});
  CHECK(refusal([&] { needed.add("v", Kind::needed); }) ==
        "one column alone, but t is needed too: if a row comes every 0.04 s, "
        "awk '{ print NR * 0.04, $1 }' adds t; if this line is a heading, begin it with #");
  needed.begin_run(columns({"t", "c2"}), false, {});
  CHECK(refusal([&] { needed.add("v", Kind::needed); }) ==
        "there is no column 'v' among 2 columns without names; if this line is a heading, "
        "begin it with #, or say --use v=COLUMN");
  CHECK(needed.add("x", Kind::wanted) == 0);  // may be absent
  CHECK(needed.all()[0].column == NeededColumns::no_column);
}

TEST_CASE("needed columns: a unit that the tools do not read is not taken for SI", "[text]") {
  CHECK(output({"t_ms", "x/cm"}, {"t=1[ms]", "x=x/cm"}, {"t", "x"}) == "t[s] x[m]");
  CHECK(output({"t_ms", "x/cm"}, {"t=1[ms]", "x=x/cm[cm]"}, {"t", "x"}) == "t[s] x[m]");
  CHECK(output({"t", "w_km/h"}, {}, {"w_km/h"}) == "t w_km/h");  // no quantity
  const Texts file = {"t (moments)", "v (bananas)"};
  CHECK(output(file, {"v=2[m/s]"}) ==
        "column 't[moments]' cannot serve as t: its unit 'moments' is not one of those known "
        "(s, sec, ms, us, ns, min, h); convert it first (rolling-recipes(7)) or say --use "
        "'t=1[UNIT]'");
  CHECK(output(file).ends_with("or say --use 't=1[UNIT]'"));
  CHECK(output(file, {"t=1[s]", "v=2[m/s]"}) == "t[s] v[m/s]");
}

TEST_CASE("needed columns: one that displaces another of its name", "[text]") {
  CHECK(output({"t[s]", "v[m/s]", "w[cm/s]"}, {"v=w"}, {"v"}) == "t[s] v_in[m/s] v[m/s]");
}

TEST_CASE("needed columns: the order of the calls does not change the names", "[text]") {
  Texts order = {"t", "v", "x"};
  do
    CHECK(output({"t[s]", "v", "w[cm/s]", "x", "v_in"}, {"v=w", "x=2"}, order) ==
          "t[s] x[m] v[m/s] x_in v_in");
  while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("needed columns: the next run may have other places and units", "[text]") {
  NeededColumns needed({}, true);
  needed.begin_run(columns({"t", "v[km/h]", "n[pebble]"}), true, {});
  const auto v = needed.add("v", Kind::needed), n = needed.add("n", Kind::needed);
  CHECK(needed.all()[v].to_si(72) == 20);
  CHECK(converts(needed));
  needed.begin_run(columns({"v", "n[pebble]", "t"}), true, {});
  CHECK(needed.all()[v].column == 0);
  CHECK(needed.all()[n].column == 1);
  CHECK_FALSE(converts(needed));
  needed.begin_run(columns({"v[km/h]", "n[pebble]"}), true, {});
  CHECK(converts(needed));
  CHECK(refusal([&] {
          needed.begin_run(columns({"v", "n[stone]"}), true, {});
        }) == "column 2 is 'n[stone]', and 'n[pebble]' in the runs before");
  CHECK(refusal([&] { needed.begin_run(columns({"v"}), true, {}); }) ==
        "there is no column 'n' among v");
}

TEST_CASE("needed columns: a column as it is has no unit of its quantity", "[text]") {
  NeededColumns needed({}, true);
  needed.begin_run(columns({"a[mm]", "v[km/h]"}), true, {});
  const auto a = needed.add("a", Kind::as_is, "m");
  CHECK(needed.all()[a].to_si(3) == 3e-3);
  CHECK(to_text(needed.in_output()[0]) == "a[mm]");
  CHECK_FALSE(needed.renames());
}

TEST_CASE("needed columns: the names of a file without names end where --use says another place",
          "[text]") {
  CHECK(NeededColumns({"v=2"}, true).names_without_use({"t", "v", "x"}) == Texts{"t", "v", "x"});
  CHECK(NeededColumns({"v=3"}, true).names_without_use({"t", "v", "x"}) == Texts{"t"});
  CHECK(NeededColumns({"v=3"}, true).use_has_numbers());
  CHECK_FALSE(NeededColumns({"v=w"}, true).use_has_numbers());
}

TEST_CASE("needed columns: one that is wanted, and absent from a later run, converts nothing",
          "[text]") {
  NeededColumns needed({}, true);
  needed.begin_run(columns({"t", "x[cm]"}), true, {});
  needed.add("x", Kind::wanted);
  CHECK(converts(needed));
  needed.begin_run(columns({"t"}), true, {});
  CHECK_FALSE(converts(needed));
  CHECK(to_text(needed.in_output()[0]) == "t");
}
