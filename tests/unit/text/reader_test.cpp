#include "text/reader.h"

#include <fmt/format.h>

#include <memory>

#include "unit/text/files.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

using Texts = std::vector<std::string>;

/// All that a reader gives of t and v (or `wanted`) in files of these texts: records as "t v", " |
/// " between them, " || " between runs; or the message that refuses them.
std::string records(const Texts& texts, ReaderOptions options = {},
                    const std::vector<std::string>& wanted = {"t", "v"}) {
  std::vector<std::unique_ptr<TemporaryFile>> files;
  for (const std::string& text : texts) {
    files.push_back(std::make_unique<TemporaryFile>(text));
    options.files.push_back(files.back()->name());
  }
  std::string all;
  const std::string message = refusal([&] {
    Reader in(options, {"t", "v"});
    std::vector<std::size_t> slots;
    for (const std::string& name : wanted)
      slots.push_back(name == "t" ? in.need_time() : in.need(name));
    for (bool first_run = true; in.next_run(); first_run = false) {
      if (!first_run) all += " || ";
      for (bool first = true; in.next(); first = false) {
        if (!first) all += " | ";
        for (std::size_t i = 0; i < slots.size(); ++i)
          all += fmt::format("{}{}", i ? " " : "", in[slots[i]]);
      }
    }
  });
  return message.empty() ? all : anonymous(message);
}

/// The records as they would pass through, lines in < >.
std::string copies(const std::string& text, ReaderOptions options = {},
                   const std::vector<std::string>& wanted = {"t", "v"}) {
  const TemporaryFile file(text);
  options.files = {file.name()};
  Bytes all;
  Reader in(options, {"t", "v"});
  for (const std::string& name : wanted) in.need(name);
  while (in.next_run())
    while (in.next()) {
      all.append('<');
      in.append_text(all);
      all.append('>');
    }
  return {all.data(), all.size()};
}

std::string names(const std::string& text) {
  const TemporaryFile file(text);
  Reader in({{file.name()}, {}, {}, false}, {"t", "v"});
  std::string all;
  for (const Column& column : in.columns()) all += (all.empty() ? "" : " ") + to_text(column);
  return all;
}

ReaderOptions use(const Texts& what) { return {{}, what, {}, false}; }
ReaderOptions run(int number) { return {{}, {}, number, false}; }
const ReaderOptions strict{{}, {}, {}, true};

}  // namespace

TEST_CASE("reader: blanks, tabs, commas and semicolons separate", "[text]") {
  CHECK(records({"0 1\n1 2\n"}) == "0 1 | 1 2");
  CHECK(records({"  0   1  \n\t1 \t2\n"}) == "0 1 | 1 2");
  CHECK(records({"0\t1\n1\t2\n"}) == "0 1 | 1 2");
  CHECK(records({"0,1\n1,2\n"}) == "0 1 | 1 2");
  CHECK(records({"0 , 1\n 1,\t2\n"}) == "0 1 | 1 2");
  CHECK(records({"0;1\n1;2\n"}) == "0 1 | 1 2");
  CHECK(records({"0 1\n1 2"}) == "0 1 | 1 2");
}

TEST_CASE("reader: the first record sets the separator, and the others have it", "[text]") {
  CHECK(records({"0,1\n1;2\n"}) == "FILE:2: 1 field where the first record has 2");
  CHECK(records({"0\t1\n1 2\n"}) == "FILE:2: 1 field where the first record has 2");
  CHECK(records({"0 1\n1 2 3\n"}) == "FILE:2: 3 fields where the first record has 2");
  CHECK(records({"0,1\n1,2,\n"}) ==
        "FILE:2: 3 fields where the first record has 2; if some of its commas are decimal ones, "
        "make them points first");
}

TEST_CASE("reader: names in the last # line before the data", "[text]") {
  CHECK(records({"# v[m/s]\tt[s]\n5 0\n"}) == "0 5");
  CHECK(records({"# v t\n5,0\n"}) == "0 5");
  CHECK(records({"# v, t\n5,0\n"}) == "0 5");
  CHECK(records({"#v;t\n5;0\n"}) == "0 5");
  CHECK(records({"# Velocity (m/s) Time (s)\n5 0\n"}) == "0 5");
  CHECK(records({"# made by me\n# on a Monday\n# v t\n5 0\n"}) == "0 5");
  CHECK(records({"# v t\n## smooth v mean width 3\n5 0\n"}) == "0 5");
  CHECK(records({"# v t\n# three words here\n5 0\n"}) ==
        "0 5");  // a remark: not as many names as columns
  CHECK(records({"#\n#\n5 0\n"}) == "5 0");
}

