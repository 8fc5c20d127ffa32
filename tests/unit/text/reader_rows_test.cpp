// SPDX-License-Identifier: GPL-3.0-or-later
#include "unit/text/rows.h"

using namespace rolling;

TEST_CASE("reader: clock times are seconds", "[text]") {
  CHECK(rows({"Time,v\n12:34:56.789,1\n12:34:57,2\n"}) == "45296.789 1 | 45297 2");
  CHECK(rows({"Time;v\n1:02,5;0,5\n1:03,25;2\n"}) == "62.5 0.5 | 63.25 2");
  CHECK(rows({"Time v\n2026-11-24T23:59:59Z 1\n2026-11-25T00:00:01Z 2\n"}) == "86399 1 | 86401 2");
  CHECK(rows({"Time\tv\n23:59:59\t1\n0:00:00\t2\n\n0:00:01\t3\n"}) == "86399 1 | 86400 2 || 1 3");
  CHECK(rows({"Time (hh:mm:ss.fff),v\n9:59:59,1\n\"10:00:00\",2\n"}) == "35999 1 | 36000 2");
  CHECK(rows({"Laufzeit [hh:mm:ss];v\n00:01:01;1\n00:01:02;2\n"}) == "61 1 | 62 2");
  CHECK(rows({"Laufzeit [s];Uhr [hh:mm:ss];v\n1;00:01:01;1\n2;00:01:02;2\n"}) == "1 1 | 2 2");
  CHECK(rows({"Time (hhmmss),v\n95959.5,1\n100000,2\n"}) == "35999.5 1 | 36000 2");
  CHECK(rows({"1 101259.5\n2 101300\n"}, {.use = {"v=1", "t=2[hhmmss]"}}) == "36779.5 1 | 36780 2");
  CHECK(rows({"Time,v\n1:00:00,1\nNaN,2\n,3\n1:00:01,4\n"}) == "3600 1 | 3601 4");
  CHECK(rows({"Time,v\n1:00:00,1\n0:59:59,2\n"}) ==
        "FILE:3: field 1 (t): '0:59:59' does not come after 3600 s; if all times fall, sort the "
        "rows by time; else put a blank line before "
        "another run, or say --use t=COLUMN");
  for (const char* text : {"Time,v\n1:00:00,1\n5000,2\n", "Time,v\n1,1\n1:00:00,2\n"})
    CHECK(rows({text}).find("is of another form than the times before it") != std::string::npos);
  // A unit other than seconds, or that of a clock, is not left unheard.
  for (const char* text : {"Time (ms),v\n1:00:00,1\n", "Time (hh:mm:ss),v\n9.5,1\n",
                           "Time (hhmmss),v\n105960,1\n", "Time (hhmmss),v\n1059.x,1\n"})
    CHECK(rows({text}).find("FILE:2: field 1 (t): '") == 0);
  CHECK(rows({"x,v\n1:00:00,1\n"}, {}, {"x", "v"}).find("'1:00:00' is not a number") !=
        std::string::npos);
}

TEST_CASE("reader: times that may be digits of a clock are told", "[text]") {
  const auto jump = [](const std::string& times) { return told("t,v\n" + times).find("hhmmss"); };
  for (const char* times :
       {"101258,1\n101259,1\n101300,1\n", "105958,1\n105959,1\n110000,1\n",
        "101258.8,1\n101259.3,1\n101259.8,1\n101300.3,1\n", "57,1\n58,1\n59,1\n100,1\n",
        // the step before the jump and the one in it differ by less than half of a step
        "58,1\n59,1\n100.4,1\n", "105958,1\n105959,1\n110000.4,1\n",
        // up to a step and a half from the end of the minute
        "58.9,1\n59.9,1\n100.9,1\n"})
    CHECK(jump(times) < 200);
  CHECK(jump("58,1\n59,1\n100,1\n") < 200);
  CHECK(told("Time (ms),v\n58,1\n59,1\n100,1\n").empty());
  CHECK(told("Time,v\n0:58,1\n0:59,1\n1:40,1\n").empty());
  // The same times in seconds, and other gaps.
  for (const char* times :
       {"36778,1\n36779,1\n36780,1\n", "10,1\n11,1\n52,1\n", "58,1\n59,1\n101,1\n",
        "0,1\n41,1\n82,1\n", "0,1\n4041,1\n", "59,1\n100,1\n101,1\n", "58,1\n59,1\n100.6,1\n",
        "105958,1\n105959,1\n110000.6,1\n", "60.4,1\n61.4,1\n102.4,1\n"})
    CHECK(jump(times) == std::string::npos);
}

TEST_CASE("reader: rows of one time, where they are joined", "[text]") {
  const auto refused = [](EqualTimes joins) {
    return rows({"0 1\n0 2\n1 3\n"}, {.equal_times = joins});
  };
  CHECK(refused(EqualTimes::first) == "0 1 | 0 2 | 1 3");  // the filter joins them
  CHECK(refused(EqualTimes::refused).find("--equal-times") != std::string::npos);
  CHECK(told("0 1\n0 2\n0 3\n1 4\n\n1 5\n", {.equal_times = EqualTimes::mean}) ==
        "t is column 1, taken in s; v is column 2, taken in m/s");
  CHECK(rows({"0 1\n1 2\n0 3\n"}, {.equal_times = EqualTimes::mean}).find("does not come after") !=
        std::string::npos);
}
