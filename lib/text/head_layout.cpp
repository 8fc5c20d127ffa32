// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/head.h"

#include <algorithm>
#include <map>
#include <optional>

#include "base/error.h"
#include "text/number.h"

namespace rolling {
namespace {

/// The labels that make runs: those of a t; without one, those of a known quantity that another
/// label brings too (or of any other column, if they are numbers); else the only one, if it is of a
/// known quantity or a number.
std::vector<std::string> labels_of_runs(const std::vector<Column>& line) {
  const auto labels = [&](auto&& counts) {
    std::vector<std::string> all;
    for (const Column& c : line)
      if (!c.run.empty() && counts(c) && std::ranges::count(all, c.run) == 0) all.push_back(c.run);
    return all;
  };
  if (auto timed = labels([](const Column& c) { return c.name == "t"; }); !timed.empty())
    return timed;
  const bool one = labels([](const Column&) { return true; }).size() == 1;
  return labels([&](const Column& c) {
    const auto is_alike = [&](const Column& other) {
      return other.name == c.name && !other.run.empty() && other.run != c.run;
    };
    return (is_known(c) || is_number(c.run)) && (one || std::ranges::any_of(line, is_alike));
  });
}

/// The columns. Columns of other runs keep their label in the name alone.
std::vector<Column> without_other_labels(std::vector<Column> line,
                                         const std::vector<std::string>& runs) {
  for (Column& c : line)
    if (!c.run.empty() && !is_known(c) && std::ranges::count(runs, c.run) == 0) {
      c.name = labelled_name(c);
      c.run.clear();
    }
  return line;
}

/// Refuses a quantity that occurs fewer times than t: it is not clear to which t it belongs.
void refuse_unclear(const std::vector<Column>& line, bool labelled) {
  std::map<std::string, std::size_t> count;  // of a name
  for (const Column& c : line)
    if (!labelled || !c.run.empty()) ++count[c.name];
  const std::size_t times = count["t"];
  if (times < 2) return;
  for (const Column& c : line)
    if (is_known(c) && (labelled ? c.run.empty() && c.name != "t" : count[c.name] < times))
      fail("it is not clear which of {} columns t belongs to {}: say --use t=N, by number", times,
           c.name);
}

}  // namespace

Layout Layout::of(const std::vector<Column>& named, Sides sides) {
  const auto labels = labels_of_runs(named);
  const auto line = without_other_labels(named, labels);
  std::map<std::string, std::size_t> count;
  std::map<std::string, std::size_t> seen;  // of a name
  for (const Column& column : line) ++count[column.name];
  std::size_t all = 1;
  if (sides == Sides::by_names)
    all = labels.empty() ? std::max<std::size_t>(count["t"], 1) : labels.size();
  if (all > 1) refuse_unclear(line, !labels.empty());
  Layout layout{std::vector<Run>(all), std::vector<bool>(line.size())};
  for (std::size_t r = 0; r < std::min(all, labels.size()); ++r) layout.runs[r].label = labels[r];
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Column& column = line[i];
    std::optional<std::size_t> own;  // the run that it belongs to; none if to every one
    if (const auto label = std::ranges::find(labels, column.run); label != labels.end())
      own = static_cast<std::size_t>(label - labels.begin());
    else if (labels.empty() && count[column.name] > 1) own = seen[column.name]++;
    layout.shared[i] = !own;
    for (std::size_t r = 0; r < all; ++r)
      if (!own || r == std::min(*own, all - 1)) {
        layout.runs[r].fields.push_back(i);
        layout.runs[r].columns.push_back(column);
      }
  }
  return layout;
}

}  // namespace rolling
