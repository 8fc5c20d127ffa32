#include "text/unit_lines.h"

#include "unit/text/files.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

using Names = std::vector<std::string>;

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
        "f:2: the column 'x[cm]' has another unit in the line below, 'mm'");
}

TEST_CASE("unit lines: a unit that looks like the label of a run is still the unit", "[text]") {
  CHECK(with_unit("t", "mm:ss") == "t[mm:ss]");
  CHECK(with_unit("t", "s Run 2") == "t[s Run 2]");
}

TEST_CASE("unit lines: a comment notes the unit of a column whose name has none", "[text]") {
  const auto noted = [](const std::string& comment) {
    std::vector<Column> columns = {{"t"}, {"x", "m"}, {"v"}};
    note_other_units(comment, columns);
    return columns[0].elsewhere + '|' + columns[1].elsewhere + '|' + columns[2].elsewhere;
  };
  CHECK(noted("# t [ms]: time, x [cm]") == "ms||");
  CHECK(noted("# t[ms]\tv [km/h]") == "ms||km/h");
  CHECK(noted("# t[s] v[m/s]") == "||");
  CHECK(noted("# t[fortnight] w[cm]") == "||");
  CHECK(noted("## t[ms]") == "||");
  CHECK(noted("# time in ms, velocity in cm/s") == "ms||cm/s");
  CHECK(noted("# t: ms; v = km/h") == "ms||km/h");
  CHECK(noted("# col1: time in s") == "||");
  CHECK(noted("# time in min: 5") == "||");  // a value
  CHECK(noted("# speed: min 0, time: 40 ms") == "||");
  CHECK(noted("# time: in the morning") == "||");
}

TEST_CASE("unit lines: a comment with the units of some columns notes them by place", "[text]") {
  const auto noted = [](const std::string& comment) {
    std::vector<Column> columns = {{"t"}, {"v"}, {"F"}, {"x", "m"}};
    note_other_units(comment, columns);
    return columns[0].elsewhere + '|' + columns[1].elsewhere + '|' + columns[3].elsewhere;
  };
  CHECK(noted("# s cm/s N mm") == "|cm/s|");
  CHECK(noted("# [ms] [cm/s] [N] [m]") == "ms|cm/s|");
  CHECK(noted("# s,,N,mm") == "||");
  CHECK(noted("# taken 40 ms apart") == "||");  // one unit alone may be a word of a sentence
  CHECK(noted("# ms cm/s N") == "||");          // not as many as columns
  CHECK(noted("# ms cm/s t v") == "||");        // names
  CHECK(noted("## ms cm/s N m") == "||");
  CHECK(noted("# units: ms, cm/s, N, m") == "ms|cm/s|");
  CHECK(noted("# units ms cm/s") == "||");
  CHECK(noted("# 40 ms cm/s N m") == "||");
}

TEST_CASE("unit lines: a comment with units that does not name the columns is refused", "[text]") {
  const auto refused = [](const std::string& comment, std::size_t width) {
    return refusal([&] { refuse_units_of_others(comment, width, false, "f:2"); });
  };
  CHECK(refused("# t[ms]", 2) == "f:2: a comment with units, but not the names of 2 columns");
  CHECK(refused("# t[s] x[m]", 1) == "f:2: a comment with units, but not the names of 1 column");
  CHECK(refused("# t[s] alone", 2).empty());
  CHECK(refused("# w[ms]", 2).empty());
  const std::string units = refused("# t[ms]", 2);
  for (const char* comment : {"# units: ms cm/s", "# units: ms, cm/s, N", "# [ms], [m]",
                              "# Units: [ms] (cm/s)", "# col1: time in ms", "# velocity = cm/s"})
    CHECK(refused(comment, 2) == units);
  for (const char* comment : {"# units: s m/s", "# col1: time in s", "# every 40 ms m by m",
                              "# radius in cm: 4", "# time: s, velocity: m/s"})
    CHECK(refused(comment, 2).empty());
  CHECK_NOTHROW(refuse_units_of_others("# ms cm/s", 2, true, "f:2"));
}

TEST_CASE("unit lines: a line of units only, one of which is not SI, is refused", "[text]") {
  const auto refused = [](const Names& fields) {
    return refusal([&] { refuse_line_of_units(fields, "f:2"); });
  };
  CHECK(refused({"s", "", "[cm]"}) ==
        "f:2: a line of units: put each behind the name of its column, as in t[ms]");
  CHECK(refused({"s", "m/s"}).empty());
  CHECK(refused({"ms", "later"}).empty());
  CHECK(refused({"later", "ms"}).empty());
  CHECK(refused({"", ""}).empty());
  CHECK(refused({}).empty());
}
