// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/output.h"

#include <initializer_list>
#include <limits>

#include "unit/text/files.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

void row(Output& out, std::initializer_list<double> cells) {
  for (const double cell : cells) out.cell(cell);
  out.end_line();
}

}  // namespace

TEST_CASE("output: names read back as they are, those that begin with a quote or # too", "[text]") {
  const std::vector<Column> columns{{"t", "s"}, {"\"v\""}, {"\"w\"_1", "m"},
                                    {"5\""},    {"\"u"},   {"#1"}};
  const std::string line = names_line(columns);
  std::vector<Column> read;
  for (const std::string& name : split_names(std::string_view(line).substr(2), '\t'))
    read.push_back(read_column(name));
  CHECK(read == columns);
  CHECK(names_line({{"t", "s"}, {"5\""}}) == "# t[s]\t5\"");
}

TEST_CASE("output: names and rows are tab-separated, numbers shortest", "[text]") {
  CHECK(printed([] {
          Output out;
          out.names({{"t", "s", ""}, {"closure", "", ""}});
          row(out, {0.1, 1. / 3, -0.0});
          out.flush();
        }) == "# t[s]\tclosure\n0.1\t0.3333333333333333\t-0\n");
}

TEST_CASE("output: digits hold for every computed number", "[text]") {
  CHECK(printed([] {
          Output out;
          out.digits = 3;
          row(out, {0.1, 2. / 3});
          out.flush();
        }) == "0.1\t0.667\n");
}

TEST_CASE("output: nan and inf are refused, not printed", "[text]") {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    Output out;
    CHECK(refusal([&] { row(out, {1.0, bad}); }) == "the result is not a finite number");
    CHECK(printed([&] {
            out.drop_line();
            out.flush();
          }).empty());
  }
}

TEST_CASE("output: a dropped line leaves the whole lines before it", "[text]") {
  CHECK(printed([] {
          Output out;
          row(out, {1.0});
          out.text("half a");
          out.drop_line();
          out.flush();
        }) == "1\n");
}

TEST_CASE("output: unbuffered, a line goes out at once; else with its block", "[text]") {
  for (const bool unbuffered : {false, true})
    CHECK(printed([&] {
            Output out;
            out.unbuffered = unbuffered;
            row(out, {1.0});
          }) == (unbuffered ? "1\n" : ""));
  const std::string text = printed([] {
    Output out;
    for (int i = 0; i < 40000; ++i) row(out, {1.0});
  });
  CHECK(text.size() >= 1 << 16);  // constant memory: it went out before anybody asked
}

TEST_CASE("output: a full disk is an error, once, and nothing is left to write", "[text]") {
  Output out;
  std::string first, second = "not run";
  {
    const Redirect to_full(STDOUT_FILENO, "/dev/full");
    row(out, {1.0});
    first = refusal([&] { out.flush(); });
    second = refusal([&] {
      out.drop_line();
      out.flush();
    });
  }
  CHECK(first == "standard output: No space left on device");
  CHECK(second.empty());
}

TEST_CASE("output: a last line goes behind what has been printed, and only there", "[text]") {
  CHECK(printed([] {
          Output out;
          row(out, {1.0});
          out.text("half a");
          out.end_with("## the end");
        }) == "1\n## the end\n");
  CHECK(printed([] {
          Output out;
          out.text("half a");
          out.end_with("## the end");
        }).empty());
  CHECK(printed([] {
          Output out;
          row(out, {1.0});
          const Redirect full(STDOUT_FILENO, "/dev/full");
          out.end_with("## the end");  // and does not throw
        }).empty());
}

TEST_CASE("output: a cell of text is quoted where it has to be", "[text]") {
  CHECK(printed([] {
          Output out;
          out.cell(1.0);
          out.cell("a b");
          out.cell("a\"b");
          out.end_line();
          out.flush();
        }) == "1\ta b\t\"a\"\"b\"\n");
}
