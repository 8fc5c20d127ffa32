// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/number.h"

#include <cmath>
#include <random>
#include <string>

#include "unit/catch.h"

using namespace rolling;

namespace {

/// What parse_estimate() makes of `text`, written again; "refused" if it takes none.
std::string reread(const std::string& text) {
  Estimate estimate{-7, -7};
  if (parse_estimate(text, estimate)) return to_text(estimate);
  CHECK(estimate.value == -7);
  CHECK(estimate.sigma == -7);
  return "refused";
}

}  // namespace

TEST_CASE("estimate: a number, alone or with its standard uncertainty", "[text]") {
  CHECK(reread("0.50") == "0.5");
  CHECK(reread("0.50+-0.005") == "0.5+-0.005");
  CHECK(reread("0.50 +- 0.005") == "0.5+-0.005");
  CHECK(reread("-1e-3\t+-2E-4") == "-0.001+-0.0002");
  CHECK(reread("9.81+-0") == "9.81");
  CHECK(reread("+5+-+1") == "5+-1");
  for (const char* sign : {"\xC2\xB1", "\xB1", "+/-", " +/- "})  // in UTF-8 and Latin-1
    CHECK(reread("0.5" + std::string(sign) + "0.005") == "0.5+-0.005");
  for (const char* text : {"0.5\xC2\xB1\xC2\xB1"
                           "0.1",
                           "0.5+/-", "0.5\xC2", "0.5+/-+-0.1"})
    CHECK(reread(text) == "refused");
}

TEST_CASE("estimate: anything else is refused whole", "[text]") {
  for (const char* text : {"", "+-", "0.5+-", "+-0.005", "0.5+-0.005 ", " 0.5+-0.005", "0.5 ",
                           "0.5+--0.005", "0.5+--0", "0.5+-0.1+-0.1", "0.5 + - 0.1", "0.5-+0.1",
                           "0.5+-nan", "0.5+-1e400", "inf+-1", "0.5+-1%", "0.5 0.1", "0.5\n+-1"}) {
    CAPTURE(text);
    CHECK(reread(text) == "refused");
  }
}

TEST_CASE("estimate: what is written reads back to the same numbers", "[text]") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-300, 300);
  for (int i = 0; i < 1000; ++i) {
    const Estimate written{std::pow(10, exponent(random)) * (i % 2 ? -1 : 1),
                           i % 5 ? std::pow(10, exponent(random)) : 0};
    Estimate read;
    REQUIRE(parse_estimate(to_text(written), read));
    CHECK(read.value == written.value);
    CHECK(read.sigma == written.sigma);
  }
}
