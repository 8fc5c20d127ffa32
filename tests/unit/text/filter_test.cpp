// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/filter.h"

#include <limits>

#include "unit/text/files.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

std::string base_names_as_FILE(std::string text) {
  const std::string base = temporary_name().substr(temporary_name().rfind('/') + 1);
  for (auto at = text.find(base); at != std::string::npos; at = text.find(base))
    text.replace(at, base.size() + 6, "FILE");
  return text;
}

/// What a filter prints that replaces v by -v, or appends `columns` of v, 2 v, ..., each row
/// `late` rows late.
std::string filtered(const std::vector<std::string>& texts, const std::vector<Column>& append,
                     std::size_t late = 0) {
  std::vector<std::unique_ptr<TemporaryFile>> files;
  ReaderOptions options;
  for (const std::string& text : texts)
    options.files.push_back(files.emplace_back(std::make_unique<TemporaryFile>(text))->name());
  return base_names_as_FILE(printed([&] {
    Reader in(options, {"t", "v"});
    Output out;
    const auto v = in.need("v");
    Filter filter(in, out, "test it");
    if (append.empty()) filter.replace(v);
    for (const Column& column : append) filter.append(column);
    while (filter.next_run()) {
      std::vector<double> waiting;
      const auto put = [&] {
        for (std::size_t i = 0; i < append.size(); ++i)
          filter.put(static_cast<double>(i + 1) * waiting.front());
        if (append.empty()) filter.put(-waiting.front());
        waiting.erase(waiting.begin());
      };
      while (filter.next()) {
        waiting.push_back(filter[v]);
        if (waiting.size() > late) put();
      }
      while (!waiting.empty()) put();
    }
    out.flush();
  }));
}

const std::vector<Column> one = {{"y", "m", ""}}, two = {{"y", "m", ""}, {"z", "", ""}};

}  // namespace

TEST_CASE("filter: a replaced column, whatever stands around it", "[text]") {
  CHECK(filtered({"# t v note\n0 1.0 a\n01 2 b\n"}, {}) ==
        "## test it\n# t\tv[m/s]\tnote\n0\t-1\ta\n01\t-2\tb\n");
}

TEST_CASE("filter: appended columns take their numbers in turn", "[text]") {
  CHECK(filtered({"# t v\n0 1.0\n1 2.0\n"}, two) ==
        "## test it\n# t\tv[m/s]\ty[m]\tz\n0\t1.0\t1\t2\n1\t2.0\t2\t4\n");
}

TEST_CASE("filter: however late the numbers come, the rows come out the same", "[text]") {
  const std::string text =
      "# by hand\n# t v\n0 1\n# among\n1 2\n2 3\n\n# between\n0 4\n1 5\n# last\n";
  for (const auto& columns : {std::vector<Column>{}, one, two})
    for (std::size_t late = 1; late < 5; ++late) {
      INFO(late << " late, " << columns.size() << " appended");
      CHECK(filtered({text}, columns, late) == filtered({text}, columns, 0));
    }
}

TEST_CASE("filter: comments keep their place, also after the last row", "[text]") {
  for (std::size_t late = 0; late < 4; ++late) {
    INFO(late << " late");
    CHECK(
        filtered({"# by hand\n# t v\n0 1\n# among\n1 2\n# end of run\n\n# between\n0 4\n# last\n"},
                 one, late) ==
        "## run FILE 1\n# by hand\n## test it\n# t\tv[m/s]\ty[m]\n0\t1\t1\n# among\n1\t2\t2\n"
        "# end of run\n\n## run FILE 2\n# between\n## test it\n# t\tv[m/s]\ty[m]\n0\t4\t4\n"
        "# last\n");
  }
}

TEST_CASE("filter: one blank line between runs, none before the first and after the last",
          "[text]") {
  CHECK(filtered({"\n\n0 1\n\n\n\n0 2\n\n\n"}, one) ==
        "## run FILE 1\n## test it\n# t[s]\tv[m/s]\ty[m]\n0\t1\t1\n\n"
        "## run FILE 2\n## test it\n# t[s]\tv[m/s]\ty[m]\n0\t2\t2\n");
  CHECK(filtered({"0 1\n", "0 2\n"}, one) ==
        "## run FILE\n## test it\n# t[s]\tv[m/s]\ty[m]\n0\t1\t1\n\n"
        "## run FILE\n## test it\n# t[s]\tv[m/s]\ty[m]\n0\t2\t2\n");
  CHECK(filtered({"# t v\n0 NaN\n\n0 2\n\n0 NaN\n\n0 3\n"}, one) ==
        "## run FILE 2\n## test it\n# t\tv[m/s]\ty[m]\n0\t2\t2\n\n"
        "## run FILE 4\n## test it\n# t\tv[m/s]\ty[m]\n0\t3\t3\n");
}

TEST_CASE("filter: the name of a computed column is its own, the old one becomes NAME_in",
          "[text]") {
  CHECK(filtered({"# t[s] v[m/s] y[km]\n0 1 2\n"}, one) ==
        "## test it\n# t[s]\tv[m/s]\ty_in[km]\ty[m]\n0\t1\t2\t1\n");
  CHECK(filtered({"# y_in v y\n0 1 2\n"}, one) ==
        "## test it\n# y_in\tv[m/s]\ty_in_in\ty[m]\n0\t1\t2\t1\n");
}

