// SPDX-License-Identifier: GPL-3.0-or-later
// energy-ledger - append where the energy goes (Eqs. 1 to 23); see energy-ledger(1)
#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/doubts.h"
#include "cli/history.h"
#include "cli/law_file.h"
#include "cli/quantities.h"
#include "cli/tool.h"
#include "contact/ledger.h"
#include "text/row_pipe.h"

using namespace rolling;

namespace {

/// The arguments of a quantity.
struct Moment {
  const Ledger& now;
  const Balance& balance;
  double temperature;
  const LawOfFile& law;
};

constexpr Computed<double (*)(const Moment&)> quantities[] = {
    {"omega", "rad/s", [](const Moment& m) { return m.now.omega(); }},
    {"p", "N s", [](const Moment& m) { return m.now.p(); }},
    {"L", "N m s", [](const Moment& m) { return m.now.L(); }},
    {"A", "", [](const Moment& m) { return m.now.A(); }},
    {"J", "kg m^2", [](const Moment& m) { return m.now.J(); }},
    {"D", "m", [](const Moment& m) { return m.now.D(); }},
    {"sigma_D", "m", [](const Moment& m) { return m.law.sigma(m.now.v()); }},
    {"F_N", "N", [](const Moment& m) { return m.now.F_N(); }},
    {"F_H", "N", [](const Moment& m) { return m.now.F_H(); }},
    {"F_S", "N", [](const Moment& m) { return m.now.F_S(); }},
    {"F_G", "N", [](const Moment& m) { return m.now.F_G(); }},
    {"tau_N", "N m", [](const Moment& m) { return m.now.tau_N(); }},
    {"tau_H", "N m", [](const Moment& m) { return m.now.tau_H(); }},
    {"vP_H", "m/s", [](const Moment& m) { return m.now.vP_H(); }},
    {"vP_V", "m/s", [](const Moment& m) { return m.now.vP_V(); }},
    {"I_pH", "N", [](const Moment& m) { return m.now.I_pH(); }},
    {"I_pN", "N", [](const Moment& m) { return m.now.I_pN(); }},
    {"I_LH", "N m", [](const Moment& m) { return m.now.I_LH(); }},
    {"I_LN", "N m", [](const Moment& m) { return m.now.I_LN(); }},
    {"E_trans", "J", [](const Moment& m) { return m.now.E_trans(); }},
    {"E_rot", "J", [](const Moment& m) { return m.now.E_rot(); }},
    {"E", "J", [](const Moment& m) { return m.now.E(); }},
    {"I_E1", "W", [](const Moment& m) { return m.now.I_E1(); }},
    {"I_E2", "W", [](const Moment& m) { return m.now.I_E2(); }},
    {"P_T1", "W", [](const Moment& m) { return m.now.P_T1(); }},
    {"P_R1", "W", [](const Moment& m) { return m.now.P_R1(); }},
    {"P_R2", "W", [](const Moment& m) { return m.now.P_R2(); }},
    {"P_T2", "W", [](const Moment& m) { return m.now.P_T2(); }},
    {"P_T3", "W", [](const Moment& m) { return m.now.P_T3(); }},
    {"P_T4", "W", [](const Moment& m) { return m.now.P_T4(); }},
    {"P_diss", "W", [](const Moment& m) { return m.now.P_diss(); }},
    {"E_diss", "J", [](const Moment& m) { return m.balance.energy.to_mat(); }},
    {"P_air", "W", [](const Moment& m) { return m.now.P_air(m.law.law.air(m.now.v())); }},
    {"E_air", "J", [](const Moment& m) { return m.balance.to_air(); }},
    {"W_g", "J", [](const Moment& m) { return m.balance.energy.to_gravity(); }},
    {"Pi_S", "W/K", [](const Moment& m) { return m.now.P_diss() / m.temperature; }},
    {"I_S", "W/K", [](const Moment& m) { return m.now.P_diss() / m.temperature; }},
    {"S", "J/K", [](const Moment& m) { return m.balance.energy.to_mat() / m.temperature; }},
    {"E_tr", "J", [](const Moment& m) { return 0 - m.balance.energy.to_mat(); }},
    {"p_tr", "N s", [](const Moment& m) { return 0 - m.balance.p.to_mat(); }},
    {"L_trH", "N m s", [](const Moment& m) { return m.balance.L_H(); }},
    {"L_trN", "N m s", [](const Moment& m) { return m.balance.L_N(); }},
};
constexpr std::string_view of_temperature[] = {"Pi_S", "I_S", "S"};
constexpr std::string_view of_momenta[] = {"p_tr", "L_trH", "L_trN"};

/// What the options and the scene describe.
struct Task {
  std::vector<Computed<double (*)(const Moment&)>> row;  ///< what is appended, without --summary
  double temperature = not_given;
  Body given{};                 ///< the body of the options, without the mass
  std::vector<Body> masses;     ///< one, or one for each run
  std::string list;             ///< the option that has one for each
  std::vector<LawOfFile> laws;  ///< with their bodies; without a law that of the options
  bool uses_law = false;        ///< instead of the column D
  bool law_of_scene = false;    ///< it uses the law because the first run has no column D
  bool summary = false;
  bool momenta = false;          ///< they are balanced too
  double tolerance = not_given;  ///< NaN without --check
  std::size_t t, x, v, D;        ///< slots of the reader
  std::string height;
  std::unique_ptr<const Road> road;

