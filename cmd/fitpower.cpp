// fitpower - fit the power law D = a v^b to columns; see fitpower(1)
#include <algorithm>
#include <compare>
#include <cmath>
#include <set>

#include "cli/fit_report.h"
#include "cli/history.h"
#include "fit/fit.h"
#include "signal/repeats.h"
#include "text/estimate.h"

using namespace rolling;

namespace {

/// The values of NAME=VALUE, repeated.
void set_parameters(const std::string& option, const std::vector<std::string>& settings,
                    const std::map<std::string, std::optional<double>*>& parameters) {
  for (const std::string& setting : settings) {
    const auto equals = setting.find('=');
    const auto parameter = parameters.find(setting.substr(0, equals));
    double value;
    if (equals == std::string::npos || parameter == parameters.end() ||
        !parse_number(std::string_view(setting).substr(equals + 1), value))
      fail("{}: '{}' is not NAME=VALUE with a name that it knows", option, shown(setting));
    if (*parameter->second)
      fail("{}: '{}' comes after another for {}", option, shown(setting), parameter->first);
    *parameter->second = value;
  }
}

/// Warns of readings that a logger held: the fit counts each repetition as a new reading. Speeds
/// that were made of positions are no readings.
void warn_of_held(Tool& tool, Route route, const FitRun& run,
                  const std::vector<std::string>& history) {
  const bool position = route == Route::position;
  if (!position && speeds_of_positions(history)) return;
  const double held = records_held(position ? run.x : run.v);
  if (held > 1)
    tool.warn(fmt::format(
        "run {}: {} repeat: each stands in {:.2g} records on average; keep only the record "
        "in which a new one comes",
        run.name, position ? "positions" : "speeds", held));
}

/// The columns that are read: those that the route fits, or those of the other routes too.
enum class Columns { of_route, of_all_routes };

std::vector<double> FitRun::*column_of(std::string_view name) {
  return name == "x" ? &FitRun::x : name == "v" ? &FitRun::v : &FitRun::D;
}

/// Warns of a record that was given twice: in a joint fit it makes the errors too small. Fewer than
/// ten readings may be equal by chance.
void warn_of_copies(Tool& tool, Route route, const std::vector<FitRun>& runs) {
  const auto y = column_of(columns_of(route).back());
  const auto less = [&](std::size_t i, std::size_t j) {  // of all doubles, NaN too
    return std::ranges::lexicographical_compare(
        runs[i].*y, runs[j].*y, [](double a, double b) { return std::strong_order(a, b) < 0; });
  };
  std::set<std::size_t, decltype(less)> different(less);
  std::string copy;
  std::size_t copies = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if ((runs[i].*y).size() < 10) continue;
    const auto [same, inserted] = different.insert(i);
    if (!inserted && ++copies == 1)
      copy =
          fmt::format("run {}: its readings are those of run {}", runs[i].name, runs[*same].name);
  }
  if (copies > 0)
    tool.warn(
        fmt::format("{}{}: leave copies out, for each counts as one more roll", copy,
                    copies > 1 ? fmt::format(", the first of {} copies", copies) : std::string()));
}

std::vector<FitRun> read_runs(Tool& tool, Reader& in, Route route, const Body& body,
                              Columns columns) {
  const bool all_columns = columns == Columns::of_all_routes;
  struct Needed {
    std::size_t slot;
    std::vector<double> FitRun::*column;
  };
  std::vector<Needed> needed;
  const auto names = columns_of(route);
  for (const std::string& name : names)
    if (name != "t") needed.push_back({in.need(name), column_of(name)});
  bool timed = is_trajectory(route) || (all_columns && in.find("t"));
  if (timed) needed.push_back({in.need_time(), &FitRun::t});
  // The columns of the other routes; and x, with which the speeds are compared if a `##` line says
  // that they are differences.
  for (const char* name : {"x", "v", "D"})
    if ((all_columns || (*name == 'x' && route == Route::velocity && !in.history().empty())) &&
        in.find(name) && std::find(names.begin(), names.end(), name) == names.end())
      needed.push_back({in.want(name), column_of(name)});
  std::vector<FitRun> runs;
  while (in.next_run()) {
    FitRun& run = runs.emplace_back();
    run.name = in.run_name();
    run.body = body;
    if (!timed && !in.history().empty() && in.find("t")) {  // the filters act on these times
      needed.push_back({in.need_time(), &FitRun::t});
      timed = true;
    }
    const std::size_t room = runs.size() == 1 ? in.records_ahead() : 0;  // most files are one run
    for (const auto& [slot, column] : needed) (run.*column).reserve(room);
    while (in.next())
      for (const auto& [slot, column] : needed) (run.*column).push_back(in[slot]);
    warn_of_held(tool, route, run, in.history());
    History history = history_of(in.history(), run.t);
    if (in.renames() && !history.filters.empty())
      history = {{}, {}, "--use takes other columns than its `##` lines speak of"};
    run.shift_of = history.shift_of;
    history = known_windows(compared(std::move(history), run), run, columns_of(route).back());
    run.filters = std::move(history.filters);
    run.shift_of = history.shift_of;
    if (!history.doubt.empty())
      tool.warn(fmt::format("run {}: {}: the fit goes on as if no filter were known", run.name,
                            history.doubt));
    if (history.left_out > 0)
      tool.warn(fmt::format(
          "run {}: it was cut after the filters that its `##` lines name: {} more "
          "records at the cut are left out, since their windows are not known; cut first",
          run.name, history.left_out));
  }
  return runs;
}

