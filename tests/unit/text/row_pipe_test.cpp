// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/row_pipe.h"

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
    RowPipe pipe(in, out, "test it");
    if (append.empty()) pipe.replace(v);
    for (const Column& column : append) pipe.append(column);
    while (pipe.next_run()) {
      std::vector<double> waiting;
      const auto put = [&] {
        for (std::size_t i = 0; i < append.size(); ++i)
          pipe.put(static_cast<double>(i + 1) * waiting.front());
        if (append.empty()) pipe.put(-waiting.front());
        waiting.erase(waiting.begin());
      };
      while (pipe.next()) {
        waiting.push_back(pipe[v]);
        if (waiting.size() > late) put();
      }
      while (!waiting.empty()) put();
    }
    out.flush();
  }));
}

const std::vector<Column> one = {{"y", "m", ""}}, two = {{"y", "m", ""}, {"z", "", ""}};

}  // namespace

TEST_CASE("row pipe: a replaced column, whatever stands around it", "[text]") {
  CHECK(filtered({"# t v note\n0 1.0 a\n01 2 b\n"}, {}) ==
        "## test it\n# t\tv[m/s]\tnote\n0\t-1\ta\n01\t-2\tb\n");
}

TEST_CASE("row pipe: appended columns take their numbers in turn", "[text]") {
  CHECK(filtered({"# t v\n0 1.0\n1 2.0\n"}, two) ==
        "## test it\n# t\tv[m/s]\ty[m]\tz\n0\t1.0\t1\t2\n1\t2.0\t2\t4\n");
}

TEST_CASE("row pipe: however late the numbers come, the rows come out the same", "[text]") {
  const std::string text =
      "# by hand\n# t v\n0 1\n# among\n1 2\n2 3\n\n# between\n0 4\n1 5\n# last\n";
  for (const auto& columns : {std::vector<Column>{}, one, two})
    for (std::size_t late = 1; late < 5; ++late) {
      INFO(late << " late, " << columns.size() << " appended");
      CHECK(filtered({text}, columns, late) == filtered({text}, columns, 0));
    }
}

