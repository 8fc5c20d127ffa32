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
  CHECK(chosen("Time (s),Velocity (m/s)") == "no number: <Time (s)><Velocity (m/s)>");
  CHECK(chosen("\"0,5\",\"1,5\"") == "<0,5><1,5>");  // a record that is refused, not a heading
  CHECK(chosen("") == "no number: ");
}

TEST_CASE("dialect: decimal commas and U+2212 are read where they leave no doubt", "[text]") {
  Dialect semicolon;
  REQUIRE(semicolon.choose("0,5;1"));
  CHECK(fields(semicolon, "\xE2\x88\x92" "1,5E\xE2\x88\x92" "2;x,y") == "<-1.5E-2><x,y>");
  CHECK_THROWS_AS(semicolon.split("1.5;2"), Error);
  Dialect tab;
  REQUIRE(tab.choose("0\t1"));
  CHECK(fields(tab, "1\t2.5") == "<1><2.5>");
  CHECK(fields(tab, "1\t2,5") == "<1><2,5>");  // and so no number
  Dialect comma, blanks;
  REQUIRE(comma.choose("0,1"));
  CHECK(fields(comma, "1,\xE2\x88\x92" "2") == "<1><\xE2\x88\x92" "2>");
  REQUIRE(blanks.choose("0 1"));
  CHECK(fields(blanks, "1 \xE2\x88\x92" "2") == "<1><\xE2\x88\x92" "2>");
}

TEST_CASE("dialect: a quote opens where a field begins; elsewhere it is a character", "[text]") {
  CHECK(chosen("5\" pipe,7") == "<5\" pipe><7>");
  CHECK(chosen("a, \"b,c\" ,7") == "<a><b,c><7>");
  CHECK(chosen("\"a\"\"\",\"\",7") == "<a\"><><7>");
  CHECK(chosen("\"a\" b,\"c\"d\"e,7") == "no number: <a b><cde,7>");  // what stands behind the closing quote, up to another that opens
  CHECK(chosen("7,\"open") == "<7><open>");
}

TEST_CASE("dialect: a wanted number is that of its field, wherever and however it stands", "[text]") {
  const auto numbers = [](std::string_view first, std::string_view line) {
    Dialect dialect;
    REQUIRE(dialect.choose(first));
    dialect.want(0);
    dialect.want(2);
    std::string all;
    for (const Field& field : dialect.split(line)) all += std::isnan(field.number) ? "- " : fmt::format("{} ", field.number);
    return all;
  };
  for (const std::string line : {"1.5\t7\t-2e3", "1.5 \t\"7\"\t \"-2e3\"", "+1.50\t\t-2000."}) CHECK(numbers("0\t0\t0", line) == "1.5 - -2000 ");
  for (const std::string line : {"1,5;7;-2e3", "\"1,5\" ;7;\xE2\x88\x92" "2000"}) CHECK(numbers("0,5;0;0", line) == "1.5 - -2000 ");
  CHECK(numbers("0 0 0", "  1.5 7\t-2e3  ") == "1.5 - -2000 ");
  CHECK(numbers("0,0,0", "1.5 , 7 ,-2e3") == "1.5 - -2000 ");
  for (const std::string line : {"1.5x,7,-2e3e", "nan,7,", ",7,inf", "1 5,7,--2", "\"\",7,1e400"}) CHECK(numbers("0,0,0", line) == "- - - ");
  for (const std::string line : {"1.5x 7 -2e3e", "nan 7 x", "1,5 7 1e400"}) CHECK(numbers("0 0 0", line) == "- - - ");
  CHECK(numbers("0,0,0", "1,2") == "1 - ");
  CHECK(numbers("0,0,0", "1,2,3,4") == "1 - 3 - ");
}

TEST_CASE("dialect: the texts of a long line that do not stand in it all last until the next", "[text]") {
  Dialect dialect;
  std::string line = "1,5", expected = "<1.5>";
  CHECK(dialect.choose("0,5;x"));
  for (int i = 0; i < 1000; ++i) {
    line += ";\"1\"2,5;\"a \"\"b\"\"\";\xE2\x88\x92" + std::to_string(i) + ",25;\"" + std::string(static_cast<std::size_t>(i % 40), '7') + ",\"8";
    expected += "<12.5><a \"b\"><-" + std::to_string(i) + ".25><" + std::string(static_cast<std::size_t>(i % 40), '7') + ".8>";
  }
  CHECK(fields(dialect, line) == expected);
}

TEST_CASE("dialect: a line is as it stands where nothing but tabs is between its fields", "[text]") {
  Dialect dialect;
  REQUIRE(dialect.choose("0.5\t1\tx"));
  dialect.want(0);
  const auto stands = [&](std::string_view line) {
    dialect.split(line);
    return dialect.as_it_stands();
  };
  CHECK(stands("0.5\t1\tx y"));
  CHECK(stands("NaN\t\t"));
  for (const char* line : {"0.5 \t1\tx", " 0.5\t1\tx", "0.5\t1 \tx", "0.5\t1\t x", "0.5\t\"1\"\tx", "0.5\t1\t\xE2\x88\x92" "1"}) CHECK_FALSE(stands(line));
}
