// SPDX-License-Identifier: GPL-3.0-or-later
// Missing readings: what stands for one, what does not, and what becomes of its row.
#include "text/reader.h"

#include "unit/kind_of_error.h"
#include "unit/text/rows.h"

using namespace rolling;

TEST_CASE("reader: a first row whose readings are all missing is a row, not names", "[text]") {
  CHECK(rows({"# t v\nNaN NaN\n0 1\n"}) == "0 1");
  CHECK(rows({"t,v\nNaN,nan\n0,1\n"}) == "0 1");
  CHECK(rows({"NaN NaN\n0 1\n"}) == "0 1");
  CHECK(rows({"t,v\n,\n0,1\n"}) == "0 1");
  CHECK(rows({"# v t\n;\n5;0\n"}) == "0 5");
  CHECK(rows({"# v t\n## smooth v mean width 3\n;\n5;0\n"}) == "0 5");
  CHECK(rows({"t,v\n,\n0,1\n"}, strict) == "0 1");    // a blank row is a run break
  CHECK(rows({"My cart,\n,\nt,v\n0,1\n"}) == "0 1");  // blank cells of a preamble
}

TEST_CASE("reader: a first row with a blank cell before one that begins with # is a row",
          "[text]") {
  CHECK(rows({"# t\tx\tv\n\t#\t2\n0\t1\t2\n"}, strict) ==
        "FILE:2: field 1 (t): '' is a missing reading");
  CHECK(rows({"\t# a comment\n# t v\n\t# another\n0 1\n"}) == "0 1");
}

TEST_CASE("reader: a missing reading leaves its row out, and is counted", "[text]") {
  const TemporaryFile file("t,v,x\n0,1,\n1,,5\n2,NaN,5\n3,nan,\n4,2,NaN\n");
  Reader in({.files = {file.name()}}, {});
  in.need("t");
  in.need("v");
  std::size_t seen = 0;
  while (in.next_run())
    while (in.next()) ++seen;
  CHECK(seen == 2);
  CHECK(in.left_out() == 3);
  CHECK(rows({"t,v\n0,1\n1,\n2,3\n"}) == "0 1 | 2 3");
  CHECK(rows({"t,v\n0,1\n1,\n"}, strict) == "FILE:3: field 2 (v): '' is a missing reading");
  CHECK(rows({"t,v,x\n0,1,\n"}, strict) == "0 1");  // x is not needed
  CHECK(rows({"t v\n0 1\n1 NaN\n"}, strict) == "FILE:3: field 2 (v): 'NaN' is a missing reading");
}

TEST_CASE("reader: what spreadsheets write for an error is no comment", "[text]") {
  CHECK(rows({"0\t1\n#N/A\t2\n"}) ==
        "FILE:2: field 1 (t): '#N/A' is not a number; write NaN for a missing reading, # before a "
        "line that is no row, and a blank line before another run");
  CHECK(rows({"0 1\n#DIV/0! 2\n"}) ==
        "FILE:2: field 1 (t): '#DIV/0!' is not a number; write NaN for a missing reading, # before "
        "a line that is no row, and a blank line before another run");
  CHECK(rows({"0,1\n#1,2\n"}) == "0 1");  // a row that was taken out
}

TEST_CASE("reader: a column that is wanted but not needed may miss its readings", "[text]") {
  const TemporaryFile file("t,v,x\n0,1,2\n1,2,\n2,,4\n3,4,y\n");
  Reader in({.files = {file.name()}}, {});
  const auto v = in.need("v"), x = in.want("x");
  REQUIRE(in.next_run());
  REQUIRE(in.next());
  CHECK(in[x] == 2);
  REQUIRE(in.next());
  CHECK(in[x] != in[x]);
  CHECK(in[v] == 2);
  // Past the row without v, to one whose x is no number.
  CHECK(kind_of_error([&] { in.next(); }) == InputError);
  CHECK(in.left_out() == 1);
}
