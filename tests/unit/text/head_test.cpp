// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/head.h"

#include "unit/text/files.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

/// What stands before the first row: comments, the columns, and the row with its number.
std::string head(std::string_view text, Sides sides = Sides::by_names) {
  const TemporaryFile file(text);
  std::string all;
  const std::string message = refusal([&] {
    Lines lines(file.name());
    Dialect dialect;
    const Head head = read_head(lines, dialect, nullptr, {"t", "v"}, sides);
    for (const std::string& comment : head.comments) all += comment + '|';
    all += head.named ? "" : " no names,";
    for (const Column& column : head.layout.runs.front().columns) all += ' ' + to_text(column);
    lines.next();
    all += fmt::format(" in {} of {}; {}: {}", head.layout.runs.size(), head.layout.width(),
                       lines.number(), lines.text());
  });
  return message.empty() ? all : message.substr(message.find(':') + 1);
}

}  // namespace

TEST_CASE("head: names in the last comment, in a line, or in the order of the tool", "[text]") {
  CHECK(head("# by hand\n# t[s] x[m]\n0 1\n") == "# by hand| t[s] x[m] in 1 of 2; 3: 0 1");
  CHECK(head("Hall three\n\nTime (s),Position (m)\n0,1\n") ==
        "# Hall three| t[s] x[m] in 1 of 2; 4: 0,1");
  CHECK(head("0 1 2\n") == " no names, t v c3 in 1 of 3; 1: 0 1 2");
  CHECK(head("# about three words\n0 1\n") ==
        "# about three words| no names, t v in 1 of 2; 2: 0 1");
  CHECK(head("sep=;\n# t[ms];x[cm]\n0;1\n") == "# sep=;| t[ms] x[cm] in 1 of 2; 3: 0;1");
  CHECK(head("Hall three\n# t, made by hand, y\n# t[ms],x[cm],y\n0,1,2\n") ==
        "# Hall three|# t, made by hand, y| t[ms] x[cm] y in 1 of 3; 4: 0,1,2");
  CHECK(head("p,q\n# v and t\n0,1\n") == "# v and t| p q in 1 of 2; 3: 0,1");
  CHECK(head("t,x\n# v,t\n0,1\n") == "# v,t| t x in 1 of 2; 3: 0,1");
  CHECK(head("# t,x\np,q\n0,1\n") == "# t,x| p q in 1 of 2; 3: 0,1");
  CHECK(head("\"two\nlines\" ,\nt,v\n0,1\n") == "# \"two lines\" ,| t v in 1 of 2; 4: 0,1");
}

TEST_CASE("head: several history lines, one of them below the names, were sorted", "[text]") {
  const std::string one = "## smooth v mean width 3\n", other = "## differentiate v central\n",
                    names = "# t\tv\n", sorted = "## lines sorted|";
  const auto is_sorted = [&](const std::string& lines) {
    return head(lines + "0\t1\n").find(sorted) != std::string::npos;
  };
  for (const std::string& lines : {names + one + other, names + other + one, one + names + other})
    CHECK(is_sorted(lines));
  for (const std::string& lines :
       {one + other + names, names + one, one + names, names + "## run 2\n" + one})
    CHECK_FALSE(is_sorted(lines));
  CHECK(head(names + other + one + "0\t1\n") ==
        "## differentiate v central|## smooth v mean width 3|## lines sorted| t v in 1 of 2; 4: "
        "0\t1");
}

TEST_CASE("head: numbers, dates and times in a comment are no names", "[text]") {
  const std::string order = " no names, t v in 1 of 2; 2: 0 1";
  for (const std::string comment : {"# rows: 3", "# 2026-11-24 10:15", "# 1 2", "# m 1e3"})
    CHECK(head(comment + "\n0 1\n") == comment + "|" + order);
  CHECK(head("# p q2\n0 1\n") == " p q2 in 1 of 2; 2: 0 1");
  CHECK(head("# \xCE\xBE"
             "1 \xCE\xBE"
             "2\n0 1\n") ==
        " \xCE\xBE"
        "1 \xCE\xBE"
        "2 in 1 of 2; 2: 0 1");
  CHECK(head("# t 2\n0 1\n") == " t 2 in 1 of 2; 2: 0 1");
}

TEST_CASE("head: commas with and without blanks are refused where both may be meant", "[text]") {
  CHECK(head("1,5, 2,5\n2,5, 3,5\n") ==
        "1: '1,5, 2,5' can be read in two ways: if its commas without a blank are decimal ones, "
        "make them points first, else take the blanks away");
  for (const std::string line : {"1, 2", "1,2", "1.5, 2,3", "1,2,3, 4", "1,2,a, b", "1,2,\"3, 4\""})
    CHECK(head(line + "\n").ends_with("; 1: " + line));
  CHECK(head("t, v, x\n1, 2,3\n") == " t v x in 1 of 3; 2: 1, 2,3");
}

TEST_CASE("head: runs side by side, or one row of all", "[text]") {
  const std::string text = "t Run 1,v Run 1,t Run 2,v Run 2\n0,1,0,2\n";
  CHECK(head(text) == " t v in 2 of 4; 2: 0,1,0,2");
  CHECK(head(text, Sides::one) == " t v t v in 1 of 4; 2: 0,1,0,2");
}

