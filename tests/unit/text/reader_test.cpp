// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/reader.h"

#include "unit/text/rows.h"

using namespace rolling;

/// What to do about a number with signs that are none of it.
/// What the message of a text that is no number ends with.
static const std::string digits_alone = "; write it with digits and a decimal point alone",
                         hint =
                             "; write NaN for a missing reading, # before a line that is no row, "
                             "and a blank line before "
                             "another run";

TEST_CASE("reader: blanks, tabs, commas and semicolons separate", "[text]") {
  CHECK(rows({"0 1\n1 2\n"}) == "0 1 | 1 2");
  CHECK(rows({"  0   1  \n\t1 \t2\n"}) == "0 1 | 1 2");
  CHECK(rows({"0\t1\n1\t2\n"}) == "0 1 | 1 2");
  CHECK(rows({"0,1\n1,2\n"}) == "0 1 | 1 2");
  CHECK(rows({"0 , 1\n 1,\t2\n"}) == "0 1 | 1 2");
  CHECK(rows({"0;1\n1;2\n"}) == "0 1 | 1 2");
  CHECK(rows({"0 1\n1 2"}) == "0 1 | 1 2");
}

TEST_CASE("reader: the first row sets the separator, and the others have it", "[text]") {
  CHECK(rows({"0,1\n1;2\n"}) == "FILE:2: 1 field where the first row has 2");
  CHECK(rows({"0\t1\n1 2\n"}) == "FILE:2: 1 field where the first row has 2");
  CHECK(rows({"0 1\n1 2 3\n"}) == "FILE:2: 3 fields where the first row has 2");
  CHECK(rows({"0,1\n1,2,3\n"}) ==
        "FILE:2: 3 fields where the first row has 2; if some of its commas are decimal ones, "
        "make them points first");
}

TEST_CASE("reader: names in the last # line before the data", "[text]") {
  CHECK(rows({"# v[m/s]\tt[s]\n5 0\n"}) == "0 5");
  CHECK(rows({"# v t\n5,0\n"}) == "0 5");
  CHECK(rows({"# v, t\n5,0\n"}) == "0 5");
  CHECK(rows({"#v;t\n5;0\n"}) == "0 5");
  CHECK(rows({"# Velocity (m/s) Time (s)\n5 0\n"}) == "0 5");
  CHECK(rows({"# made by me\n# on a Monday\n# v t\n5 0\n"}) == "0 5");
  CHECK(rows({"# v t\n## smooth v mean width 3\n5 0\n"}) == "0 5");
  CHECK(rows({"# v t\n# three words here\n5 0\n"}) ==
        "0 5");  // a remark: not as many names as columns
  CHECK(rows({"#\n#\n5 0\n"}) == "5 0");
}

