// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/law_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/ranges.h>
#include <iterator>
#include <set>
#include <utility>

#include "base/enumeration.h"
#include "base/error.h"
#include "base/version.h"
#include "cli/history.h"

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

/// The law whose coefficients are those of the file, no more and no less. Throws InputError if
/// there is none.
const LawForm& law_of_columns(const Reader& in, const std::string& file) {
  std::set<std::string> written;
  for (const Column& column : in.columns())
    if (is_coefficient(in, column.name)) written.insert(column.name);
  for (const LawForm& form : laws()) {
    std::set<std::string> names;
    for (const LawForm::Coefficient& c : form.coefficients) names.insert(c.name);
    if (names == written) return form;
  }
  if (!written.contains("a") && !written.contains("d0"))
    fail<InputError>("{}: neither a table of v and D nor a row of fitpower", shown(file));
  fail<InputError>("{}: no law has these coefficients and no others: {}", shown(file),
                   enumeration({written.begin(), written.end()}));
}

/// A number of its roll that a row may have.
struct RollNumber {
  const char* name;
  const char* unit;
  double LawOfFile::*value;
};
constexpr RollNumber roll_numbers[] = {{"slope", "", &LawOfFile::slope},
                                       {"wind", "m/s", &LawOfFile::wind},
                                       {"steepness", "", &LawOfFile::steepness},
                                       {"v0", "m/s", &LawOfFile::v0},
                                       {"x0", "m", &LawOfFile::x0},
                                       {"t0", "s", &LawOfFile::t0}};

/// The rows of fitpower in a file, with their bodies.
std::vector<LawOfFile> read_rows(Tool& tool, Reader& in, const std::string& file, const Body& given,
                                 bool with_errors) {
  const LawForm& form = law_of_columns(in, file);
  std::set<std::string> runs;
  auto all = rows_of_fit(in, form, with_errors, [&](const LawOfFile& row) {
    if (&law_of_columns(in, file) != &form)
      fail<InputError>("{}: rows of several laws: give those of one", shown(file));
    if (!runs.insert(row.run).second)
      fail<InputError>(
          "{}: more than one row{}: give one row, or rows of fitpower --each, with a column run",
          shown(file), row.run.empty() ? "" : fmt::format(" of run '{}'", shown(row.run)));
  });
  if (all.empty()) fail<InputError>("{}: no row of fitpower", shown(file));
  for (LawOfFile& row : all) {
    row.body = given;
    if (row.fitted_with)
      take_body(tool, row.run, "the law was fitted with {}", *row.fitted_with, row.body);
    // The slope and the wind of a row are fitted: they take precedence over those of a scene.
    Body& body = row.body;
    if (!std::isnan(row.slope) && !tool.on_command_line("slope")) body.slope = row.slope;
    if (!std::isnan(row.wind) && !tool.on_command_line("wind")) body.wind = row.wind;
    if (!std::isnan(row.steepness)) body.steepness = row.steepness;
  }
  return all;
}

