#include "text/layout.h"

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

/// The runs of a names line as `label:fields`, after the names of their columns.
std::string layout(const std::vector<std::string>& names, const std::string& run = "") {
  std::vector<Column> line;
  for (const std::string& name : names) line.push_back(read_column(name));
  try {
    const Layout layout = Layout::of(line, run);
    std::string text;
    for (const Column& column : layout.columns) text += to_text(column) + ' ';
    for (const Layout::Run& r : layout.runs) {
      text += r.label + ':';
      for (const std::size_t i : r.fields) text += std::to_string(i);
      text += ' ';
    }
    return text;
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("layout: a plain names line is one run", "[text]") {
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
        "t[s] x 1:01 2:32 ");
  CHECK(layout({"t", "v", "t", "v", "room"}) == "t v room :014 :234 ");
}

TEST_CASE("layout: columns of one name keep their places in every run", "[text]") {
  CHECK(layout({"v Run 1", "t Run 1", "v Run 1", "v Run 2", "t Run 2", "v Run 2"}) ==
        "v t v 1:012 2:345 ");
}

TEST_CASE("layout: --run picks by the number that is printed, else by place", "[text]") {
  const std::vector<std::string> printed = {"t Run #2", "v Run #2", "t Run #4", "v Run #4"},
                                 plain = {"t", "v", "t", "v"};
  CHECK(layout(printed, "4") == "t v 4:23 ");
  CHECK(layout(printed, "1") == "there is no run 1 among the 2 side by side: 2, 4");
  CHECK(layout(plain, "2") == "t v :23 ");
  CHECK(layout(plain, "3") == "there is no run 3 among the 2 side by side");
}

TEST_CASE("layout: runs of different columns are refused unless one is picked", "[text]") {
  const std::vector<std::string> names = {"t Run #1", "v Run #1", "t Run #2", "x Run #2"},
                                 units = {"t Run 1", "v (m/s) Run 1", "t Run 2", "v (km/h) Run 2"};
  CHECK(layout(names) == "the runs side by side have different columns: pick one with --run");
  CHECK(layout(names, "2") == "t x 2:23 ");
  CHECK(layout(units) == "the runs side by side have different columns: pick one with --run");
}
