// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of rows: one below another, in several files, side by side; their heads and names.
#include "text/reader.h"

#include "unit/text/rows.h"

using namespace rolling;

TEST_CASE("reader: a separator at the ends of lines may be left out in the second run too",
          "[text]") {
  CHECK(rows({"t,v,\n0,1,\n1,2\n\n2,3,\n3,4\n"}) == "0 1 | 1 2 || 2 3 | 3 4");
}

TEST_CASE("reader: units that a comment gives to the columns of the second run alone", "[text]") {
  CHECK(told("# t v F\n0 1 2\n\n# s cm/s N\n2 3 4\n") ==
        "v is column 2, 'v', taken in m/s although line 4 says cm/s");
}

TEST_CASE("reader: blank lines end a run, however many", "[text]") {
  CHECK(rows({"0 1\n1 2\n\n0 3\n"}) == "0 1 | 1 2 || 0 3");
  CHECK(rows({"\n\n0 1\n \n\t\n\n0 3\n\n\n"}) == "0 1 || 0 3");
  CHECK(rows({"0 1\n# a comment is no break\n1 2\n"}) == "0 1 | 1 2");
  CHECK(rows({"t,v\n0,1\n\nt,v\n0,2\n"}) == "0 1 || 0 2");  // each run under its own header
  CHECK(rows({"t,v\n0,1\nt,v\n1,2\n"}) ==
        "FILE:3: field 1 (t): 't' is the header again; put a blank line before it, or give the "
        "files one by one");
}

TEST_CASE("reader: files in order, a run break between them", "[text]") {
  CHECK(rows({"0 1\n1 2\n", "0 3\n"}) == "0 1 | 1 2 || 0 3");
  CHECK(rows({"0 1", "0 3"}) == "0 1 || 0 3");
  CHECK(rows({"# t v\n0 1\n", "t,v\n0,3\n"}) ==
        "0 1 || 0 3");  // the form is each file's own, the columns are not
  CHECK(rows({"0 1\n\n", "\n0 3\n"}) == "0 1 || 0 3");
  CHECK(rows({"# t v\n0 1\n", "# v t\n0 3\n"}) == "0 1 || 3 0");
  CHECK(rows({"# t[s] v[m/s]\n0 1\n", "# t[ms] v[m/s]\n7 3\n"}) == "0 1 || 0.007 3");
  CHECK(rows({"# t v\n0 1\n", "0 3\n"}) ==
        "FILE: its columns are not those of FILE: those have names; give it a header");
  CHECK(rows({"0 1\n", "0 3 4\n"}) ==
        "FILE: its columns are not those of FILE: 3, not 2; give it a header");
  CHECK(rows({"0 1\n", ""}) == "FILE: no rows");
}

TEST_CASE("reader: a second file that is not there is refused, and where() is still safe",
          "[text]") {
  const TemporaryFile file("0 1\n");
  Reader in({.files = {file.name(), "/no/such/file"}}, {"t", "v"});
  in.need("t");
  REQUIRE(in.next_run());
  REQUIRE(in.next());
  CHECK_FALSE(in.next());
  CHECK(refusal([&] { in.next_run(); }) == "/no/such/file: No such file or directory");
  CHECK(in.where().empty());
}

static const std::string joined =
    "smooth --equal-times mean (or first) makes one row of rows of one time";
static const std::string unnamed =
    "; if the times are in another column, --use t=COLUMN; else " + joined;