TEST_CASE("reader: names in a first line that is not numeric", "[text]") {
  CHECK(records({"v t\n5 0\n"}) == "0 5");
  CHECK(records({"Velocity (m/s),Time (s)\n5,0\n"}) == "0 5");
  CHECK(records({"Velocity (m/s);Time (s)\n5;0\n"}) == "0 5");
  CHECK(records({"Velocity (m/s)\tTime (s)\n5\t0\n"}) == "0 5");
  CHECK(records({"# a comment\n\nv t\n\n5 0\n"}) == "0 5");
  CHECK(records({"A preamble of words\nv t\n5 0\n"}) == "0 5");
  CHECK(records({"t v a\n0 5\n"}) == "FILE:2: 2 fields under a line of 3 names");
  CHECK(records({"t v\n0\n"}) == "FILE:2: 1 field under a line of 2 names");
  CHECK(records({"t v\r\n0 5\r\n\x1A"}) == "0 5");
  CHECK(records({"# t\tv\n0\t5\n\n# t v\n0 7\n"}) ==
        "FILE:5: '0 7' is separated by blanks, and the records before by tabs; if it is a heading, "
        "begin it with #");
  CHECK(records({"t v\n0 5\n\nt;v\n0,5;7\n"}) ==
        "FILE:5: '0,5;7' is separated by ';', and the records before by blanks; if it is a "
        "heading, begin it with #");
  CHECK(records({"t,v\n0,5\n\n0;\n"}) ==
        "FILE:4: '0;' is separated by ';', and the records before by ','; if it is a heading, "
        "begin it with #");
  CHECK(records({"# t\tv\n0\t5\n\n0;7;note\n"}) ==
        "FILE:4: '0;7;note' is separated by ';', and the records before by tabs; if it is a "
        "heading, begin it with #");
  CHECK(records({"t,v\n0,5\n\nRun 2\n\nThe end of 3 runs\n\n1. try\n"}) == "0 5");
  const std::string hint = "; if this line is not a record, begin it with #";
  // Quotes that are none in this file do not make a record a line of names, or a remark.
  CHECK(records({"# t v\n\"0\" \"5\"\n1 6\n"}, use({"t=1", "v=2"})) ==
        "FILE:2: field 1 (t): '\"0\"' is not a number" + hint);
  CHECK(records({"t,v\n'0','5'\n1,6\n"}) == "FILE:2: field 1 (t): ''0'' is not a number" + hint);
  CHECK(records({"t v\n0 5\n\n\"1\" \"6\"\n"}) ==
        "FILE:4: field 1 (t): '\"1\"' is not a number" + hint);
  CHECK(records({"t,v\n0,5\n\nSecond\n0,5\n"}) ==
        "FILE:5: 2 fields under a line of 1 name; if line 4 is a heading, begin it with #");
  CHECK(records({"\"Velocity (m/s)\",\"Time (s)\"\n5,0\n"}) == "0 5");
}

TEST_CASE("reader: names of columns that no tool knows, and of none", "[text]") {
  CHECK(names("# t[s] Angle (rad) w[rad/s]\n0 1 2\n") == "t[s] Angle[rad] w[rad/s]");
  CHECK(names("Time (s),,Angular Velocity (rad/s)\n0,1,2\n") == "t[s] c2 Angular_Velocity[rad/s]");
  CHECK(names("0 1 2 3\n") == "t[s] v[m/s] c3 c4");
  CHECK(names("# one word for two columns\n0 1\n") == "t[s] v[m/s]");
  CHECK(names("# x\n0 1\n") == "t[s] v[m/s]");  // fewer names than columns: a comment
}

TEST_CASE("reader: byte order mark, CR LF, quotes", "[text]") {
  CHECK(records({"\xEF\xBB\xBF"
                 "v,t\r\n5,0\r\n\r\n6,0\r\n"}) == "0 5 || 0 6");
  CHECK(records({"\xEF\xBB\xBF"
                 "5,0\r\n"}) == "5 0");
  CHECK(records({"\xEF\xBB\xBFt,v\n0,5\n\n\xEF\xBB\xBFt,v\n0,6\n"}) == "0 5 || 0 6");
  CHECK(records({"\"t\",\"v\"\n\"0\",\"5\"\n\"1\",6\n"}) == "0 5 | 1 6");
  CHECK(copies("t,v,note\n0,5,\"a, \"\"b\"\"\"\n") == "<0\t5\t\"a, \"\"b\"\"\">");
  CHECK(copies("t,v,u\n0,0,\"\"\"\"\n") == "<0\t0\t\"\"\"\">");  // quoted where it has to be
  CHECK(copies("u,t,v\n\"#1\",0,5\n\"a\tb\",1,5\n\"a\nb\",2,5\n") ==
        "<\"#1\"\t0\t5><\"a\tb\"\t1\t5><\"a\nb\"\t2\t5>");
  CHECK(records({"t,v\n0,\"1\"5\n"}) == "FILE:2: field 2: text behind the quote that closes '1'");
}

TEST_CASE("reader: a decimal comma where ; or tab separates", "[text]") {
  CHECK(records({"t;v\n0,5;1,25\n1;2\n1,5;-3,5e2\n"}) == "0.5 1.25 | 1 2 | 1.5 -350");
  CHECK(records({"t\tv\n0,5\t1,25\n"}) == "0.5 1.25");
  CHECK(copies("t;v\n0,50;+1,250\n") == "<0.50\t+1.250>");  // only the mark changes
}

TEST_CASE("reader: a first record that has decimal commas only is a record, not names", "[text]") {
  CHECK(records({"0,0;1,5\n0,1;1,6\n"}) == "0 1.5 | 0.1 1.6");
  CHECK(records({"Zeit (s);v (m/s)\n0,0;1,5\n1;1,6\n"}, use({"t=1"})) == "0 1.5 | 1 1.6");
  CHECK(records({"t\tv\n0,0\t1,5\n1\t2\n"}) == "0 1.5 | 1 2");
}

TEST_CASE("reader: a first record whose readings are all missing is a record, not names",
          "[text]") {
  CHECK(records({"# t v\nNaN NaN\n0 1\n"}) == "0 1");
  CHECK(records({"t,v\nNaN,nan\n0,1\n"}) == "0 1");
  CHECK(records({"NaN NaN\n0 1\n"}) == "0 1");
  CHECK(records({"t,v\n,\n0,1\n"}) == "0 1");
  CHECK(records({"# v t\n;\n5;0\n"}) == "0 5");
  CHECK(records({"# v t\n## smooth v mean width 3\n;\n5;0\n"}) == "0 5");
  CHECK(records({"t,v\n,\n0,1\n"}, strict) == "FILE:2: field 1 (t): a reading is missing");
  CHECK(records({"My cart,\n,\nt,v\n0,1\n"}) == "0 1");  // blank cells of a preamble
}

TEST_CASE("reader: a line of tabs is a blank line, in a file delimited by tabs too", "[text]") {
  CHECK(records({"t\tv\n0\t1\n\t\n0\t2\n"}) == "0 1 || 0 2");
  CHECK(records({"t,v\n0,1\n,\n1,2\n"}) == "0 1 | 1 2");
}

