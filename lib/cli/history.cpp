// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/history.h"

#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>
#include <iterator>
#include <numeric>
#include <set>

#include "base/enumeration.h"
#include "base/error.h"
#include "contact/body.h"
#include "fit/input.h"
#include "signal/method.h"
#include "text/row_pipe.h"
#include "text/head.h"
#include "text/number.h"

namespace rolling {
namespace {

/// A streaming filter as one of whole columns.
LinearFilter linear(Quantity from, Quantity to, const SignalOptions& options, std::size_t reach) {
  return {from, to, reach,
          [options](auto t, auto y) { return output_of(*make_signal(options), t, y); },
          options.method->shift_invariant && options.width.seconds == 0};
}

/// The way over the time from row i - 1 to row i, as the speed of row i or (`forward`) of row i -
/// 1. The row without a neighbour has the speed of the one beside it.
LinearFilter step(bool forward) {
  return {Quantity::x, Quantity::v, 1, [forward](auto t, auto x) {
            const std::size_t n = x.size();
            std::vector<double> v(n);
            for (std::size_t i = 1; i < n; ++i)
              v[forward ? i - 1 : i] = (x[i] - x[i - 1]) / (t[i] - t[i - 1]);
            if (n > 1 && forward) v[n - 1] = v[n - 2];
            if (n > 1 && !forward) v[0] = v[1];
            return v;
          }};
}

/// Removes the filters of a column and of what was made of it: a derivative of the same name has
/// taken its place (in the file it has another name since).
void forget(FilterChain& filters, Quantity made) {
  std::set<Quantity> gone{made};
  std::erase_if(filters, [&](const LinearFilter& filter) {
    if (gone.contains(filter.from)) gone.insert(filter.to);
    return gone.contains(filter.to);
  });
}

/// Adds what a line of these words tells. False if the chain is unknown from here on. Throws Error
/// if the lines are not trusted.
bool extend(History& history, const std::string& line, std::span<const std::string> words,
            std::span<const double> t) {
  const auto believe = [&](bool is_right) {
    if (!is_right) fail("`## {}` is not what its tool writes", shown(line));
  };
  if (line == columns_renamed) return false;
  if (line == lines_sorted) fail("its `##` lines were sorted, so that their order says nothing");
  FilterChain& filters = history.filters;
  if (words[0] == "shift-from-accel") {
    believe(history.shift_of.has_value());
    filters.push_back({Quantity::a, Quantity::D, 0,
                       [](auto, auto a) { return std::vector<double>(a.begin(), a.end()); }, true});
    return true;
  }
  const bool derivative = words[0] == "differentiate";
  if (!derivative && words[0] != "smooth") return true;
  believe(words.size() > 2);
  const std::string& method = words[2];
  const bool coast = method == "coast" || method == "rolls";
  const bool from = method == "from";
  const bool to = method == "to";
  const bool outliers = method == "outliers";
  if (!derivative && method == "equal-times") {
    believe(words.size() == 4 && (words[3] == "first" || words[3] == "mean"));
    return true;
  }
  if (!derivative && (coast || from || to || outliers)) {
    double number;
    believe(coast ? words.size() == 3 : words.size() == 4 && parse_number(words[3], number));
    const bool filtered = change_numbers(filters);
    history.cut_begin |= filtered && (coast || from);
    history.cut_end |= filtered && (coast || to);
    return !outliers;  // the rows that it leaves out depend on the readings: not linear
  }
  const auto options =
      signal_options(derivative ? derivative_methods : smoothing_methods,
                     fmt::format("{}", fmt::join(words.begin() + 2, words.end(), " ")));
  believe(options.has_value());
  if (!options->method->linear) return false;
  const auto column = quantity_named(words[1]);
  const auto made = column && derivative ? derivative_of(*column) : column;
  if (!made) return true;  // of no column that is fitted
  believe(column != Quantity::t);
  if (derivative) forget(filters, *made);
  filters.push_back(linear(*column, *made, *options, reach(*options, t)));
  // The matrices of wider filters would not fit into memory.
  constexpr std::size_t most = 50'000'000;
  std::size_t wide = 0;
  for (const LinearFilter& filter : filters) wide += filter.reach;
  if (wide * t.size() > most || filters.size() > 100)
    fail("the filters in its `##` lines are too wide or too many for {} rows", t.size());
  return true;
}

/// Leaves out the filters that none of these columns has gone through. Returns the raw columns of
/// which the filters made them.
std::set<Quantity> keep_filters_of(const std::vector<Quantity>& fitted, FilterChain& filters) {
  std::set<Quantity> columns(fitted.begin(), fitted.end());
  FilterChain kept;
  for (auto filter = filters.rbegin(); filter != filters.rend(); ++filter)
    if (columns.erase(filter->to) > 0) {
      columns.insert(filter->from);
      kept.push_back(std::move(*filter));
    }
  filters.assign(kept.rbegin(), kept.rend());
  return columns;
}

/// "t and x"
std::string names_of(const std::set<Quantity>& quantities) {
  std::string names;
  for (const Quantity q : quantities) add_item(names, name_of(q), " and ");
  return names;
}

/// The body of each of so many rows in the words `K 0.5 R 0.04,0.05 g 9.81 [slope S] [wind W]
/// [exact]`. Empty if they are of more runs than rows, nothing for other words.
std::optional<std::vector<Body>> read_bodies(std::span<const std::string> words, std::size_t rows) {
  std::vector<Body> bodies(rows, {NAN, NAN, NAN, NAN});
  auto number = numbers_of_body.begin();
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "exact") {
      for (Body& body : bodies) body.exact = true;
      continue;
    }
    number = std::ranges::find(number, numbers_of_body.end(), words[i], &NumberOfBody::name);
    if (number == numbers_of_body.end() || ++i == words.size()) return {};
    const bool may_be_fit =
        std::ranges::count(scene_numbers, number->value, &SceneNumber::value) > 0;
    const std::vector<std::string> texts = split_names(words[i], ',');
    if (texts.size() != 1 && texts.size() != rows) return std::vector<Body>{};
    for (std::size_t row = 0; row < rows; ++row) {
      const std::string& text = texts[texts.size() == 1 ? 0 : row];
      Estimate read{NAN};
      if (!parse_estimate(text, read) && !(text == "fit" && may_be_fit)) return {};
      bodies[row].*number->value = read.value;
      if (number->sigma) bodies[row].*number->sigma = read.sigma;
    }
  }
  for (const Body& body : bodies)
    if (!(body.K >= 0 && body.R > 0 && body.g > 0)) return {};
  return bodies;
}

}  // namespace