/// What two columns of a file make.
template <typename Table>
Table read_table(Reader& in, const std::string& file, std::size_t x, std::size_t y) {
  std::vector<double> all_x;
  std::vector<double> all_y;
  while (in.next_run())
    while (in.next()) {
      all_x.push_back(in[x]);
      all_y.push_back(in[y]);
    }
  return located([&] { return file; }, [&] { return Table(std::move(all_x), std::move(all_y)); });
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
    if (!below.empty()) above += fmt::format("/{}", below);
    all.push_back({c.name, above});
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

std::string words_of(const Body& body, const std::string& height) {
  std::string words;
  if (body.slope != 0) words += fmt::format(" slope {}", body.slope);
  if (body.wind != 0) words += fmt::format(" wind {}", body.wind);
  if (!height.empty()) words += " height " + std::string(shown(height));
  if (body.steepness != 1) words += fmt::format(" steepness {}", body.steepness);
  return words;
}

std::string line_of_fit(const std::string& route, const FitOptions& options,
                        const std::vector<std::optional<Body>>& of_runs) {
  const LawForm& law = *options.law;
  std::string line = fmt::format("fitpower {} {}", version(), route);
  if (!options.fits_power()) line += ' ' + replace_all(law.formula, {{" + ", "+"}, {" ", "*"}});
  const auto known = [&](const std::optional<Body>& of) {
    return of && of->exact == of_runs.front()->exact;
  };
  if (!std::ranges::all_of(of_runs, known)) return line;
  for (const NumberOfBody& number : numbers_of_body) {
    if (number.value == &Body::wind && law.drag < 0) continue;
    std::vector<std::string> texts;
    for (const auto& of : of_runs) texts.push_back(to_text(number.of(*of)));
    if (std::ranges::count(texts, texts.front()) == std::ssize(texts)) texts.resize(1);
    for (const SceneNumber& fitted : scene_numbers)
      if (fitted.value == number.value && options.*fitted.is_fitted) texts = {"fit"};
    line += fmt::format(" {} {}", number.name, fmt::join(texts, ","));
  }
  if (of_runs.front()->exact) line += " exact";
  return line;
}

void add_options(Tool& tool, LawOptions& law) {
  tool.number("-a,--coefficient", law.power.a, positive,
              "coefficient a of the law D = a v^b: D at 1 m/s [m]");
  tool.number("-b,--exponent", law.power.b, any_number, "exponent b of the law");
  tool.text("--law", law.file, "FILE",
            "file (- is standard input) with the law: a row of fitpower or a table of v and D");
}

void check_wind(const Body& body, const Law& law) {
  if (body.wind != 0 && !law.has_drag())
    fail<OptionError>("--wind acts on a term d2 v^2, which this law does not have");
}

void add_height(Tool& tool, std::string& file) {
  tool.text("--height", file, "FILE",
            "table of x and h: the height of the track along the way x of the body's centre");
}

std::unique_ptr<const Road> read_road(Tool& tool, const std::string& file, bool fit_slope) {
  if (file.empty()) return {};
  if (!fit_slope) tool.refuse({"slope"}, "does not go with --height, which has the slope");
  Reader& in = tool.read_file(file, {"x", "h"});
  const auto x = in.need("x");
  const auto h = in.need_as_is("h", "m");
  return std::make_unique<const Road>(read_table<Road>(in, file, x, h));
}

std::vector<LawOfFile> rows_of_fit(Reader& in, const LawForm& form, bool with_errors,
                                   const std::function<void(const LawOfFile&)>& of_row) {
  std::vector<std::pair<std::size_t, double LawOfFile::*>> roll;  // with their slots
  std::vector<std::size_t> coefficients;                          // slots, as these
  std::vector<std::size_t> sigmas;
  std::vector<std::size_t> correlations;
  for (const RollNumber& number : roll_numbers)
    if (in.find(number.name))
      roll.emplace_back(in.need_as_is(number.name, number.unit), number.value);
  for (const Column& c : columns_of(form)) {
    coefficients.push_back(in.need_as_is(c.name, c.unit));
    if (with_errors) sigmas.push_back(in.need_as_is("sigma_" + c.name, c.unit));
  }
  if (with_errors)
    for (const std::string& name : correlations_of(form))
      correlations.push_back(in.need_as_is(name));

  std::vector<LawOfFile> all;
  while (in.next_run()) {
    // Rows without numbers, of runs that were not fitted, have a place in the `##` line too, and
    // the reader leaves them out.
    const std::size_t left_out = in.left_out();
    const std::size_t first = all.size();
    std::vector<std::size_t> places;
    while (in.next()) {
      places.push_back(places.size() + in.left_out() - left_out);
      LawOfFile& row = all.emplace_back();
      std::vector<double> written;
      for (const std::size_t slot : coefficients) {
        written.push_back(in[slot]);
        row.coefficients.push_back({in[slot]});
      }
      row.law = Law(form, written);
      if (const auto law = row.law.power(); law && !(law->a > 0))
        fail("a = {} must be greater than 0", law->a);
      if (const auto run = in.find("run")) row.run = in.text(*run);
      for (const auto& [slot, number] : roll) row.*number = in[slot];
      for (std::size_t j = 0; j < sigmas.size(); ++j) {
        row.coefficients[j].sigma = in[sigmas[j]];
        row.correlations.emplace_back();
        for (std::size_t i = 0; i < j; ++i)
          row.correlations[j].push_back(in[correlations[j * (j - 1) / 2 + i]]);
      }
      of_row(row);
    }
    const auto bodies = bodies_of_rows(in.history(), places.size() + in.left_out() - left_out);
    for (std::size_t i = 0; i < places.size() && !bodies.empty(); ++i)
      all[first + i].fitted_with = bodies[places[i]];
  }
  return all;
}

std::vector<LawOfFile> read_laws(Tool& tool, const LawOptions& options, const Body& given,
                                 bool with_errors) {
  const std::string& file = options.file;
  if (file.empty()) {
    tool.need({"coefficient", "exponent", "radius", "shape-factor"});
    return {{.law = options.power, .body = given}};
  }
  const bool replaced = tool.on_command_line("coefficient") || tool.on_command_line("exponent");
  if (with_errors)
    tool.refuse({"coefficient", "exponent"}, "does not go with the uncertainties of a row");
  Reader& in = tool.read_file(file, {"v", "D"});
  const bool is_table = in.find("v") && in.find("D");
  if (is_table) tool.refuse({"coefficient", "exponent"}, "does not go with a table of v D");
  if (is_table && with_errors)
    fail("{}: a table of v and D has no uncertainties: give a row of fitpower", shown(file));
  if (replaced) tool.need({"coefficient", "exponent"});
  std::vector<LawOfFile> laws;
  if (is_table) {
    const auto v = in.need("v");
    laws.push_back({.law = read_table<TableLaw>(in, file, v, in.need("D")), .body = given});
  } else laws = read_rows(tool, in, file, given, with_errors);
  const auto adds = [&](const LawOfFile& law) {
    return std::ranges::any_of(roll_numbers, [&](const RollNumber& number) {
      return !std::isnan(law.*number.value) && tool.has(number.name) &&
             !tool.on_command_line(number.name);
    });
  };
  if (replaced && in.history().empty() && std::ranges::none_of(laws, adds))
    fail<OptionError>("--law adds nothing to the command line: leave it out");
  const auto of_several = [](const std::string& line) {
    return line.starts_with("fitpower ") && line.find(',') != std::string::npos;
  };
  for (LawOfFile& law : laws) {
    if (replaced) law.law = options.power;
    if (!std::isnan(law.body.K) && !std::isnan(law.body.R)) continue;
    if (std::ranges::any_of(in.history(), of_several))
      fail<OptionError>("{}: the row has several K or R: give -K and -R", shown(file));
    tool.need({"radius", "shape-factor"});
  }
  return laws;
}

const LawOfFile& law_of(const std::vector<LawOfFile>& laws, const std::string& run) {
  if (laws.size() == 1) return laws.front();
  std::string runs;
  for (const LawOfFile& law : laws) {
    if (law.run == run) return law;
    add_item(runs, law.run);
  }
  fail<InputError>(
      "the file of laws has no row of run '{}' (runs: {}); a file of one row is for all runs",
      shown(run), shown(runs));
}

void take_body(Tool& tool, const std::string& run, const char* warning, const Body& of,
               Body& body) {
  Body given = body;
  for (const NumberOfBody& number : uncertain_numbers) {
    if (tool.given(number.value)) continue;
    given.*number.value = not_given;
    if (std::isnan(of.*number.value)) continue;
    body.*number.value = of.*number.value;
    body.*number.sigma = of.*number.sigma;
  }
  const bool gives_wind = tool.has("wind") && tool.given("wind");
  if (!gives_wind && !std::isnan(of.wind)) body.wind = of.wind;
  std::string others = other_body(of, given);
  take_geometry(tool, of.exact, body.exact, others);
  if (!others.empty()) tool.warn(run, fmt::format(fmt::runtime(warning), others));
}

void take_geometry(const Tool& tool, bool other, bool& exact, std::string& others) {
  if (!tool.given("exact")) exact = other;
  else if (exact != other)
    add_item(others, other ? "--exact (here A = 1)" : "A = 1 (here --exact)");
}

double LawOfFile::sigma(std::span<const double> by_c) const {
  if (correlations.empty()) return not_given;
  std::vector<double> part;  // what each coefficient of the formula brings
  double variance = 0;
  for (std::size_t j = 0; j < correlations.size(); ++j) {
    part.push_back(by_c[j] * coefficients[j].sigma);
    variance += part[j] * part[j];
    for (std::size_t i = 0; i < j; ++i) variance += 2 * correlations[j][i] * part[i] * part[j];
  }
  return std::sqrt(std::max(variance, 0.0));
}

double LawOfFile::sigma(double v) const {
  std::array<double, LawForm::most> by_c{};
  const double against = v < 0 ? -law.wind() : law.wind();
  if (v != 0) law.in_wind(against).at(std::abs(v), by_c.data());
  return sigma(by_c);
}

}  // namespace rolling