TEST_CASE("reader: a separator at the ends of lines may be left out in the second run too",
          "[text]") {
  CHECK(records({"t,v,\n0,1,\n1,2\n\n2,3,\n3,4\n"}) == "0 1 | 1 2 || 2 3 | 3 4");
}

TEST_CASE("reader: units that a comment gives to the columns of the second run alone", "[text]") {
  CHECK(records({"# t v F\n0 1 2\n\n# s cm/s N\n2 3 4\n"}) ==
        "FILE:5: column 'v' cannot serve as v: is it in cm/s, as line 4 says? Write the unit in "
        "brackets or say --use v=2[UNIT]");
}

TEST_CASE("reader: what is no number is refused with what to do about it", "[text]") {
  CHECK(records({"t,v\n0,1\n10:15:00.5,2\n"}) ==
        "FILE:3: field 1 (t): '10:15:00.5' is not a number; make it one number of seconds first");
  CHECK(records({"t,v\n0,1\n1 5,2\n"}) ==
        "FILE:3: field 1 (t): '1 5' is not a number; if a comma here is a decimal one, make it a "
        "point first");
  CHECK(records({"t,v\n0,1\n1 x,2\n"}) == "FILE:3: field 1 (t): '1 x' is not a number");
  for (const char* text : {"t,v\n1 000,2\n", "t;v\n1 000;2\n",
                           "t;v\n1\xE2\x80\xAF"
                           "000;2\n"})
    CHECK(records({text}) ==
          "FILE:2: field 1 (t): '1 000' is not a number; remove what separates its thousands");
  CHECK(records({"t;v\n1.000,5;2\n"}) ==
        "FILE:2: field 1 (t): '1.000,5' is not a number; remove what separates its thousands");
  CHECK(records({"t v\n5\xC2\xA0 2\n"}) ==
        "FILE:2: field 1 (t): '5 ' is not a number; remove the blanks that are not plain ones");
}

TEST_CASE("reader: two decimal marks in one file are refused", "[text]") {
  CHECK(records({"t;v\n0,5;1\n1.5;2\n"}) ==
        "FILE:3: field 1: the decimal mark of '1.5' is not that of the numbers before it");
  CHECK(records({"t;v\n0.5;1\n1,5;2\n"}) ==
        "FILE:3: field 1 (t): '1,5' is not a number; if a comma here is a decimal one, make it a "
        "point first");
  CHECK(records({"0.5 1\n1,5 2\n"}) ==
        "FILE:2: field 1 (t): '1,5' is not a number; if a comma here is a decimal one, make it a "
        "point first");
  CHECK(records({"t\tv\n0\t998\n1\t1,002\n"}) ==
        "FILE:3: field 2: '1,002' can be read in two ways: if its comma is a decimal one, replace "
        "it by "
        "a point, else remove it");
  CHECK(records({"t\tv\n0,0\t1,002\n"}) == "0 1.002");
  CHECK(records({"t;v\n0;1,234,567\n"}) ==
        "FILE:2: field 2 (v): '1,234,567' is not a number; remove what separates its thousands");
  CHECK(records({"t;v\n0;1,234.5\n"}) ==
        "FILE:2: field 2 (v): '1,234.5' is not a number; remove what separates its thousands");
}

TEST_CASE("reader: blank lines end a run, however many", "[text]") {
  CHECK(records({"0 1\n1 2\n\n0 3\n"}) == "0 1 | 1 2 || 0 3");
  CHECK(records({"\n\n0 1\n \n\t\n\n0 3\n\n\n"}) == "0 1 || 0 3");
  CHECK(records({"0 1\n# a comment is no break\n1 2\n"}) == "0 1 | 1 2");
  CHECK(records({"t,v\n0,1\n\nt,v\n0,2\n"}) == "0 1 || 0 2");  // each run under its own names line
  CHECK(records({"t,v\n0,1\nt,v\n1,2\n"}) ==
        "FILE:3: field 1 (t): 't' is not a number; put a blank line before the names of "
        "another run");
}

TEST_CASE("reader: files in order, a run break between them", "[text]") {
  CHECK(records({"0 1\n1 2\n", "0 3\n"}) == "0 1 | 1 2 || 0 3");
  CHECK(records({"0 1", "0 3"}) == "0 1 || 0 3");
  CHECK(records({"# t v\n0 1\n", "t,v\n0,3\n"}) ==
        "0 1 || 0 3");  // the form is each file's own, the columns are not
  CHECK(records({"0 1\n\n", "\n0 3\n"}) == "0 1 || 0 3");
  CHECK(records({"# t v\n0 1\n", "# v t\n0 3\n"}) == "0 1 || 3 0");
  CHECK(records({"# t[s] v[m/s]\n0 1\n", "# t[ms] v[m/s]\n7 3\n"}) == "0 1 || 0.007 3");
  CHECK(records({"# t v\n0 1\n", "0 3\n"}) ==
        "FILE: its columns are not those of FILE: those have names; give it a line of names");
  CHECK(records({"0 1\n", "0 3 4\n"}) ==
        "FILE: its columns are not those of FILE: 3, not 2; give it a line of names");
  CHECK(records({"0 1\n", ""}) == "FILE: no records");
}

TEST_CASE("reader: a second file that is not there is refused, and where() is still safe",
          "[text]") {
  const TemporaryFile file("0 1\n");
  Reader in({{file.name(), "/no/such/file"}, {}, {}, false}, {"t", "v"});
  in.need_time();
  REQUIRE(in.next_run());
  REQUIRE(in.next());
  CHECK_FALSE(in.next());
  CHECK(refusal([&] { in.next_run(); }) == "/no/such/file: No such file or directory");
  CHECK(in.where().empty());
}

