#include "cli/history.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "contact/contact.h"
#include "signal/derivative.h"
#include "signal/smoother.h"
#include "text/column.h"
#include "text/number.h"

namespace rolling {
namespace {

/// A streaming filter as a function of whole columns.
std::vector<double> apply(const std::unique_ptr<Signal>& signal, std::span<const double> t,
                          std::span<const double> y) {
  std::vector<double> out;
  for (std::size_t i = 0; i < t.size(); ++i)
    for (const double value : signal->push(t[i], y[i])) out.push_back(value);
  for (const double value : signal->finish()) out.push_back(value);
  return out;
}

double number_after(const std::vector<std::string>& words, std::string_view key) {
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (double value; words[i] == key && parse_number(words[i + 1], value)) return value;
  fail("a `##` line does not say its {}", key);
}

LinearFilter linear(const std::string& from, const std::string& to, const SignalOptions& options,
                    std::span<const double> t) {
  return {from, to, reach(options, t),
          [options](auto time, auto y) { return apply(make_signal(options), time, y); }};
}

std::string derivative_of(const std::string& column) {
  return column == "x" ? "v" : column == "v" ? "a" : "d" + column;
}

}  // namespace

std::vector<LinearFilter> filters_of_sensors() {
  std::vector<LinearFilter> filters;
  for (const char* method : {"central", "vernier", "pasco"}) {
    const SignalOptions options = signal_options(derivative_methods, method).value();
    filters.push_back({"x", "v", options.method->reach, [options](auto time, auto y) {
                         return apply(make_signal(options), time, y);
                       }});
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

FilterChain filters_of(const std::vector<std::string>& history, std::span<const double> t) {
  FilterChain chain;
  bool cut_begin = false, cut_end = false;
  const auto append = [&](LinearFilter filter) {
    filter.cut_begin = std::exchange(cut_begin, false);
    filter.cut_end = std::exchange(cut_end, false);
    chain.push_back(std::move(filter));
  };
  for (const std::string& line : history) {
    const auto words = split_names(line, '\0');
    if (words.size() < 3) continue;
    const std::string &tool = words[0], &column = words[1], &method = words[2];
    const std::string said = fmt::format("{}", fmt::join(words.begin() + 2, words.end(), " "));
    if (tool == "smooth") {
      if (method == "coast" || method == "from" || method == "to") {
        cut_begin = cut_begin || method != "to";
        cut_end = cut_end || method != "from";
        continue;
      }
      const auto options = signal_options(smoothing_methods, said);
      if (!options || !options->method->linear) return {};
      append(linear(column, column, *options, t));
    } else if (tool == "differentiate") {
      const auto options = signal_options(derivative_methods, said);
      if (!options || !options->method->linear) return {};
      append(linear(column, derivative_of(column), *options, t));
    } else if (tool == "shift-from-accel") {
      // The exact root of Eq. 9 bends away from Eq. 11 by (D/R)^2, which does not matter to an
      // error bar.
      const Body body{0, number_after(words, "R"), number_after(words, "K"),
                      number_after(words, "g")};
      const double scale = -(1 + body.K) * body.R / body.g;
      append({"a", "D", 0, [scale](auto, auto y) {
                std::vector<double> D(y.begin(), y.end());
                for (double& value : D) value *= scale;
                return D;
              }});
    }
  }
  return chain;
}

}  // namespace rolling
