// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/method.h"

#include <cmath>

#include "unit/catch.h"
#include "unit/signal/through.h"

using namespace rolling;

namespace {

const auto tables = {smoothing_methods, derivative_methods};

/// Every method, those with a width at several ones.
std::vector<SignalOptions> all_options() {
  std::vector<SignalOptions> all;
  for (const auto table : tables)
    for (const SignalMethod& method : table)
      if (!method.has_width()) all.push_back({&method});
      else
        for (const Width width : {Width{5, 0}, {11, 0}, {21, 0}, {0, 0.3}, {0, 0.44}})
          for (std::size_t order = method.has_order ? 1 : 2; order <= (method.has_order ? 4 : 2);
               ++order)
            all.push_back({&method, width, order});
  return all;
}

double largest(const Series& y) {
  double most = 0;
  for (const double value : y) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace

TEST_CASE("method: its words are read back as what wrote them", "[signal]") {
  const auto t = uneven_times(70), y = noise(70, 4);
  for (const SignalOptions& options : all_options()) {
    const std::string words = describe(options);
    INFO(words);
    std::size_t found = 0;
    for (const auto table : tables)
      if (const auto again = signal_options(table, words);
          again && again->method == options.method) {
        CHECK(through(*make_signal(*again), t, y) == through(*make_signal(options), t, y));
        ++found;
      }
    CHECK(found == 1);
  }
  const auto mean = by_name(smoothing_methods).at("mean");
  CHECK(describe({mean}) == "mean width 11");
  CHECK(describe({mean, {0, 0.4}}) == "mean seconds 0.4");
  CHECK(describe({by_name(smoothing_methods).at("savgol"), {7, 0}, 3}) == "savgol width 7 order 3");
  CHECK(describe({by_name(derivative_methods).at("pasco")}) == "pasco");
}

TEST_CASE("method: words that no filter writes are no filter's", "[signal]") {
  for (const char* words : {"",
                            " ",
                            "median ",
                            "mean",
                            "mean width",
                            "mean width ",
                            "mean width 3.9",
                            "mean width 4",
                            "mean width 0",
                            "mean width -3",
                            "mean width +3",
                            "mean width 1e1",
                            "mean width 03",
                            "mean width 3 ",
                            "mean  width 3",
                            "mean width 3 order 2",
                            "mean seconds 0",
                            "mean seconds -1",
                            "mean seconds nan",
                            "mean seconds inf",
                            "mean seconds 1e999",
                            "mean seconds 0.40",
                            "mean width 3 seconds 0.4",
                            "mean width 99999999999999999999",
                            "savgol width 11",
                            "savgol order 2",
                            "savgol order 2 width 11",
                            "savgol width 11 order 11",
                            "savgol width 11 order 2 order 2",
                            "savgol width 11 order 2x",
                            "Mean width 11",
                            "boxcar 3",
                            "width 11",
                            "mean\twidth 11"}) {
    INFO("'" << words << "'");
    CHECK(!signal_options(smoothing_methods, words));
  }
  for (const char* words :
       {"central width 3", "pasco order 2", "mean width 11", "vernier ", "savgol"})
    CHECK(!signal_options(derivative_methods, words));
}

TEST_CASE("method: it is linear if it says so, and only then", "[signal]") {
  const std::size_t n = 60;
  for (const auto& t : {even_times(n), uneven_times(n)})
    for (const SignalOptions& options : all_options()) {
      INFO(describe(options));
      const auto y = noise(n, 1), z = noise(n, 2);
      Series both;
      for (std::size_t i = 0; i < n; ++i) both.push_back(y[i] - 3 * z[i]);
      const auto of_y = through(*make_signal(options), t, y),
                 of_z = through(*make_signal(options), t, z),
                 of_both = through(*make_signal(options), t, both);
      Series off;
      for (std::size_t i = 0; i < n; ++i) off.push_back(of_both[i] - of_y[i] + 3 * of_z[i]);
      CHECK((largest(off) < 1e-12 * largest(of_both)) == options.method->linear);
    }
}

TEST_CASE("method: a number depends on the samples within its reach", "[signal]") {
  const std::size_t n = 90;
  for (const auto& t : {even_times(n), uneven_times(n)})
    for (const SignalOptions& options : all_options()) {
      INFO(describe(options));
      const std::size_t far = reach(options, t);
      CHECK(far <= n);
      if (!options.method->linear) continue;
      std::size_t furthest = 0;
      for (std::size_t j = 0; j < n; ++j) {
        Series y(n, 0);
        y[j] = 1;
        const auto out = through(*make_signal(options), t, y);
        for (std::size_t i = 0; i < n; ++i) {
          if (out[i] == 0) continue;
          const std::size_t distance = std::max(i, j) - std::min(i, j);
          const bool end = i < far || i + far >= n;
          CHECK(distance <= (end ? 2 : 1) * far);
          if (!end) furthest = std::max(furthest, distance);
        }
      }
      CHECK(furthest + 2 >= far);  // of windows in seconds it is a bound
      if (options.width.seconds == 0) CHECK(furthest == far);
    }
}
