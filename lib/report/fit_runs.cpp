// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/fit_runs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "cli/doubts.h"
#include "cli/history.h"
#include "cli/law_file.h"
#include "contact/body.h"
#include "selection/readings.h"
#include "statistics/levels.h"
#include "statistics/run_laws.h"

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

/// Objects to positions and speeds that contradict each other: one of them has another unit.
void compare_ways(Tool& tool, const Run& run) {
  if (run.t.empty() || run.x.empty() || run.v.empty()) return;
  const double ratio = ways_ratio(run.t, run.x, run.v);
  if (ratio > levels::ways_differ || ratio < 1 / levels::ways_differ)
    tool.object(run.name,
                fmt::format("x covers {:.3g} times the way that v covers: is one of t, x and v in "
                            "another unit, or v not the velocity along x? See --use",
                            ratio));
}

struct FitRows {
  std::vector<OwnLaw> laws;
  std::vector<Run> runs;  ///< the names and bodies of the runs, without readings
  bool a_fixed = false;
  bool b_fixed = false;

  /// Throws Error for a row that is none of a fit with errors.
  void add(std::string name, const LawOfFile& row) {
    const Estimate a = row.coefficients[0];
    const Estimate b = row.coefficients[1];
    const double corr = row.correlations[1][0];
    if (a.sigma < 0 || b.sigma < 0 || std::abs(corr) > 1)
      fail("sigma_a, sigma_b or corr is not one of a fit");
    if (a.sigma == 0 && b.sigma == 0) fail("a and b have no errors: were both fixed?");
    if (laws.empty()) {
      a_fixed = a.sigma == 0;
      b_fixed = b.sigma == 0;
    }
    if (a_fixed != (a.sigma == 0) || b_fixed != (b.sigma == 0))
      fail("{} is fixed in some rows only", a_fixed != (a.sigma == 0) ? "a" : "b");
    if (!laws.empty() && ((a_fixed && std::log(a.value) != laws.front().law.a) ||
                          (b_fixed && b.value != laws.front().law.b)))
      fail("{} is fixed at another value than in the first row", a_fixed ? "a" : "b");
    const double log_a = a.sigma / a.value;
    const Symmetric C{log_a * log_a, corr * log_a * b.sigma, b.sigma * b.sigma};
    if (!C.inverse().is_finite() || !(C.aa * C.bb >= C.ab * C.ab))
      fail("corr = {} has too few digits to separate a from b: write the rows with more", corr);
    laws.push_back({laws.size(), {std::log(a.value), b.value}, C, known_errors});
    runs.emplace_back().name = std::move(name);
  }
};

/// A row that is there twice would count twice.
void warn_of_same_rows(Tool& tool, const FitRows& rows) {
  std::set<std::vector<double>> different;
  for (const OwnLaw& row : rows.laws) {
    const Symmetric& C = row.covariance;
    if (!different.insert({row.law.a, row.law.b, C.aa, C.ab, C.bb}).second)
      tool.object(rows.runs[row.run].name,
                  "its numbers are those of an earlier row: leave copies out");
  }
}

FitRows read_rows(Tool& tool) {
  Reader& in = tool.read({});
  if (in.find("d0")) fail("these are rows of another law: --route fits joins rows of a v^b only");
  if (!in.find("sigma_a")) fail("no rows of fitpower: there is no column sigma_a");
  const auto rms = in.want("rms");  // NaN in runs that lack it, as the others
  const auto n = in.want("n");
  std::vector<std::size_t> sigmas;
  for (const char* number : {"sigma_a", "sigma_b", "sigma_v0", "sigma_x0", "sigma_slope"})
    sigmas.push_back(in.want(number));
  FitRows rows;
  const auto all = rows_of_fit(in, laws().front(), true, [&](const LawOfFile& row) {
    rows.add(row.run.empty() ? in.where() : row.run, row);
    const auto parameters = static_cast<double>(  // what is fixed has no error
        std::ranges::count_if(sigmas, [&](std::size_t sigma) { return in[sigma] > 0; }));
    if (!(in[n] > parameters) || !(in[rms] > 0)) return;
    rows.laws.back().rms = in[rms];
    rows.laws.back().freedom = in[n] - parameters;
  });
  for (std::size_t i = 0; i < all.size(); ++i) rows.runs[i].shift_of = all[i].fitted_with;
  if (rows.laws.size() < 2)
    fail("{}: a joint law is that of two or more", counted(rows.laws.size(), "row"));
  return rows;
}