TEST_CASE("reader: --use says which column serves, by name or number", "[text]") {
  CHECK(records({"0 1 2\n1 3 4\n"}, use({"v=3"})) == "0 2 | 1 4");
  CHECK(records({"# time_of_day speed_of_light\n0 1\n"},
                use({"t=time_of_day", "v=speed_of_light"})) == "0 1");
  CHECK(records({"# t v\n0 1\n"}, use({"t=v", "v=t"})) == "1 0");
  CHECK(records({"# t w[rpm]\n0 1\n"}, use({"v=w"})) ==
        "FILE: column 'w[rpm]' cannot serve as v: its unit 'rpm' is not one of those known (m/s, "
        "mm/s, cm/s, km/h, mph, ft/s); convert it first or say --use v=2[UNIT]");
  CHECK(records({"0 1 72\n"}, use({"v=3[km/h]"})) == "0 20");
  CHECK(records({"# t w\n0 72\n"}, use({"v=w[MPH]"})) == "0 32.18688");
  CHECK(records({"# t w[m/s]\n0 72\n"}, use({"v=w[km/h]"})) ==
        "FILE: --use v says km/h, but the column's name w[m/s]");
  CHECK(records({"1 2 3 40\n"}, use({"t=4[ms]", "v=2"})) == "0.04 2");
  CHECK(records({"1 2 3 40\n"}, use({"t=4"})) ==
        "FILE: there is no column 'v' among 4 columns without names; say --use v=COLUMN");
  CHECK(records({"# t w[km/h]\n0 72\n"}, use({"v=w"})) == "0 20");
  CHECK(records({"0 1 2\n"}, use({"Velocity=3"})) == "0 2");  // the long name is the same quantity
}

TEST_CASE("reader: --run picks one, by its printed number or its place", "[text]") {
  CHECK(records({"0 1\n\n0 2\n1 3\n\n0 4\n"}, run(2)) == "0 2 | 1 3");
  CHECK(records({"0 1\n\n0 2\n"}, run(1)) == "0 1");
  CHECK(records({"0 1\n\n0 bad\n\n0 4\n"}, run(3)) == "0 4");  // what is not read is not judged
  CHECK(records({"0 1\n", "0 2\n", "0 3\n"}, run(2)) == "0 2");
  CHECK(records({"Time (s) Run #7,Velocity (m/s) Run #7\n0,1\n"}, run(7)) == "0 1");
  CHECK(records({"0 1\n\n0 2\n"}, run(3)) == "there is no run 3 (runs: 2)");
  CHECK(records({"t Run 2,v Run 2,t Run 4,v Run 4\n0,1,0,5\n"}, run(4)) == "0 5");
  CHECK(records({"t Run 2,v Run 2,t Run 4,v Run 4\n0,1,0,5\n"}, run(3)) ==
        "there is no run 3 (runs: 2, 4)");
  CHECK(records({"t,v,t,v\n0,1,0,2\n", "t,v,t,v\n0,3,0,4\n"}, run(3)) == "0 3");
}

TEST_CASE("reader: --run picks one run and no other", "[text]") {
  const std::string second = ": another run 1; give the file of one of them alone";
  // Where names carry numbers, places do not count beside them.
  CHECK(records({"Latest: t,Latest: v,Run 1: t,Run 1: v\n0,1,0,5\n"}, run(1)) == "0 5");
  // The number of one run and the place of another, in blocks of a file and in two files.
  CHECK(records({"t,v\n0,1\n\nt Run #1,v Run #1\n0,7\n"}, run(1)) == "FILE:4" + second);
  CHECK(records({"t,v\n0,1\n", "t Run #1,v Run #1\n0,7\n"}, run(1)) == "FILE:1" + second);
  // The same number twice.
  CHECK(records({"t Run #1,v Run #1\n0,1\n\n0,7\n"}, run(1)) == "FILE:4" + second);
  CHECK(records({"t Run 1,v Run 1,t Run 2,v Run 2\n0,1,0,2\n\n0,3,0,4\n"}, run(1)) ==
        "FILE:4" + second);
}

TEST_CASE("reader: a comma that may separate thousands is refused, whatever minus stands before it",
          "[text]") {
  const std::string two_ways =
      "can be read in two ways: if its comma is a decimal one, replace it by a point, else remove "
      "it";
  CHECK(records({"t\tv\n0\t-1,002\n"}) == "FILE:2: field 2: '-1,002' " + two_ways);
  CHECK(records({"t\tv\n0\t\xE2\x88\x92"
                 "1,002\n"}) == "FILE:2: field 2: '???1,002' " + two_ways);
  // In a column that is not needed it is text, but then no decimal comma may follow.
  CHECK(records({"x\tt\tv\n1,002\t0\t1\n3\t1\t2\n"}) == "0 1 | 1 2");
  CHECK(records({"x\tt\tv\n1,002\t0\t1\n3,5\t1\t2\n"}) ==
        "FILE:3: field 1: '3,5' has a decimal comma, and the comma of a number before it could be "
        "read in two ways: replace each decimal comma by a point, and remove each other comma");
}

TEST_CASE("reader: in a file separated by tabs, a tab in front is a blank field", "[text]") {
  CHECK(records({"note\ttag\tt\tv\nx\t#1\t0\t1\n\t#2\t1\t2\n\t## 3\t2\t3\n"}) == "0 1 | 1 2 | 2 3");
  CHECK(records({"note\ttag\tt\tv\n\t#1\t0\t1\n\t## 2\t1\t2\n"}) == "0 1 | 1 2");
  CHECK(records({"# note\ttag\tt\tv\n\t#1\t0\t1\n\t## 2\t1\t2\n"}) == "0 1 | 1 2");
  CHECK(records({"note\tt\tv\n\t# remark\nx\t0\t1\n"}) == "0 1");
  CHECK(records({"t,v\n\t# remark\n0,1\n"}) == "0 1");
}

