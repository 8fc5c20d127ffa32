// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/clock.h"

#include <ctime>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "unit/catch.h"

using namespace rolling;

namespace {

/// The seconds that a clock reads in the last of these texts.
std::optional<double> last_of(const std::vector<std::string>& texts) {
  Clock clock;
  std::optional<double> seconds;
  for (const std::string& text : texts) seconds = clock.seconds(text);
  return seconds;
}

}  // namespace

TEST_CASE("clock: any time of a day, to the double nearest to it", "[text]") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const long ms = static_cast<long>(random() % 86400000);
    const double seconds = static_cast<double>(ms) / 1000;  // correctly rounded
    const long h = ms / 3600000;
    const long min = ms / 60000 % 60;
    const double s = static_cast<double>(ms % 60000) / 1000;
    CHECK(last_of({fmt::format("{}:{:02}:{:06.3f}", h, min, s)}) == seconds);
    CHECK(last_of({fmt::format("{:02}:{:02}:{:06.3f}", h, min, s)}) == seconds);
    CHECK(last_of({fmt::format("{}:{:06.3f}", ms / 60000, s)}) == seconds);
    CHECK(last_of({with_colons(fmt::format("{}", h * 10000 + min * 100 + ms % 60000 / 1000))}) ==
          static_cast<double>(ms / 1000));
    CHECK(last_of({with_colons(fmt::format("{:02}{:02}{:06.3f}", h, min, s))}) == seconds);
  }
}

TEST_CASE("clock: dates and offsets, as the C library counts them", "[text]") {
  std::mt19937_64 random(2);
  for (int i = 0; i < 20000; ++i) {
    const auto first = static_cast<std::time_t>(random() % 4'000'000'000);
    const auto later = first + static_cast<std::time_t>(random() % 40'000'000);
    const int offset = static_cast<int>(random() % 113) * 15 - 14 * 60;  // minutes
    const auto text = [](std::time_t utc, int of) {
      const std::time_t local = utc + 60 * of;
      std::tm parts{};
      ::gmtime_r(&local, &parts);
      char date[32];
      std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%S", &parts);
      return fmt::format("{}.25{}{:02}:{:02}", date, of < 0 ? '-' : '+', std::abs(of) / 60,
                         std::abs(of) % 60);
    };
    const std::time_t midnight = first - (first + 60 * offset) % 86400;
    if (first + 60 * offset < 0) continue;
    CHECK(last_of({text(first, offset)}) == static_cast<double>(first - midnight) + .25);
    CHECK(last_of({text(first, offset), text(later, 0)}) ==
          static_cast<double>(later - midnight) + .25);
  }
  CHECK(last_of({"2024-02-28 23:59:59", "2024-03-01 00:00:00"}) == 2 * 86400);  // a leap year
  CHECK(last_of({"2026-10-25T02:59:59+02:00", "2026-10-25T02:00:00+01:00"}) == 3 * 3600);
  CHECK(last_of({"10:00:00Z"}) == 36000);
  CHECK(last_of({"10:00:00-0530"}) == 36000);
  CHECK(last_of({"10:00:00+01"}) == 36000);
}

TEST_CASE("clock: it goes on behind midnight, and nowhere else", "[text]") {
  CHECK(last_of({"23:59:59.5", "0:00:00"}) == 86400);
  CHECK(last_of({"23:59:59", "12:00:00", "23:00:00", "1:00:00"}) == 86400 + 86400 - 86400 + 3600);
  CHECK(last_of({"18:00:00", "0:00:00", "18:00:00", "0:00:01"}) == 2 * 86400 + 1);
  CHECK(last_of({"12:00:01", "12:00:00"}) == 43200);  // which the reader refuses
  CHECK(last_of({"59:59.5", "0:00.5"}) == .5);
  CHECK(last_of({"59:59.5", "60:00.5"}) == 3600.5);
  CHECK(last_of({"2026-11-24T23:59:59", "2026-11-24T00:00:00"}) == 0);
}

TEST_CASE("clock: other texts are no times", "[text]") {
  for (const char* text : {"",
                           "12",
                           "12:",
                           ":12",
                           "12:60",
                           "1:2:60",
                           "1:60:00",
                           "1:2:3:4",
                           "-1:02",
                           "1:-2",
                           "1:002",
                           "1:02.",
                           "1:02.5.5",
                           "1:02e1",
                           "1:02 ",

                           "1:02Z",
                           "12:34:56 PM",
                           "12:34:56X",
                           "12:34:56+1",
                           "12:34:56+1:00:00",
                           "2026-11-24",
                           "2026-11-24T12:34",
                           "2026-02-29T12:34:56",
                           "2026-13-01T12:34:56",
                           "2026-1-1T12:34:56:00",
                           "9999999:00:00",
                           "1:02:0x3"})
    CHECK_FALSE(last_of({text}).has_value());
  // Forms are not mixed: which day or hour is meant is then not known.
  CHECK_FALSE(last_of({"12:34:56", "35:00"}).has_value());
  CHECK_FALSE(last_of({"12:34:56", "12:34:57Z"}).has_value());
  CHECK_FALSE(last_of({"2026-11-24T12:34:56", "12:34:57"}).has_value());
  CHECK_FALSE(last_of({"24/11/2026 23:59:59", "25/11/2026 0:00:00"}).has_value());
  CHECK(last_of({"24/11/2026 12:34:56", "24/11/2026 12:34:57"}) == 45297);
}
