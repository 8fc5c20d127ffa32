#include "text/side_by_side.h"

#include "unit/catch.h"
#include "unit/text/files.h"

using namespace rolling;

namespace {

/// The lines of each run as <number text>, those of a run behind a |.
std::string apart(const std::string& text, const std::vector<std::string>& names) {
  std::vector<Column> columns;
  for (const std::string& name : names) columns.push_back(read_column(name));
  const TemporaryFile file(text);
  Lines lines(file.name());
  Dialect dialect;
  dialect.choose("0,1,2,3");
  std::string all;
  const std::string message = refusal([&] {
    for (const Side& side : take_apart(lines, dialect, Layout::of(columns))) {
      all += '|';
      for (std::size_t i = 0; i < side.size(); ++i)
        all += fmt::format("<{} {}>", side[i].number, side[i].text);
    }
  });
  while (lines.next()) all += fmt::format(" {}", lines.text());
  return message.empty() ? all : anonymous(message);
}

const std::vector<std::string> two = {"t Run 1", "v Run 1", "t Run 2", "v Run 2"},
                               shared = {"t", "v Run 1", "v Run 2"};

}  // namespace

TEST_CASE("side by side: runs become lines of their own, up to the end of the run", "[text]") {
  CHECK(apart("0,1,5,6\n1,2,7,8\n\n9,9,9,9\n", two) ==
        "|<1 0\t1><2 1\t2>|<1 5\t6><2 7\t8> 9,9,9,9");
  CHECK(apart("0,1,5,6\n## a\n", two) == "|<1 0\t1>|<1 5\t6> ## a");
  CHECK(apart("0,1,5\n", shared) == "|<1 0\t1>|<1 0\t5>");
  CHECK(apart("0,\"a\tb\",5,\"#\"\n", two) == "|<1 0\t\"a\tb\">|<1 5\t\"#\">");
}

TEST_CASE("side by side: blanks below the last reading are padding, those above it are not",
          "[text]") {
  CHECK(apart("0,1,5,6\n1,2\n2,3,7,8\n3,4,,\n", two) ==
        "|<1 0\t1><2 1\t2><3 2\t3><4 3\t4>|<1 5\t6><2 \t><3 7\t8>");
  CHECK(apart("0,1,5\n1,2,\n", shared) == "|<1 0\t1><2 1\t2>|<1 0\t5>");
}

TEST_CASE("side by side: comments stay with the first run", "[text]") {
  CHECK(apart("0,1,5,6\n# a\n,,7,8\n# b\n", two) == "|<1 0\t1><2 # a><4 # b>|<1 5\t6><3 7\t8>");
}

TEST_CASE("side by side: what is no record is refused with its line", "[text]") {
  CHECK(apart("0,1,5,6\n1,2,3,4,5\n", two) == "FILE:2: 5 fields where the first row has 4");
  CHECK(apart("0,1,5,\"6\n", two) == "FILE:1: a quote that is not closed");
  CHECK(apart("0,1,5,6\n## smooth: ended with an error\n", two) ==
        "FILE:2: smooth ended with an error: the rows are not complete");
}
