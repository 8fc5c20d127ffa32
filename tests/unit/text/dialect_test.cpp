#include "text/dialect.h"

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

namespace {

std::string fields(Dialect& dialect, std::string_view line) {
  std::string all;
  for (const auto field : dialect.split(line)) all += '<' + std::string(field) + '>';
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
