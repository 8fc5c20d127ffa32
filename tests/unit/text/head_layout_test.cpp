// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/head.h"

#include <utility>

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

/// The runs of a header as `label:fields`, each behind the names of its columns where they are
/// others than those of the run before.
std::string layout(const std::vector<std::string>& names) {
  std::vector<Column> line;
  for (const std::string& name : names) line.push_back(read_column(name));
  std::string text, before;
  for (const Layout::Run& r : Layout::of(line, Sides::by_names).runs) {
    std::string columns;
    for (const Column& column : r.columns) columns += to_text(column) + ' ';
    if (std::exchange(before, columns) != columns) text += columns;
    text += r.label + ':';
    for (const std::size_t i : r.fields) text += std::to_string(i);
    text += ' ';
  }
  return text;
}

}  // namespace

TEST_CASE("layout: a plain header is one run", "[text]") {
  CHECK(layout({"t", "x", "v"}) == "t x v :012 ");
  CHECK(layout({"Time (s) Run #2", "Velocity (m/s) Run #2"}) == "t[s] v[m/s] 2:01 ");
  CHECK(layout({"t", "v", "v"}) == "t v v :012 ");  // which v is for --use to say
}

TEST_CASE("layout: runs side by side, grouped by run, by quantity, with a shared time, time last",
          "[text]") {
  CHECK(layout({"Time (s) Run #2", "Position (m) Run #2", "Time (s) Run #4",
                "Position (m) Run #4"}) == "t[s] x[m] 2:01 4:23 ");
  CHECK(layout({"Time Run 1", "Time Run 2", "Velocity Run 1", "Velocity Run 2"}) ==
        "t v 1:02 2:13 ");
  CHECK(layout({"Time (s)", "Velocity Run 1", "Velocity Run 2"}) == "t[s] v 1:01 2:02 ");
  CHECK(layout({"Latest: Velocity (m/s)", "Latest: Time (s)", "Run 1: Velocity (m/s)",
                "Run 1: Time (s)"}) == "v[m/s] t[s] Latest:01 1:23 ");
  CHECK(layout({"Data Set 1:Time(s)", "Data Set 1:x", "Data Set 2:x", "Data Set 2:Time(s)"}) ==
        "t[s] x 1:01 x t[s] 2:23 ");
  CHECK(layout({"t", "v", "t", "v", "room"}) == "t v room :014 :234 ");
  // What is of another run keeps that in its name.
  CHECK(layout({"t Run 1", "v Run 1", "t Run 2", "v Run 2", "Load Run 9"}) ==
        "t v Load_Run_9 1:014 2:234 ");
}

TEST_CASE("layout: of several times, a quantity goes with one that is its own", "[text]") {
  for (const std::vector<std::string>& names : {std::vector<std::string>{"t", "v", "t", "x"},
                                                {"t", "v", "t", "v", "t", "x"},
                                                {"t Run 1", "v Run 1", "t Run 2", "v Run 2", "x"}})
    CHECK_THROWS_AS(layout(names), Error);
  CHECK(layout({"t", "v Run 1", "v Run 2", "x"}) == "t v x 1:013 2:023 ");
}

TEST_CASE("layout: columns of one name keep their places in every run", "[text]") {
  CHECK(layout({"v Run 1", "t Run 1", "v Run 1", "v Run 2", "t Run 2", "v Run 2"}) ==
        "v t v 1:012 2:345 ");
}

TEST_CASE("layout: runs may have different columns, and no column is lost", "[text]") {
  CHECK(layout({"t Run #1", "v Run #1", "t Run #2", "x Run #2"}) == "t v 1:01 t x 2:23 ");
  CHECK(layout({"t Run 1", "v (m/s) Run 1", "t Run 2", "v (km/h) Run 2"}) ==
        "t v[m/s] 1:01 t v[km/h] 2:23 ");
  CHECK(layout({"t", "v", "t", "v", "v"}) == "t v :01 t v v :234 ");
}