Column derivative_of(const Column& column) {
  const auto of = quantity_named(column.name);
  if (const auto made = of ? derivative_of(*of) : std::nullopt) {
    const std::string name(name_of(*made));
    return {name, std::string(si_unit(name))};
  }
  return {"d" + column.name, column.unit.empty() ? "" : column.unit + "/s"};
}

std::string line_of(const Body& body) {
  std::string line = "shift-from-accel";
  if (body.exact) line += " exact";
  for (const NumberOfBody& number : uncertain_numbers) {
    const Estimate x = number.of(body);
    if (number.value != &Body::slope || x.value != 0 || x.sigma != 0)
      line += fmt::format(" {} {}", number.name, to_text(x));
  }
  return line;
}

std::vector<Body> bodies_of_rows(const std::vector<std::string>& lines, std::size_t rows) {
  for (const std::string& line : lines) {
    const std::vector<std::string> words = split_names(line, '\0');
    if (words.front() != "fitpower") continue;
    const auto numbers = std::ranges::find(words, numbers_of_body[0].name);
    if (words.size() >= 3 && numbers == words.end()) return {};
    const auto bodies = read_bodies({numbers, words.end()}, rows);
    if (numbers - words.begin() > 4 || !bodies)
      fail("`## {}` is not what fitpower writes", shown(line));
    return *bodies;
  }
  return {};
}

// The numbers of shift-from-accel are known even if the filters before it are not.
History history_of(const std::vector<std::string>& lines, std::span<const double> t) {
  History history;
  bool known = !t.empty();  // the filters depend on the times
  for (const std::string& line : lines) try {
      const auto words = split_names(line, '\0');
      if (words.size() < 2) continue;
      if (words[0] == "shift-from-accel") {
        const auto of = read_bodies(std::span(words).subspan(1), 1);
        history.shift_of.reset();
        if (of && !of->empty()) history.shift_of = of->front();
      }
      if (!known) continue;
      known = extend(history, line, words, t);
      if (!known) history = {.shift_of = history.shift_of};
    } catch (const Error& error) {
      return {.doubt = error.what()};
    }
  return history;
}

std::string other_body(const std::optional<Body>& shift_of, const Body& body) {
  std::string others;
  if (!shift_of) return others;
  for (const NumberOfBody& number : uncertain_numbers) {
    const Estimate then = number.of(*shift_of);
    const Estimate now = number.of(body);
    if (std::isnan(now.value) || std::isnan(then.value) ||
        (then.value == now.value && (then.sigma == now.sigma || now.sigma == 0)))
      continue;
    add_item(others, fmt::format("{} {} (here {})", number.name, to_text(then), to_text(now)));
  }
  return others;
}

