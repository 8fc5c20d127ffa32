// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/lines.h"

#include <utility>

#include "unit/text/files.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

/// The lines from the next one on, each as <number text>.
std::string rest(Lines& lines) {
  std::string all;
  while (lines.next())
    all.append("<")
        .append(std::to_string(lines.number()))
        .append(" ")
        .append(lines.text())
        .append(">");
  return all;
}

std::string lines(std::string_view text) {
  const TemporaryFile file(text);
  Lines all(file.name());
  return rest(all);
}

}  // namespace

TEST_CASE("lines: a quoted field takes its line ends with it, and has the number of its first line",
          "[text]") {
  CHECK(lines("a\nb\n") == "<1 a><2 b>");
  CHECK(lines("1,\"a\nb\",2\n3\n") == "<1 1,\"a\nb\",2><3 3>");
  CHECK(lines("\"a\n\nb\nc\"\n3") == "<1 \"a\n\nb\nc\"><5 3>");
  CHECK(lines("1\t\"a\nb\"\n") == "<1 1\t\"a\nb\">");
  CHECK(lines("1;\"a\"\"\nb\"\n") == "<1 1;\"a\"\"\nb\">");
}

TEST_CASE("lines: a quote that begins no field ends at its line", "[text]") {
  CHECK(lines("5\" wheel\n1\n") == "<1 5\" wheel><2 1>");
  CHECK(lines("\"a\",\"b\"\n1\n") == "<1 \"a\",\"b\"><2 1>");
  CHECK(lines("# a,\"b\n1\n") == "<1 # a,\"b><2 1>");
  CHECK(lines(" # a,\"b\n1\n") == "<1  # a,\"b><2 1>");  // nor one in a comment
}

TEST_CASE("lines: a quote that is not closed is refused where it begins", "[text]") {
  const TemporaryFile file("1\n2,\"a\n3\n");
  Lines all(file.name());
  REQUIRE(all.next());
  CHECK(refusal([&] { all.next(); }) == file.name() + ":2: a quote that is not closed");
  const TemporaryFile many("2,\"a\n" + std::string(1 << 20, '\n') + "\"\n");  // in a megabyte
  Lines megabyte(many.name());
  CHECK(refusal([&] { megabyte.next(); }) == many.name() + ":1: a quote that is not closed");
}

TEST_CASE("lines: taken from what is there, and counted", "[text]") {
  const TemporaryFile file("a\nbc\r\nd\ne");
  Lines all(file.name());
  REQUIRE(all.next());
  REQUIRE(all.ahead() == "bc\r\nd\ne");
  all.take(2, 2);
  CHECK(all.text() == "bc");
  CHECK(all.number() == 2);
  all.take(1, 1);
  CHECK(all.text() == "d");
  CHECK(rest(all) == "<4 e>");
  CHECK(all.ahead().empty());
}

TEST_CASE("lines: a line that is put back comes once more", "[text]") {
  const TemporaryFile file("a\nb\n");
  Lines all(file.name());
  REQUIRE(all.next());
  all.put_back();
  CHECK(all.ahead().empty());
  CHECK(rest(all) == "<1 a><2 b>");
}

TEST_CASE("lines: what a line is", "[text]") {
  const auto kind_of = [](std::string_view line, char separator = '\0') {
    const TemporaryFile file(std::string(line) + "\n");
    Lines all(file.name());
    if (separator != '\0') all.separate_by(separator);
    REQUIRE(all.next());
    return all.kind();
  };
  CHECK(kind_of(" \t ") == LineKind::blank);
  CHECK(kind_of("") == LineKind::blank);
  CHECK(kind_of("\x1A") == LineKind::blank);
  CHECK(kind_of(" # a") == LineKind::comment);
  CHECK(kind_of("#N/Atlantic") == LineKind::comment);
  CHECK(kind_of("\t## a") == LineKind::history);
  CHECK(kind_of("\"## a\",,") == LineKind::history);
  CHECK(kind_of("\"## a\",1") == LineKind::row);
  CHECK(kind_of("#N/A\t1") == LineKind::row);
  CHECK(kind_of("#REF!") == LineKind::row);
  CHECK(kind_of("a # b") == LineKind::row);
  CHECK(kind_of("\t#2\t1", '\t') == LineKind::row);  // the first field is blank
  CHECK(kind_of(" \t## 2\t1", '\t') == LineKind::row);
  CHECK(kind_of(" #2\t1", '\t') == LineKind::comment);
  CHECK(kind_of("\t#2\t1", ';') == LineKind::comment);
  CHECK(kind_of("\t\t", '\t') == LineKind::blank);
}

TEST_CASE(
    "lines: a spreadsheet fills a history line up with separators, or takes it apart at its "
    "blanks",
    "[text]") {
  for (const char* line :
       {"## smooth v mean", " ## smooth v mean;; ;", "##,smooth,v,mean,,", "\"## smooth v mean\"",
        "\"## smooth v mean\";;", "##\tsmooth\tv\tmean", "##;smooth;v;mean"})
    CHECK(history_line(line) == "## smooth v mean");
  CHECK(history_line("## run a,b;c") == "## run a,b;c");
  CHECK(history_line("##,") == "##");
}

TEST_CASE("lines: blank cells make a blank row, a quote that is text or opens a field does not",
          "[text]") {
  for (const auto& [text, kinds] : {std::pair{",,\n\"\",\"\"\n", "blank blank "},
                                    {"\"\"\"\",\n", "row "},
                                    {",\"\n\"\n", "row "}}) {
    const TemporaryFile file(text);
    Lines lines(file.name());
    lines.separate_by(',');
    std::string all;
    while (lines.next()) all += lines.kind() == LineKind::blank ? "blank " : "row ";
    CHECK(all == kinds);
  }
}