TEST_CASE("reader: tabs between names separate the fields, though blanks stand between numbers",
          "[text]") {
  CHECK(records({"# t\tv\tnote\n0\t1\t1 2\n1\t2\t3\n"}) == "0 1 | 1 2");
  CHECK(records({"t\tv\tnote\n0\t1\t1 2\n1\t2\t3\n"}) == "0 1 | 1 2");
  CHECK(records({"# t\tv x\n0\t1 2\n1\t2 3\n"}) == "0 1 | 1 2");
}

TEST_CASE("reader: a carriage return or a NUL within a line is refused wherever it stands",
          "[text]") {
  const std::string refused =
      "FILE:2: a carriage return within the line; make the line ends LF first (tr '\\r' '\\n')";
  CHECK(records({"0 1 a\n1 2 b\rc\n"}) == refused);
  CHECK(records({"0 1 a\n# b\rc\n1 2 a\n"}) == refused);
  CHECK(records({"0,1,a\n1,2,\"b\rc\"\n"}) == refused);
  CHECK(records({std::string("0 1 a\n1 2 \0\n", 12)}).starts_with("FILE:2: a NUL byte"));
}

TEST_CASE("reader: a unit that only a comment gives is not passed over", "[text]") {
  const std::string refused =
      "FILE: column 'v' cannot serve as v: is it in km/h, as line 1 says? Write the unit in "
      "brackets or say --use v=2[UNIT]";
  CHECK(records({"# v [km/h]: by a GPS\n# t v\n0 36\n"}) == refused);
  CHECK(records({"t [s], v [km/h] and a remark\n\nt,v\n0,36\n"}) == refused);
  CHECK(records({"# v [km/h]: by a GPS\n# t v\n0 36\n"}, use({"v=v[km/h]"})) == "0 10");
  CHECK(records({"# v [km/h]: by a GPS\n# t v[m/s]\n0 36\n"}) == "0 36");
  CHECK(records({"# v [m/s]: by a GPS\n# x [cm]\n# t v\n0 36\n"}) == "0 36");
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
          "all speeds in kilometres per hour", "time unit: min", "speed in knots",
          "Velocity (cm/s) from a camera", "t/ms, v/cm s^-1"}) {
      INFO(before << words << behind);
      CHECK(records({before + words + behind}, use(use_columns)).starts_with("FILE"));
    }
    for (const char* words : {"times are in s", "speed is in m/s", "x and D in mm"}) {
      INFO(before << words << behind);
      CHECK(records({before + words + behind}, use(use_columns)).starts_with("0 1"));
    }
  }
}

TEST_CASE("reader: units are converted, and go out converted", "[text]") {
  CHECK(records({"# t[ms] v[km/h]\n0 72\n40 36\n"}) == "0 20 | 0.04 10");
  CHECK(copies("# t[ms] v[km/h] x[mm]\n40 36 007\n") ==
        "<0.04\t10\t007>");  // x is not needed: as it came
  CHECK(
      records({"# t[parsec] v\n0 1\n"}) ==
      "FILE: column 't[parsec]' cannot serve as t: its unit 'parsec' is not one of those known (s, "
      "sec, ms, us, min, h); convert it first or say --use t=1[UNIT]");
  CHECK(records({"# t[h] v\n1e308 1\n"}) ==
        "FILE:2: field 1 (t): '1e308' is beyond the range of a double in SI units");
}

TEST_CASE("reader: a missing reading leaves its record out, and is counted", "[text]") {
  const TemporaryFile file("t,v,x\n0,1,\n1,,5\n2,NaN,5\n3,nan,\n4,2,NaN\n");
  Reader in({{file.name()}, {}, {}, false}, {});
  in.need_time();
  in.need("v");
  std::size_t seen = 0;
  while (in.next_run())
    while (in.next()) ++seen;
  CHECK(seen == 2);
  CHECK(in.left_out() == 3);
  CHECK(records({"t,v\n0,1\n1,\n2,3\n"}) == "0 1 | 2 3");
  CHECK(records({"t,v\n0,1\n1,\n"}, strict) == "FILE:3: field 2 (v): a reading is missing");
  CHECK(records({"t,v,x\n0,1,\n"}, strict) == "0 1");  // x is not needed
  CHECK(records({"t v\n0 1\n1 NaN\n"}, strict) == "FILE:3: field 2 (v): a reading is missing");
}

TEST_CASE("reader: what is neither number nor missing is refused, and says where", "[text]") {
  CHECK(records({"0 1\n1 abc\n"}) == "FILE:2: field 2 (v): 'abc' is not a number");
  CHECK(records({"0 1\n\n# c\n1 inf\n"}) == "FILE:4: field 2 (v): 'inf' is not a number");
  CHECK(records({"0 1\n1 1e400\n"}) == "FILE:2: field 2 (v): '1e400' is not a number");
  CHECK(records({"0 1\n1 0x1\n"}) == "FILE:2: field 2 (v): '0x1' is not a number");
  CHECK(records({"0 1\n1 " + std::string(50, '9') + "x\n"}) ==
        "FILE:2: field 2 (v): '" + std::string(40, '9') + "...' is not a number");
  CHECK(records({"0 1\n1 \xE2\x88\x92"
                 "1\n"}) ==
        "FILE:2: field 2 (v): '???1' is not a number; make its minus sign (U+2212) a hyphen first");
}

TEST_CASE("reader: time increases within a run, and starts anew in the next", "[text]") {
  CHECK(records({"0 1\n0 2\n"}) == "FILE:2: field 1 (t): '0' does not come after 0");
  CHECK(records({"1 1\n0.5 2\n"}) ==
        "FILE:2: field 1 (t): '0.5' does not come after 1; put a blank line before another run");
  CHECK(records({"# t[ms] v\n500 1\n500 2\n"}) ==
        "FILE:3: field 1 (t): '500' does not come after 0.5 s");
  CHECK(records({"5 1\n\n4 2\n"}) == "5 1 || 4 2");
  CHECK(records({"-1e308 1\n1e308 2\n"}) == "-1e+308 1 | 1e+308 2");
  CHECK(records({"0 1\n0 2\n"}, {}, {"v"}) == "1 | 2");  // who does not need t does not judge it
}