TEST_CASE("reader: names in a first line that is not numeric", "[text]") {
  CHECK(rows({"v t\n5 0\n"}) == "0 5");
  CHECK(rows({"Velocity (m/s),Time (s)\n5,0\n"}) == "0 5");
  CHECK(rows({"Velocity (m/s);Time (s)\n5;0\n"}) == "0 5");
  CHECK(rows({"Velocity (m/s)\tTime (s)\n5\t0\n"}) == "0 5");
  CHECK(rows({"# a comment\n\nv t\n\n5 0\n"}) == "0 5");
  CHECK(rows({"A preamble of words\nv t\n5 0\n"}) == "0 5");
  CHECK(rows({"t v a\n0 5\n"}) ==
        "FILE:2: 2 fields under a line of 3 names: begin that with # if it is no header, put "
        "quotes around names that hold a separator, and make decimal commas points");
  CHECK(rows({"t v\n0\n"}) ==
        "FILE:2: 1 field under a line of 2 names: begin that with # if it is no header, put quotes "
        "around names that hold a separator, and make decimal commas points");
  CHECK(rows({"t v\r\n0 5\r\n\x1A"}) == "0 5");
  CHECK(rows({"# t\tv\n0\t5\n\n# t v\n0 7\n"}) ==
        "FILE:5: '0 7' is not separated as the rows before; if it is a heading, begin it with #");
  CHECK(rows({"t v\n0 5\n\nt;v\n0,5;7\n"}) ==
        "FILE:5: '0,5;7' is not separated as the rows before; if it is a heading, begin it with #");
  CHECK(rows({"t,v\n0,5\n\n0;\n"}) ==
        "FILE:4: '0;' is not separated as the rows before; if it is a heading, begin it with #");
  CHECK(rows({"# t\tv\n0\t5\n\n0;7;note\n"}) ==
        "FILE:4: '0;7;note' is not separated as the rows before; if it is a heading, begin it with "
        "#");
  CHECK(rows({"t,v\n0,5\n\nRun 2\n\nThe end of 3 runs\n\n1. try\n"}) == "0 5");
  // Quotes that are none in this file do not make a row a header, or a remark.
  CHECK(rows({"# t v\n\"0\" \"5\"\n1 6\n"}, use({"t=1", "v=2"})) ==
        "FILE:2: field 1 (t): '\"0\"' is not a number" + digits_alone);
  CHECK(rows({"t,v\n'0','5'\n1,6\n"}) ==
        "FILE:2: field 1 (t): ''0'' is not a number" + digits_alone);
  CHECK(rows({"t v\n0 5\n\n\"1\" \"6\"\n"}) ==
        "FILE:4: field 1 (t): '\"1\"' is not a number" + digits_alone);
  CHECK(rows({"t,v\n0,5\n\nSecond\n0,5\n"}) ==
        "FILE:5: 2 fields under a line of 1 name: begin that with # if it is no header, put quotes "
        "around names that hold a separator, and make decimal commas points");
  CHECK(rows({"\"Velocity (m/s)\",\"Time (s)\"\n5,0\n"}) == "0 5");
}

TEST_CASE("reader: names of columns that no tool knows, and of none", "[text]") {
  CHECK(names("# t[s] Angle (rad) w[rad/s]\n0 1 2\n") == "t[s] Angle[rad] w[rad/s]");
  CHECK(names("Time (s),,Angular Velocity (rad/s)\n0,1,2\n") == "t[s] c2 Angular_Velocity[rad/s]");
  CHECK(names("0 1 2 3\n") == "t[s] v[m/s] c3 c4");
  CHECK(names("# one word for two columns\n0 1\n") == "t[s] v[m/s]");
  CHECK(names("# x\n0 1\n") == "t[s] v[m/s]");  // fewer names than columns: a comment
}

TEST_CASE("reader: byte order mark, CR LF, quotes", "[text]") {
  CHECK(rows({"\xEF\xBB\xBF"
              "v,t\r\n5,0\r\n\r\n6,0\r\n"}) == "0 5 || 0 6");
  CHECK(rows({"\xEF\xBB\xBF"
              "5,0\r\n"}) == "5 0");
  CHECK(rows({"\xEF\xBB\xBFt,v\n0,5\n\n\xEF\xBB\xBFt,v\n0,6\n"}) == "0 5 || 0 6");
  CHECK(rows({"\"t\",\"v\"\n\"0\",\"5\"\n\"1\",6\n"}) == "0 5 | 1 6");
  CHECK(copies("t,v,note\n0,5,\"a, \"\"b\"\"\"\n") == "<0\t5\t\"a, \"\"b\"\"\">");
  CHECK(copies("t,v,u\n0,0,\"\"\"\"\n") == "<0\t0\t\"\"\"\">");  // quoted where it has to be
  CHECK(copies("u,t,v\n\"#1\",0,5\n\"a\tb\",1,5\n\"a\nb\",2,5\n") ==
        "<\"#1\"\t0\t5><\"a\tb\"\t1\t5><\"a\nb\"\t2\t5>");
  CHECK(rows({"t,v\n0,\"1\"5\n"}) == "FILE:2: field 2: text behind the quotes of '\"1\"5'");
}

