// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/fit_runs.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "cli/history.h"
#include "cli/law_file.h"
#include "selection/readings.h"

namespace rolling {
namespace {

/// Gives a run the filters that its `##` lines name, as far as they are trusted.
void set_filters(Tool& tool, const Reader& in, Route route, Run& run) {
  History history = history_of(in.history(), run.t);
  if (in.renames() && !history.filters.empty())
    history = {.doubt = "--use takes other columns than its `##` lines name"};
  if (run.t.empty() && change_numbers(history_of(in.history(), std::array{0.0}).filters))
    history.doubt = "it has no times, and without them its `##` lines say nothing";
  history = give_filters(std::move(history), run, columns_of(route));
  if (!history.doubt.empty())
    tool.warn(run.name, history.doubt + ": the fit goes on as if no filter were known");
  if (history.left_out > 0)
    tool.warn(run.name,
              fmt::format("it was cut after the filters that its `##` lines name: {} more rows at "
                          "the cut are left out, since their windows are not known; cut first",
                          history.left_out));
}

/// Warns of a run without known filters beside one with filters: a run break takes the `##` lines
/// away.
void warn_of_lost_history(Tool& tool, const std::vector<Run>& runs) {
  const auto first =
      std::ranges::find_if(runs, [](const Run& run) { return change_numbers(run.filters); });
  for (const Run& run : runs)
    if (first != runs.end() && run.filters.empty())
      tool.warn(run.name, "its filters are not known, those of run " + first->name +
                              " are: the fit goes on as if no filter were known");
}

}  // namespace

std::string name_of(Route route) {
  constexpr std::array names{"loglog", "shift", "velocity", "position"};
  return names[static_cast<std::size_t>(route)];
}

std::vector<Quantity> columns_of(Route route) {
  if (!is_trajectory(route)) return {Quantity::v, Quantity::D};
  return {Quantity::t, fitted_column(route)};
}

std::vector<Run> read_runs(Tool& tool, Reader& in, Route route, bool needs_x) {
  PerQuantity<std::optional<std::size_t>> slots;
  for (const Quantity q : columns_of(route)) slots[q] = in.need(std::string(name_of(q)));
  if (needs_x) slots[Quantity::x] = in.need("x");
  std::vector<Run> runs;
  while (in.next_run()) {
    Run& run = runs.emplace_back();
    run.name = in.run_name();
    if (!in.history().empty())  // the `##` lines are compared with the other columns
      for (const Quantity q : {Quantity::t, Quantity::x, Quantity::v, Quantity::D})
        if (const std::string name(name_of(q)); in.find(name) && !slots[q])
          slots[q] = q == Quantity::t ? in.need(name) : in.want(name);
    while (in.next())
      for (const Quantity q : all_quantities)
        if (slots[q]) run[q].push_back(in[*slots[q]]);
    set_filters(tool, in, route, run);
  }
  warn_of_lost_history(tool, runs);
  return runs;
}

bool take_pulses(Tool& tool, std::vector<Run>& runs) {
  std::vector<double> ways;
  for (const Run& run : runs) {
    const auto way = run.filters.empty() ? way_between_pulses(run.t, run.v) : std::nullopt;
    if (!way) return false;
    ways.push_back(*way);
  }
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (std::size_t i = 0; i < runs[r].t.size(); ++i)
      runs[r].x.push_back(ways[r] * static_cast<double>(i));
    std::vector<double>().swap(runs[r].v);
    tool.warn(runs[r].name,
              fmt::format("each speed is {:.4g} m over the time between two rows: the rows are "
                          "pulses, and their positions are fitted",
                          ways[r]));
  }
  return true;
}

void Bodies::give_to(std::vector<Run>& runs) const {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Run& run = runs[i];
    run.body = all[value_of_run(list, all.size(), i, runs.size())];
    if (!begins.empty()) run.x0 = begins[value_of_run("--x0", begins.size(), i, runs.size())];
    else if (run.body.road && !run.x.empty()) run.x0 = run.x.front();
  }
}

void warn_of_copies(Tool& tool, Route route, const std::vector<Run>& runs) {
  std::set<std::vector<std::string_view>> different;  // the readings, as their bytes
  for (const Run& run : runs) {
    std::vector<std::string_view> readings;
    for (const Quantity q : columns_of(route)) {
      const std::vector<double>& x = run[q];
      readings.emplace_back(reinterpret_cast<const char*>(x.data()), x.size() * sizeof(double));
    }
    if (readings.back().size() >= 10 * sizeof(double) && !different.insert(readings).second)
      tool.object(run.name,
                  "its readings are those of an earlier run: leave copies out, for each counts as "
                  "one more roll");
  }
}

void warn_of_unused_body(Tool& tool, const std::vector<Run>& runs, Geometry geometry) {
  std::string unused;
  for (const char* option : {"shape-factor", "radius", "gravity", "slope", "exact"})
    if (tool.on_command_line(option)) add_item(unused, std::string("--") + option);
  for (const Run& run : runs) {
    std::string others;
    if (run.shift_of) {
      ShiftOf given{run.body, geometry};
      others = take_contact(tool, *run.shift_of, given);
    } else if (!unused.empty())
      tool.warn(run.name, "not used: " + unused + ": no `##` line says how D was computed");
    if (!others.empty())
      tool.warn(run.name, "D was computed with " + others + ": the fit uses the numbers of D");
  }
}

}  // namespace rolling