TEST_CASE("reader: an empty file, a header alone, words alone", "[text]") {
  CHECK(records({""}) == "FILE: no records");
  CHECK(records({"\n\n"}) == "FILE: no records");
  CHECK(records({"# t v\n"}) == "FILE: no records");
  CHECK(records({"t,v\n"}) == "FILE: no records");
  std::string words;
  for (int i = 0; i < 200; ++i) words += "once upon a time\n";
  CHECK(records({words}) == "FILE: no numbers in the first 100 lines");
}

TEST_CASE("reader: comments pass, those in front of a run apart from those among its records",
          "[text]") {
  const TemporaryFile file(
      "# by hand\n## smooth x mean width 3\n# t v\n0 1\n# among\n1 2\n# end\n\n# between\n0 3\n"
      "# after\n\n# last\n");
  Reader in({{file.name()}, {}, {}, false}, {"t", "v"});
  std::string all;
  const auto add = [&](const Texts& comments) {
    for (const std::string& comment : comments)
      if (!comment.starts_with("## run")) all += comment + ';';
  };
  while (in.next_run()) {
    all += '[';
    add(in.comments());
    all += ']';
    bool more = true;
    while (more) {
      more = in.next();
      add(in.remarks());
      if (more) all += '|';
    }
  }
  add(in.comments());
  CHECK(all == "[# by hand;## smooth x mean width 3;]|# among;|# end;[# between;]|# after;# last;");
}

TEST_CASE("reader: a preamble becomes comments", "[text]") {
  const TemporaryFile file("Motion sensor, hall 3\nt,v\n0,1\n");
  const Reader in({{file.name()}, {}, {}, false}, {});
  CHECK(in.comments() == Texts{"# Motion sensor, hall 3"});
}

TEST_CASE("reader: the history is that of the present run alone", "[text]") {
  const TemporaryFile first(
      "## smooth v mean width 3\n## differentiate v central\n# t v\n0 1\n\n0 2\n\n"
      "## smooth v mean width 5\n0 3\n"
      "## differentiate v central\n0 4\n"),  // which begins a run, without a blank line
      second("# t v\n0 5\n");
  Reader in({{first.name(), second.name()}, {}, {}, false}, {});
  std::string all;
  while (in.next_run()) {
    all += '[';
    for (const std::string& line : in.history()) all += line + ';';
    all += ']';
    while (in.next()) continue;
  }
  CHECK(all ==
        "[smooth v mean width 3;differentiate v central;][][smooth v mean width 5;]"
        "[differentiate v central;][]");
}

TEST_CASE("reader: --run gives the head of its run and nothing of another", "[text]") {
  const TemporaryFile file(
      "# one\n## smooth v mean width 3\n# t[s] v[m/s]\n0 1\n\n# two\n# t[ms] v[km/h] n\n0 36 1\n");
  Reader in({{file.name()}, {}, 2, false}, {});
  CHECK(in.history().empty());
  CHECK(in.comments() == Texts{"# two"});
  const auto v = in.need("v");
  CHECK(in.columns().size() == 3);
  REQUIRE(in.next_run());
  REQUIRE(in.next());
  CHECK(in[v] == 10);
}

TEST_CASE("reader: names and units hold until others come", "[text]") {
  const std::string first = "# t[s]\tv[m/s]\n0\t1\n\n";
  CHECK(records({first + "1\t2\n\n# t[ms]\tv[km/h]\n0\t36\n\n1000\t72\n"}) ==
        "0 1 || 1 2 || 0 10 || 1 20");
  CHECK(records({first + "# v[m/s]\tt[s]\n5\t7\n"}) == "0 1 || 7 5");
  CHECK(records({first + "# t[s]\tx[m]\tv[m/s]\n7\t8\t9\n"}) == "0 1 || 7 9");
  CHECK(records({first + "# second run\n1\t2\n"}) == "0 1 || 1 2");  // a remark of two words
  CHECK(records({first + "# t[s]\tx[m]\n1\t2\n"}) ==
        "FILE:4: there is no column 'v' among t[s], x[m]; say --use v=COLUMN");
  CHECK(records({first + "# t[s]\tv[furlong/s]\n1\t2\n"}) ==
        "FILE:4: column 'v[furlong/s]' cannot serve as v: its unit 'furlong/s' is not one of those "
        "known (m/s, mm/s, cm/s, km/h, mph, ft/s); convert it first or say --use v=2[UNIT]");
  CHECK(records({"# t w[rpm]\n0 1\n\n# t w[rad/s]\n0 2\n"}, {}, {"t", "w"}) ==
        "FILE:4: column w is in rad/s, and in rpm in the runs before");
  CHECK(records({"# t w\n0 1\n\n# t u\n0 2\n"}, {}, {"t", "2"}) ==
        "FILE:4: column 2 is u, and w in the runs before");
  CHECK(records({first + "1\t2\t3\n"}) == "FILE:4: 3 fields where the first record has 2");
}

