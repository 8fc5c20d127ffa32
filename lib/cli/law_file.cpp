// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/law_file.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/enumeration.h"
#include "base/error.h"

namespace rolling {
namespace {

/// A formula without what a person may write or leave out. Coast-down tests call d0, d1 and d2 f0,
/// f1 and f2.
std::string bare(std::string formula) {
  std::erase_if(formula, [](char c) { return c == ' ' || c == '*'; });
  std::ranges::replace(formula, 'n', 'b');
  std::ranges::replace(formula, 'f', 'd');
  return formula;
}

/// True for a column that a person reads as the coefficient of a law: one of the table, or d3. A p
/// beside chi2 is a probability.
bool is_coefficient(const Reader& in, const std::string& name) {
  if (name == "p" && in.find("chi2")) return false;
  if (name.starts_with('d') && is_whole(std::string_view(name).substr(1))) return true;
  return std::ranges::any_of(laws(), [&](const LawForm& form) {
    return std::ranges::any_of(form.coefficients, [&](const auto& c) { return name == c.name; });
  });
}

/// The law whose coefficients are those of the file, no more and no less; none for a table of v and
/// D. Throws InputError for coefficients that no law has together.
const LawForm* law_of_columns(const Reader& in, const std::string& file) {
  std::set<std::string> written;
  for (const Column& column : in.columns())
    if (is_coefficient(in, column.name)) written.insert(column.name);
  for (const LawForm& form : laws()) {
    std::set<std::string> names;
    for (const LawForm::Coefficient& c : form.coefficients) names.insert(c.name);
    if (names == written) return &form;
  }
  const bool is_row = written.contains("a") || written.contains("d0");
  if (is_row && !(in.find("v") && in.find("D")))
    fail<InputError>("{}: no law has these coefficients and no others: {}", shown(file),
                     enumeration({written.begin(), written.end()}));
  return nullptr;
}

/// The row of fitpower in a file.
LawOfFile read_row(Tool& tool, Reader& in, const LawForm& form, const PowerLaw& given,
                   std::vector<RowNumber> numbers, bool with_errors) {
  const bool power = &form == &laws().front();
  if (!power)
    tool.refuse({"coefficient", "exponent"}, fmt::format("does not go with D = {}", form.formula));
  if (with_errors)
    tool.refuse({"coefficient", "exponent"}, "does not go with the uncertainties of a row");
  const bool replaced = tool.on_command_line("coefficient") || tool.on_command_line("exponent");
  if (replaced) tool.need({"coefficient", "exponent"});
  std::erase_if(numbers, [&](const RowNumber& number) {
    return !in.find(number.name) || tool.on_command_line(number.name);
  });
  std::vector<std::size_t> columns, coefficients, sigmas, correlations;  // slots
  for (const RowNumber& number : numbers)
    columns.push_back(in.need_as_is(number.name, number.unit));
  for (const Column& c : columns_of(form)) {
    coefficients.push_back(in.need_as_is(c.name, c.unit));
    if (with_errors) sigmas.push_back(in.need_as_is("sigma_" + c.name, c.unit));
  }
  if (with_errors)
    for (const std::string& name : correlations_of(form))
      correlations.push_back(in.need_as_is(name));
  if (!in.next_run() || !in.next()) fail<InputError>("{}: no row of fitpower", in.where());
  for (std::size_t i = 0; i < numbers.size(); ++i) *numbers[i].value = in[columns[i]];
  std::vector<double> written;
  for (const std::size_t coefficient : coefficients) written.push_back(in[coefficient]);
  LawOfFile row{};
  for (std::size_t j = 0; j < sigmas.size(); ++j) {
    row.coefficients.push_back({written[j], in[sigmas[j]]});
    row.correlations.emplace_back();
    for (std::size_t i = 0; i < j; ++i)
      row.correlations[j].push_back(in[correlations[j * (j - 1) / 2 + i]]);
  }
  if (power && !replaced && !(written[0] > 0)) fail("a = {} must be greater than 0", written[0]);
  if (replaced && numbers.empty())
    fail<OptionError>("--law tells nothing that is not on the command line: leave it out");
  if (in.next() || in.next_run()) fail("more than one row: a law is one row of fitpower");
  if (replaced) written = {given.a, given.b};
  row.law = Law::as_written(form, written);
  return row;
}

}  // namespace

const LawForm& law_named(const std::string& formula) {
  std::string known;
  for (const LawForm& form : laws()) {
    if (bare(form.formula) == bare(formula)) return form;
    add_item(known, form.formula);
  }
  fail("'{}' is none of {}", shown(formula), known);
}

std::vector<Column> columns_of(const LawForm& form) {
  std::vector<Column> all;
  for (const LawForm::Coefficient& c : form.coefficients) {
    std::string above;
    std::string below;
    for (const auto& [unit, power] : {std::pair("m", c.D + c.v), {"s", -c.v}}) {
      if (power == 0) continue;
      std::string& side = power > 0 ? above : below;
      side += std::abs(power) == 1 ? unit : fmt::format("{}^{}", unit, std::abs(power));
    }
    all.push_back({c.name, above + (below.empty() ? "" : "/" + below)});
  }
  return all;
}

std::vector<std::string> correlations_of(const LawForm& form) {
  if (&form == &laws().front()) return {"corr"};
  std::vector<std::string> all;
  for (std::size_t j = 1; j < form.coefficients.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      all.push_back(
          fmt::format("corr_{}_{}", form.coefficients[i].name, form.coefficients[j].name));
  return all;
}

std::string words_of(const Law& law) {
  if (law.has_points()) return "table";
  std::string words;
  for (std::size_t j = 0; j < law.size(); ++j) {
    std::array<double, LawForm::most> unused;
    words += fmt::format("{}{} {}", j == 0 ? "" : " ", law.form().coefficients[j].name,
                         law.in_SI(j, unused));
  }
  return words;
}

void add_options(Tool& tool, LawOptions& law) {
  tool.number("-a,--coefficient", law.power.a, positive,
              "coefficient a of the law D = a v^b [m (s/m)^b]");
  tool.number("-b,--exponent", law.power.b, any_number, "exponent b of the law");
  tool.text("--law", law.file, "FILE",
            "file (- is standard input) with the law: a row of fitpower or a table of v D");
}

LawOfFile read_law(Tool& tool, const LawOptions& options, const std::vector<RowNumber>& numbers,
                   bool with_errors) {
  const std::string& file = options.file;
  if (file.empty()) {
    tool.need({"coefficient", "exponent"});
    return {options.power};
  }
  Reader& in = tool.read_file(file, {"v", "D"});
  if (const LawForm* form = law_of_columns(in, file))
    return read_row(tool, in, *form, options.power, numbers, with_errors);
  tool.refuse({"coefficient", "exponent"}, "does not go with a table of v D");
  if (!in.find("v") || !in.find("D"))
    fail<InputError>("{}: neither a table of v and D nor a row of fitpower", shown(file));
  if (with_errors)
    fail("{}: a table of v and D has no uncertainties: give a row of fitpower", shown(file));
  const auto v = in.need("v");
  const auto D = in.need("D");
  std::vector<double> speeds;
  std::vector<double> shifts;
  while (in.next_run())
    while (in.next()) {
      speeds.push_back(in[v]);
      shifts.push_back(in[D]);
    }
  try {
    return {TableLaw(std::move(speeds), std::move(shifts))};
  } catch (const Error& error) {
    fail<InputError>("{}: {}", file, error.what());
  }
}

double LawOfFile::sigma(double v) const {
  if (coefficients.empty()) return not_given;
  std::vector<double> part;  // what each coefficient brings
  double variance = 0;
  for (std::size_t j = 0; j < coefficients.size(); ++j) {
    // a central difference, since the law is known by its formula's coefficients alone
    constexpr double step = 1e-3;
    const auto moved = [&](double by) {
      std::vector<double> written;
      for (const Estimate& c : coefficients) written.push_back(c.value);
      written[j] += by * coefficients[j].sigma;
      return Law::as_written(law.form(), written)(v);
    };
    part.push_back((moved(step) - moved(-step)) / (2 * step));
    variance += part[j] * part[j];
    for (std::size_t i = 0; i < j; ++i) variance += 2 * correlations[j][i] * part[i] * part[j];
  }
  return std::sqrt(std::max(variance, 0.0));
}

}  // namespace rolling