/// The values of --fix and --start.
void set_parameters(FitOptions& options, const std::vector<std::string>& fixed,
                    const std::vector<std::string>& start) {
  set_parameters("--fix", fixed,
                 {{"a", &options.a}, {"b", &options.b}, {"v0", &options.v0}, {"x0", &options.x0}});
  set_parameters("--start", start, {{"a", &options.start_a}, {"b", &options.start_b}});
}

/// A slope that is not `fit`.
void set_slope(const std::string& text, Body& body, BodyUncertainty& uncertainty) {
  Estimate given;
  if (!parse_estimate(text, given)) fail("--slope: '{}' is no number, and not `fit`", shown(text));
  body.slope = given.value;
  uncertainty.slope = given.sigma;
}

void add_options(Tool& tool, FitOptions& options) {
  tool.geometry(options.geometry);
  tool.number("--min-speed", options.min_speed, not_negative, "leave slower records out [m/s]");
  tool.flag("--robust", options.robust,
            "let outliers count little: bisquare loss instead of squares");
}

/// The shape factor of each run, and the uncertainties of the numbers of its body.
void set_bodies(std::vector<FitRun>& runs, const std::vector<Estimate>& shape_factors,
                const BodyUncertainty& uncertainty) {
  if (shape_factors.size() > 1 && shape_factors.size() != runs.size())
    fail("--shape-factor gives {} values, but runs are {}", shape_factors.size(), runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Estimate K = shape_factors.empty() ? Estimate{not_given}
                                             : shape_factors[shape_factors.size() > 1 ? i : 0];
    runs[i].body.K = K.value;
    runs[i].given = uncertainty;
    runs[i].given.K = K.sigma;
  }
}

/// Warns of numbers of the body that the fit does not use, because D was computed with others.
void warn_of_other_body(Tool& tool, const std::vector<FitRun>& runs) {
  for (const FitRun& run : runs) {
    Body given = run.body;
    if (!tool.given("gravity")) given.g = not_given;
    if (!tool.given("slope")) given.slope = not_given;
    const std::string others = other_body(run.shift_of, given, run.given);
    if (others.empty()) continue;
    tool.warn(fmt::format("run {}: D was computed with {}: the fit uses the numbers of D", run.name,
                          others));
    return;
  }
}

/// The groups of runs that are fitted together: one group of all runs, or one for each run.
std::vector<std::vector<FitRun>> grouped(std::vector<FitRun> runs, bool each) {
  std::vector<std::vector<FitRun>> groups;
  if (each)
    for (FitRun& run : runs) groups.push_back({std::move(run)});
  else groups.push_back(std::move(runs));
  return groups;
}

/// Fits each group of runs. With `each` a group is one run: if it cannot be fitted, a message names
/// it and the others are fitted all the same.
std::vector<std::optional<FitResult>> fit_all(Tool& tool, Route route,
                                              const std::vector<std::vector<FitRun>>& fits,
                                              const FitOptions& options, bool each) {
  std::vector<std::optional<FitResult>> results;
  for (const auto& runs : fits) {
    const double done = static_cast<double>(results.size()) / static_cast<double>(fits.size());
    tool.progress.at("fitting", fits.size() == 1 ? not_given : done);
    try {
      results.emplace_back(fit(route, runs, options));
    } catch (const Error& error) {
      if (!each) throw;
      tool.say(fmt::format("run {}: {}", runs.front().name, error.what()));
      results.emplace_back();
    }
  }
  return results;
}

/// The output: a row for each fit.
struct Table {
  Output& out;
  bool with_v0, with_slope, with_run;

  std::vector<Column> columns() const {
    std::vector<Column> columns = {{"a", "m"}, {"sigma_a", "m"}, {"b"}, {"sigma_b"},
                                   {"corr"},   {"rms"},          {"n"}};
    if (with_v0) columns.insert(columns.end(), {{"v0", "m/s"}, {"sigma_v0", "m/s"}});
    if (with_slope) columns.insert(columns.end(), {{"slope"}, {"sigma_slope"}});
    if (with_run) columns.push_back({"run"});
    return columns;
  }
  void write_names() const { out.names(columns()); }