TEST_CASE("reader: a decimal comma where ; or tab separates", "[text]") {
  CHECK(rows({"t;v\n0,5;1,25\n1;2\n1,5;-3,5e2\n"}) == "0.5 1.25 | 1 2 | 1.5 -350");
  CHECK(rows({"t\tv\n0,5\t1,25\n"}) == "0.5 1.25");
  CHECK(copies("t;v\n0,50;+1,250\n") == "<0.50\t+1.250>");  // only the mark changes
}

TEST_CASE("reader: a first row that has decimal commas only is a row, not names", "[text]") {
  CHECK(rows({"0,0;1,5\n0,1;1,6\n"}) == "0 1.5 | 0.1 1.6");
  CHECK(rows({"Zeit (s);v (m/s)\n0,0;1,5\n1;1,6\n"}, use({"t=1"})) == "0 1.5 | 1 1.6");
  CHECK(rows({"t\tv\n0,0\t1,5\n1\t2\n"}) == "0 1.5 | 1 2");
}

TEST_CASE("reader: a row of blank cells is a run break, whatever separates them", "[text]") {
  for (const std::string separator : {"\t", ",", ";"})
    for (const std::string blanks : {"", " ", "\"\""})
      for (const bool named : {true, false}) {
        const std::string blank = blanks + separator + blanks + separator + blanks + "\n";
        const auto row = [&](int t) { return fmt::format("{1}{0}{2}{0}3\n", separator, t, t + 1); };
        const std::string names = named ? "t" + separator + "v" + separator + "w\n" : "";
        INFO(names << blank);
        CHECK(rows({names + row(0) + row(1) + blank + row(0) + blank + blank + row(1) + blank}) ==
              "0 1 | 1 2 || 0 1 || 1 2");
        CHECK(rows({blank + names + blank + row(0)}) == "0 1");
      }
  CHECK(rows({"t,v,t,v\n0,1,0,5\n,,,\n2,3,2,6\n"}) == "0 1 || 0 5 || 2 3 || 2 6");
  CHECK(rows({"0 1\n,\n1 2\n"}).starts_with("FILE:2"));  // no separator of this file
}

TEST_CASE("reader: what is no number is refused with what to do about it", "[text]") {
  CHECK(rows({"t,v\n0,1\n10:15:00.5,2\n"}) ==
        "FILE:3: field 1 (t): '10:15:00.5' is of another form than the times before it");
  CHECK(rows({"t,v\n0,1\n1 5,2\n"}) == "FILE:3: field 1 (t): '1 5' is not a number" + digits_alone);
  CHECK(rows({"t,v\n0,1\n1 x,2\n"}) == "FILE:3: field 1 (t): '1 x' is not a number" + digits_alone);
  for (const char* text : {"t;v\n1 000;2\n",
                           "t;v\n1\xE2\x80\xAF"
                           "000;2\n"})
    CHECK(rows({text}) == "FILE:2: field 1 (t): '1 000' is not a number" + digits_alone);
  CHECK(rows({"t;v\n1.000,5;2\n"}) ==
        "FILE:2: field 1 (t): '1.000,5' is not a number" + digits_alone);
  CHECK(rows({"t v\n5\xC2\xA0 2\n"}) == "FILE:2: field 1 (t): '5 ' is not a number" + digits_alone);
}

TEST_CASE("reader: two decimal marks in one file are refused", "[text]") {
  CHECK(rows({"t;v\n0,5;1\n1.5;2\n"}) ==
        "FILE:3: field 1: the decimal mark of '1.5' is not that of the numbers before it");
  CHECK(rows({"t;v\n0.5;1\n1,5;2\n"}) ==
        "FILE:3: field 1 (t): '1,5' is not a number" + digits_alone);
  CHECK(rows({"0.5 1\n1,5 2\n"}) == "FILE:2: field 1 (t): '1,5' is not a number" + digits_alone);
  CHECK(rows({"t\tv\n0\t998\n1\t1,002\n"}) ==
        "FILE:3: field 2: '1,002' can be read in two ways: if its comma is a decimal one, replace "
        "it by "
        "a point, else remove it");
  CHECK(rows({"t\tv\n0,0\t1,002\n"}) == "0 1.002");
  CHECK(rows({"t;v\n0;1,234,567\n"}) ==
        "FILE:2: field 2 (v): '1,234,567' is not a number" + digits_alone);
  CHECK(rows({"t;v\n0;1,234.5\n"}) ==
        "FILE:2: field 2 (v): '1,234.5' is not a number" + digits_alone);
}

