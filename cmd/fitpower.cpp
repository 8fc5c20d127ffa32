// SPDX-License-Identifier: GPL-3.0-or-later
// fitpower - fit the power law D = a v^b, or another law, to columns; see fitpower(1)
#ifdef __linux__
#include <malloc.h>
#endif

#include <algorithm>
#include <cmath>

#include "cli/fit_report.h"
#include "cli/fit_rows.h"
#include "cli/fit_runs.h"
#include "cli/law_file.h"
#include "cli/linear_filters.h"
#include "fit/fit.h"
#include "text/number.h"

using namespace rolling;

namespace {

/// Keeps memory that is freed for the next column. A fit needs columns of the same size many times,
/// and each page that the system takes away must be given, and filled with zeros, again.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
#endif
}

/// Holds a parameter at the value of a text NAME=VALUE.
void fix(FitOptions& options, const std::string& setting) {
  const auto equals = setting.find('=');
  const std::string name = setting.substr(0, equals);
  std::optional<double>* const parameter = name == "a"    ? &options.a
                                           : name == "b"  ? &options.b
                                           : name == "v0" ? &options.v0
                                           : name == "x0" ? &options.x0
                                                          : nullptr;
  double value;
  if (equals == std::string::npos || !parameter)
    fail("'{}' is not NAME=VALUE with a name that it knows", shown(setting));
  if (!parse_number(std::string_view(setting).substr(equals + 1), value))
    fail("the value in '{}' is not a number", shown(setting));
  if (*parameter) fail("'{}' comes after another for {}", shown(setting), name);
  *parameter = value;
}

void add_options(Tool& tool, FitOptions& options, Bodies& bodies) {
  tool.add("--slope", "S|fit",
           "the mat rises by S metres a metre along growing x; fit: find it, of all runs",
           [&](const std::string& text) {
    Estimate slope;
    options.fit_slope = text == "fit";
    if (!options.fit_slope && !parse_estimate(text, slope))
      fail("'{}' is no number, and not `fit`", shown(text));
    bodies.body.slope = slope.value, bodies.uncertainty.slope = slope.sigma;
  });
  tool.geometry(options.geometry);
  tool.number("--min-speed", options.min_speed, not_negative, "leave slower rows out [m/s]");
  tool.flag("--robust", options.robust,
            "let outliers count little: bisquare loss instead of squares");
  tool.add("--law", "LAW", "fit this law of those that --report compares: d0+d2*v^2",
           [&](const std::string& text) { options.law = &law_named(text); });
  tool.add(
      "--fix", "NAME=VALUE", "hold a, b, v0 or x0 fixed",
      [&](const std::string& setting) { fix(options, setting); }, Options::Values::many);
}

/// Runs that are fitted together, and their fit, if they can be fitted.
struct Group {
  std::vector<FitRun> runs = {};
  std::optional<FitResult> result = {};
};

/// Fits all runs together, or with `each` every run by itself: if one cannot be fitted, a message
/// names it and the others are fitted all the same.
std::vector<Group> fit_all(Tool& tool, Route route, std::vector<FitRun> runs,
                           const FitOptions& options, bool each) {
  std::vector<Group> groups;
  if (each)
    for (FitRun& run : runs) groups.emplace_back().runs.push_back(std::move(run));
  else groups.push_back({std::move(runs)});
  for (Group& group : groups) try {
      group.result = fit(route, group.runs, options);
    } catch (const Error& error) {
      if (!each) throw;
      tool.say(group.runs.front().name, error.what());
    }
  return groups;
}

/// A number of the row of a fit, and its column.
struct Cell {
  Column column;
  double value;
  bool is_count = false;  ///< not rounded to --digits
};

/// The row of a fit.
std::vector<Cell> row_of(const Group& group, bool with_slope) {
  const FitResult& r = *group.result;
  std::vector<Cell> row;
  const auto estimate = [&](const Column& c, const Estimate& x) {
    row.insert(row.end(), {{c, x.value}, {{"sigma_" + c.name, c.unit}, x.sigma}});
  };
  const auto columns = columns_of(r.law.form());
  for (std::size_t j = 0; j < columns.size(); ++j) estimate(columns[j], r.coefficients[j]);
  const auto names = correlations_of(r.law.form());
  for (std::size_t j = 1, k = 0; j < columns.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) row.push_back({{names[k++]}, r.correlations[i][j]});
  row.insert(row.end(), {{{"rms"}, r.rms}, {{"n"}, static_cast<double>(r.n), true}});
  const bool roll = r.v0.size() == 1;  // the numbers of one of several are no columns
  if (roll) estimate({"v0", "m/s"}, r.v0.front());
  if (with_slope) estimate({"slope"}, {r.slope, r.sigma_slope});
  if (r.x0.size() == 1) estimate({"x0", "m"}, r.x0.front());
  if (roll) row.push_back({{"t0", "s"}, group.runs.front().t.front()});
  return row;
}