TEST_CASE("filter: each run goes out with its own history, columns and units", "[text]") {
  CHECK(filtered({"## a b c\n# t v\n0 1\n", "# w v[km/h] t[ms]\n0 36 7\n"}, one) ==
        "## run FILE\n## a b c\n## test it\n# t\tv[m/s]\ty[m]\n0\t1\t1\n\n"
        "## run FILE\n## test it\n# w\tv[m/s]\tt[ms]\ty[m]\n0\t10\t7\t10\n");
}

TEST_CASE("filter: what a run without rows had to say goes before the next one, its history not",
          "[text]") {
  CHECK(filtered({"# one\n## a\n# t v\n0 NaN\n# in it\n\n# two\n0 2\n\n# three\n0 NaN\n"}, one) ==
        "# one\n# in it\n## run FILE 2\n# two\n## test it\n# t\tv[m/s]\ty[m]\n0\t2\t2\n# three\n");
}

TEST_CASE("filter: a result that is not finite is refused, and its row is not begun", "[text]") {
  const TemporaryFile file("0 1\n1 2\n");
  std::string message;
  CHECK(printed([&] {
          Reader in({.files = {file.name()}}, {"t", "v"});
          Output out;
          in.need("v");
          message = refusal([&] {
            Filter filter(in, out, "test it");
            filter.append({"y", "", ""});
            filter.next_run();
            filter.next();
            filter.put(1);
            filter.next();
            filter.put(std::numeric_limits<double>::infinity());
          });
          out.drop_line();
          out.flush();
        }) == "## test it\n# t[s]\tv[m/s]\ty\n0\t1\t1\n");
  CHECK(message == "the result is not a finite number");
}

TEST_CASE("filter: rows that could not be written are not written later", "[text]") {
  const TemporaryFile file("0 1\n1 2\n");
  CHECK(printed([&] {
          Reader in({.files = {file.name()}}, {"t", "v"});
          Output out;
          out.unbuffered = true;
          in.need("v");
          std::string message;
          {
            Filter filter(in, out, "test it");
            filter.append({"y", "", ""});
            filter.next_run();
            filter.next();
            {
              const Redirect full(STDOUT_FILENO, "/dev/full");
              message = refusal([&] { filter.put(1); });
            }
          }
          CHECK(message == "standard output: No space left on device");
          out.flush();
        }) == "");
}

TEST_CASE("filter: rows left out before the first run with a history", "[text]") {
  const TemporaryFile file("0 1\n1 2\n# between\n\n0 3\n1 4\n2 5\n");
  CHECK(base_names_as_FILE(printed([&] {
          Reader in({.files = {file.name()}}, {"t", "v"});
          Output out;
          const auto v = in.need("v");
          Filter filter(in, out, "test it");
          filter.replace(v);
          filter.next_run();
          for (std::size_t i = 0; filter.next(); ++i) filter.drop(i);
          filter.next_run();
          while (filter.next())
            ;
          filter.drop(1);
          filter.put(30);
          filter.put(50);
          filter.next_run();
          out.flush();
        })) == "# between\n## run FILE 2\n## test it\n# t[s]\tv[m/s]\n0\t30\n2\t50\n");
}

TEST_CASE("filter: no row left is an error of its own", "[text]") {
  const TemporaryFile file("0 1\n1 2\n");
  std::string message;
  printed([&] {
    Reader in({.files = {file.name()}}, {"t", "v"});
    Output out;
    Filter filter(in, out, "");
    message = refusal([&] {
      while (filter.next_run())
        for (std::size_t i = 0; filter.next(); ++i) filter.drop(i);
    });
  });
  CHECK(message == "no rows are left");
}

TEST_CASE("filter: no row with all its readings is an error", "[text]") {
  const TemporaryFile file("# t v\n0 NaN\n\n1 NaN\n");
  std::string message;
  printed([&] {
    Reader in({.files = {file.name()}}, {});
    Output out;
    in.need("v");
    Filter filter(in, out, "test it");
    filter.append({"y", "", ""});
    message = refusal([&] {
      while (filter.next_run())
        while (filter.next()) filter.put(1);
    });
  });
  CHECK(message == file.name() + ": no rows: a needed reading is missing in every one");
}

TEST_CASE("filter: ten thousand rows that wait for a late filter", "[text]") {
  std::string text, expected = "## test it\n# t[s]\tv[m/s]\ty[m]\n";
  for (int i = 0; i < 10000; ++i) {
    const std::string n = std::to_string(i);
    text += n + ' ' + n + '\n';
    expected += n + '\t' + n + '\t' + n + '\n';
  }
  CHECK((filtered({text}, one, 3000) == expected));
}

TEST_CASE("filter: rows left out behind one that waits", "[text]") {
  std::string text;
  for (int i = 0; i < 100; ++i) text += std::to_string(i) + " 1\n";
  const TemporaryFile file("# a\n9 9\n\n" + text);
  const std::string written = printed([&] {
    Reader in({.files = {file.name()}}, {"t", "v"});
    Output out;
    const auto v = in.need("v");
    Filter filter(in, out, "test it");
    filter.replace(v);
    filter.next_run();
    filter.next();
    filter.next_run();
    while (filter.next())
      ;
    for (std::size_t i = 0; i < 100; ++i)
      if (i != 3 && i != 98) filter.drop(i);
    filter.put(7);
    filter.put(8);
    filter.put(9);
    filter.next_run();
    out.flush();
  });
  CHECK(written.find("\n9\t7\n") != std::string::npos);
  CHECK(written.substr(written.rfind("v[m/s]")) == "v[m/s]\n3\t8\n98\t9\n");
}