TEST_CASE("reader: --use says which column serves, by name or number", "[text]") {
  CHECK(rows({"0 1 2\n1 3 4\n"}, use({"v=3"})) == "0 2 | 1 4");
  CHECK(rows({"# time_of_day speed_of_light\n0 1\n"}, use({"t=time_of_day", "v=speed_of_light"})) ==
        "0 1");
  CHECK(rows({"# t v\n0 1\n"}, use({"t=v", "v=t"})) == "1 0");
  CHECK(rows({"# t w[rpm]\n0 1\n"}, use({"v=w"})) ==
        "FILE: column 'w[rpm]' cannot serve as v: its unit 'rpm' is not one of those known (m/s, "
        "mm/s, cm/s, km/h, mph, ft/s); convert it first (rolling-recipes(7)) or say --use "
        "'v=2[UNIT]'");
  CHECK(rows({"0 1 72\n"}, use({"v=3[km/h]"})) == "0 20");
  CHECK(rows({"# t w\n0 72\n"}, use({"v=w[MPH]"})) == "0 32.18688");
  CHECK(rows({"# t w[m/s]\n0 72\n"}, use({"v=w[km/h]"})) == "0 20");
  CHECK(rows({"1 2 3 40\n"}, use({"t=4[ms]", "v=2"})) == "0.04 2");
  CHECK(rows({"1 2 3 40\n"}, use({"t=4"})) ==
        "FILE:1: there is no column 'v' among 4 columns without names; if this line is a heading, "
        "begin it with #, or say --use v=COLUMN");
  CHECK(rows({"# t w[km/h]\n0 72\n"}, use({"v=w"})) == "0 20");
  CHECK(rows({"0 1 2\n"}, use({"Velocity=3"})) == "0 2");  // the long name is the same quantity
}

TEST_CASE("reader: a comma that may separate thousands is refused, whatever minus stands before it",
          "[text]") {
  const std::string two_ways =
      "can be read in two ways: if its comma is a decimal one, replace it by a point, else remove "
      "it";
  CHECK(rows({"t\tv\n0\t-1,002\n"}) == "FILE:2: field 2: '-1,002' " + two_ways);
  CHECK(rows({"t\tv\n0\t\xE2\x88\x92"
              "1,002\n"}) == "FILE:2: field 2: '???1,002' " + two_ways);
  // In a column that is not needed it is text, but then no decimal comma may follow.
  CHECK(rows({"x\tt\tv\n1,002\t0\t1\n3\t1\t2\n"}) == "0 1 | 1 2");
  CHECK(rows({"x\tt\tv\n1,002\t0\t1\n3,5\t1\t2\n"}) ==
        "FILE:3: field 1: '3,5' has a decimal comma, and the mark of a number before it could be "
        "read in two ways: replace each decimal comma by a point, and remove each other mark");
}

TEST_CASE("reader: in a file separated by tabs, a tab in front is a blank field", "[text]") {
  CHECK(rows({"note\ttag\tt\tv\nx\t#1\t0\t1\n\t#2\t1\t2\n\t## 3\t2\t3\n"}) == "0 1 | 1 2 | 2 3");
  CHECK(rows({"note\tt\tv\n\t# remark\nx\t0\t1\n"}) == "0 1");
  CHECK(rows({"t,v\n\t# remark\n0,1\n"}) == "0 1");
}