TEST_CASE("reader: --run picks one, by its printed number or its place", "[text]") {
  CHECK(rows({"0 1\n\n0 2\n1 3\n\n0 4\n"}, run(2)) == "0 2 | 1 3");
  CHECK(rows({"0 1\n\n0 2\n"}, run(1)) == "0 1");
  // What is passed over is read as strictly, in the columns that are needed.
  CHECK(rows({"0 1\n\n0 bad\n\n0 4\n"}, run(3)) ==
        "FILE:3: field 2 (v): 'bad' is not a number; write NaN for a missing reading, # before a "
        "line that is no row, and a blank line before another run");
  CHECK(rows({"0 1\n\n0 bad\n\n0 4\n"}, run(1)) ==
        "FILE:3: field 2 (v): 'bad' is not a number; write NaN for a missing reading, # before a "
        "line that is no row, and a blank line before another run");
  CHECK(rows({"0 1\n\n0 bad\n\n0 4\n"}, run(3), {"t"}) == "0");
  CHECK(rows({"1 1\n1 2\n\n0 4\n"}, run(2)) ==
        "FILE:2: field 1 (t): '1' does not come after 1" + unnamed);
  CHECK(rows({"1 1\n1 2\n\n0 4\n"}, run(2), {"v"}) == "4");
  CHECK(rows({"t,v (odd)\n0,1\n\nt,v\n0,4\n"}, run(2)).find("its unit 'odd'") < 60);
  CHECK(rows({"0 1\n0 1 2\n\n0 4\n"}, run(2)) == "FILE:2: 3 fields where the first row has 2");
  CHECK(rows({"0 1\n", "0 2\n", "0 3\n"}, run(2)) == "0 2");
  CHECK(rows({"Time (s) Run #7,Velocity (m/s) Run #7\n0,1\n"}, run(7)) == "0 1");
  CHECK(rows({"0 1\n\n0 2\n"}, run(3)) == "there is no run 3 (runs: 1, 2)");
  CHECK(rows({"t Run 2,v Run 2,t Run 4,v Run 4\n0,1,0,5\n"}, run(4)) == "0 5");
  CHECK(rows({"t Run 2,v Run 2,t Run 4,v Run 4\n0,1,0,5\n"}, run(3)) ==
        "there is no run 3 (runs: 2, 4)");
  // Of files of several runs each, the numbers in the names of the runs.
  CHECK(rows({"t,v,t,v\n0,1,0,2\n", "t,v,t,v\n0,3,0,4\n"}, run(3)) ==
        "there is no run 3 (runs: 1, 2, 1, 2)");
  CHECK(rows({"## run a 7\n0 1\n\n## run b 1\n0 2\n"}, run(1)) == "0 2");
}

TEST_CASE("reader: --run takes what the header calls a run, or what it lists", "[text]") {
  const auto of = [](const char* name) { return ReaderOptions{.run = name}; };
  const Texts vernier = {"Latest: t,Latest: v,Run 1: t,Run 1: v\n0,1,0,5\n"};
  CHECK(rows(vernier, of("Latest")) == "0 1");
  CHECK(rows(vernier, of("1")) == "0 5");
  CHECK(rows(vernier, of("2")) == "there is no run 2 (runs: Latest, 1)");
  CHECK(rows({"t Run #0,v Run #0,t Run #1,v Run #1\n0,1,0,5\n"}, of("0")) == "0 1");
  CHECK(rows({"0 1\n\n0 2\n"}, of("0")) == "there is no run 0 (runs: 1, 2)");
  CHECK(rows({"Latest: t,Latest: v\n0,1\n"}, of("Latest")) == "0 1");
  CHECK(rows({"Latest: t,Latest: v\n0,1\n"}, of("1")) == "0 1");
  CHECK(rows({"## run first try\n0 1\n\n## run second\n0 2\n"}, of("second")) == "0 2");
  CHECK(rows({"## run a roll 2 of 6\n0 1\n\n## run b\n0 2\n"}, of("a roll 2 of 6")) == "0 1");
  CHECK(rows({"0 1\n"}, of("x")) == "there is no run x (runs: 1)");
}

TEST_CASE("reader: --run picks one run and no other", "[text]") {
  const std::string second = ": another run 1; give the file of one of them alone";
  // Where names carry numbers, places do not count beside them.
  CHECK(rows({"Latest: t,Latest: v,Run 1: t,Run 1: v\n0,1,0,5\n"}, run(1)) == "0 5");
  // The number of one run and the place of another, in blocks of a file and in two files.
  CHECK(rows({"t,v\n0,1\n\nt Run #1,v Run #1\n0,7\n"}, run(1)) == "FILE:4" + second);
  CHECK(rows({"t,v\n0,1\n", "t Run #1,v Run #1\n0,7\n"}, run(1)) == "FILE:1" + second);
  // The same number twice.
  CHECK(rows({"t Run #1,v Run #1\n0,1\n\n0,7\n"}, run(1)) == "FILE:4" + second);
  CHECK(rows({"t Run 1,v Run 1,t Run 2,v Run 2\n0,1,0,2\n\n0,3,0,4\n"}, run(1)) ==
        "FILE:4" + second);
}

