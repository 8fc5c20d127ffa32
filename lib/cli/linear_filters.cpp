// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/linear_filters.h"

#include <numeric>

namespace rolling {

LinearFilter linear(const std::string& from, const std::string& to, const SignalOptions& options,
                    std::size_t reach) {
  return {from, to, reach,
          [options](auto t, auto y) {
    return output_of(*make_signal(options), t.size(), [&](std::size_t i) {
      return Sample{t[i], y[i]};
    });
          },
          options.method->shift_invariant && options.width.seconds == 0};
}

namespace {

/// The way over the time from row i - 1 to row i, as the speed of row i or (`forward`) of row i -
/// 1. The row without a neighbour has the speed of the one beside it.
LinearFilter step(bool forward) {
  return {"x", "v", 1, [forward](auto t, auto x) {
            const std::size_t n = x.size();
            std::vector<double> v(n);
            for (std::size_t i = 1; i < n; ++i)
              v[forward ? i - 1 : i] = (x[i] - x[i - 1]) / (t[i] - t[i - 1]);
            if (n > 1) (forward ? v[n - 1] : v[0]) = forward ? v[n - 2] : v[1];
            return v;
          }};
}

}  // namespace

std::vector<LinearFilter> filters_of_sensors() {
  std::vector<LinearFilter> filters{step(false), step(true)};
  for (const char* method : {"central", "vernier", "pasco"}) {
    const SignalOptions options = signal_options(derivative_methods, method).value();
    filters.push_back(linear("x", "v", options, options.method->reach));
  }
  for (std::size_t width : {2U, 3U, 5U})
    filters.push_back({"v", "v", width / 2, [width](auto, auto y) {
                         std::vector<double> means(y.size());
                         for (std::size_t i = 0; i + width <= y.size(); ++i)
                           means[i + width / 2] = std::accumulate(&y[i], &y[i] + width, 0.0) /
                                                  static_cast<double>(width);
                         return means;
                       }});
  return filters;
}

}  // namespace rolling
