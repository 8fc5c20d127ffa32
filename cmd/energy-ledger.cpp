// energy-ledger - append where the energy goes (Eqs. 14 to 23); see energy-ledger(1)
#include <array>
#include <cmath>

#include "cli/tool.h"
#include "contact/balance.h"
#include "text/filter.h"

int main(int argc, char** argv) {
  using namespace rolling;
  using enum BodyOption;
  Tool tool("energy-ledger", "Append the energies and the flows of energy of a rolling body.");
  Body body;
  Geometry geometry;
  PowerLaw law;
  bool summary = false;
  double tolerance = not_given;
  tool.body(body, {mass, radius, shape_factor, gravity});
  tool.law(law);
  tool.geometry(geometry);
  tool.flag("--summary", summary,
            "print only a row for each run: energy at the start, at the end, dissipated, closure");
  tool.number("--check", tolerance, not_negative, "exit with 1 when |closure| is above this");
  tool.scene();
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    tool.need({"mass", "radius", "shape-factor"});
    Reader& in = tool.read({"t", "v", "D"});
    const auto t = in.need_time(), v = in.need("v");
    // A law on the command line is meant; the law of a scene stands in for a D that is not there.
    const bool use_law = tool.on_command_line("coefficient") || tool.on_command_line("exponent") ||
                         (!std::isnan(law.a) && !in.find("D"));
    if (use_law) tool.need({"coefficient", "exponent"});
    const std::size_t D = use_law ? 0 : in.need("D");
    const auto push = [&](Balance& balance) -> const Ledger& {
      return balance.push(in[t], in[v], use_law ? law(in[v]) : in[D]);
    };

    int status = 0;
    const auto check = [&](const Balance& balance) {
      if (std::isnan(tolerance) || std::abs(balance.closure()) <= tolerance) return;
      tool.say(fmt::format("the check does not hold: closure {:.4g} is beyond {}",
                           balance.closure(), tolerance));
      status = 1;
    };
    if (summary) {
      tool.out.names({{"E_start", "J"}, {"E_end", "J"}, {"E_diss", "J"}, {"closure", ""}});
      while (in.next_run()) {
        Balance balance(body, geometry);
        while (in.next()) push(balance);
        tool.out.row(
            std::array{balance.start(), balance.end(), balance.dissipated(), balance.closure()});
        check(balance);
      }
    } else {
      Filter filter(
          in, tool.out,
          use_law ? fmt::format("energy-ledger a {} b {}", law.a, law.b) : "energy-ledger D");
      for (const char* energy : {"E_trans", "E_rot"}) filter.append({energy, "J"});
      for (const char* flow : {"I_E1", "I_E2", "P_T1", "P_R1", "P_R2", "P_T2", "P_diss"})
        filter.append({flow, "W"});
      filter.append({"E_diss", "J"});
      while (filter.next_run()) {
        Balance balance(body, geometry);
        while (filter.next()) {
          const Ledger& l = push(balance);
          filter.put(std::array{l.E_trans, l.E_rot, l.I_E1, l.I_E2, l.P_T1, l.P_R1, l.P_R2, l.P_T2,
                                l.P_diss, balance.dissipated()});
        }
        check(balance);
      }
    }
    return status;
  });
}
