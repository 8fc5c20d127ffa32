// smooth - smooth a column and select its records; see smooth(1)
#include <cmath>
#include <utility>

#include "cli/tool.h"
#include "signal/selection.h"
#include "signal/smoother.h"
#include "text/filter.h"

namespace {

using namespace rolling;

std::size_t odd_number(const std::string& text) {
  double value;
  if (!parse_number(text, value)) fail("-w,--width: '{}' is not a number", shown(text));
  if (!odd.holds(value)) fail("-w,--width: '{}' must be {}", shown(text), odd.text);
  return static_cast<std::size_t>(value);
}

/// The column to smooth where none is given: v, else the first column that is not t.
std::string default_column(const Reader& in, std::size_t t) {
  return in.find("v") || in.columns().size() == 1 ? "v" : in.column_of(t) == 0 ? "2" : "1";
}

/// Refuses options that exclude each other.
void check(const Tool& tool, const SignalOptions& options) {
  if (options.width.seconds > 0) tool.refuse({"width"}, "does not go with --seconds: give one");
  if (!options.method->has_order) tool.refuse({"order"}, "goes with --method savgol");
}

/// The `##` lines.
std::string history(const std::string& column, const SelectionOptions& selected,
                    const SignalOptions& smoothed) {
  std::string lines;
  const auto add = [&](const std::string& line) {
    (lines += lines.empty() ? "" : "\n## ") += "smooth " + line;
  };
  if (std::isfinite(selected.from)) add(fmt::format("t from {}", selected.from));
  if (std::isfinite(selected.to)) add(fmt::format("t to {}", selected.to));
  if (selected.outliers > 0) add(fmt::format("{} outliers {}", column, selected.outliers));
  if (selected.coast) add(column + " coast");
  const Width& width = smoothed.width;
  if (width.seconds > 0 || width.samples > 1)  // a window of one record is no filter
    add(column + ' ' + describe(smoothed));
  return lines;
}

void warn_of_doubt(Tool& tool, const Reader& in, const Selection& selection) {
  if (const auto& doubt = selection.doubt())
    tool.warn(
        fmt::format("run {}: --coast keeps the roll from {:.6g} s on, but by fainter signs it "
                    "begins at {:.6g} s: choose with --from",
                    in.run_name(), doubt->begin, doubt->other));
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("smooth",
            "Replace a column by its mean over a moving window, or smooth it otherwise; select its "
            "records.");
  std::string column, width = "11";
  SelectionOptions select;
  auto methods = by_name(smoothing_methods);
  SignalOptions options{methods["mean"]};
  tool.text("-c,--column", column, "COLUMN",
            "the column to smooth (v, else the first that is not t)");
  tool.choice("-M,--method", options.method, methods, "what takes the place of a reading (mean)");
  tool.text("-w,--width", width, "N",
            "width of the window, an odd number of samples (11), or auto");
  tool.number("--seconds", options.width.seconds, positive,
              "width of the window in seconds, instead");
  tool.count("--order", options.order, polynomial, "order of savgol's polynomial (2)");
  tool.number("--outliers", select.outliers, positive,
              "leave out readings further than this many scaled MADs from their window's median");
  tool.flag("--coast", select.coast, "keep the free roll only: after the last push or hold");
  tool.number("--from", select.from, any_number, "leave out the records before this time [s]");
  tool.number("--to", select.to, any_number, "leave out the records after this time [s]");
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    check(tool, options);
    bool choose = width == "auto";
    if (width != "auto") options.width.samples = odd_number(width);
    select.width = options.width;
    make_signal(options);  // refuses wrong options before anything is read
    Reader& in = tool.filter({"t", "v"});
    const auto t = in.need_time();
    if (column.empty()) column = default_column(in, t);
    const auto y = in.need(column);
    const std::string name = in.columns()[in.column_of(y)].name;
    select.positions = name == "x";
    if (select.coast && name != "x" && name != "v")
      fail("--coast needs x or v, not {}: say --use v=COLUMN, or --use x=COLUMN -c x", shown(name));

    Filter filter(in, tool.out);
    filter.replace(y);
    bool told = false;
    const auto tell = [&] {
      if (!std::exchange(told, true)) filter.set_history(history(name, select, options));
    };
    std::size_t outliers = 0;
    while (filter.next_run()) {
      if (!choose && !select.coast) tell();  // else the first run may still be refused
      Selection selection(select);
      std::unique_ptr<Signal> smoother =
          choose ? std::make_unique<AutoSmoother>(options) : make_signal(options);
      std::size_t record = 0, kept = 0;
      const auto take = [&](std::span<const Judged> samples) {
        for (const Judged& s : samples) {
          if (s.kept) filter.put(smoother->push(s.t, s.y)), ++kept;
          else filter.drop(record);
          ++record;
        }
      };
      while (filter.next()) {
        if (select.all()) filter.put(smoother->push(filter[t], filter[y])), ++kept;
        else take(selection.push(filter[t], filter[y]));
      }
      selection.finish();
      warn_of_doubt(tool, in, selection);
      if (!choose) tell();
      for (auto more = selection.rest(); !more.empty(); more = selection.rest()) take(more);
      const auto rest = smoother->finish();
      if (choose && kept > 0) {  // the first run with records decides for all
        options = static_cast<AutoSmoother&>(*smoother).options();
        choose = false;
        tell();
      }
      filter.put(rest);
      outliers += selection.outliers();
    }
    tool.count_left_out(outliers, "outliers");
    return 0;
  });
}
