// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/law_file.h"

#include <map>

#include "base/error.h"
#include "cli/row_column.h"

namespace rolling {
namespace {

/// The row of fitpower in a file.
void read_row(Tool& tool, Reader& in, const std::string& file, PowerLaw& law,
              std::vector<RowNumber> numbers) {
  struct Known {
    const char *option, *quantity;
  };
  static const std::map<std::string, Known> known{
      {"a", {"coefficient", "D"}}, {"b", {"exponent", ""}}, {"slope", {"slope", ""}},
      {"v0", {"v0", "v"}},         {"x0", {"x0", "x"}},     {"t0", {"t0", "t"}}};
  numbers.insert(numbers.end(), {{"a", &law.a}, {"b", &law.b}});
  std::erase_if(numbers, [&](const RowNumber& number) { return !in.find(number.name); });
  std::vector<RowColumn> columns;
  for (const RowNumber& number : numbers)
    columns.emplace_back(in, number.name, known.at(number.name).quantity);
  if (!in.next_run() || !in.next()) fail<InputError>("{}: no row of fitpower", shown(file));
  bool told = false;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (tool.on_command_line(known.at(numbers[i].name).option)) continue;
    *numbers[i].value = columns[i].value();
    told = true;
    if (numbers[i].value == &law.a && !(law.a > 0)) fail("a = {} must be greater than 0", law.a);
  }
  if (!told) fail<OptionError>("--law tells nothing that is not on the command line: leave it out");
  if (in.next() || in.next_run()) fail("more than one row: a law is one row of fitpower");
}

}  // namespace

std::optional<Law> read_law(Tool& tool, const std::string& file, PowerLaw& law,
                            const std::vector<RowNumber>& numbers) {
  Reader& in = tool.read_file(file, {"v", "D"});
  if (in.find("a") && in.find("b")) {
    read_row(tool, in, file, law, numbers);
    return {};
  }
  tool.refuse({"coefficient", "exponent"}, "does not go with a table of v D");
  if (!in.find("v") || !in.find("D"))
    fail<InputError>("{}: neither a table of v and D nor a row of fitpower", shown(file));
  const auto v = in.need("v"), D = in.need("D");
  std::vector<double> speeds, shifts;
  while (in.next_run())
    while (in.next()) speeds.push_back(in[v]), shifts.push_back(in[D]);
  try {
    return TableLaw(std::move(speeds), std::move(shifts));
  } catch (const Error& error) {
    fail<InputError>("{}: {}", file, error.what());
  }
}

}  // namespace rolling
