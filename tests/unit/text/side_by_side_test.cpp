// SPDX-License-Identifier: GPL-3.0-or-later
#include "unit/text/rows.h"

using namespace rolling;

namespace {

/// The lines of each run below a header as <number text>, those of a run behind a |.
std::string apart(const std::string& text, const std::string& header) {
  const TemporaryFile file(header + "\n" + text);
  std::string all;
  const std::string message = refusal([&] {
    Reader in({.files = {file.name()}}, {});
    while (in.next_run()) {
      all += '|';
      for (bool more = true; more;) {
        more = in.next();
        for (const std::string& remark : in.remarks()) all += fmt::format("<{}>", remark);
        if (!more) break;
        Bytes line;
        in.append_text(line);
        const std::string where = in.where();
        all += fmt::format("<{} {}>", where.substr(where.rfind(':') + 1),
                           std::string_view(line.data(), line.size()));
      }
    }
  });
  return message.empty() ? all : anonymous(message);
}

const std::string two = "t Run 1,v Run 1,t Run 2,v Run 2", shared = "t,v Run 1,v Run 2";

}  // namespace

TEST_CASE("side by side: each run has its rows, up to the end of the run", "[text]") {
  CHECK(apart("0,1,5,6\n1,2,7,8\n\n9,9,9,9\n", two) ==
        "|<2 0\t1><3 1\t2>|<2 5\t6><3 7\t8>|<5 9\t9>|<5 9\t9>");
  CHECK(apart("0,1,5,6\n## a\n1,1,1,1\n", two) == "|<2 0\t1>|<2 5\t6>|<4 1\t1>|<4 1\t1>");
  CHECK(apart("0,1,5\n", shared) == "|<2 0\t1>|<2 0\t5>");
  CHECK(apart("0,\"a\tb\",5,\"#\"\n", two) == "|<2 0\t\"a\tb\">|<2 5\t\"#\">");
}

TEST_CASE("side by side: a row of which a run has no reading is none of it", "[text]") {
  CHECK(apart("0,1,5,6\n1,2\n2,3,7,8\n3,4,,\n", two) ==
        "|<2 0\t1><3 1\t2><4 2\t3><5 3\t4>|<2 5\t6><4 7\t8>");
  CHECK(apart("0,1,5\n1,2,\n", shared) == "|<2 0\t1><3 1\t2>|<2 0\t5>");
}

TEST_CASE("side by side: comments stay with the first run", "[text]") {
  CHECK(apart("0,1,5,6\n# a\n,,7,8\n# b\n", two) == "|<2 0\t1><# a><# b>|<2 5\t6><4 7\t8>");
}

TEST_CASE("side by side: what is no row is refused with its line", "[text]") {
  CHECK(apart("0,1,5,6\n1,2,3,4,5\n", two) ==
        "FILE:3: 5 fields where the first row has 4; if some of its commas are decimal ones, make "
        "them points first");
  CHECK(apart("0,1,5,\"6\n", two) == "FILE:2: a quote that is not closed");
  CHECK(apart("0,1,5,6\n## smooth: ended with an error\n", two) ==
        "FILE:3: smooth ended with an error: the rows are not complete");
}