/// What K, R and g have brought to ln a of all rows (a goes as (K + 1) R/g, Eq. 12) is taken out of
/// the rows: it is not noise.
std::vector<CommonError> take_common(FitRows& rows) {
  std::vector<CommonError> all;
  for (const NumberOfBody& number : uncertain_numbers) {
    std::map<std::pair<double, double>, CommonError> by_value;
    for (std::size_t i = 0; i < rows.runs.size(); ++i) {
      const auto [value, sigma] = number.of(rows.runs[i].body);
      if (!(sigma > 0)) continue;
      const double log_a = sigma / (number.value == &Body::K ? value + 1 : value);
      by_value.try_emplace({value, sigma}, rows.runs.size()).first->second[i] = {log_a, 0};
      Symmetric& C = rows.laws[i].covariance;
      C.aa -= log_a * log_a;
      if (!rows.a_fixed && !(C.aa > 0 && C.aa * C.bb >= C.ab * C.ab))
        fail(
            "row {}: its sigma_a is smaller than the uncertainty of {} alone makes it: give the -K "
            "and -R of its fit",
            rows.runs[i].name, number.name);
    }
    for (auto& [value, common] : by_value) all.push_back(std::move(common));
  }
  return all;
}

std::vector<Cell> row_of(const JointLaw& joint, std::size_t n) {
  const Symmetric& C = joint.covariance;
  const double a = std::exp(joint.law.a);
  return {{{"a", "m"}, a},
          {{"sigma_a", "m"}, a * std::sqrt(C.aa)},
          {{"b"}, joint.law.b},
          {{"sigma_b"}, std::sqrt(C.bb)},
          {{"corr"}, C.ab != 0 ? C.ab / std::sqrt(C.aa * C.bb) : 0},
          {{"scatter_ln_a"}, joint.scatter_log_a},
          {{"scatter_b"}, joint.scatter_b},
          {{"n"}, static_cast<double>(n)},
          {{"chi2"}, joint.agreement.ratio},
          {{"dof"}, static_cast<double>(joint.agreement.dof)},
          {{"p"}, joint.agreement.p}};
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
    tool.know_run(run.name);
    if (in.history().empty() && is_trajectory(route))
      for (const Quantity q : {Quantity::x, Quantity::v})
        if (!slots[q]) slots[q] = in.want_beside(name_of(q));
    if (!in.history().empty())  // the `##` lines are compared with the other columns
      for (const Quantity q : {Quantity::t, Quantity::x, Quantity::v, Quantity::D})
        if (const std::string name(name_of(q)); in.find(name) && !slots[q])
          slots[q] = q == Quantity::t ? in.need(name) : in.want(name);
    while (in.next())
      for (const Quantity q : all_quantities)
        if (slots[q]) run[q].push_back(in[*slots[q]]);
    set_filters(tool, in, route, run);
    compare_ways(tool, run);
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
    runs[r].x.clear();
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

double fastest(const Run& run) {
  double v = NAN;
  for (const double of_row : run.v) v = std::fmax(v, std::abs(of_row));
  return v;
}

void Bodies::give_to(std::vector<Run>& runs) const {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Run& run = runs[i];
    run.body = all[value_of_run(list, all.size(), i, runs.size())];
    run.body.exact = exact;
    if (!begins.empty()) run.x0 = begins[value_of_run("--x0", begins.size(), i, runs.size())];
    else if (run.body.road && !run.x.empty()) run.x0 = run.x.front();
  }
}

void warn_of_copies(Tool& tool, Route route, const std::vector<Run>& runs) {
  std::set<std::string> different;  // the sizes of all readings, as their bytes
  for (const Run& run : runs) {
    std::string readings;
    for (const Quantity q : columns_of(route))
      for (const double x : run[q]) {
        const double size = std::abs(x);  // a copy may be taken for a run in the other direction
        readings.append(reinterpret_cast<const char*>(&size), sizeof size);
      }
    const std::size_t rows = readings.size() / sizeof(double) / columns_of(route).size();
    if (rows >= 10 && !different.insert(std::move(readings)).second)
      tool.object(run.name,
                  "its readings are those of an earlier run: leave copies out, for each counts as "
                  "one more roll");
  }
}

