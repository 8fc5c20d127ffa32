// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/law_file.h"

#include <vector>

#include "base/error.h"
#include "cli/row_column.h"

namespace rolling {

LawFile read_law(Tool& tool, const std::string& file) {
  Reader& in = tool.read_file(file, {"v", "D"});
  if (in.find("a") && in.find("b")) {
    const RowColumn a(in, "a", "D"), b(in, "b");
    std::optional<RowColumn> slope, v0;
    if (in.find("slope")) slope.emplace(in, "slope");
    if (tool.has("v0") && in.find("v0")) v0.emplace(in, "v0", "v");
    if (!in.next_run() || !in.next()) fail<InputError>("{}: no row of fitpower", shown(file));
    LawFile law;
    if (!tool.on_command_line("coefficient")) law.a = a.value();
    if (law.a && !(*law.a > 0)) fail("a = {} must be greater than 0", *law.a);
    if (!tool.on_command_line("exponent")) law.b = b.value();
    if (slope && !tool.on_command_line("slope")) law.slope = slope->value();
    if (v0 && !tool.on_command_line("v0")) law.v0 = v0->value();
    if (law.v0 && *law.v0 < 0)
      fail("v0 = {}: that body rolled towards falling x; say --v0 {}, and turn the sign of a slope",
           *law.v0, -*law.v0);
    if (!law.a && !law.b && !law.slope && !law.v0)
      fail<OptionError>("--law tells nothing that is not on the command line: leave it out");
    if (in.next() || in.next_run()) fail("more than one row: a law is one row of fitpower");
    return law;
  }
  tool.refuse({"coefficient", "exponent"}, "does not go with a table of v D");
  const auto v = in.need("v"), D = in.need("D");
  std::vector<double> speeds, shifts;
  while (in.next_run())
    while (in.next()) speeds.push_back(in[v]), shifts.push_back(in[D]);
  try {
    return {.points = TableLaw(std::move(speeds), std::move(shifts))};
  } catch (const Error& error) {
    fail<InputError>("{}: {}", file, error.what());
  }
}

}  // namespace rolling