bool change_numbers(const FilterChain& filters) {
  return std::ranges::any_of(filters, [](const LinearFilter& filter) { return filter.reach > 0; });
}

std::optional<bool> shifts_are_exact(const std::vector<std::string>& lines) {
  std::optional<bool> exact;
  for (const std::string& line : lines) {
    const auto words = split_names(line, '\0');
    if (words.front() != "shift-from-accel" && words.front() != "simulate") continue;
    exact = false;
    for (std::size_t i = 1; i < words.size(); ++i)
      if (words[i] == "exact" && words[i - 1] != "height")
        exact = true;  // a table may have that name
  }
  return exact;
}

std::vector<std::string> windows_of_v(const std::vector<std::string>& lines) {
  std::vector<std::string> windows = lines;
  std::erase_if(windows, [](const std::string& line) {
    const auto has = [&](const char* word) { return line.find(word) < line.size(); };
    return !((has("smooth v ") || has(" x ")) && (has(" width ") || has(" seconds ")));
  });
  return windows;
}

bool shifts_of_speeds(const std::vector<std::string>& lines) {
  constexpr std::string_view smooth = "smooth v ";
  const bool sorted = std::ranges::count(lines, lines_sorted) > 0;  // `smooth v` may be the first
  const auto smooths = [&](const std::string& line) {
    return !sorted && line.starts_with(smooth) &&
           signal_options(smoothing_methods, line.substr(smooth.size()));
  };
  const auto begins = [](std::string_view words) {
    return [words](const std::string& line) { return line.starts_with(words); };
  };
  // v has been replaced where it was smoothed.
  const auto since = std::find_if(lines.rbegin(), lines.rend(), smooths).base();
  const auto derivative = std::find_if(since, lines.end(), begins("differentiate v "));
  return std::any_of(derivative, lines.end(), begins("shift-from-accel "));
}

// How many rows were removed is not known, nor at which times, and thus not the windows at the
// former end. Further inside, they are those of the times of the run.
History give_filters(History history, Run& run, const std::vector<Quantity>& columns) {
  run.shift_of = history.shift_of;
  const Mismatch found = mismatch(history.filters, run);
  history.cut_begin |= found.begin;
  history.cut_end |= found.end;
  PerQuantity<std::size_t> windows{};  // the rows on either side that a column has read
  for (const LinearFilter& filter : history.filters)
    windows[filter.to] = windows[filter.from] + filter.reach;
  std::size_t widest = 0;
  for (const Quantity column : columns) widest = std::max(widest, windows[column]);
  history.left_out = widest * (std::size_t{history.cut_begin} + history.cut_end);
  const auto distrust = [&](std::string why) {
    history = {.shift_of = history.shift_of, .doubt = std::move(why)};
  };
  if (found.inside) {
    history.shift_of.reset();
    distrust("the columns are not what the `##` lines say");
  } else if (history.left_out > 0 && run.t.size() < history.left_out + 10)
    distrust(
        "it was cut after the filters that its `##` lines name, and fewer than 10 rows are far "
        "enough from the cut");
  std::set<Quantity> raw = keep_filters_of(columns, history.filters);
  raw.erase(Quantity::t);
  if (raw != std::set{Quantity::x} && raw != std::set{Quantity::v}) {
    if (change_numbers(history.filters))
      distrust(
          fmt::format("its filtered columns were made of {}, not of x or v alone", names_of(raw)));
    history.filters.clear();
  }
  run.filters = history.filters;
  run.shift_of = history.shift_of;
  for (const Quantity q : {Quantity::x, Quantity::v, Quantity::D}) {
    const std::size_t n = std::min(windows[q], run[q].size());
    if (history.cut_begin) std::fill_n(run[q].begin(), n, NAN);
    if (history.cut_end) std::fill_n(run[q].rbegin(), n, NAN);
  }
  return history;
}

std::vector<LinearFilter> filters_of_sensors() {
  std::vector<LinearFilter> filters{step(false), step(true)};
  for (const char* method : {"central", "vernier", "pasco"}) {
    const SignalOptions options = signal_options(derivative_methods, method).value();
    filters.push_back(linear(Quantity::x, Quantity::v, options, options.method->reach));
  }
  for (std::size_t width : {2U, 3U, 5U})
    filters.push_back({Quantity::v, Quantity::v, width / 2, [width](auto, auto y) {
                         std::vector<double> means(y.size());
                         for (std::size_t i = 0; i + width <= y.size(); ++i)
                           means[i + width / 2] = std::accumulate(&y[i], &y[i] + width, 0.0) /
                                                  static_cast<double>(width);
                         return means;
                       }});
  return filters;
}

}  // namespace rolling