TEST_CASE("reader: the names are the last comment with as many fields as the records", "[text]") {
  CHECK(records({"# t[ms] v[km/h]\n#----\n0 36\n"}) == "0 10");
  CHECK(records({"# t[ms] v[km/h]\n# made on Tuesday\n0 36\n"}) == "0 10");
  CHECK(records({"# t[ms], v[km/h]\n0 36\n"}) == "0 10");
  CHECK(records({"# t[s] v[cm s^-1]\n0 100\n"}) == "0 1");
  CHECK(records({"# t[ms] v[km/h] n\n# made on Tuesday\n0 36 1\n"}) == "0 10");
  CHECK(records({"# t[ms] v[km/h] x[m]\n0 36\n"}) ==
        "FILE:1: a comment with units, but not the names of 2 columns");
  CHECK(records({"# Speed (km/h) from GPS\n0 36\n"}) ==
        "FILE: column 'v' cannot serve as v: is it in km/h, as line 1 says? Write the unit in "
        "brackets or say --use v=2[UNIT]");
  CHECK(records({"# t[s] v[m/s]\n0 1\n# t[ms] v[km/h]\n1000 36\n"}) ==
        "FILE:3: names among the records; where another run begins, put a blank line before it");
}

TEST_CASE("reader: a run's name", "[text]") {
  const auto run_names = [](const Texts& texts, ReaderOptions options = {}) {
    std::vector<std::unique_ptr<TemporaryFile>> files;
    for (const std::string& text : texts)
      options.files.push_back(files.emplace_back(std::make_unique<TemporaryFile>(text))->name());
    Reader in(options, {"t", "v"});
    std::string all;
    while (in.next_run()) {
      const bool goes_out = !in.comments().empty() && in.comments()[0] == "## run " + in.run_name();
      all += (goes_out ? "<" : "(") + in.run_name() + (goes_out ? ">" : ")");
    }
    for (const auto& file : files) {
      const std::string name = file->name().substr(file->name().rfind('/') + 1);
      for (auto at = all.find(name); at != std::string::npos; at = all.find(name))
        all.replace(at, name.size(), "FILE");
    }
    return all;
  };
  CHECK(run_names({"0 1\n"}) == "(FILE)");
  CHECK(run_names({"0 1\n", "0 2\n\n0 3\n"}) == "<FILE><FILE 1><FILE 2>");
  CHECK(run_names({"t Run 7,v Run 7\n0,1\n\nt Run 9,v Run 9\n0,1\n"}) == "<FILE 7><FILE 9>");
  CHECK(run_names({"t Run 2,v Run 2,t Run 4,v Run 4\n0,1,0,5\n"}) == "<FILE 2><FILE 4>");
  CHECK(run_names({"## run a b\n0 1\n\n0 2\n"}) == "<a b><FILE 2>");
  CHECK(run_names({"0 1\n\n0 2\n"}, run(2)) == "(FILE 2)");
  const TemporaryFile file("0 1\n\n0 2\n");
  const Redirect from_file(STDIN_FILENO, file.name());
  CHECK(run_names({}) == "<1><2>");
}

TEST_CASE("reader: a tool that ended with an error is refused, wherever it says so", "[text]") {
  for (const std::string text :
       {"## smooth: ended with an error\n", "0 1\n## smooth: ended with an error\n",
        "0 1\n\n## smooth: ended with an error\n", "# t v\n## smooth: ended with an error\n0 1\n",
        "t,v\n0,1\n## smooth: ended with an error,\n"}) {
    INFO(text);
    const std::string message = records({text});
    CHECK(message.substr(message.find(": ")) ==
          ": smooth ended with an error: the records are not complete");
  }
  CHECK(records({"## no error: ended with an error\n0 1\n"}) == "0 1");
}

TEST_CASE("reader: what spreadsheets write for an error is no comment", "[text]") {
  CHECK(records({"0\t1\n#N/A\t2\n"}) ==
        "FILE:2: field 1 (t): '#N/A' is not a number; write NaN for a "
        "missing reading");
  CHECK(records({"0 1\n#DIV/0! 2\n"}) ==
        "FILE:2: field 1 (t): '#DIV/0!' is not a number; write NaN for "
        "a missing reading");
  CHECK(records({"0,1\n#1,2\n"}) == "0 1");  // a record that was taken out
}

TEST_CASE("reader: what passes through passes byte for byte, its separator aside", "[text]") {
  CHECK(copies("0.500   +1e0 x_y -0 1E-400\n") == "<0.500\t+1e0\tx_y\t-0\t1E-400>");
  CHECK(copies("t;v;note\n0;1;caf\xC3\xA9 au lait \n") == "<0\t1\tcaf\xC3\xA9 au lait>");
}

TEST_CASE("reader: a record goes out without the text of a column, and says where it stood",
          "[text]") {
  const TemporaryFile file("00 1.50 xyz\n");
  Reader in({{file.name()}, {}, {}, false}, {"t", "v"});
  in.need("v");
  REQUIRE(in.next_run());
  REQUIRE(in.next());
  Bytes text;
  text.append("before");
  CHECK(in.append_text(text, 1) == 3);
  CHECK(std::string_view(text.data(), text.size()) == "before00\t\txyz");
  CHECK(in.append_text(text) == 11);
  CHECK(std::string_view(text.data(), text.size()) == "before00\t\txyz00\t1.50\txyz");
  CHECK(in.where() == file.name() + ":1");
}

TEST_CASE("reader: where() is a record, behind the last one its run, and nothing around them",
          "[text]") {
  const TemporaryFile file("# t v\n0 1\n"), two("# t v\n0 1\n\n0 2\n");
  Reader in({{file.name(), two.name()}, {}, {}, false}, {});
  CHECK(in.where().empty());
  const auto base = [](const std::string& path) { return path.substr(path.rfind('/') + 1); };
  const std::string places[][2] = {{file.name() + ":2", "run " + base(file.name())},
                                   {two.name() + ":2", "run " + base(two.name()) + " 1"},
                                   {two.name() + ":4", "run " + base(two.name()) + " 2"}};
  for (const auto& [record, run] : places) {
    REQUIRE(in.next_run());
    REQUIRE(in.next());
    CHECK(in.where() == record);
    CHECK_FALSE(in.next());
    CHECK(in.where() == run);
  }
  CHECK_FALSE(in.next_run());
  CHECK(in.where().empty());

  Reader one({{file.name()}, {}, {}, false}, {});
  REQUIRE(one.next_run());
  while (one.next()) continue;
  CHECK(one.where() == file.name());
}

