// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/dialect.h"

#include <cmath>

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

std::string fields(Dialect& dialect, std::string_view line) {
  std::string all;
  for (const Field& field : dialect.split(line)) all += '<' + std::string(field.text) + '>';
  return all;
}

std::string chosen(std::string_view line) {
  Dialect dialect;
  const bool number = dialect.choose(line);
  return (number ? "" : "no number: ") + fields(dialect, line);
}

std::string outside(std::string_view text, std::string_view between = separators) {
  bool within = false;
  const std::string unquoted = outside_quotes(text, between, within);
  return unquoted + (within ? "..." : "");
}

std::string appended(std::string_view field) {
  Bytes line;
  append_field(line, field);
  return {line.data(), line.size()};
}

}  // namespace

TEST_CASE("dialect: the form is the first of tab ; , outside quotes, else blanks", "[text]") {
  CHECK(chosen("1 2\t3") == "<1><2><3>");
  CHECK(chosen("1\t2 x") == "<1><2 x>");
  CHECK(chosen("1\t\t3") == "<1><><3>");
  CHECK(chosen("1; 2;3") == "<1><2><3>");
  CHECK(chosen("1,2;3,5") == "<1.2><3.5>");
  CHECK(chosen("1 , 2,") == "<1><2><>");
  CHECK(chosen("  1   2  ") == "<1><2>");
  CHECK(chosen("\"a,b\",\"say \"\"so\"\"\",7") == "<a,b><say \"so\"><7>");
  CHECK(chosen("\"a\"\"\tb\",1") == "<a\"\tb><1>");
  CHECK(chosen("Time (s),Velocity (m/s)") == "no number: <Time (s)><Velocity (m/s)>");
  CHECK(chosen("\"0,5\",\"1,5\"") == "<0,5><1,5>");  // a row that is refused, not a heading
  CHECK(chosen("") == "no number: ");
}

TEST_CASE("dialect: a choice forgets what the lines before it have shown", "[text]") {
  Dialect dialect;
  REQUIRE(dialect.choose("1.5;2.5"));
  dialect.want(0);
  CHECK(dialect.split("1.5;2.5")[0].number == 1.5);
  REQUIRE(dialect.choose("0,5;1,5"));
  const auto fields = dialect.split("0,5;1,5");  // both decimal marks in one file are refused
  CHECK(fields[0].text == "0.5");
  CHECK(std::isnan(fields[0].number));  // not wanted any more
}

TEST_CASE("dialect: decimal commas and U+2212 are read where they leave no doubt", "[text]") {
  Dialect semicolon;
  REQUIRE(semicolon.choose("0,5;1"));
  CHECK(fields(semicolon,
               "\xE2\x88\x92"
               "1,5E\xE2\x88\x92"
               "2;x,y") == "<-1.5E-2><x,y>");
  CHECK_THROWS_AS(semicolon.split("1.5;2"), Error);
  Dialect tab;
  REQUIRE(tab.choose("0\t1"));
  CHECK(fields(tab, "1\t2.5") == "<1><2.5>");
  CHECK(fields(tab, "1\t2,5") == "<1><2,5>");  // and so no number
  Dialect comma, blanks;
  REQUIRE(comma.choose("0,1"));
  CHECK(fields(comma,
               "1,\xE2\x88\x92"
               "2") ==
        "<1><\xE2\x88\x92"
        "2>");
  REQUIRE(blanks.choose("0 1"));
  CHECK(fields(blanks,
               "1 \xE2\x88\x92"
               "2") ==
        "<1><\xE2\x88\x92"
        "2>");
}

TEST_CASE("dialect: a quote opens where a field begins; elsewhere it is a character", "[text]") {
  CHECK(chosen("5\" pipe,7") == "<5\" pipe><7>");
  CHECK(chosen("a, \"b,c\" ,7") == "<a><b,c><7>");
  CHECK(chosen("\"a\"\"\",\"\",7") == "<a\"><><7>");
  CHECK_THROWS_WITH(chosen("7,\"a\" b"), "field 2: text behind the quotes of '\"a\" b'");
}

