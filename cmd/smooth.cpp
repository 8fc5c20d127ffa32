// smooth - replace a column by its moving mean; see smooth(1)
#include "cli/tool.h"
#include "signal/moving_mean.h"
#include "text/filter.h"

int main(int argc, char** argv) {
  using namespace rolling;
  Tool tool("smooth", "Replace a column by its mean over a moving window.");
  std::string column;
  MovingMean::Window window;
  tool.text("-c,--column", column, "COLUMN", "the column to smooth (v, else the first that is not t)");
  tool.count("-w,--width", window.samples, odd, "width of the window, an odd number of samples (11)");
  tool.number("--seconds", window.seconds, positive, "width of the window in seconds, instead");
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    Reader& in = tool.read({"t", "v"});
    const auto t = in.need_time();
    if (column.empty()) column = in.find("v") || in.columns().size() == 1 ? "v" : in.column_of(t) == 0 ? "2" : "1";
    const auto y = in.need(column);
    const std::string width = window.seconds > 0 ? fmt::format("seconds {}", window.seconds) : fmt::format("width {}", window.samples);
    Filter filter(in, tool.out, fmt::format("smooth {} mean {}", in.columns()[in.column_of(y)].name, width));
    filter.replace(y);
    while (filter.next_run()) {
      MovingMean mean(window);
      while (filter.next())
        for (const double value : mean.push(filter[t], filter[y])) filter.put(value);
      for (const double value : mean.finish()) filter.put(value);
    }
    return 0;
  });
}