void doubt_speed(Tool& tool, const FitOfRuns& fit) {
  for (std::size_t r = 0; r < fit.result->v0.size(); ++r) {
    const double v0 = std::abs(fit.result->v0[r].value);
    const Body& body = fit.runs[r].body;
    if (std::abs(fit.result->law(v0)) > body.R) continue;  // told
    if (is_hardly_so_fast(body, v0))
      tool.object(fit.runs[r].name,
                  fmt::format("v0 comes out as {:.3g} m/s: are the units those of the file, as in "
                              "v[km/h], and the times in seconds? See --use",
                              v0));
  }
}

void warn_of_unused_body(Tool& tool, const std::vector<Run>& runs) {
  std::string unused;
  for (const char* option : {"shape-factor", "radius", "gravity", "slope", "exact"})
    if (tool.on_command_line(option)) add_item(unused, std::string("--") + option);
  for (const Run& run : runs) {
    Body given = run.body;
    if (run.shift_of)
      take_body(tool, run.name, "D was computed with {}: the fit uses the numbers of D",
                *run.shift_of, given);
    else if (!unused.empty())
      tool.warn(run.name, "not used: " + unused + ": no `##` line says how D was computed");
  }
}

void write_table(Output& out, const std::string& line, const std::vector<std::vector<Cell>>& rows,
                 const std::vector<std::string>& runs) {
  out.line("## " + line);
  std::vector<Column> columns;
  for (const Cell& cell : rows.front()) columns.push_back(cell.column);
  if (!runs.empty()) columns.push_back({"run"});
  out.names(columns);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const auto& [column, value] : rows[i]) {
      const bool is_count = column.name == "n" || column.name == "dof";  // not rounded to --digits
      if (std::isnan(value)) out.cell("");
      else if (is_count) out.cell(std::to_string(static_cast<std::size_t>(value)));
      else out.cell(value);
    }
    if (!runs.empty()) out.cell(runs[i]);
    out.end_line();
  }
  out.flush();  // the rows stand above the messages
}

std::string p_of(double p) { return p < 1e-300 ? "p < 1e-300" : fmt::format("p = {:.1g}", p); }

std::string disagreement(const Agreement& found, const std::vector<Run>& runs, bool check) {
  const bool agree = found.agree();
  if (agree && !(check && found.p_of_run <= levels::run_off)) return {};
  std::string line =
      agree ? fmt::format("the runs agree as a whole, but one of {} is off ({})", found.runs,
                          p_of(found.p_of_run))
            : fmt::format(
                  "the runs disagree by more than their noise (chi2 {:.4g} of {} degrees "
                  "of freedom, {})",
                  found.ratio, found.dof, p_of(found.p));
  line +=
      fmt::format(": run {} {}", runs[found.run].name,
                  found.runs > 2 ? "is furthest from the others"
                                 : "differs from the other (which of them is off is not known)");
  if (found.log_D.sigma > 0)
    line += fmt::format(", in D({:.2g} m/s) by {:+.3g} +- {:.1g} %", found.speed,
                        100 * std::expm1(found.log_D.value), 100 * found.log_D.sigma);
  if (found.b.sigma > 0)
    line += fmt::format(", in its exponent by {:+.2g} +- {:.1g}", found.b.value, found.b.sigma);
  if (agree) return line;
  return line + (found.of_mean ? "; the row is their mean, with their scatter in its uncertainties"
                               : "; the uncertainties of the row contain their scatter");
}

void fit_rows(Tool& tool, const Bodies& bodies) {
  FitRows rows = read_rows(tool);
  warn_of_same_rows(tool, rows);
  bodies.give_to(rows.runs);
  std::vector<std::optional<Body>> of_runs;
  for (Run& run : rows.runs) {
    tool.know_run(run.name);
    if (run.shift_of) {
      run.body.exact = run.shift_of->exact;
      take_body(tool, run.name, "the row was fitted with {}", *run.shift_of, run.body);
      run.shift_of = run.body;
    }
    of_runs.push_back(run.shift_of);
  }
  const auto common = take_common(rows);
  const JointLaw joint = joint_law(rows.laws, common);
  write_table(tool.out, line_of_fit("fits", {}, of_runs), {row_of(joint, rows.laws.size())});
  const std::string found = disagreement(joint.agreement, rows.runs, tool.checks);
  if (!found.empty()) tool.object("", found, rows.runs[joint.agreement.run].name);
}

}  // namespace rolling
