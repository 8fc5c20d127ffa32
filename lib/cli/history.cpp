#include "cli/history.h"

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

/// How many samples lie within `seconds` of one, at most.
std::size_t samples_within(double seconds, std::span<const double> t) {
  std::size_t most = 0;
  for (std::size_t i = 0, j = 0; i < t.size(); ++i) {
    while (t[i] - t[j] > seconds) ++j;
    most = std::max(most, i - j + 1);
  }
  return most;
}

double number_after(const std::vector<std::string>& words, std::string_view key) {
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (double value; words[i] == key && parse_number(words[i + 1], value)) return value;
  fail("a `##` line does not say its {}", key);
}

std::size_t count_after(const std::vector<std::string>& words, std::string_view key) {
  const double value = number_after(words, key);
  if (!(value >= 1 && value < 1e9)) fail("a `##` line has a {} of {}", key, value);
  return static_cast<std::size_t>(value);
}

LinearFilter derivative(const std::string& from, const std::string& to,
                        const DerivativeOptions& options) {
  const auto method = options.method;
  const std::size_t reach = method == DerivativeMethod::savgol    ? options.width / 2
                            : method == DerivativeMethod::vernier ? 3
                            : method == DerivativeMethod::pasco   ? 2
                                                                  : 1;
  return {from, to, reach,
          [options](auto time, auto y) { return apply(make_derivative(options), time, y); }};
}

}  // namespace

std::vector<LinearFilter> filters_of_sensors() {
  std::vector<LinearFilter> filters;
  for (auto method :
       {DerivativeMethod::central, DerivativeMethod::vernier, DerivativeMethod::pasco})
    filters.push_back(derivative("x", "v", {method}));
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
  return history_of(history, t).filters;
}

History history_of(const std::vector<std::string>& history, std::span<const double> t) {
  if (t.empty()) return {};  // filters act on times
  History result;
  FilterChain& chain = result.filters;
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
    if (tool == "smooth") {
      if (method == "coast" || method == "from" || method == "to") {
        cut_begin = cut_begin || method != "to";
        cut_end = cut_end || method != "from";
        continue;
      }
      const auto known = smoothing_methods.find(method);
      if (known == smoothing_methods.end() || known->second == SmoothingMethod::median ||
          words.size() != (method == "savgol" ? 7U : 5U))
        return {};
      SmootherOptions options{known->second};
      if (words[3] == "seconds") options.width.seconds = number_after(words, "seconds");
      else options.width.samples = count_after(words, "width");
      if (method == "savgol") options.order = count_after(words, "order");
      const double seconds = options.width.seconds;
      if (!(seconds >= 0)) fail("a `##` line has a window of {} seconds", seconds);
      const std::size_t reach =
          seconds > 0 ? samples_within(seconds, t) : options.width.samples / 2;
      append({column, column, reach,
              [options](auto time, auto y) { return apply(make_smoother(options), time, y); }});
    } else if (tool == "differentiate") {
      const auto known = derivative_methods.find(method);
      if (known == derivative_methods.end() || known->second == DerivativeMethod::spline ||
          words.size() != (method == "savgol" ? 7U : 3U))
        return {};
      DerivativeOptions options{known->second};
      if (method == "savgol") {
        options.width = count_after(words, "width");
        options.order = count_after(words, "order");
      }
      append(derivative(column, column == "x" ? "v" : column == "v" ? "a" : "d" + column, options));
    } else if (tool == "shift-from-accel") {
      const Body body{0, number_after(words, "R"), number_after(words, "K"),
                      number_after(words, "g")};
      result.shift_of =
          ShiftOf{body, words[1] == "exact" ? Geometry::exact : Geometry::approximate};
      append({"a", "D", 0, [](auto, auto y) { return std::vector<double>(y.begin(), y.end()); }});
    }
  }
  return result;
}

}  // namespace rolling
