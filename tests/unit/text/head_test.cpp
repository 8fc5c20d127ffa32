#include "text/header.h"

#include "unit/text/files.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

/// What is found before the first record: comments, the names line in < >, the columns, and the
/// first record with its number.
std::string header(std::string_view text, const std::string& run = "", bool one_run = false) {
  const TemporaryFile file(text);
  std::string all;
  const std::string message = refusal([&] {
    Lines lines(file.name());
    Dialect dialect;
    const Header header = read_header(lines, dialect, {"t", "v"}, run, one_run);
    for (const std::string& comment : header.comments) all += comment + '|';
    all += '<' + header.names_line + '>' + (header.named ? "" : " no names,");
    for (const Column& column : header.layout.columns) all += ' ' + to_text(column);
    all += fmt::format(" in {} of {}; {}: {}", header.layout.runs.size(), header.layout.width,
                       lines.number(), lines.text());
  });
  return message.empty() ? all : message.substr(message.find(':') + 1);
}

}  // namespace

TEST_CASE("header: names in the last comment, in a line, or in the order of the tool", "[text]") {
  CHECK(header("# by hand\n# t[s] x[m]\n0 1\n") == "# by hand|<> t[s] x[m] in 1 of 2; 3: 0 1");
  CHECK(header("Hall three\n\nTime (s),Position (m)\n0,1\n") ==
        "# Hall three|<Time (s),Position (m)> t[s] x[m] in 1 of 2; 4: 0,1");
  CHECK(header("0 1 2\n") == "<> no names, t v c3 in 1 of 3; 1: 0 1 2");
  CHECK(header("# about three words\n0 1\n") ==
        "# about three words|<> no names, t v in 1 of 2; 2: 0 1");
  CHECK(header("## smooth v mean\n# t v\n## differentiate v central\n0 1\n") ==
        "## smooth v mean|## differentiate v central|<> t v in 1 of 2; 4: 0 1");
}

TEST_CASE("header: runs side by side, one of them, or one record of all", "[text]") {
  const std::string text = "t Run 1,v Run 1,t Run 2,v Run 2\n0,1,0,2\n";
  CHECK(header(text) == "<t Run 1,v Run 1,t Run 2,v Run 2> t v in 2 of 4; 2: 0,1,0,2");
  CHECK(header(text, "2") == "<t Run 1,v Run 1,t Run 2,v Run 2> t v in 1 of 4; 2: 0,1,0,2");
  CHECK(header(text, "", true) ==
        "<t Run 1,v Run 1,t Run 2,v Run 2> t v t v in 1 of 4; 2: 0,1,0,2");
  CHECK(header(text, "3") == " there is no run 3 among the 2 side by side: 1, 2");
}

TEST_CASE("header: a record without readings is one, as wide as the names", "[text]") {
  CHECK(header("t,v\n,\n0,1\n") == "<t,v> t v in 1 of 2; 2: ,");
  CHECK(header("# t v\nNaN NaN\n") == "<> t v in 1 of 2; 2: NaN NaN");
  CHECK(header("My cart,\n,\nt,v\n0,1\n") == "# My cart,|# ,|<t,v> t v in 1 of 2; 4: 0,1");
}

TEST_CASE("header: what ends a line of names or of the first record is no column", "[text]") {
  CHECK(header("t,v,\n0,1\n") == "<t,v,> t v in 1 of 2; 2: 0,1");
  CHECK(header("t,v\n0,1,\n") == "<t,v> t v in 1 of 2; 2: 0,1,");
}

TEST_CASE("header: no columns are refused, with the line", "[text]") {
  CHECK(header("") == " no records");
  CHECK(header("# t v\n") == " no records");
  CHECK(header("t,v\n0,1,2\n") ==
        "2: 3 fields under a line of 2 names; if some of its commas are decimal ones, make them "
        "points first");
  CHECK(header("t v\n0\n") == "2: 1 field under a line of 2 names");
  CHECK(header(std::string_view("t\0v\n", 4)) ==
        "1: a NUL byte; UTF-16 must be made UTF-8 first (iconv -f UTF-16)");
  CHECK(header("t v\r0 1\r") ==
        "1: a carriage return within the line; make the line ends LF first (tr '\\r' '\\n')");
  std::string words;
  for (int i = 0; i < 101; ++i) words += "once upon a time\n";
  CHECK(header(words) == " no numbers in the first 100 lines");
}
