// SPDX-License-Identifier: GPL-3.0-or-later
// energy-ledger - append where the energy goes (Eqs. 1 to 23); see energy-ledger(1)
#include <algorithm>
#include <cmath>

#include "cli/history.h"
#include "cli/law_file.h"
#include "cli/quantities.h"
#include "cli/tool.h"
#include "contact/ledger.h"
#include "text/filter.h"

using namespace rolling;

namespace {

/// The arguments of a quantity.
struct Moment {
  const Ledger& now;
  const Balance& balance;
  double temperature;
  const LawOfFile& law;
};

constexpr Quantity<double (*)(const Moment&)> quantities[] = {
    {"omega", "rad/s", [](const Moment& m) { return m.now.omega(); }},
    {"p", "N s", [](const Moment& m) { return m.now.p(); }},
    {"L", "N m s", [](const Moment& m) { return m.now.L(); }},
    {"A", "", [](const Moment& m) { return m.now.A(); }},
    {"D", "m", [](const Moment& m) { return m.now.D(); }},
    {"sigma_D", "m", [](const Moment& m) { return m.law.sigma(m.now.v()); }},
    {"F_N", "N", [](const Moment& m) { return m.now.F_N(); }},
    {"F_H", "N", [](const Moment& m) { return m.now.F_H(); }},
    {"tau_N", "N m", [](const Moment& m) { return m.now.tau_N(); }},
    {"tau_H", "N m", [](const Moment& m) { return m.now.tau_H(); }},
    {"vP_H", "m/s", [](const Moment& m) { return m.now.vP_H(); }},
    {"vP_V", "m/s", [](const Moment& m) { return m.now.vP_V(); }},
    {"E_trans", "J", [](const Moment& m) { return m.now.E_trans(); }},
    {"E_rot", "J", [](const Moment& m) { return m.now.E_rot(); }},
    {"I_E1", "W", [](const Moment& m) { return m.now.I_E1(); }},
    {"I_E2", "W", [](const Moment& m) { return m.now.I_E2(); }},
    {"P_T1", "W", [](const Moment& m) { return m.now.P_T1(); }},
    {"P_R1", "W", [](const Moment& m) { return m.now.P_R1(); }},
    {"P_R2", "W", [](const Moment& m) { return m.now.P_R2(); }},
    {"P_T2", "W", [](const Moment& m) { return m.now.P_T2(); }},
    {"P_T3", "W", [](const Moment& m) { return m.now.P_T3(); }},
    {"P_T4", "W", [](const Moment& m) { return m.now.P_T4(); }},
    {"P_diss", "W", [](const Moment& m) { return m.now.P_diss(); }},
    {"E_diss", "J", [](const Moment& m) { return m.balance.dissipated(); }},
    {"W_g", "J", [](const Moment& m) { return m.balance.lifted(); }},
    {"Pi_S", "W/K", [](const Moment& m) { return m.now.P_diss() / m.temperature; }},
};

/// What the options and the scene describe.
struct Task {
  Body body{};
  Geometry geometry{};
  LawOfFile law = {};
  bool uses_law = false;      ///< instead of the column D
  bool law_of_scene = false;  ///< it uses the law because the first run has no column D
  bool summary = false;
  double tolerance = not_given;  ///< NaN without --check
};

/// The energy balances of the runs, and the warnings after the last one.
class Accounts {
 public:
  Accounts(Tool& tool, Reader& in, const Task& task)
      : tool_(tool), in_(in), task_(task), t_(in.need_time()), v_(in.need("v")),
        D_(task.uses_law ? v_ : in.need("D")) {}

  /// Begins the balance of a run.
  Balance open() {
    if (task_.law_of_scene && in_.find("D"))
      fail<InputError>(
          "run {} has a column D, and the runs before it have none: choose the law by -a and -b, "
          "or give the runs one by one",
          in_.run_name());
    const bool shows_balance = task_.summary || !std::isnan(task_.tolerance);
    tests_nothing_ |= shows_balance && !task_.uses_law && shifts_of_speeds(in_.history());
    const auto shift_of = history_of(in_.history(), {}).shift_of;
    if (const auto others = other_body(shift_of, task_.body); !task_.uses_law && !others.empty())
      tool_.warn(in_.run_name(), "D was computed with " + others);
    return Balance(task_.body);
  }

  /// Adds the present row to the balance of its run.
  Ledger enter(Balance& balance) {
    const double v = in_[v_];
    if (task_.uses_law) task_.law.law.check_speed(v);
    const double D = task_.uses_law ? task_.law.law(v) : in_[D_];
    const Ledger now(task_.body, task_.geometry, v, D);
    balance.push(in_[t_], now);
    beyond_ += std::abs(D) > task_.body.R;
    return now;
  }

