// SPDX-License-Identifier: GPL-3.0-or-later
// A chain through text gives bit for bit what the library gives in one process. Needs the tools on
// PATH.
#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "contact/contact.h"
#include "signal/derivative.h"
#include "signal/moving.h"
#include "text/number.h"
#include "unit/catch.h"
#include "unit/text/files.h"

using namespace rolling;

namespace {

std::vector<double> through(Signal& signal, const std::vector<double>& t,
                            const std::vector<double>& y) {
  std::vector<double> out;
  for (std::size_t i = 0; i < t.size(); ++i)
    for (const double value : signal.push(t[i], y[i])) out.push_back(value);
  for (const double value : signal.finish()) out.push_back(value);
  return out;
}

}  // namespace

TEST_CASE(
    "smooth | differentiate | shift-from-accel through text equals the library in memory, bit for "
    "bit",
    "[pipeline]") {
  std::mt19937_64 random(20261121);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> t, v;
  std::string text = "# t[s]\tv[m/s]\n";
  for (int i = 0; i < 5000; ++i) {
    t.push_back((i ? t.back() : 0) + 0.02 + 0.04 * uniform(random));
    v.push_back(0.5 + 0.1 * uniform(random) - 5e-5 * i);
    text += fmt::format("{}\t{}\n", t.back(), v.back());
  }
  const Body body{1, 0.04, 0.83};
  const std::vector<double> smooth = through(*moving_mean({.samples = 11, .seconds = 0}), t, v),
                            a = through(*central_derivative(), t, smooth);

  const TemporaryFile file(text);
  const std::string command = "smooth " + file.name() +
                              " | differentiate | shift-from-accel -K 0.83 -R 0.04 | grep -v '^#'";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  REQUIRE(pipe);
  std::size_t rows = 0, equal = 0;
  for (double row[4]; std::fscanf(pipe, "%lf %lf %lf %lf", row, row + 1, row + 2, row + 3) == 4;
       ++rows) {
    const auto same = [](double x, double y) {
      return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
    };
    equal += rows < t.size() && same(row[0], t[rows]) && same(row[1], smooth[rows]) &&
             same(row[2], a[rows]) && same(row[3], shift_from_acceleration(body, a[rows]));
  }
  ::pclose(pipe);
  CHECK(rows == t.size());
  CHECK(equal == t.size());
}