  /// A run that could not be fitted has blank cells, and so have errors that do not exist.
  void write(const std::optional<FitResult>& result, const std::string& run) const {
    if (result) {
      const FitResult& r = *result;
      const auto cell = [&](double value) {
        const bool no_error = r.errors == Errors::none && std::isnan(value);
        no_error ? out.blank() : out.cell(value);
      };
      for (const double value : {r.a, r.sigma_a, r.b, r.sigma_b, r.corr, r.rms}) cell(value);
      out.blank();
      out.text(std::to_string(r.n));  // a count is never rounded to --digits
      if (with_v0)
        for (const double value : {r.v0.front(), r.sigma_v0.front()}) cell(value);
      if (with_slope)
        for (const double value : {r.slope, r.sigma_slope}) cell(value);
    } else {
      for (std::size_t i = 1; i < columns().size(); ++i) out.blank();
    }
    if (with_run) out.cell(run);
    out.end_line();
  }
};

/// The columns of a file without names. If --use says where t is and there is no --route, the route
/// is a trajectory: no column then counts as v or D by its position.
std::vector<std::string> order_without_names(std::optional<Route> given, bool times_given) {
  if (!given && times_given) return {};
  return columns_of(given.value_or(Route::shift));
}

/// The route without --route, by the columns of the input.
Route default_route(const Reader& in) {
  return in.find("D") ? Route::shift : in.find("v") ? Route::velocity : Route::position;
}

}  // namespace

int main(int argc, char** argv) {
  using enum BodyOption;
  Tool tool("fitpower", "Fit the power law D = a v^b to columns.");
  std::optional<Route> given_route;
  std::vector<Estimate> shape_factors;
  std::vector<std::string> fixed, start;
  std::string slope_text = "0";
  Body body;
  BodyUncertainty uncertainty;
  FitOptions options;
  bool each = false, with_report = false, with_check = false;
  tool.choice("--route", given_route, fit_routes(),
              "what is fitted: D of v (loglog, shift), v of t or x of t (shift if there is D, else "
              "velocity if v, else position)");
  tool.numbers("-K,--shape-factor", shape_factors, not_negative,
               "shape factor K of J = K m R^2; one, or one for each run: 0.5,0.83");
  tool.body(body, {radius, gravity}, &uncertainty);
  tool.text("--slope", slope_text, "S|fit",
            "the mat rises by S metres a metre along growing x; fit: find it, of all runs");
  add_options(tool, options);
  tool.flag("--each", each, "fit each run by itself, a row for each");
  tool.list("--fix", fixed, "NAME=VALUE", "hold a, b, v0 or x0 fixed");
  tool.list("--start", start, "NAME=VALUE", "begin the search at this a or b");
  tool.flag("--report", with_report,
            "tell on standard error what each route finds, and whether the law is adequate");
  tool.flag("--check", with_check,
            "exit with 1 if runs disagree, a beginning, another law or the residuals speak against "
            "the fit");
  tool.scene();
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    set_parameters(options, fixed, start);
    Reader& in = tool.read(order_without_names(given_route, tool.used("t")));
    const Route route = given_route ? *given_route : default_route(in);
    options.possible_filters = filters_of_sensors();
    options.fit_slope = slope_text == "fit";
    if (!options.fit_slope) set_slope(slope_text, body, uncertainty);
    const bool trajectory = is_trajectory(route);
    if (trajectory) tool.need({"radius", "shape-factor"});
    if (options.v0 && !trajectory) fail("--fix: this route has no v0");
    if (options.x0 && route != Route::position) fail("--fix: this route has no x0");

    auto runs =
        read_runs(tool, in, route, body, with_report ? Columns::of_all_routes : Columns::of_route);
    if (!each) warn_of_copies(tool, route, runs);
    set_bodies(runs, shape_factors, uncertainty);
    if (!trajectory && !options.fit_slope) warn_of_other_body(tool, runs);
    const auto fits = grouped(std::move(runs), each);
    const Table table{tool.out, trajectory && fits.front().size() == 1, options.fit_slope, each};
    const auto results = fit_all(tool, route, fits, options, each);
    const auto fitted = [](const auto& result) { return result.has_value(); };
    if (std::none_of(results.begin(), results.end(), fitted)) return 2;

    table.write_names();
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < results.size(); ++i) {
      table.write(results[i], fits[i].front().name);
      if (results[i]) left_out += results[i]->left_out;
    }
    for (std::size_t i = 0; i < fits.size(); ++i) {
      if (!results[i]) continue;
      warn_of(tool, route, *results[i], fits[i], with_check);
      if (!with_report && !with_check) continue;
      std::optional<LawComparison> laws;  // AICc needs sums of squares
      if (!options.robust) laws = compare_laws(route, fits[i], options);
      if (with_report && each) tool.say(fmt::format("run {}, the report:", fits[i].front().name));
      if (with_report) report(tool, fits[i], options, laws);
      if (with_check)
        check(tool, *results[i], laws, disturbed_beginning(route, fits[i], options), fits[i]);
    }
    tool.count_left_out(left_out, "this route cannot use them");
    return std::all_of(results.begin(), results.end(), fitted) ? 0 : 2;
  });
}