TEST_CASE("reader: tabs between names separate the fields, though blanks stand between numbers",
          "[text]") {
  CHECK(rows({"# t\tv\tnote\n0\t1\t1 2\n1\t2\t3\n"}) == "0 1 | 1 2");
  CHECK(rows({"t\tv\tnote\n0\t1\t1 2\n1\t2\t3\n"}) == "0 1 | 1 2");
  CHECK(rows({"# t v x\n0\t1 2\n1\t2 3\n"}) == "0 1 | 1 2");
}

TEST_CASE("reader: a carriage return or a NUL within a line is refused wherever it stands",
          "[text]") {
  const std::string refused =
      "FILE:2: a carriage return within the line; make the line ends LF first (tr '\\r' '\\n')";
  CHECK(rows({"0 1 a\n1 2 b\rc\n"}) == refused);
  CHECK(rows({"0 1 a\n# b\rc\n1 2 a\n"}) == refused);
  CHECK(rows({"0,1,a\n1,2,\"b\rc\"\n"}) == refused);
  CHECK(rows({std::string("0 1 a\n1 2 \0\n", 12)}).starts_with("FILE:2: a NUL byte"));
}

TEST_CASE("reader: a unit that only a comment gives is not passed over", "[text]") {
  const std::string line = "v is column 2, 'v', taken in m/s although line 1 says km/h";
  CHECK(told("# v [km/h]: by a GPS\n# t v\n0 36\n") == line);
  CHECK(told("t [s], v [km/h] and a remark\n\nt,v\n0,36\n") == line);
  CHECK(told("# v [km/h]: by a GPS\n# t v\n0 36\n", use({"v=v[km/h]"})).empty());
  CHECK(told("# v [km/h]: by a GPS\n# t v[m/s]\n0 36\n").empty());
  CHECK(told("# v [m/s]: by a GPS\n# x [cm]\n# t v\n0 36\n").empty());
}

TEST_CASE("reader: no words about units are passed over, whatever names the columns", "[text]") {
  struct Form {
    std::string before, behind;  // what stands around the words
    std::vector<std::string> use;
  };
  const std::vector<std::string> by_name = {"t=A", "v=B"}, by_number = {"t=1", "v=2"};
  const Form forms[] = {
      {"# ", "\n0\t1\n", {}},
      {"# ", "\n# t\tv\n0\t1\n", {}},
      {"# t\tv\n# ", "\n0\t1\n", {}},
      {"# ", "\nt,v\n0,1\n", {}},
      {"", "\nt,v\n0,1\n", {}},
      {"# ", "\n# A\tB\n0\t1\n", by_name},
      {"", "\nA;B\n0;1\n", by_name},
      {"# ", "\n0 1\n", by_number},
      {"t,v\n0,1\n\n# ", "\n2,3\n", {}},
  };
  for (const auto& [before, behind, use_columns] : forms) {
    for (const char* words :
         {"times are in ms", "speed: km/h", "Units: ms and cm/s",
          "all speeds in kilometres per hour", "speed in knots", "Velocity (cm/s) from a camera"}) {
      INFO(before << words << behind);
      CHECK_FALSE(told(before + words + behind, use(use_columns)).empty());
    }
    for (const char* words : {"times are in s", "speed is in m/s", "x and D in mm"}) {
      INFO(before << words << behind);
      CHECK(told(before + words + behind, use(use_columns)).find(" says ") == std::string::npos);
    }
  }
}

TEST_CASE("reader: units are converted, and go out converted", "[text]") {
  CHECK(rows({"# t[ms] v[km/h]\n0 72\n40 36\n"}) == "0 20 | 0.04 10");
  CHECK(copies("# t[ms] v[km/h] x[mm]\n40 36 007\n") ==
        "<0.04\t10\t007>");  // x is not needed: as it came
  CHECK(
      rows({"# t[parsec] v\n0 1\n"}) ==
      "FILE: column 't[parsec]' cannot serve as t: its unit 'parsec' is not one of those known (s, "
      "sec, ms, us, ns, min, h); convert it first (rolling-recipes(7)) or say --use 't=1[UNIT]'");
  CHECK(rows({"# t[h] v\n1e308 1\n"}) ==
        "FILE:2: field 1 (t): '1e308' is beyond the range of a double in SI units");
}

