// fitpower - fit the power law D = a v^b to columns; see fitpower(1)
#include <algorithm>
#include <cmath>
#include <span>

#include "cli/fit_report.h"
#include "cli/history.h"
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

struct Runs {
  std::vector<FitRun> runs;
  std::vector<std::string> names;
};

Runs read_runs(Tool& tool, Reader& in, Route route, const Body& body, bool all_columns) {
  struct Needed {
    std::size_t slot;
    std::vector<double> FitRun::*column;
  };
  std::vector<Needed> needed;
  const auto column_of = [](std::string_view name) {
    return name == "x" ? &FitRun::x : name == "v" ? &FitRun::v : &FitRun::D;
  };
  const auto names = columns_of(route);
  for (const std::string& name : names)
    if (name != "t") needed.push_back({in.need(name), column_of(name)});
  bool timed = names.front() == "t" || (all_columns && in.find("t"));
  if (timed) needed.push_back({in.need_time(), &FitRun::t});
  // What other routes would fit; and x, with which speeds that claim to be differences are
  // compared.
  for (const char* name : {"x", "v", "D"})
    if ((all_columns || (*name == 'x' && route == Route::velocity && !in.history().empty())) &&
        in.find(name) && std::find(names.begin(), names.end(), name) == names.end())
      needed.push_back({in.want(name), column_of(name)});
  Runs all;
  auto& runs = all.runs;
  while (in.next_run()) {
    FitRun& run = runs.emplace_back();
    all.names.push_back(in.run_name());
    run.body = body;
    if (!timed && !in.history().empty() && in.find("t")) {  // the filters act on these times
      needed.push_back({in.need_time(), &FitRun::t});
      timed = true;
    }
    const std::size_t room = runs.size() == 1 ? in.records_ahead() : 0;  // most files are one run
    for (const auto& [slot, column] : needed) (run.*column).reserve(room);
    while (in.next())
      for (const auto& [slot, column] : needed) (run.*column).push_back(in[slot]);
    History history = history_of(in.history(), run.t);
    run.shift_of = history.shift_of;
    history = compared(std::move(history), run);
    run.filters = std::move(history.filters);
    run.shift_of = history.shift_of;
    if (!history.doubt.empty())
      tool.warn(fmt::format("run {}: {}: the fit goes on as if no filter were known", runs.size(),
                            history.doubt));
  }
  return all;
}

/// The cells of a row; blank where a fit of as many parameters as records has no errors.
void write_cells(Tool& tool, const FitResult& r, bool with_v0, bool with_slope) {
  const auto cell = [&](double value) {
    r.errors == Errors::none&& std::isnan(value) ? tool.out.blank() : tool.out.cell(value);
  };
  for (const double value : {r.a, r.sigma_a, r.b, r.sigma_b, r.corr, r.rms}) cell(value);
  tool.out.blank();
  tool.out.text(std::to_string(r.n));  // a count is never rounded to --digits
  if (with_v0)
    for (const double value : {r.v0.front(), r.sigma_v0.front()}) cell(value);
  if (with_slope)
    for (const double value : {r.slope, r.sigma_slope}) cell(value);
}

}  // namespace