/// Writes a row for each group, of which `one` has been fitted. A run that could not be fitted has
/// blank cells, and so have errors that do not exist.
void write(Output& out, const std::vector<Group>& groups, const Group& one, bool with_slope,
           bool with_run) {
  std::vector<Column> columns;
  for (const Cell& cell : row_of(one, with_slope)) columns.push_back(cell.column);
  const std::size_t cells = columns.size();
  if (with_run) columns.push_back({"run"});
  out.names(columns);
  for (const Group& group : groups) {
    if (!group.result)
      for (std::size_t j = 0; j < cells; ++j) out.blank();
    else
      for (const auto& [column, value, is_count] : row_of(group, with_slope)) {
        if (is_count) out.cell(std::to_string(static_cast<std::size_t>(value)));
        else if (group.result->errors == Errors::none && std::isnan(value)) out.blank();
        else out.cell(value);
      }
    if (with_run) out.cell(group.runs.front().name);
    out.end_line();
  }
  out.flush();  // the rows stand above the report
}

/// The values of --route, `fits` without a route.
std::map<std::string, std::optional<Route>> route_choices() {
  std::map<std::string, std::optional<Route>> choices{{"fits", {}}};
  for (const RouteWords& words : all_routes()) choices[words.name] = words.route;
  return choices;
}

int joint_of_rows(Tool& tool, const Bodies& bodies, bool with_check) {
  tool.refuse({"each", "exact", "fix", "law", "min-speed", "report", "robust", "slope"},
              "is for the fits of the runs: --route fits reads their rows");
  return fit_rows(tool, bodies, with_check);
}

/// The columns of a file without names. If --use says where t is and there is no --route, the route
/// is a trajectory: no column then counts as v or D by its position.
std::vector<std::string> order_without_names(std::optional<Route> given, bool times_given) {
  if (!given && times_given) return {};
  return words_of(given.value_or(Route::shift)).columns;
}

/// The route without --route, by the columns of the input.
Route default_route(const Reader& in) {
  return in.find("D")                    ? Route::shift
         : in.find("x") || !in.find("v") ? Route::position
                                         : Route::velocity;
}

}  // namespace

int main(int argc, char** argv) {
  using enum BodyOption;
  keep_freed_memory();
  Tool tool("fitpower", "Fit the power law D = a v^b to columns.");
  std::optional<Route> given_route;
  Bodies bodies;
  FitOptions options;
  bool each = false, with_report = false, with_check = false;
  tool.choice(
      "--route", given_route, route_choices(),
      "D of v (loglog, shift), v of t, x of t, or rows of fitpower (fits); without it shift "
      "if there is D, else position if x, else velocity");
  tool.numbers("-K,--shape-factor", bodies.shape_factors, not_negative,
               "shape factor K of J = K m R^2; one, or one for each run: 0.5,0.83");
  tool.numbers("-R,--radius", bodies.radii, radius_in_metres,
               "radius [m]; one, or one for each run");
  tool.body(bodies.body, {gravity}, &bodies.uncertainty);
  add_options(tool, options, bodies);
  tool.flag("--each", each, "fit each run by itself, a row for each");
  tool.flag("--report", with_report,
            "tell on standard error what each route finds, and whether another law is better");
  tool.flag("--check", with_check,
            "exit with 1 if runs disagree, a beginning, another law or the residuals speak against "
            "the fit");
  tool.scene();
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    if (tool.on_command_line("route") && !given_route)
      return joint_of_rows(tool, bodies, with_check);
    Reader& in = tool.read(order_without_names(given_route, tool.used("t")));
    Route route = given_route ? *given_route : default_route(in);
    options.possible_filters = filters_of_sensors();
    const bool trajectory = is_trajectory(route);
    if (trajectory) tool.need({"radius", "shape-factor"});
    if (options.v0 && !trajectory) fail<OptionError>("--fix: this route has no v0");
    if (options.x0 && route != Route::position) fail<OptionError>("--fix: this route has no x0");

    auto runs =
        read_runs(tool, in, route, with_report ? Columns::of_all_routes : Columns::of_route);
    if (!each) warn_of_copies(tool, route, runs);
    if (route == Route::velocity && take_pulses(tool, runs)) route = Route::position;
    bodies.give_to(runs);
    if (!trajectory && !options.fit_slope) warn_of_unused_body(tool, runs, options.geometry);
    const auto groups = fit_all(tool, route, std::move(runs), options, each);
    const auto fitted = [](const Group& group) { return group.result.has_value(); };
    const auto one = std::ranges::find_if(groups, fitted);
    if (one == groups.end()) return 2;

    write(tool.out, groups, *one, options.fit_slope, each);
    const bool compares = with_report || with_check;
    if (options.robust && compares)
      tool.warn(
          "neither other laws nor the beginning are looked at with --robust: this needs sums "
          "of squares");
    std::size_t left_out = 0;
    for (const auto& [grouped, result] : groups) {
      if (!result) continue;
      left_out += result->left_out;
      std::optional<LawComparison> laws;  // AICc needs sums of squares
      if (compares && !options.robust) laws = compare_laws(route, grouped, options);
      remark(tool, route, *result, grouped, options, laws, with_check);
      if (!with_report) continue;
      if (each) tool.say(fmt::format("run {}, the report:", grouped.front().name));
      report(tool, grouped, options, laws);
    }
    tool.count_left_out(left_out, why_left_out(route, options));
    return std::ranges::all_of(groups, fitted) ? 0 : 2;
  });
}
