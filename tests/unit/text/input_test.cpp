// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/input.h"

#include <unistd.h>

#include "unit/text/files.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

/// The lines of a file, each in < >.
std::string lines(std::string_view text) {
  const TemporaryFile file(text);
  Input input(file.name());
  std::string all;
  std::size_t number = 0;
  for (std::string_view line; input.next(line);) {
    all.append("<").append(line).append(">");
    REQUIRE(input.line_number() == ++number);
  }
  return all;
}

}  // namespace

TEST_CASE("input: lines end with LF, CR LF, or the file", "[text]") {
  CHECK(lines("a\nb\n") == "<a><b>");
  CHECK(lines("a\r\nb\r\n") == "<a><b>");
  CHECK(lines("a\nb") == "<a><b>");
  CHECK(lines("a\n\nb\n\n") == "<a><><b><>");
  CHECK(lines("").empty());
  CHECK(lines("\n") == "<>");
  CHECK(lines("a\rb\n") == "<a\rb>");  // a CR inside a line is the line's
  CHECK(lines(std::string_view("a\0b\n", 4)) == std::string_view("<a\0b>", 5));
}

TEST_CASE(
    "input: a byte order mark is taken off any line: each of two joined files may begin with one",
    "[text]") {
  CHECK(lines("\xEF\xBB\xBF"
              "a\n\xEF\xBB\xBF"
              "b\n") == "<a><b>");
  CHECK(lines("\xEF\xBB\xBF\xEF\xBB\xBF"  // the first of them has nothing else
              "a\n") == "<a>");
}

TEST_CASE("input: lines across the blocks of reading are whole", "[text]") {
  std::string text, expected;
  for (int i = 0; i < 20000; ++i) {
    const std::string line = std::to_string(i) + std::string(static_cast<std::size_t>(i % 97), 'x');
    text += line + '\n';
    expected += '<' + line + '>';
  }
  CHECK((lines(text) == expected));
  for (const std::size_t length : {(1u << 18) - 1, 1u << 18, (1u << 18) + 1, (1u << 19) - 1,
                                   1u << 19})  // a line's end where a block ends
    CHECK((lines(std::string(length, 'x') + "\nz\n") == '<' + std::string(length, 'x') + "><z>"));
  CHECK((lines(std::string(900000, 'y') + "\nz\n") == '<' + std::string(900000, 'y') + "><z>"));
}

TEST_CASE("input: a line of more than a megabyte is refused, and says where", "[text]") {
  const TemporaryFile file("a\n" + std::string((1 << 20) + 10, 'x') + "\n");
  CHECK(anonymous(refusal([&] {
          Input input(file.name());
          for (std::string_view line; input.next(line);) continue;
        })) == "FILE:2: a line of more than 1048576 bytes");
}

TEST_CASE("input: what cannot be read is refused with the system's reason", "[text]") {
  CHECK(refusal([] { Input input("/no/such/file"); }) ==
        "/no/such/file: No such file or directory");
  CHECK(refusal([] {
          Input input("/tmp");
          std::string_view line;
          input.next(line);
        }) == "/tmp: Is a directory");
}

TEST_CASE("input: - is standard input", "[text]") {
  const TemporaryFile file("a\nb\n");
  const Redirect from_file(STDIN_FILENO, file.name());
  Input input("-");
  std::string_view line;
  REQUIRE(input.next(line));
  CHECK(line == "a");
  REQUIRE(input.next(line));
  CHECK_FALSE(input.next(line));
}

TEST_CASE("input: a pipe may give one byte at a time", "[text]") {
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  Input input("/dev/fd/" + std::to_string(ends[0]));
  std::string_view line;
  for (const std::string text : {"\n", "b\n"}) {
    REQUIRE(::write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()));
    REQUIRE(input.next(line));
    CHECK(line == text.substr(0, text.size() - 1));
  }
  ::close(ends[1]);
  CHECK_FALSE(input.next(line));
  ::close(ends[0]);
}