int main(int argc, char** argv) {
  using enum BodyOption;
  Tool tool("fitpower", "Fit the power law D = a v^b to columns.");
  std::optional<Route> given_route;
  std::vector<Estimate> shape_factors;
  std::vector<std::string> fixed, start;
  std::string given_slope = "0";
  Body body;
  FitOptions options;
  bool each = false, with_report = false, with_check = false;
  tool.choice("--route", given_route, fit_routes(),
              "what is fitted: D of v (loglog, shift), v of t or x of t (shift if there is D, else "
              "velocity if v, else position)");
  tool.numbers("-K,--shape-factor", shape_factors, not_negative,
               "shape factor K of J = K m R^2; one, or one for each run: 0.5,0.83");
  tool.body(body, {radius, gravity});
  tool.text("--slope", given_slope, "S|fit",
            "the mat rises by S metres a metre along growing x; fit: find it, of all runs");
  tool.geometry(options.geometry);
  tool.flag("--each", each, "fit each run by itself, a row for each");
  tool.list("--fix", fixed, "NAME=VALUE", "hold a, b, v0 or x0 fixed");
  tool.list("--start", start, "NAME=VALUE", "begin the search at this a or b");
  tool.number("--min-speed", options.min_speed, not_negative, "leave slower records out [m/s]");
  tool.flag("--robust", options.robust,
            "let outliers count little: bisquare loss instead of squares");
  tool.flag("--report", with_report,
            "tell on standard error what each route finds, and whether the law is adequate");
  tool.flag("--check", with_check,
            "exit with 1 if another law is better or the residuals are not white");
  tool.scene();
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    set_parameters(
        "--fix", fixed,
        {{"a", &options.a}, {"b", &options.b}, {"v0", &options.v0}, {"x0", &options.x0}});
    set_parameters("--start", start, {{"a", &options.start_a}, {"b", &options.start_b}});
    Reader& in = tool.read(columns_of(given_route.value_or(Route::shift)));
    const Route route = given_route    ? *given_route
                        : in.find("D") ? Route::shift
                        : in.find("v") ? Route::velocity
                                       : Route::position;
    options.possible_filters = filters_of_sensors();
    options.fit_slope = given_slope == "fit";
    if (Estimate given; parse_estimate(given_slope, given)) body.slope = given.value;
    else if (!options.fit_slope)
      fail("--slope: '{}' is no number, and not `fit`", shown(given_slope));
    const bool trajectory = route == Route::velocity || route == Route::position;
    if (trajectory) tool.need({"radius", "shape-factor"});
    for (const auto& [name, held] : {std::pair("v0", options.v0), std::pair("x0", options.x0)})
      if (held && !(name[0] == 'v' ? trajectory : route == Route::position))
        fail("--fix: this route has no {}", name);

    auto [runs, run_names] = read_runs(tool, in, route, body, with_report);
    if (shape_factors.size() > 1 && shape_factors.size() != runs.size())
      fail("--shape-factor gives {} values, but runs are {}", shape_factors.size(), runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i)
      runs[i].body.K =
          shape_factors.empty() ? not_given : shape_factors[shape_factors.size() > 1 ? i : 0].value;

    std::vector<std::vector<FitRun>> fits;
    if (each)
      for (FitRun& run : runs) fits.push_back({std::move(run)});
    else fits.push_back(std::move(runs));

    std::vector<Column> names = {{"a", "m"}, {"sigma_a", "m"}, {"b"}, {"sigma_b"},
                                 {"corr"},   {"rms"},          {"n"}};
    const bool with_v0 = trajectory && fits.front().size() == 1;
    if (with_v0) names.insert(names.end(), {{"v0", "m/s"}, {"sigma_v0", "m/s"}});
    if (options.fit_slope) names.insert(names.end(), {{"slope"}, {"sigma_slope"}});
    if (each) names.push_back({"run"});
    std::vector<std::optional<FitResult>> results;
    for (const auto& joint : fits) {
      tool.progress.at("fitting", fits.size() == 1 ? not_given
                                                   : static_cast<double>(results.size()) /
                                                         static_cast<double>(fits.size()));
      try {
        results.emplace_back(fit(route, joint, options));
      } catch (const Error& error) {  // one run that cannot be fitted loses no other
        if (!each) throw;
        tool.say(fmt::format("run {}: {}", run_names[results.size()], error.what()));
        results.emplace_back();
      }
    }
    const auto fitted = [](const auto& result) { return result.has_value(); };
    if (std::none_of(results.begin(), results.end(), fitted)) return 2;

    tool.out.names(names);
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (!results[i]) {
        for (std::size_t blank = 1; blank < names.size(); ++blank) tool.out.blank();
        tool.out.cell(run_names[i]);
        tool.out.end_line();
        continue;
      }
      const FitResult& r = *results[i];
      write_cells(tool, r, with_v0, options.fit_slope);
      if (each) tool.out.cell(run_names[i]);
      tool.out.end_line();
      left_out += r.left_out;
    }
    for (std::size_t i = 0; i < fits.size(); ++i) {
      if (!results[i]) continue;
      const auto of_fit = each ? std::span(run_names).subspan(i, 1) : std::span(run_names);
      warn_of(tool, *results[i], of_fit);
      if (!with_report && !with_check) continue;
      const auto laws = compare_if_possible(route, fits[i], options);
      if (with_report) report(tool, fits[i], options, laws);
      if (with_check) check(tool, *results[i], laws, of_fit);
    }
    tool.count_left_out(left_out, "this route cannot use them");
    return std::all_of(results.begin(), results.end(), fitted) ? 0 : 2;
  });
}
