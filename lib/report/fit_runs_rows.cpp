// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/fit_runs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "cli/law_file.h"
#include "contact/body.h"
#include "statistics/run_laws.h"

namespace rolling {
namespace {

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
  for (const UncertainNumber& number : uncertain_numbers) {
    std::map<std::pair<double, double>, CommonError> by_value;
    for (std::size_t i = 0; i < rows.runs.size(); ++i) {
      const Body& body = rows.runs[i].body;
      const double value = body.*number.value;
      const double sigma = body.*number.sigma;
      if (!(sigma > 0)) continue;
      const double log_a = sigma / (number.value == &Body::K ? value + 1 : value);
      by_value.try_emplace({value, sigma}, rows.runs.size()).first->second[i] = {log_a, 0};
      Symmetric& C = rows.laws[i].covariance;
      C.aa -= log_a * log_a;
      if (!rows.a_fixed && !(C.aa > 0 && C.aa * C.bb >= C.ab * C.ab))
        fail(
            "row {}: its sigma_a is smaller than the uncertainty of {} alone makes it: give the -K "
            "and "
            "-R of its fit",
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

void fit_rows(Tool& tool, const Bodies& bodies) {
  FitRows rows = read_rows(tool);
  warn_of_same_rows(tool, rows);
  bodies.give_to(rows.runs);
  std::vector<std::optional<ShiftOf>> of_runs;
  for (Run& run : rows.runs) {
    if (run.shift_of) {
      ShiftOf contact{run.body, run.shift_of->geometry};
      const std::string others = take_contact(tool, *run.shift_of, contact);
      if (!others.empty()) tool.warn(run.name, "the row was fitted with " + others);
      run.body = contact.body;
      run.shift_of = contact;
    }
    of_runs.push_back(run.shift_of);
  }
  const auto common = take_common(rows);
  const JointLaw joint = joint_law(rows.laws, common);
  write_table(tool.out, line_of_fit("fits", {}, of_runs), {row_of(joint, rows.laws.size())});
  const std::string found = disagreement(joint.agreement, rows.runs, tool.checks);
  if (!found.empty()) tool.object("", found);
}

}  // namespace rolling
