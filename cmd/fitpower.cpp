// SPDX-License-Identifier: GPL-3.0-or-later
// fitpower - fit the power law D = a v^b, or another law, to columns; see fitpower(1)
#include <algorithm>
#include <cmath>

#include "cli/history.h"
#include "cli/law_file.h"
#include "fit/fit.h"
#include "report/fit_runs.h"
#include "text/number.h"

using namespace rolling;

namespace {

/// Holds a parameter fixed by a text NAME=VALUE.
void fix(FitOptions& options, const std::string& setting) {
  std::map<std::string, std::optional<double>*> parameters{{"v0", &options.v0},
                                                           {"x0", &options.x0}};
  std::vector<std::string> names;
  for (std::size_t j = 0; j < options.law->coefficients.size(); ++j) {
    names.emplace_back(options.law->coefficients[j].name);
    parameters[names.back()] = &options.fixed[j];
  }
  const auto equals = setting.find('=');
  const auto parameter = parameters.find(setting.substr(0, equals));
  double value;
  if (equals == std::string::npos || parameter == parameters.end())
    fail<OptionError>("--fix: '{}' is not NAME=VALUE; NAME is {}, v0 or x0", shown(setting),
                      fmt::join(names, ", "));
  if (!parse_number(std::string_view(setting).substr(equals + 1), value))
    fail<OptionError>("--fix: the value in '{}' is not a number", shown(setting));
  if (*parameter->second)
    fail<OptionError>("--fix: '{}' comes after another for {}", shown(setting), parameter->first);
  *parameter->second = value;
}

/// The values of --route.
std::map<std::string, std::optional<Route>> routes() {
  std::map<std::string, std::optional<Route>> all{{"fits", {}}};
  for (const Route route : {Route::loglog, Route::shift, Route::velocity, Route::position})
    all[name_of(route)] = route;
  return all;
}

/// `settings` are those of --fix.
void add_options(Tool& tool, FitOptions& options, Bodies& bodies,
                 std::vector<std::string>& settings) {
  tool.bodies(bodies.all, bodies.list, {&Body::R, &Body::K, &Body::g, &Body::slope, &Body::wind},
              &options);
  add_height(tool, bodies.height);
  tool.add("--x0", "X,...",
           "x at the start of runs of speeds [m]; one, or one for each run: 0,2400 (the column x, "
           "else fitted)",
           [&](const std::string& text) {
    for (const std::string& x : split_names(text, ','))
      bodies.begins.push_back(to_number(x, any_number));
  });
  tool.choice("--steepness", options.fit_steepness, {{"fit", true}},
              "find a factor of the height, one for all runs");
  tool.geometry(bodies.exact);
  tool.number("--min-speed", options.min_speed, not_negative, "leave out slower rows [m/s]");
  tool.flag("--robust", options.robust,
            "let outliers count little: bisquare loss instead of squares");
  tool.add("--law", "LAW", "fit this law of those that --report compares: d0+d2*v^2",
           [&](const std::string& text) { options.law = &law_named(text); });
  tool.add(
      "--fix", "NAME=VALUE", "fix a coefficient of the law, v0 or x0 at this value",
      [&](const std::string& setting) { settings.push_back(setting); }, Tool::Values::many);
}

/// Refuses a wind under a law without a drag, and says what one wind for several runs assumes.
void doubt_wind(Tool& tool, const FitOptions& options, std::size_t runs) {
  if (options.law->drag < 0)
    tool.refuse({"wind"}, "acts on a term d2 v^2: say --law d0+d2*v^2, or another with d2");
  if (options.fit_wind && runs > 1)
    tool.warn(
        "one wind is fitted for all runs: if it was not the same, the law is off, and the "
        "residuals do not show it");
}

/// Refuses the options of runs beside rows of fitpower.
void refuse_runs(Tool& tool) {
  tool.refuse({"each", "exact", "fix", "height", "law", "min-speed", "report", "robust", "slope",
               "steepness", "wind", "x0"},
              "is for the fits of the runs: --route fits reads their rows");
}

/// Gives the bodies their road; refuses what needs one without it, and what does not go with one.
void give_road(Tool& tool, Bodies& bodies, const Road* road, Route route) {
  for (Body& body : bodies.all) body.road = road;
  if (!road) return tool.refuse({"x0", "steepness"}, "goes with --height");
  if (route != Route::velocity) tool.refuse({"x0"}, "is for runs of speeds: positions have it");
  if (!is_trajectory(route)) tool.refuse({"height"}, "is for the routes velocity and position");
}

/// Refuses a limit of speed above all rows.
void refuse_slow(const std::vector<Run>& runs, const FitOptions& options) {
  double v = NAN;
  for (const Run& run : runs) v = std::fmax(v, fastest(run));
  if (v < options.min_speed)
    fail<OptionError>("--min-speed {}: the fastest row has {:.3g} m/s", options.min_speed, v);
}

/// Fits all runs together, or with `each` every run by itself: if one cannot be fitted, a message
/// names it and the others are fitted all the same. With `compares` other laws are fitted too.
std::vector<FitOfRuns> fit_all(Tool& tool, Route route, std::vector<Run> runs,
                               const FitOptions& options, bool each, bool compares) {
  refuse_slow(runs, options);
  std::vector<FitOfRuns> fits;
  if (each)
    for (Run& run : runs) fits.push_back({route, {std::move(run)}});
  else fits.push_back({route, std::move(runs)});
  for (FitOfRuns& one : fits) try {
      FitResult result = fit(route, one.runs, options);
      if (compares) one.laws = compare_laws(route, one.runs, options);
      one.result = std::move(result);
    } catch (const Error& error) {
      if (!each) throw;
      tool.say(one.runs.front().name, tool.told(error));
    }
  return fits;
}

/// The row of a fit.
std::vector<Cell> row_of(const FitOfRuns& fit) {
  const FitResult& r = *fit.result;
  std::vector<Cell> row;
  const auto estimate = [&](const Column& c, const Estimate& x) {
    row.insert(row.end(), {{c, x.value}, {{"sigma_" + c.name, c.unit}, x.sigma}});
  };
  const auto columns = columns_of(r.law.form());
  for (std::size_t j = 0; j < columns.size(); ++j) estimate(columns[j], r.coefficients[j]);
  const auto names = correlations_of(r.law.form());
  std::size_t pair = 0;
  for (std::size_t j = 1; j < columns.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) row.push_back({{names[pair++]}, r.correlations[i][j]});
  row.insert(row.end(), {{{"rms"}, r.rms}, {{"n"}, static_cast<double>(r.n)}});
  const bool roll = r.v0.size() == 1;  // the numbers of one of several are no columns
  if (roll) estimate({"v0", "m/s"}, r.v0.front());
  for (std::size_t i = 0; i < scene_numbers.size(); ++i)
    if (r.scene[i]) estimate({scene_numbers[i].name, scene_numbers[i].unit_of_value}, *r.scene[i]);
  if (r.x0.size() == 1) estimate({"x0", "m"}, r.x0.front());
  if (roll) row.push_back({{"t0", "s"}, fit.runs.front().t.front()});
  return row;
}

/// Says where runs of speeds begin, if the fit has found it.
void say_begins(Tool& tool, const std::vector<FitOfRuns>& fits) {
  std::string begins;
  for (const FitOfRuns& fit : fits)
    for (std::size_t r = 0; fit.result && r < fit.runs.size(); ++r) {
      const auto& [x0, sigma] = fit.result->x0[r];
      add_item(begins, fmt::format("{:.7g} +- {:.2g}", x0, sigma));
    }
  tool.warn(fmt::format("x0 is fitted, since there is no column x and no --x0: {} m", begins));
}

/// The line that says of what the rows were made.
std::string line_above(const std::vector<FitOfRuns>& fits, const FitOptions& options) {
  std::vector<std::optional<Body>> of_runs;
  for (const FitOfRuns& fit : fits)
    for (const Run& run : fit.runs)
      of_runs.push_back(is_trajectory(fit.route) ? run.body : run.shift_of);
  return line_of_fit(name_of(fits.front().route), options, of_runs);
}

/// Writes a row for each fit; `fitted` is one of them. A run that could not be fitted has blank
/// cells, and so have errors that do not exist.
void write(Output& out, const std::vector<FitOfRuns>& fits, const FitOfRuns& fitted,
           const FitOptions& options, bool with_run) {
  std::vector<Cell> blank = row_of(fitted);
  for (Cell& cell : blank) cell.value = NAN;
  std::vector<std::vector<Cell>> rows;
  std::vector<std::string> names;
  for (const FitOfRuns& fit : fits) {
    rows.push_back(fit.result ? row_of(fit) : blank);
    if (with_run) names.push_back(fit.runs.front().name);
  }
  write_table(out, line_above(fits, options), rows, names);
}

/// The columns of a file without names: those of the route, or speeds over time where the body is
/// given, else v and D. If --use says which is t, no column is v or D by its place.
std::vector<std::string> order_of_columns(const Tool& tool, std::optional<Route> route) {
  if (!route && tool.given("shape-factor") && tool.given("radius")) route = Route::velocity;
  std::vector<std::string> names;
  if (route || !tool.uses("t"))
    for (const Quantity q : columns_of(route.value_or(Route::shift)))
      names.emplace_back(name_of(q));
  return names;
}

/// The route without --route, by the columns of the input.
Route default_route(const Reader& in) {
  if (in.find("D")) return Route::shift;
  if (in.find("x") || !in.find("v")) return Route::position;
  return Route::velocity;
}

/// Why a route leaves rows out.
std::string why_left_out(Route route, const FitOptions& options) {
  std::string why;
  if (route == Route::loglog) why = "v or D is not above 0, or the body has stopped";
  if (route == Route::shift) why = "v is not above 0";
  if (route == Route::velocity)
    why = "they lie beside an end or a lost reading, where a sensor's speeds are not to be trusted";
  if (options.min_speed > 0) add_item(why, "slower than --min-speed", ", or ");
  return why;
}

/// What the options and the scene describe.
struct Task {
  std::optional<Route> route;  ///< none without --route, and for `fits`
  Bodies bodies = {};
  FitOptions options = {};
  std::vector<std::string> fixed = {};  ///< the settings of --fix; the law may come behind them
  bool each = false;
  bool with_report = false;
};

/// Prints the remarks on the fits, and their reports.
void remark_on(Tool& tool, Route route, std::vector<FitOfRuns>& fits, const Task& task) {
  if (task.options.fit_x0) say_begins(tool, fits);
  if (task.options.robust && (task.with_report || tool.checks))
    tool.warn(
        "neither other laws nor the beginning are looked at with --robust: this needs sums "
        "of squares");
  std::size_t left_out = 0;
  for (FitOfRuns& one : fits) {
    if (!one.result) continue;
    left_out += one.result->left_out;
    remark(tool, one, task.options, fits.size());
    doubt_speed(tool, one);
    if (!task.with_report) continue;
    if (task.each) tool.say(fmt::format("run {}, the report:", one.runs.front().name));
    report(tool, one, *task.options.law);
  }
  tool.count_left_out(left_out, why_left_out(route, task.options));
}

/// Fits the runs of the input. Returns the exit status.
int fit_input(Tool& tool, Task& task) {
  FitOptions& options = task.options;
  Reader& in = tool.read(order_of_columns(tool, task.route));
  if (in.find("sigma_a") || in.find("sigma_d0"))
    fail<InputError>("these are rows of fitpower: --route fits joins them");
  Route route = task.route ? *task.route : default_route(in);
  options.possible_filters = filters_of_sensors();
  const bool trajectory = is_trajectory(route);
  if (trajectory) tool.need({"radius", "shape-factor"});
  if (options.v0 && !trajectory) fail<OptionError>("--fix: this route has no v0");
  if (options.x0 && route != Route::position) fail<OptionError>("--fix: this route has no x0");

  const auto road = read_road(tool, task.bodies.height, options.fit_slope);
  give_road(tool, task.bodies, road.get(), route);
  const bool needs_x = road && route == Route::velocity && task.bodies.begins.empty();
  options.fit_x0 = needs_x && !in.find("x");
  auto runs = read_runs(tool, in, route, needs_x && !options.fit_x0);
  doubt_wind(tool, options, task.each ? 1 : runs.size());
  if (!task.each) warn_of_copies(tool, route, runs);
  if (!road && route == Route::velocity && take_pulses(tool, runs)) route = Route::position;
  task.bodies.give_to(runs);
  if (!trajectory && !options.fit_slope) warn_of_unused_body(tool, runs);
  const bool compares = (task.with_report || tool.checks) && !options.robust;
  auto fits = fit_all(tool, route, std::move(runs), options, task.each, compares);
  const auto fitted = [](const FitOfRuns& one) { return one.result.has_value(); };
  const auto first = std::ranges::find_if(fits, fitted);
  if (first == fits.end()) return trouble;
  write(tool.out, fits, *first, options, task.each);
  remark_on(tool, route, fits, task);
  return std::ranges::all_of(fits, fitted) ? 0 : trouble;
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("fitpower", "Fit the power law D = a v^b to columns.");
  Task task;
  tool.choice<std::optional<Route>>(
      "--route", task.route, routes(),
      "fit D(v) (shift, loglog), v(t), x(t), or rows of fitpower (fits); without it shift if "
      "there is a D, else position if there is an x, else velocity");
  add_options(tool, task.options, task.bodies, task.fixed);
  tool.flag("--each", task.each, "fit each run by itself, a row for each");
  tool.flag("--report", task.with_report,
            "print the parts of the uncertainties and the fits of other laws on standard error");
  tool.flag("--check", tool.checks,
            "exit with 1 if the runs disagree, or the start, the residuals or another law speak "
            "against the fit");
  tool.accept();
  tool.scene();
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    if (!tool.checks) tool.refuse({"accept"}, "goes with --check");
    for (const std::string& setting : task.fixed) fix(task.options, setting);
    if (!tool.on_command_line("route") || task.route) return fit_input(tool, task);
    refuse_runs(tool);
    fit_rows(tool, task.bodies);
    return 0;
  });
}
