// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/lines.h"

#include <unistd.h>

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
  all.take_to(all.ahead().data() + 2);
  CHECK(all.text() == "bc");
  CHECK(all.number() == 2);
  all.take_to(all.ahead().data() + 1);
  CHECK(all.text() == "d");
  CHECK(rest(all) == "<4 e>");
  CHECK(all.ahead().empty());
}

TEST_CASE("lines: a line that is put back comes once more", "[text]") {
  const TemporaryFile file("a\nb\n");
  Lines all(file.name());
  REQUIRE(all.next());
  all.put_back();
  CHECK(rest(all) == "<1 a><2 b>");
}

TEST_CASE("lines: those that are held come again, from where they were held", "[text]") {
  std::string text = "a\n\"b\n\",1\n";
  for (int i = 0; i < 100000; ++i) text += std::to_string(i) + '\n';
  const TemporaryFile file(text);
  Lines all(file.name());
  REQUIRE(all.next());
  REQUIRE(all.next());
  all.put_back();
  all.hold(true);
  const std::string first = rest(all);
  CHECK(first.starts_with("<2 \"b\n\",1><4 0>"));
  all.put_back();
  all.hold(false);
  CHECK((rest(all) == first));
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

TEST_CASE("lines: lines end with LF, CR LF, or the file", "[text]") {
  CHECK(lines("a\nb\n") == "<1 a><2 b>");
  CHECK(lines("a\r\nb\r\n") == "<1 a><2 b>");
  CHECK(lines("a\nb") == "<1 a><2 b>");
  CHECK(lines("a\n\nb\n\n") == "<1 a><2 ><3 b><4 >");
  CHECK(lines("").empty());
  CHECK(lines("\n") == "<1 >");
}

TEST_CASE(
    "lines: a byte order mark is taken off any line: each of two joined files may begin with one",
    "[text]") {
  CHECK(lines("\xEF\xBB\xBF"
              "a\n\xEF\xBB\xBF"
              "b\n") == "<1 a><2 b>");
  CHECK(lines("\xEF\xBB\xBF\xEF\xBB\xBF"  // the first of them has nothing else
              "a\n") == "<1 a>");
}

TEST_CASE("lines: lines across the blocks of reading are whole", "[text]") {
  std::string text, expected;
  for (int i = 0; i < 20000; ++i) {
    const std::string line = std::to_string(i) + std::string(static_cast<std::size_t>(i % 97), 'x');
    text += line + '\n';
    expected += fmt::format("<{} {}>", i + 1, line);
  }
  CHECK((lines(text) == expected));
  for (const std::size_t length : {(1u << 18) - 1, 1u << 18, (1u << 18) + 1, (1u << 19) - 1,
                                   1u << 19})  // a line's end where a block ends
    CHECK((lines(std::string(length, 'x') + "\nz\n") ==
           fmt::format("<1 {}><2 z>", std::string(length, 'x'))));
  CHECK((lines(std::string(900000, 'y') + "\nz\n") ==
         fmt::format("<1 {}><2 z>", std::string(900000, 'y'))));
}

TEST_CASE("lines: a line of more than a megabyte is refused, and says where", "[text]") {
  const TemporaryFile file("a\n" + std::string((1 << 20) + 10, 'x') + "\n");
  CHECK(anonymous(refusal([&] {
          Lines all(file.name());
          while (all.next()) continue;
        })) == "FILE:2: a line of more than 1048576 bytes");
}

TEST_CASE("lines: what cannot be read is refused with the system's reason", "[text]") {
  CHECK(refusal([] { Lines("/no/such/file"); }) == "/no/such/file: No such file or directory");
  CHECK(refusal([] { Lines("/tmp").next(); }) == "/tmp: Is a directory");
}

TEST_CASE("lines: - is standard input", "[text]") {
  const TemporaryFile file("a\nb\n");
  const Redirect from_file(STDIN_FILENO, file.name());
  Lines input("-");
  CHECK(rest(input) == "<1 a><2 b>");
}

TEST_CASE("lines: a pipe may give one byte at a time", "[text]") {
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  Lines input("/dev/fd/" + std::to_string(ends[0]));
  for (const std::string text : {"\n", "b\n"}) {
    REQUIRE(::write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()));
    REQUIRE(input.next());
    CHECK(input.text() == text.substr(0, text.size() - 1));
  }
  ::close(ends[1]);
  CHECK_FALSE(input.next());
  ::close(ends[0]);
}