  /// This quantity is appended.
  bool has(std::string_view name) const {
    return std::ranges::any_of(row, [&](const auto& quantity) { return quantity.name == name; });
  }
  /// A mat is inclined.
  bool inclined() const {
    return std::ranges::any_of(
        laws, [](const LawOfFile& law) { return law.body.slope != 0 || law.body.road; });
  }
};

/// The laws that the options tell, each in the wind of its run.
std::vector<LawOfFile> laws_in_wind(Tool& tool, const LawOptions& options, const Body& given,
                                    bool with_errors) {
  std::vector<LawOfFile> laws = read_laws(tool, options, given, with_errors);
  for (LawOfFile& law : laws) {
    check_wind(law.body, law.law);
    law.law = law.law.in_wind(law.body.wind);
  }
  return laws;
}

/// The mass for run i. Throws OptionError if there are fewer than runs.
double mass_of_run(const Task& task, Reader& in, std::size_t i) {
  const std::size_t count = task.masses.size();
  std::size_t runs = count;
  if (count > 1 && i >= count)
    for (runs = i + 1; in.next_run();) ++runs;
  return task.masses[value_of_run(task.list, count, i, runs)].m;
}

/// Objects to a mass that is probably in grams.
void doubt_mass(Tool& tool, const std::string& run, const Body& body) {
  if (is_hardly_so_heavy(body))
    tool.object(run, fmt::format("m = {} kg on a radius of {} m: if that is grams, write {}",
                                 body.m, body.R, body.m / 1000));
}

/// Checks the balance of the run that `in` has read.
void check(Tool& tool, const Reader& in, const Balance& balance, double tolerance) {
  std::string beyond;
  const auto ask = [&](const char* name, double deviation, const std::string& when) {
    if (std::abs(deviation) > tolerance)
      add_item(beyond, fmt::format("{} {:.4g}{}", name, deviation, when));
  };
  ask("closure", balance.energy.closure(), "");
  ask("imbalance", balance.energy.imbalance(),
      fmt::format(" at t = {:.6g} s", balance.energy.time_of_imbalance()));
  if (balance.p.closure_tells()) ask("closure_p", balance.p.closure(), "");
  if (balance.L.closure_tells()) ask("closure_L", balance.L.closure(), "");
  if (beyond.empty()) return;
  std::string line = fmt::format("the check does not hold: {}: beyond {}", beyond, tolerance);
  for (const std::string& filter : windows_of_v(in.history()))
    line += fmt::format("; a window that is too long does this: `{}`", filter);
  tool.object(in.run_name(), line);
}

/// The body of a run whose D is a column: its `##` lines have the geometry. Where they have other
/// numbers than are given, a line says so.
Body body_of_shifts(Tool& tool, const Reader& in, Body body) {
  std::string others = other_body(history_of(in.history(), {}).shift_of, body);
  if (const auto exact = shifts_are_exact(in.history()))
    take_geometry(tool, *exact, body.exact, others);
  if (!others.empty()) tool.warn(in.run_name(), "D was computed with " + others);
  return body;
}

/// The header of --summary.
void write_names(Output& out, const Reader& in, bool inclined) {
  std::vector<Column> columns = {{"E_start", "J"}, {"E_end", "J"},    {"E_diss", "J"},
                                 {"closure", ""},  {"imbalance", ""}, {"closure_p", ""},
                                 {"closure_L", ""}};
  if (inclined) columns.push_back({"W_g", "J"});
  if (out.plain) out.run_among(in.comments());
  out.names(columns);
}

/// The row of --summary for a run, with a blank cell for a closure that it does not have.
void write_row(Output& out, const Reader& in, const Balance& balance, bool inclined) {
  const Account& energy = balance.energy;
  if (out.plain) out.run_among(in.comments());
  for (const double cell : {energy.start(), energy.end(), energy.to_mat(), energy.closure(),
                            energy.imbalance(), balance.p.closure(), balance.L.closure()}) {
    if (std::isnan(cell)) out.cell("");
    else out.cell(cell);
  }
  if (inclined) out.cell(energy.to_gravity());
  out.end_line();
}

/// Balances the runs. The numbers of each row go into the pipe behind the reader; without one, the
/// row of --summary is written for each run. Returns the exit status: 2 if a closure is asked for
/// and a run has none.
int balance_runs(Tool& tool, Reader& in, const Task& task, RowPipe* pipe) {
  std::size_t runs = 0;
  std::size_t beyond = 0;
  bool tests_nothing = false;
  bool without_closure = false;
  while (pipe ? pipe->next_run() : in.next_run()) {
    const std::string run = in.run_name();
    tool.know_run(run);
    if (task.law_of_scene && in.find("D"))
      fail<InputError>(
          "run {} has a column D, and the runs before it have none: choose the law by -a and -b, "
          "or give the runs one by one",
          run);
    const LawOfFile& law = law_of(task.laws, run);
    Body body = task.uses_law ? law.body : body_of_shifts(tool, in, law.body);
    body.m = mass_of_run(task, in, runs++);
    doubt_mass(tool, run, body);
    if (!task.uses_law) tests_nothing |= shifts_of_speeds(in.history());
    if (pipe)
      pipe->set_history("energy-ledger " + (task.uses_law ? words_of(law.law) : "D") +
                        words_of(law.body, task.height));
    Balance balance(body, task.momenta);
    double first_height = 0;
    while (pipe ? pipe->next() : in.next()) {
      const double v = in[task.v];
      if (task.uses_law) law.law.check_speed(v);
      const double D = task.uses_law ? law.law(v) : in[task.D];
      const Ledger now(body, v, D, incline(body, in[task.x], v));
      if (body.road) {
        const double height = body.road->at(in[task.x]).h;
        if (balance.energy.empty()) first_height = height;
        balance.energy.set_lifted(now.F_G() * (height - first_height));
      }
      balance.push(in[task.t], now);
      if (law.law.has_drag()) balance.push_air(in[task.t], now.P_air(law.law.air(v)));
      beyond += std::abs(D) > body.R;
      for (const auto& quantity : task.row)
        pipe->put(quantity.of({now, balance, task.temperature, law}));
    }
    if (balance.energy.empty()) continue;
    if (!pipe) write_row(tool.out, in, balance, task.inclined());
    if ((task.summary || tool.checks) && std::isnan(balance.energy.closure())) {
      tool.say(in.run_name(),
               "the body has as much energy at the end of the run as at its start: there is no "
               "closure; choose the free roll: smooth --coast");
      without_closure = true;
    }
    if (tool.checks) check(tool, in, balance, task.tolerance);
  }
  value_of_run(task.list, task.masses.size(), 0, runs);
  if (beyond > 0)
    tool.warn(fmt::format("D is beyond the radius in {}{}", counted(beyond, "row"),
                          task.uses_law ? ": the law gives metres" : ""));
  if (tests_nothing && (task.summary || tool.checks))
    tool.warn(
        "D was computed from the derivative of the same v: the balance compares v with itself "
        "and tests no law; give one with --law, or with -a and -b");
  return without_closure ? 2 : 0;
}

/// The columns that the options ask for.
void choose_columns(Tool& tool, Task& task, const std::string& columns) {
  if (task.summary)
    return tool.refuse({"columns"}, "does not go with --summary, which has its own columns");
  task.row = chosen(columns, quantities);
  const auto is_chosen = [&](std::string_view name) { return task.has(name); };
  if (const auto name = std::ranges::find_if(of_temperature, is_chosen);
      name != std::end(of_temperature) && std::isnan(task.temperature))
    fail("{} needs --temperature", *name);
}

/// The law, its body and the road of the options and the scene, and the columns that are read.
Reader& read_task(Tool& tool, Task& task, const LawOptions& law) {
  Body& body = task.given;
  // A ledger uses no uncertainties: shifts of a body with the same values are of this body.
  for (const NumberOfBody& number : uncertain_numbers) body.*number.sigma = 0;
  task.road = read_road(tool, task.height);
  body.road = task.road.get();
  const bool with_errors = task.has("sigma_D");
  if (with_errors && law.file.empty())
    fail("sigma_D is that of a law: it needs --law and a row of fitpower");
  // A law on the command line takes precedence over a column D, the law of a scene does not.
  task.uses_law =
      !law.file.empty() || tool.on_command_line("coefficient") || tool.on_command_line("exponent");
  if (task.uses_law) task.laws = laws_in_wind(tool, law, task.given, with_errors);
  Reader& in = tool.read({"t", "v", "D"});
  task.law_of_scene = !task.uses_law && !std::isnan(law.power.a) && !in.find("D");
  if (task.law_of_scene) task.laws = laws_in_wind(tool, law, task.given, with_errors);
  task.uses_law |= task.law_of_scene;
  if (!task.uses_law) {
    tool.refuse({"wind"}, "goes with a law");
    tool.need({"radius", "shape-factor"});
    if (!in.find("D")) fail("neither a law (--law, or -a and -b) nor a column D (--use D=COLUMN)");
    task.laws = {{.body = task.given}};
  }
  task.t = in.need("t");
  task.v = in.need("v");
  task.x = body.road ? in.need("x") : task.v;
  task.D = task.uses_law ? task.v : in.need("D");
  return in;
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("energy-ledger", "Append the energies and the flows of energy of a rolling body.");
  Task task;
  LawOptions law;
  std::string columns = "E_trans,E_rot,I_E1,I_E2,P_T1,P_R1,P_R2,P_T2,P_diss,E_diss";
  tool.bodies(task.masses, task.list, {&Body::m});
  tool.body(task.given, {&Body::R, &Body::K, &Body::g, &Body::slope, &Body::wind});
  add_height(tool, task.height);
  add_options(tool, law);
  tool.geometry(task.given.exact);
  tool.text("--columns", columns, "NAME,...",
            "append these quantities of the paper (energies and flows of energy)");
  tool.number("--temperature", task.temperature, positive, "temperature of the mat [K], for Pi_S");
  tool.flag("--summary", task.summary,
            "print one row for each run: energy at the start and end, energy dissipated, closure "
            "and imbalance");
  tool.add("--check", "NUMBER",
           "exit with 1 if |closure| or the imbalance is above this share (5 % is 0.05)",
           [&](const std::string& share) {
    const Domain domain{"from 0 to 1", [](double x) { return x >= 0 && x <= 1; }};
    task.tolerance = to_number(share, domain);
    tool.checks = true;
  });
  tool.accept();
  tool.scene();
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    if (!tool.checks) tool.refuse({"accept"}, "goes with --check");
    choose_columns(tool, task, columns);
    if (task.temperature < 150)
      tool.warn(fmt::format("--temperature {} K: if that is degrees Celsius, write {}",
                            task.temperature, task.temperature + 273.15));
    tool.need({"mass"});
    Reader& in = read_task(tool, task, law);
    const auto is_chosen = [&](std::string_view name) { return task.has(name); };
    task.momenta = task.summary || tool.checks || std::ranges::any_of(of_momenta, is_chosen);
    if (task.summary) {
      write_names(tool.out, in, task.inclined());
      return balance_runs(tool, in, task, nullptr);
    }
    RowPipe pipe(in, tool.out, "");
    for (const auto& quantity : task.row) pipe.append(quantity.column());
    return balance_runs(tool, in, task, &pipe);
  });
}