TEST_CASE("dialect: a wanted number is that of its field, wherever and however it stands",
          "[text]") {
  const auto numbers = [](std::string_view first, std::string_view line) {
    Dialect dialect;
    REQUIRE(dialect.choose(first));
    dialect.want(0);
    dialect.want(2);
    std::string all;
    for (const Field& field : dialect.split(line))
      all += std::isnan(field.number) ? "- " : fmt::format("{} ", field.number);
    return all;
  };
  for (const std::string line : {"1.5\t7\t-2e3", "1.5 \t\"7\"\t \"-2e3\"", "+1.50\t\t-2000."})
    CHECK(numbers("0\t0\t0", line) == "1.5 - -2000 ");
  for (const std::string line : {"1,5;7;-2e3",
                                 "\"1,5\" ;7;\xE2\x88\x92"
                                 "2000"})
    CHECK(numbers("0,5;0;0", line) == "1.5 - -2000 ");
  CHECK(numbers("0 0 0", "  1.5 7\t-2e3  ") == "1.5 - -2000 ");
  CHECK(numbers("0,0,0", "1.5 , 7 ,-2e3") == "1.5 - -2000 ");
  for (const std::string line : {"1.5x,7,-2e3e", "nan,7,", ",7,inf", "1 5,7,--2", "\"\",7,1e400"})
    CHECK(numbers("0,0,0", line) == "- - - ");
  for (const std::string line : {"1.5x 7 -2e3e", "nan 7 x", "1,5 7 1e400"})
    CHECK(numbers("0 0 0", line) == "- - - ");
  CHECK(numbers("0,0,0", "1,2") == "1 - ");
  CHECK(numbers("0,0,0", "1,2,3,4") == "1 - 3 - ");
}

TEST_CASE("dialect: the texts of a long line that do not stand in it all last until the next",
          "[text]") {
  Dialect dialect;
  std::string line = "1,5", expected = "<1.5>";
  CHECK(dialect.choose("0,5;x"));
  for (int i = 0; i < 1000; ++i) {
    line += ";\"12,5\";\"a \"\"b\"\"\";\xE2\x88\x92" + std::to_string(i) + ",25;\"" +
            std::string(static_cast<std::size_t>(i % 40), '7') + ",8\"";
    expected += "<12.5><a \"b\"><-" + std::to_string(i) + ".25><" +
                std::string(static_cast<std::size_t>(i % 40), '7') + ".8>";
  }
  CHECK(fields(dialect, line) == expected);
}

namespace {

/// What split_plain() makes of the line that begins `text`: its fields, as numbers where these are
/// wanted; "?" if there is doubt.
std::string plain_fields(Dialect& dialect, std::string_view text, std::size_t size) {
  std::span<const Field> found;
  const char* const end = dialect.split_plain(text, found);
  if (!end) return "?";
  CHECK(end == text.data() + size);
  std::string all;
  for (const Field& field : found) all += fmt::format("<{}|{}>", field.text, field.number);
  return all;
}

}  // namespace

TEST_CASE("dialect: a line of numbers and plain text is split before its end is known", "[text]") {
  for (const char separator : {'\t', ';', ','}) {
    Dialect dialect;
    const auto line = [&](std::string_view first, std::string_view second, std::string_view third) {
      return std::string(first) + separator + std::string(second) + separator + std::string(third);
    };
    REQUIRE(dialect.choose(line("0.5", "1", "x")));
    dialect.want(0);
    dialect.want(1);
    for (const char* end : {"\n", "\r\n"}) {
      const std::string plain = line("-1.5", "2e3", "a.b");
      CHECK(plain_fields(dialect, plain + end + "3", plain.size()) ==
            "<-1.5|-1.5><2e3|2000><a.b|nan>");
    }
    const std::string quoted = line("\"1\"", "2", "\"x\"");
    CHECK(plain_fields(dialect, quoted + "\n", quoted.size()) == "<1|1><2|2><x|nan>");
    const std::string blanks = line("  1", " 2", " \"x\"");
    CHECK(plain_fields(dialect, blanks + "\n", blanks.size()) == "<1|1><2|2><x|nan>");
    const std::string plain = line("1", "2", "x");
    CHECK(plain_fields(dialect, line("1", "2", "") + "\n", 0) == "?");
    CHECK(plain_fields(dialect, line("", "2", "x") + "\n", 0) == "?");
    for (const char* odd : {"", "\r", "\r\r\n", " \n", "\"\n", "#\n"})
      CHECK(plain_fields(dialect, plain + odd, 0) == "?");
    for (const char* odd : {"NaN", "1 ", "\"1", "\"\"", "\"1 \"", "\"1\"1", "\"1\" ", "1\"", "#1",
                            "1x", "0x1", "1e", "1e400",
                            "\xE2\x88\x92"
                            "1"})
      for (const std::string& text : {line(odd, "2", "x"), line("1", odd, "x")}) {
        INFO(text);
        CHECK(plain_fields(dialect, text + "\n", 0) == "?");
      }
    CHECK(plain_fields(dialect, "\n", 0) == "?");
    CHECK(plain_fields(dialect, "1\n", 1) ==
          "<1|1>");  // how many fields there must be is not its business
  }
}