TEST_CASE("row pipe: comments keep their place, also after the last row", "[text]") {
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

TEST_CASE("row pipe: one blank line between runs, none before the first and after the last",
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

TEST_CASE("row pipe: the name of a computed column is its own, the old one becomes NAME_in",
          "[text]") {
  CHECK(filtered({"# t[s] v[m/s] y[km]\n0 1 2\n"}, one) ==
        "## test it\n# t[s]\tv[m/s]\ty_in[km]\ty[m]\n0\t1\t2\t1\n");
  CHECK(filtered({"# y_in v y\n0 1 2\n"}, one) ==
        "## test it\n# y_in\tv[m/s]\ty_in_in\ty[m]\n0\t1\t2\t1\n");
}

TEST_CASE("row pipe: each run goes out with its own history, columns and units", "[text]") {
  CHECK(filtered({"## a b c\n# t v\n0 1\n", "# w v[km/h] t[ms]\n0 36 7\n"}, one) ==
        "## run FILE\n## a b c\n## test it\n# t\tv[m/s]\ty[m]\n0\t1\t1\n\n"
        "## run FILE\n## test it\n# w\tv[m/s]\tt[ms]\ty[m]\n0\t10\t7\t10\n");
}

TEST_CASE("row pipe: what a run without rows had to say goes before the next one, its history not",
          "[text]") {
  CHECK(filtered({"# one\n## a\n# t v\n0 NaN\n# in it\n\n# two\n0 2\n\n# three\n0 NaN\n"}, one) ==
        "# one\n# in it\n## run FILE 2\n# two\n## test it\n# t\tv[m/s]\ty[m]\n0\t2\t2\n# three\n");
}

TEST_CASE("row pipe: a result that is not finite is refused, and its row is not begun", "[text]") {
  const TemporaryFile file("0 1\n1 2\n");
  std::string message;
  CHECK(printed([&] {
          Reader in({.files = {file.name()}}, {"t", "v"});
          Output out;
          in.need("v");
          message = refusal([&] {
            RowPipe pipe(in, out, "test it");
            pipe.append({"y", "", ""});
            pipe.next_run();
            pipe.next();
            pipe.put(1);
            pipe.next();
            pipe.put(std::numeric_limits<double>::infinity());
          });
          out.drop_line();
          out.flush();
        }) == "## test it\n# t[s]\tv[m/s]\ty\n0\t1\t1\n");
  CHECK(message == "the result is not a finite number");
}

TEST_CASE("row pipe: rows that could not be written are not written later", "[text]") {
  const TemporaryFile file("0 1\n1 2\n");
  CHECK(printed([&] {
          Reader in({.files = {file.name()}}, {"t", "v"});
          Output out;
          out.unbuffered = true;
          in.need("v");
          std::string message;
          {
            RowPipe pipe(in, out, "test it");
            pipe.append({"y", "", ""});
            pipe.next_run();
            pipe.next();
            {
              const Redirect full(STDOUT_FILENO, "/dev/full");
              message = refusal([&] { pipe.put(1); });
            }
          }
          CHECK(message == "standard output: No space left on device");
          out.flush();
        }) == "");
}

TEST_CASE("row pipe: rows left out before the first run with a history", "[text]") {
  const TemporaryFile file("0 1\n1 2\n# between\n\n0 3\n1 4\n2 5\n");
  CHECK(base_names_as_FILE(printed([&] {
          Reader in({.files = {file.name()}}, {"t", "v"});
          Output out;
          const auto v = in.need("v");
          RowPipe pipe(in, out, "test it");
          pipe.replace(v);
          pipe.next_run();
          for (std::size_t i = 0; pipe.next(); ++i) pipe.drop(i);
          pipe.next_run();
          while (pipe.next())
            ;
          pipe.drop(1);
          pipe.put(30);
          pipe.put(50);
          pipe.next_run();
          out.flush();
        })) == "# between\n## run FILE 2\n## test it\n# t[s]\tv[m/s]\n0\t30\n2\t50\n");
}

TEST_CASE("row pipe: no row left is an error of its own", "[text]") {
  const TemporaryFile file("0 1\n1 2\n");
  std::string message;
  printed([&] {
    Reader in({.files = {file.name()}}, {"t", "v"});
    Output out;
    RowPipe pipe(in, out, "");
    message = refusal([&] {
      while (pipe.next_run())
        for (std::size_t i = 0; pipe.next(); ++i) pipe.drop(i);
    });
  });
  CHECK(message == "no rows are left");
}

TEST_CASE("row pipe: no row with all its readings is an error", "[text]") {
  const TemporaryFile file("# t v\n0 NaN\n\n1 NaN\n");
  std::string message;
  printed([&] {
    Reader in({.files = {file.name()}}, {});
    Output out;
    in.need("v");
    RowPipe pipe(in, out, "test it");
    pipe.append({"y", "", ""});
    message = refusal([&] {
      while (pipe.next_run())
        while (pipe.next()) pipe.put(1);
    });
  });
  CHECK(message == file.name() + ": no rows: a needed reading is missing in every one");
}

TEST_CASE("row pipe: ten thousand rows that wait for a late filter", "[text]") {
  std::string text, expected = "## test it\n# t[s]\tv[m/s]\ty[m]\n";
  for (int i = 0; i < 10000; ++i) {
    const std::string n = std::to_string(i);
    text += n + ' ' + n + '\n';
    expected += n + '\t' + n + '\t' + n + '\n';
  }
  CHECK((filtered({text}, one, 3000) == expected));
}

TEST_CASE("row pipe: rows left out behind one that waits", "[text]") {
  std::string text;
  for (int i = 0; i < 100; ++i) text += std::to_string(i) + " 1\n";
  const TemporaryFile file("# a\n9 9\n\n" + text);
  const std::string written = printed([&] {
    Reader in({.files = {file.name()}}, {"t", "v"});
    Output out;
    const auto v = in.need("v");
    RowPipe pipe(in, out, "test it");
    pipe.replace(v);
    pipe.next_run();
    pipe.next();
    pipe.next_run();
    while (pipe.next())
      ;
    for (std::size_t i = 0; i < 100; ++i)
      if (i != 3 && i != 98) pipe.drop(i);
    pipe.put(7);
    pipe.put(8);
    pipe.put(9);
    pipe.next_run();
    out.flush();
  });
  CHECK(written.find("\n9\t7\n") != std::string::npos);
  CHECK(written.substr(written.rfind("v[m/s]")) == "v[m/s]\n3\t8\n98\t9\n");
}