  /// Checks the balance at the end of a run.
  void close(const Balance& balance) {
    const double tolerance = task_.tolerance;
    if (std::isnan(tolerance) || balance.empty()) return;
    std::string beyond;
    if (!(std::abs(balance.closure()) <= tolerance))
      beyond = fmt::format("closure {:.4g}", balance.closure());
    if (!(balance.imbalance() <= tolerance))
      add_item(beyond, fmt::format("imbalance {:.4g} at t = {:.6g} s", balance.imbalance(),
                                   balance.time_of_imbalance()));
    if (!beyond.empty())
      tool_.object(in_.run_name(),
                   fmt::format("the check does not hold: {}: beyond {}", beyond, tolerance));
  }

  /// Prints the warnings about all runs.
  void finish() const {
    if (beyond_ > 0)
      tool_.warn(fmt::format("{} shift{} beyond the radius {} m", beyond_,
                             beyond_ == 1 ? " is" : "s are", task_.body.R));
    if (tests_nothing_)
      tool_.warn(
          "D was computed from the derivative of the same v: the balance compares v with itself "
          "and tests no law; give one with --law, or with -a and -b");
  }

 private:
  Tool& tool_;
  Reader& in_;
  const Task& task_;
  std::size_t t_, v_, D_, beyond_ = 0;
  bool tests_nothing_ = false;
};

/// Writes the table of --summary: a row for each run.
void write_summary(Output& out, Reader& in, Accounts& accounts, const Task& task) {
  const bool inclined = task.body.slope != 0;
  std::vector<Column> columns = {
      {"E_start", "J"}, {"E_end", "J"}, {"E_diss", "J"}, {"closure", ""}, {"imbalance", ""}};
  if (inclined) columns.push_back({"W_g", "J"});
  out.names(columns);
  while (in.next_run()) {
    Balance balance = accounts.open();
    while (in.next()) accounts.enter(balance);
    if (balance.empty()) continue;
    for (const double cell : {balance.start(), balance.end(), balance.dissipated(),
                              balance.closure(), balance.imbalance()})
      out.cell(cell);
    if (inclined) out.cell(balance.lifted());
    out.end_line();
    accounts.close(balance);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("energy-ledger", "Append the energies and the flows of energy of a rolling body.");
  Task task;
  LawOptions law;
  double temperature = not_given;
  std::string columns = "E_trans,E_rot,I_E1,I_E2,P_T1,P_R1,P_R2,P_T2,P_diss,E_diss";
  tool.body(task.body, {&Body::m, &Body::R, &Body::K, &Body::g, &Body::slope});
  add_options(tool, law);
  tool.geometry(task.geometry);
  tool.text("--columns", columns, "NAME,...",
            "what to append: any quantities of the paper (energies and flows of energy)");
  tool.number("--temperature", temperature, positive, "of the mat [K], for Pi_S");
  tool.flag("--summary", task.summary,
            "print only a row for each run: energies at the start, at the end, dissipated; closure "
            "and imbalance");
  tool.number("--check", task.tolerance, not_negative,
              "exit with 1 when |closure| or the imbalance is above this");
  tool.scene();
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    tool.checks = !std::isnan(task.tolerance);
    if (task.summary)
      tool.refuse({"columns"}, "does not go with --summary, which has its own columns");
    const auto row = chosen(columns, quantities);
    const auto is_chosen = [&](std::string_view name) {
      return std::ranges::count(row, name, [](const auto& quantity) { return quantity.name; }) > 0;
    };
    if (is_chosen("Pi_S") && std::isnan(temperature)) fail("Pi_S needs --temperature");
    if (is_chosen("sigma_D") && law.file.empty())
      fail("sigma_D is that of a law: it needs --law and a row of fitpower");
    tool.need({"mass", "radius", "shape-factor"});
    // A law on the command line takes precedence over a column D, the law of a scene does not.
    task.uses_law = !law.file.empty() || tool.on_command_line("coefficient") ||
                    tool.on_command_line("exponent");
    const auto read = [&] {
      return read_law(tool, law, {{"slope", "", &task.body.slope}},
                      is_chosen("sigma_D") ? Uncertainties::needed : Uncertainties::ignored);
    };
    if (task.uses_law) task.law = read();
    Reader& in = tool.read({"t", "v", "D"});
    task.law_of_scene = !task.uses_law && !std::isnan(law.power.a) && !in.find("D");
    if (task.law_of_scene) task.uses_law = true, task.law = read();
    Accounts accounts(tool, in, task);
    if (task.summary) {
      write_summary(tool.out, in, accounts, task);
      accounts.finish();
      return 0;
    }
    Filter filter(
        in, tool.out,
        fmt::format("energy-ledger {}{}", task.uses_law ? words_of(task.law.law) : "D",
                    task.body.slope == 0 ? "" : fmt::format(" slope {}", task.body.slope)));
    for (const auto& quantity : row) filter.append(quantity.column());
    while (filter.next_run()) {
      Balance balance = accounts.open();
      while (filter.next()) {
        const Ledger now = accounts.enter(balance);
        for (const auto& quantity : row)
          filter.put(quantity.of({now, balance, temperature, task.law}));
      }
      accounts.close(balance);
    }
    accounts.finish();
    return 0;
  });
}