TEST_CASE(
    "reader: runs side by side come out one under another, the padding of the shorter uncounted",
    "[text]") {
  const std::string wide =
      "Time (s) Run #2,Velocity (m/s) Run #2,Time (s) Run #4,Velocity (m/s) Run "
      "#4\n0,1,0,5\n1,2,1,\n2,3,,\n";
  CHECK(records({wide}) == "0 1 | 1 2 | 2 3 || 0 5");
  CHECK(records({wide}, run(4)) == "0 5");
  CHECK(records({wide}, run(2)) == "0 1 | 1 2 | 2 3");
  CHECK(records({wide, "Time (s),Velocity (m/s)\n0,7\n", wide}) ==
        "0 1 | 1 2 | 2 3 || 0 5 || 0 7 || 0 1 | 1 2 | 2 3 || 0 5");
  CHECK(records({wide}, strict) == "FILE:3: field 4 (v): a reading is missing");
  CHECK(records({wide}, use({"t=3", "v=4"})) == "0 5");
  CHECK(records({"Time (s),v Run 1,v Run 2\n0,1,5\n1,2,\n"}) == "0 1 | 1 2 || 0 5");
  CHECK(records({"t v t v\n0 1 0 5\n1 2 1 6\n"}) == "0 1 | 1 2 || 0 5 | 1 6");
  CHECK(records({"t;v;t;v\n0;1;0;5\n1;2\n"}) ==
        "0 1 | 1 2 || 0 5");  // a line that ends where the longer runs do
  const TemporaryFile torn("t,v,t,v\n0,1,5,3\n1,2\n2,3,7,4\n3,4\n");
  Reader in({{torn.name()}, {}, {}, false}, {});
  in.need_time();
  while (in.next_run())
    while (in.next()) continue;
  CHECK(in.left_out() == 1);  // data follows the torn row, so that it is no padding
  CHECK(records({"t Run 1,v Run 1,t Run 2,v (km/h) Run 2,n Run 2\n0,1,0,36,7\n"}) == "0 1 || 0 10");
  CHECK(records({"t Run 1,v Run 1,t Run 2,v Run 2\n0,1,0,x\n"}) ==
        "FILE:2: field 4 (v): 'x' is not a number");
  CHECK(copies("Time (s) Run #2,v Run #2,Time (s) Run #4,v Run #4\n0.0,1,0.00,5\n") ==
        "<0.0\t1><0.00\t5>");
}

TEST_CASE("reader: stacked runs under repeated names keep their numbers", "[text]") {
  const std::string stacked =
      "Time (s) Run #3,v Run #3\n0,1\n\nTime (s) Run #5,v Run #5\n0,2\n1,3\n";
  CHECK(records({stacked}) == "0 1 || 0 2 | 1 3");
  CHECK(records({stacked}, run(5)) == "0 2 | 1 3");
  CHECK(records({stacked}, run(1)) == "there is no run 1 (runs: 3, 5)");
  CHECK(records({"v Run #3,t\n1,0\n\nv Run #5,t\n2,0\n"}, run(5), {"v"}) ==
        "2");  // not every name has it
  CHECK(records({"t,v\n0,1\n\nt,w\n0,2\n"}) ==
        "FILE:4: there is no column 'v' among t, w; say --use v=COLUMN");
}

TEST_CASE("reader: a separator that ends every line is an empty last column", "[text]") {
  CHECK(names("t\tv\t\n0\t1\t\n1\t2\t\n") == "t v c3");
  CHECK(names("# t\tv\t\n0\t1\t\n") == "t v c3");
  CHECK(names("# t\tv\n0\t1\t\n") == "t v c3");
  CHECK(copies("t\tv\t\n0\t1\t\n") == "<0\t1\t>");
  CHECK(copies("t\tv\t\n0\t1\t\n1\t2\n") == "<0\t1\t><1\t2\t>");
  CHECK(copies("t\tv\n0\t1\n1\t2\t\n") == "<0\t1><1\t2>");
  CHECK(records({"t,v,\n0,1,\n1,2,\n"}) == "0 1 | 1 2");
  CHECK(records({"t,v,\n0,1\n1,2,\n"}) == "0 1 | 1 2");
  CHECK(records({"t,v\n0,1,\n1,2\n"}) == "0 1 | 1 2");
  CHECK(records({"t,v\n0,1,7\n"}) ==
        "FILE:2: 3 fields under a line of 2 names; if some of its commas are decimal ones, make "
        "them points first");
}

TEST_CASE("reader: a quoted field may hold separators and line ends", "[text]") {
  CHECK(records({"\"t\",\"v, of\nthe cart\"\n0,1\n"}, {}, {"t", "v,_of_the_cart"}) == "0 1");
  CHECK(records({"note,t,v\n\"one\ntwo, three\",0,1\nfour,1,x\n"}) ==
        "FILE:4: field 3 (v): 'x' is not a number");
  CHECK(records({"t,v,note\n0,1,\"open\n1,2,x\n"}) == "FILE:2: a quote that is not closed");
}

TEST_CASE("reader: a column that is wanted but not needed may miss its readings", "[text]") {
  const TemporaryFile file("t,v,x\n0,1,2\n1,2,\n2,,4\n3,4,y\n");
  Reader in({{file.name()}, {}, {}, false}, {});
  const auto v = in.need("v"), x = in.want("x"), again = in.want("v");
  REQUIRE(in.next_run());
  REQUIRE(in.next());
  CHECK(in[x] == 2);
  CHECK(again == v);
  REQUIRE(in.next());
  CHECK(in[x] != in[x]);
  CHECK(in[v] == 2);
  CHECK_THROWS_AS(in.next(), InputError);  // past the record without v, to one whose x is no number
  CHECK(in.left_out() == 1);
}