TEST_CASE("dialect: a line of blanks between its fields is split before its end is known",
          "[text]") {
  Dialect dialect;
  REQUIRE(dialect.choose("0.5 1 x"));
  dialect.want(0);
  for (const std::string line : {"-1.5 2e3 a.b", "  -1.5   2e3 \ta.b"})
    CHECK(plain_fields(dialect, line + "\n", line.size()) == "<-1.5|-1.5><2e3|nan><a.b|nan>");
  for (const char* odd : {"", " \n", "1 2 x \n", "1 2 x", "\"1\" 2 x\n", "1 \"2\" x\n", "1,5 2 x\n",
                          "1 2 x y\n", "#1 2 x\n", "1 #2 x\n"})
    CHECK(plain_fields(dialect, odd, 0) == "?");
}

TEST_CASE("dialect: a line whose decimal mark is not known yet is not split before its end is",
          "[text]") {
  for (const char* line : {"1;2", "1\t2"}) {
    Dialect dialect;
    REQUIRE(dialect.choose(line));
    dialect.want(0);
    CHECK(plain_fields(dialect, std::string(line) + "\n", 0) == "?");
  }
}

TEST_CASE("dialect: what is split before its end is known is split alike after it", "[text]") {
  std::uint32_t state = 1;
  const auto draw = [&](std::size_t count) {
    return (state = state * 1664525 + 1013904223) / 65536 % count;
  };
  const std::string_view alphabet = "0123456789019..,,-+eE\t\t\t;;; \"#x";
  for (const std::string first : {"0.5\t1.5", "0,5\t1,5", "0,5;1,5", "0.5 1.5"}) {
    int taken = 0;
    for (int i = 0; i < 100000; ++i) {
      std::string line;
      for (std::size_t size = 1 + draw(12); line.size() < size;)
        line += alphabet[draw(alphabet.size())];
      const auto dialect_of = [&] {
        Dialect dialect;
        dialect.choose(first);
        dialect.want(0);
        dialect.want(2);
        return dialect;
      };
      Dialect one = dialect_of(), other = dialect_of();
      const std::string plain = plain_fields(one, line + "\n", line.size());
      if (plain == "?") continue;
      ++taken;
      std::string all;
      for (const Field& field : other.split(line))
        all += fmt::format("<{}|{}>", field.text, field.number);
      INFO(first << ' ' << line);
      CHECK(plain == all);
    }
    CHECK(taken > 1000);
  }
}

TEST_CASE("dialect: a line of numbers with decimal commas is split before its end is known",
          "[text]") {
  Dialect dialect;
  REQUIRE(dialect.choose("0,5;1;x"));
  dialect.want(0);
  CHECK(plain_fields(dialect, "1,5;2,5e3;x\r\n4,5", 11) == "<1.5|1.5><2.5e3|nan><x|nan>");
  CHECK(plain_fields(dialect, "\"1,5\";3;\"x\"\n", 11) == "<1.5|1.5><3|nan><x|nan>");
  for (const char* odd : {"1.5;2;x\n", "1,5;2,5;x,y\n", "1,2,5;2;x\n", "1,5;2;x"})
    CHECK(plain_fields(dialect, odd, 0) == "?");
}

TEST_CASE("dialect: what stands outside quotes", "[text]") {
  CHECK(outside("a,\"b,c\",d") == "a,,d");
  CHECK(outside("\"a\"\"b\";c") == ";c");
  CHECK(outside("5\" wheel,c\"d") == "5\" wheel,c\"d");  // a quote that begins no field
  CHECK(outside("a, \"b\tc\"") == "a, ");
  CHECK(outside("a,\"b") == "a,...");
  CHECK(outside("a,\"b", "\t") == "a,\"b");
  CHECK(outside("a\t\"b", "\t") == "a\t...");
}

TEST_CASE("dialect: a field is quoted where it cannot stand bare", "[text]") {
  for (const char* bare : {"", "a", "a b", "a,b;c", "1#2"}) CHECK(appended(bare) == bare);
  CHECK(appended("a\tb") == "\"a\tb\"");
  CHECK(appended("a\nb") == "\"a\nb\"");
  CHECK(appended("#1") == "\"#1\"");
  CHECK(appended("5\"") == "\"5\"\"\"");
}

TEST_CASE("dialect: separators, two uses of them are one object, so that a search ends", "[text]") {
  CHECK(separators.data() == filling.data());
  CHECK(std::ranges::find(separators, 'x') == separators.end());
}
