// SPDX-License-Identifier: GPL-3.0-or-later
// differentiate - append the time derivative of a column; see differentiate(1)
#include <string_view>

#include "cli/history.h"
#include "cli/tool.h"
#include "signal/method.h"
#include "text/row_pipe.h"

int main(int argc, char** argv) {
  using namespace rolling;
  Tool tool("differentiate", "Append the time derivative of a column.");
  std::string column;
  auto methods = by_name(derivative_methods);
  SignalOptions options{methods["central"], {23, 0}};
  tool.text("-c,--column", column, "COLUMN", "the column to differentiate (v, else x)");
  tool.choice("-M,--method", options.method, methods, "how the slope is found (central)");
  tool.number("-w,--width", options.width.samples, whole,
              "width of savgol's window, an odd number of rows (23)");
  tool.number("--order", options.order, whole, "order of savgol's polynomial (2)");
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    if (!options.method->has_width()) tool.refuse({"width", "order"}, "goes with --method savgol");
    make_signal(options);  // refuses wrong options before anything is read
    Reader& in = tool.read({"t", "v"});
    const auto t = in.need("t");
    const std::string_view first = in.find("v") || !in.find("x") ? "v" : "x";
    const auto y = in.need(column.empty() ? first : column);
    const Column& from = in.columns()[in.column_of(y)];
    RowPipe pipe(in, tool.out, fmt::format("differentiate {} {}", from.name, describe(options)));
    pipe.append(derivative_of(from));
    while (pipe.next_run()) {
      const auto derivative = make_signal(options);
      while (pipe.next()) pipe.put(derivative->push(pipe[t], pipe[y]));
      pipe.put(derivative->finish());
    }
    return 0;
  });
}