TEST_CASE("head: a row of NaN is one; dates, times and blanks alone make none", "[text]") {
  CHECK(head("t,v\n,\n0,1\n") == " t v in 1 of 2; 3: 0,1");  // a blank row is none
  CHECK(head("# t v\nNaN NaN\n") == " t v in 1 of 2; 2: NaN NaN");
  CHECK(head("t,v\n10:15,\n0,1\n") == "# t,v| 15 c2 in 1 of 2; 3: 0,1");
  CHECK(head("24/11/2026,\nt,v\n0,1\n") == "# 24/11/2026,| t v in 1 of 2; 3: 0,1");
  CHECK(head("Anna,Ben\n24/11/2026,\nt,v\n0,1\n") ==
        "# Anna,Ben|# 24/11/2026,| t v in 1 of 2; 4: 0,1");
  CHECK(head("My cart,\n24/11/2026,\nt,v\n0,1\n") ==
        "# My cart,|# 24/11/2026,| t v in 1 of 2; 4: 0,1");
  CHECK(head("My cart,\n,\nt,v\n0,1\n") == "# My cart,| t v in 1 of 2; 4: 0,1");
  CHECK(head("# x of my cart\nv;t;n;\n0;1;2;\n") == "# x of my cart| v t n in 1 of 3; 3: 0;1;2;");
}

TEST_CASE("head: a separator that ends the header or the row is no column", "[text]") {
  CHECK(head("t,v,\n0,1\n") == " t v in 1 of 2; 2: 0,1");
  CHECK(head("t,v\n0,1,\n") == " t v in 1 of 2; 2: 0,1,");
  CHECK(head("t,v,\n0,1,\n") == " t v in 1 of 2; 2: 0,1,");
}

TEST_CASE("head: units in a line of their own belong to the names above it", "[text]") {
  CHECK(head("t x\n[s] [cm]\n0 1\n") == " t[s] x[cm] in 1 of 2; 3: 0 1");
  CHECK(head("Zeit,Weg,Kraft\ns,cm,N\n0,1,2\n") == " Zeit[s] Weg[cm] Kraft[N] in 1 of 3; 3: 0,1,2");
  CHECK(head("Anna,Ben\nZeit,s\n0,1\n") == "# Anna,Ben| Zeit s in 1 of 2; 3: 0,1");
  CHECK(head("t,\ns,cm\n0,1\n") == " t[s] c2[cm] in 1 of 2; 3: 0,1");
  CHECK(head("t,F\nms,N\n0,1\n") == " t[ms] F[N] in 1 of 2; 3: 0,1");
}

TEST_CASE("head: what may be names of one column above a later run is refused", "[text]") {
  const TemporaryFile file("0\n\n# t [ms]: time, v [cm/s]\n0\n");
  Lines lines(file.name());
  Dialect dialect;
  const Head first = read_head(lines, dialect, nullptr, {}, Sides::by_names);
  REQUIRE(lines.next());
  CHECK_THROWS_WITH(read_head(lines, dialect, &first, {}, Sides::by_names),
                    file.name() +
                        ":3: '# t [ms]: time, v [cm/s]' may be the names of the columns, or a "
                        "sentence: put tabs between names, one for each of 1 column, behind one "
                        "#; or give the sentence another number of words");
}

TEST_CASE("head: text behind the last run becomes comments of one line each", "[text]") {
  const TemporaryFile file("t,v\n0,1\n\n\"the\nend\",x\n");
  Lines lines(file.name());
  Dialect dialect;
  const Head first = read_head(lines, dialect, nullptr, {}, Sides::by_names);
  REQUIRE(lines.next());
  const Head last = read_head(lines, dialect, &first, {}, Sides::by_names);
  CHECK(last.layout.runs.empty());
  CHECK(last.comments == std::vector<std::string>{"# \"the end\",x"});
}

TEST_CASE("head: no columns are refused, with the line", "[text]") {
  CHECK(head("") == " no rows");
  CHECK(head("# t v\n") == " no rows");
  CHECK(head("t,v\n0,1,2\n") ==
        "2: 3 fields under a line of 2 names: begin that with # if it is no header, put quotes "
        "around names that hold a separator, and make decimal commas points");
  CHECK(head("t,v\n0,1,,\n") ==
        "2: 4 fields under a line of 2 names: begin that with # if it is no header, put quotes "
        "around names that hold a separator, and make decimal commas points");
  CHECK(head("t,v,a\n0,1\n") ==
        "2: 2 fields under a line of 3 names: begin that with # if it is no header, put quotes "
        "around names that hold a separator, and make decimal commas points");
  CHECK(head("t v\n0\n") ==
        "2: 1 field under a line of 2 names: begin that with # if it is no header, put quotes "
        "around names that hold a separator, and make decimal commas points");
  CHECK(head("\"my t\" v\n0 1\n") == " my_t v in 1 of 2; 2: 0 1");
  CHECK(head(std::string_view("t\0v\n", 4)) ==
        "1: a NUL byte: this is no text of columns; export a spreadsheet as CSV, unpack what is "
        "packed, make UTF-16 UTF-8 (iconv -f UTF-16)");
  CHECK(head("t v\r0 1\r") ==
        "1: a carriage return within the line; make the line ends LF first (tr '\\r' '\\n')");
}

TEST_CASE("head: where no line is a row, the last one is said to be none", "[text]") {
  CHECK(head("0 1,\n1 2,\n2 3,\n") == "3: no rows: no field of '2 3,' is a number");
  CHECK(head("Time (ms)|Velocity (cm/s)\n0|1\n1|2\n") ==
        "3: no rows: no field of '1|2' is a number");
  CHECK(head("t,v\n0.04 s,0.2 m\n") ==
        "2: no rows: no field of '0.04 s,0.2 m' is a number; a unit stands in the header alone");
}