TEST_CASE("reader: what is neither number nor missing is refused, and says where", "[text]") {
  CHECK(rows({"0 1\n1 abc\n"}) == "FILE:2: field 2 (v): 'abc' is not a number" + hint);
  CHECK(rows({"0 1\n\n# c\n1 inf\n"}) == "FILE:4: field 2 (v): 'inf' is not a number" + hint);
  CHECK(rows({"0 1\n1 1e400\n"}) == "FILE:2: field 2 (v): '1e400' is not a number" + digits_alone);
  const auto begins = [](const std::string& row, const std::string& message) {
    CHECK(rows({"0 1\n" + row}).starts_with(message));
  };
  begins("1 0x1\n", "FILE:2: field 2 (v): '0x1' is not a number");
  begins("1 " + std::string(50, '9') + "x\n",
         "FILE:2: field 2 (v): '" + std::string(40, '9') + "...' is not a number");
  CHECK(rows({"0 1\n1 \xE2\x88\x92"
              "1\n"}) == "FILE:2: field 2 (v): '???1' is not a number" + digits_alone);
}

TEST_CASE("reader: an empty file, a header alone, words alone", "[text]") {
  CHECK(rows({""}) == "FILE: no rows");
  CHECK(rows({"\n\n"}) == "FILE: no rows");
  CHECK(rows({"# t v\n"}) == "FILE: no rows");
  CHECK(rows({"t,v\n"}) == "FILE:1: no rows: no field of 't,v' is a number");
}

TEST_CASE("reader: a preamble becomes comments", "[text]") {
  const TemporaryFile file("Motion sensor, hall 3\nt,v\n0,1\n");
  const Reader in({.files = {file.name()}}, {});
  CHECK(in.comments() == Texts{"# Motion sensor, hall 3"});
}

TEST_CASE("reader: the names are the last comment with as many fields as the rows", "[text]") {
  CHECK(rows({"# t[ms] v[km/h]\n#----\n0 36\n"}) == "0 10");
  CHECK(rows({"# t[ms] v[km/h]\n# made on Tuesday\n0 36\n"}) == "0 10");
  CHECK(rows({"# t[ms], v[km/h]\n0 36\n"}) == "0 10");
  CHECK(rows({"# t[s] v[cm s^-1]\n0 100\n"}) == "0 1");
  CHECK(rows({"# t[ms] v[km/h] n\n# made on Tuesday\n0 36 1\n"}) == "0 10");
  CHECK(rows({"# t[ms] v[km/h] x[m]\n0 36\n"}) ==
        "FILE:1: '# t[ms] v[km/h] x[m]' may be the names of the columns, or a sentence: put tabs "
        "between names, one for each of 2 columns, behind one #; or give the sentence another "
        "number of words");
  CHECK(told("# Speed (km/h) from GPS\n0 36\n") ==
        "t is column 1, taken in s; v is column 2, taken in m/s although line 1 says km/h");
  CHECK(rows({"# t[s] v[m/s]\n0 1\n# t[ms] v[km/h]\n1000 36\n"}) ==
        "FILE:3: names among the rows; if another run begins here, put a blank line before it");
}

TEST_CASE("reader: a separator at an end of the commented names begins no name", "[text]") {
  for (const char* names : {"# t[ms];v[km/h];", "#;t[ms];v[km/h]", "#;t[ms];v[km/h];;"})
    CHECK(rows({fmt::format("{}\n0;36\n", names)}) == "0 10");
  CHECK(rows({"#,v,x,t,\n1,2,3\n"}) == "3 1");
  CHECK(rows({"\"# t (ms)\",\"v (km/h)\"\n0,36\n"}) == "0 10");
}

TEST_CASE("reader: names behind the rows of a file that has none above are refused", "[text]") {
  for (const char* end : {"## p\n# v t\n", "\n# v t\n", "## p\n# v t\n# q\n"})
    CHECK(rows({fmt::format("1 0\n2 1\n{}", end), "2 3\n"}) ==
          "FILE: the names of the columns stand behind the last row; put them above the first");
  CHECK(rows({"# t v\n1 0\n## p\n# v t\n"}) == "1 0");
  CHECK(rows({"1 0\n\n# made on Tuesday\n"}) == "1 0");
}