TEST_CASE("reader: time increases within a run, and starts anew in the next", "[text]") {
  CHECK(rows({"0 1\n0 2\n"}) == "FILE:2: field 1 (t): '0' does not come after 0" + unnamed);
  CHECK(
      rows({"1 1\n0.5 2\n"}) ==
      "FILE:2: field 1 (t): '0.5' does not come after 1; if all times fall, sort the rows by time; "
      "else put a blank line before another run, "
      "or say --use t=COLUMN");
  CHECK(rows({"# t[ms] v\n500 1\n500 2\n"}) ==
        "FILE:3: field 1 (t): '500' does not come after 0.5 s; " + joined);
  CHECK(rows({"5 1\n\n4 2\n"}) == "5 1 || 4 2");
  CHECK(rows({"-1e308 1\n1e308 2\n"}) == "-1e+308 1 | 1e+308 2");
  CHECK(rows({"0 1\n0 2\n"}, {}, {"v"}) == "1 | 2");  // who does not need t does not judge it
}

TEST_CASE("reader: comments pass, those in front of a run apart from those among its rows",
          "[text]") {
  const TemporaryFile file(
      "# by hand\n## smooth x mean width 3\n# t v\n0 1\n# among\n1 2\n# end\n\n# between\n0 3\n"
      "# after\n\n# last\n");
  Reader in({.files = {file.name()}}, {"t", "v"});
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

TEST_CASE("reader: the history is that of the present run alone", "[text]") {
  const TemporaryFile first(
      "## smooth v mean width 3\n## differentiate v central\n# t v\n0 1\n\n0 2\n\n"
      "## smooth v mean width 5\n0 3\n"
      "## differentiate v central\n0 4\n"),  // which begins a run, without a blank line
      second("# t v\n0 5\n");
  Reader in({.files = {first.name(), second.name()}}, {});
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
  Reader in({.files = {file.name()}, .run = "2"}, {});
  const auto v = in.need("v");
  REQUIRE(in.next_run());
  CHECK(in.history().empty());
  REQUIRE(in.comments().size() == 2);
  CHECK(in.comments()[0] == "## run " + in.run_name());
  CHECK(in.comments()[1] == "# two");
  CHECK(in.columns().size() == 3);
  REQUIRE(in.next());
  CHECK(in[v] == 10);
}

TEST_CASE("reader: names and units hold until others come", "[text]") {
  const std::string first = "# t[s]\tv[m/s]\n0\t1\n\n";
  CHECK(rows({first + "1\t2\n\n# t[ms]\tv[km/h]\n0\t36\n\n1000\t72\n"}) ==
        "0 1 || 1 2 || 0 10 || 1 20");
  CHECK(rows({first + "# v[m/s]\tt[s]\n5\t7\n"}) == "0 1 || 7 5");
  CHECK(rows({first + "# t[s]\tx[m]\tv[m/s]\n7\t8\t9\n"}) == "0 1 || 7 9");
  CHECK(rows({first + "# second run\n1\t2\n"}) == "0 1 || 1 2");  // a remark of two words
  CHECK(rows({first + "# t[s]\tx[m]\n1\t2\n"}) ==
        "FILE:4: there is no column 'v' among t[s], x[m]; say --use v=COLUMN");
  CHECK(rows({first + "# t[s]\tv[furlong/s]\n1\t2\n"}) ==
        "FILE:4: column 'v[furlong/s]' cannot serve as v: its unit 'furlong/s' is not one of those "
        "known (m/s, mm/s, cm/s, km/h, mph, ft/s); convert it first (rolling-recipes(7)) or say "
        "--use 'v=2[UNIT]'");
  CHECK(rows({"# t w[rpm]\n0 1\n\n# t w[rad/s]\n0 2\n"}, {}, {"t", "w"}) ==
        "FILE:4: column 2 is 'w[rad/s]', and 'w[rpm]' in the runs before");
  CHECK(rows({"# t w\n0 1\n\n# t u\n0 2\n"}, {}, {"t", "2"}) ==
        "FILE:4: column 2 is 'u', and 'w' in the runs before");
  CHECK(rows({first + "1\t2\t3\n"}) == "FILE:4: 3 fields where the first row has 2");
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
  CHECK(run_names({"0 1\n\n0 2\n"}, run(2)) == "<FILE 2>");
  const TemporaryFile file("0 1\n\n0 2\n");
  const Redirect from_file(STDIN_FILENO, file.name());
  CHECK(run_names({}) == "<1><2>");
}

TEST_CASE("reader: where() is a row, behind the last one its run, and nothing around them",
          "[text]") {
  const TemporaryFile file("# t v\n0 1\n"), two("# t v\n0 1\n\n0 2\n");
  Reader in({.files = {file.name(), two.name()}}, {});
  CHECK(in.where().empty());
  const auto base = [](const std::string& path) { return path.substr(path.rfind('/') + 1); };
  const std::string places[][2] = {{file.name() + ":2", "run " + base(file.name())},
                                   {two.name() + ":2", "run " + base(two.name()) + " 1"},
                                   {two.name() + ":4", "run " + base(two.name()) + " 2"}};
  for (const auto& [row, run] : places) {
    REQUIRE(in.next_run());
    REQUIRE(in.next());
    CHECK(in.where() == row);
    CHECK_FALSE(in.next());
    CHECK(in.where() == run);
  }
  CHECK_FALSE(in.next_run());
  CHECK(in.where().empty());

  Reader one({.files = {file.name()}}, {});
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
  CHECK(rows({wide}) == "0 1 | 1 2 | 2 3 || 0 5");
  CHECK(rows({wide}, run(4)) == "0 5");
  CHECK(rows({wide}, run(2)) == "0 1 | 1 2 | 2 3");
  CHECK(rows({wide, "Time (s),Velocity (m/s)\n0,7\n", wide}) ==
        "0 1 | 1 2 | 2 3 || 0 5 || 0 7 || 0 1 | 1 2 | 2 3 || 0 5");
  CHECK(rows({wide}, strict) == "FILE:3: field 4 (v): '' is a missing reading");
  CHECK(rows({wide}, use({"t=3", "v=4"})) == "0 5");
  CHECK(rows({"Time (s),v Run 1,v Run 2\n0,1,5\n1,2,\n"}) == "0 1 | 1 2 || 0 5");
  CHECK(rows({"t v t v\n0 1 0 5\n1 2 1 6\n"}) == "0 1 | 1 2 || 0 5 | 1 6");
  CHECK(rows({"t;v;t;v\n0;1;0;5\n1;2\n"}) ==
        "0 1 | 1 2 || 0 5");  // a line that ends where the longer runs do
  const TemporaryFile torn("t,v,t,v\n0,1,5,3\n1,2\n2,3,7,4\n3,4\n");
  Reader in({.files = {torn.name()}}, {});
  in.need("t");
  while (in.next_run())
    while (in.next()) continue;
  CHECK(in.left_out() == 1);  // data follows the torn row, so that it is no padding
  CHECK(rows({"t Run 1,v Run 1,t Run 2,v (km/h) Run 2,n Run 2\n0,1,0,36,7\n"}) == "0 1 || 0 10");
  CHECK(rows({"t Run 1,v Run 1,t Run 2,v Run 2\n0,1,0,x\n"}) ==
        "FILE:2: field 4 (v): 'x' is not a number; write NaN for a missing reading, # before a "
        "line that is no row, and a blank line before another run");
  CHECK(copies("Time (s) Run #2,v Run #2,Time (s) Run #4,v Run #4\n0.0,1,0.00,5\n") ==
        "<0.0\t1><0.00\t5>");
}

TEST_CASE("reader: stacked runs under repeated names keep their numbers", "[text]") {
  const std::string stacked =
      "Time (s) Run #3,v Run #3\n0,1\n\nTime (s) Run #5,v Run #5\n0,2\n1,3\n";
  CHECK(rows({stacked}) == "0 1 || 0 2 | 1 3");
  CHECK(rows({stacked}, run(5)) == "0 2 | 1 3");
  CHECK(rows({stacked}, run(1)) == "there is no run 1 (runs: 3, 5)");
  CHECK(rows({"v Run #3,t\n1,0\n\nv Run #5,t\n2,0\n"}, run(5), {"v"}) ==
        "2");  // not every name has it
  CHECK(rows({"t,v\n0,1\n\nt,w\n0,2\n"}) ==
        "FILE:4: there is no column 'v' among t, w; say --use v=COLUMN");
}
