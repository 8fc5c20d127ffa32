// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/delimiters.h"

#include "unit/catch.h"

using namespace rolling;

namespace {

std::string outside(std::string_view text, std::string_view between = separators) {
  const Unquoted unquoted = outside_quotes(text, between);
  return unquoted.text + (unquoted.ends_within ? "..." : "");
}

std::string appended(std::string_view field) {
  Bytes line;
  append_field(line, field);
  return {line.data(), line.size()};
}

}  // namespace

TEST_CASE("delimiters: what stands outside quotes", "[text]") {
  CHECK(outside("a,\"b,c\",d") == "a,,d");
  CHECK(outside("\"a\"\"b\";c") == ";c");
  CHECK(outside("5\" wheel,c\"d") == "5\" wheel,c\"d");  // a quote that begins no field
  CHECK(outside("a, \"b\tc\"") == "a, ");
  CHECK(outside("a,\"b") == "a,...");
  CHECK(outside("a,\"b", "\t") == "a,\"b");
  CHECK(outside("a\t\"b", "\t") == "a\t...");
}

TEST_CASE("delimiters: a field is quoted where it cannot stand bare", "[text]") {
  for (const char* bare : {"", "a", "a b", "a,b;c", "1#2"}) CHECK(appended(bare) == bare);
  CHECK(appended("a\tb") == "\"a\tb\"");
  CHECK(appended("a\nb") == "\"a\nb\"");
  CHECK(appended("#1") == "\"#1\"");
  CHECK(appended("5\"") == "\"5\"\"\"");
}

TEST_CASE("separators: two uses of them are one object, so that a search ends", "[text]") {
  CHECK(separators.data() == filling.data());
  CHECK(std::ranges::find(separators, 'x') == separators.end());
}