TEST_CASE("reader: a tool that ended with an error is refused, wherever it says so", "[text]") {
  for (const std::string text :
       {"## smooth: ended with an error\n", "0 1\n## smooth: ended with an error\n",
        "0 1\n\n## smooth: ended with an error\n", "# t v\n## smooth: ended with an error\n0 1\n",
        "t,v\n0,1\n## smooth: ended with an error,\n"}) {
    INFO(text);
    const std::string message = rows({text});
    CHECK(message.substr(message.find(": ")) ==
          ": smooth ended with an error: the rows are not complete");
  }
  CHECK(rows({"## no error: ended with an error\n0 1\n"}) == "0 1");
}

TEST_CASE("reader: what passes through passes byte for byte, its separator aside", "[text]") {
  CHECK(copies("0.500   +1e0 x_y -0 1E-400\n") == "<0.500\t+1e0\tx_y\t-0\t1E-400>");
  CHECK(copies("t;v;note\n0;1;caf\xC3\xA9 au lait \n") == "<0\t1\tcaf\xC3\xA9 au lait>");
}

TEST_CASE("reader: a row goes out without the text of a column, and says where it stood",
          "[text]") {
  const TemporaryFile file("00 1.50 xyz\n");
  Reader in({.files = {file.name()}}, {"t", "v"});
  in.need("v");
  REQUIRE(in.next_run());
  REQUIRE(in.next());
  Bytes text;
  text.append(std::string_view("before"));
  CHECK(in.append_text(text, 1) == 3);
  CHECK(std::string_view(text.data(), text.size()) == "before00\t\txyz");
  CHECK(in.append_text(text) == 11);
  CHECK(std::string_view(text.data(), text.size()) == "before00\t\txyz00\t1.50\txyz");
  CHECK(in.where() == file.name() + ":1");
}

TEST_CASE("reader: a separator at the end of a line is no column", "[text]") {
  CHECK(names("t\tv\t\n0\t1\t\n1\t2\t\n") == "t v");
  CHECK(names("# t\tv\t\n0\t1\t\n") == "t v");
  CHECK(names("# t\tv\n0\t1\t\n") == "t v");
  CHECK(names("t\tv\t\n0\t1\t5\n") == "t v c3");
  CHECK(copies("t\tv\t\n0\t1\t\n") == "<0\t1>");
  CHECK(copies("t\tv\t\n0\t1\t\n1\t2\n") == "<0\t1><1\t2>");
  CHECK(copies("0\t1\n1\t2\t\n") == "<0\t1><1\t2>");
  CHECK(copies("t\tv\n0\t1\n1\t2\t\n") == "<0\t1><1\t2>");
  CHECK(rows({"t,v,\n0,1,\n1,2,\n"}) == "0 1 | 1 2");
  CHECK(rows({"t,v,\n0,1\n1,2,\n"}) == "0 1 | 1 2");
  CHECK(rows({"t,v\n0,1,\n1,2\n"}) == "0 1 | 1 2");
  CHECK(rows({"t,v\n0,1,7\n"}) ==
        "FILE:2: 3 fields under a line of 2 names: begin that with # if it is no header, put "
        "quotes around names that hold a separator, and make decimal commas points");
}

TEST_CASE("reader: a quoted field may hold separators and line ends", "[text]") {
  CHECK(rows({"\"t\",\"v, of\nthe cart\"\n0,1\n"}, {}, {"t", "v,_of_the_cart"}) == "0 1");
  CHECK(rows({"note,t,v\n\"one\ntwo, three\",0,1\nfour,1,x\n"}) ==
        "FILE:4: field 3 (v): 'x' is not a number" + hint);
  CHECK(rows({"t,v,note\n0,1,\"open\n1,2,x\n"}) == "FILE:2: a quote that is not closed");
}
