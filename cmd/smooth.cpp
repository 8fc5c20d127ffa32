// SPDX-License-Identifier: GPL-3.0-or-later
// smooth - smooth a column and select its rows; see smooth(1)
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "cli/tool.h"
#include "selection/selection.h"
#include "signal/method.h"
#include "text/filter.h"

namespace {

using namespace rolling;

/// The column to smooth where none is given: v, else the first column that is not t.
std::string default_column(const Reader& in, std::size_t t) {
  return in.find("v") || in.columns().size() == 1 ? "v" : in.column_of(t) == 0 ? "2" : "1";
}

/// The `##` lines.
std::string history(const std::string& column, const SelectionOptions& selected,
                    const SignalOptions& smoothed) {
  std::string lines;
  const auto add = [&](const std::string& line) { add_item(lines, "smooth " + line, "\n## "); };
  if (std::isfinite(selected.from)) add(fmt::format("t from {}", selected.from));
  if (std::isfinite(selected.to)) add(fmt::format("t to {}", selected.to));
  if (selected.outliers > 0) add(fmt::format("{} outliers {}", column, selected.outliers));
  if (selected.coast) add(column + " coast");
  const Width& width = smoothed.width;
  if (width.seconds > 0 || width.samples > 1)  // a window of one row is no filter
    add(column + ' ' + describe(smoothed));
  return lines;
}

/// Tells what --coast keeps: of one run in a line, of more in a line for all.
class Told {
 public:
  explicit Told(Tool& tool) : tool_(tool) {}

  /// Adds a run of so many rows.
  void add(const Selection& selection, const std::string& run, std::size_t rows) {
    for (const double t : selection.outliers())
      if (++outliers_ <= 10) add_item(times_, fmt::format("{:.12g}", t));
    if (!selection.roll()) return;
    const auto& [kept, how, after, other] = *selection.roll();
    const std::size_t count = kept.end - kept.begin;
    ++runs_, kept_ += count, rows_ += rows;
    ++ends_[static_cast<std::size_t>(how)];
    one_ =
        fmt::format("--coast keeps {:.12g} to {:.12g} s ({} of {} rows); the roll {}", kept.from,
                    kept.to, count, rows,
                    how == FreeRoll::End::by_itself ? "ends by itself"
                    : how == FreeRoll::End::goes_on ? "goes on to the end of the run"
                                                    : fmt::format("is ended at {:.12g} s", after));
    if (other)
      tool_.warn(run,
                 fmt::format("the free roll may also be {:.12g} to {:.12g} s, and not {:.12g} to "
                             "{:.12g} s: choose with --from and --to",
                             other->from, other->to, kept.from, kept.to));
  }
  void say() const {
    if (outliers_ > 0)
      tool_.warn(fmt::format("{} left out: at {}{} s", counted(outliers_, "outlier"), times_,
                             outliers_ > 10 ? ", ..." : ""));
    if (runs_ == 1) tool_.warn(one_);
    if (runs_ > 1)
      tool_.warn(
          fmt::format("--coast keeps {} of {} rows of {} runs; rolls that end by themselves: "
                      "{}, that are ended: {}, that go on to the end of their runs: {}",
                      kept_, rows_, runs_, ends_[0], ends_[1], ends_[2]));
  }

 private:
  Tool& tool_;
  std::size_t outliers_ = 0, runs_ = 0, kept_ = 0, rows_ = 0;
  std::array<std::size_t, 3> ends_{};
  std::string times_, one_;
};

void add_options(Tool& tool, SelectionOptions& select) {
  tool.number(
      "--outliers", select.outliers, positive,
      "leave out readings that are this many times the scatter off their neighbours' motion");
  tool.flag("--coast", select.coast,
            "keep the free roll only: without push, hold, hand, brake and rest");
  tool.number("--from", select.from, any_number, "leave out the rows before this time [s]");
  tool.number("--to", select.to, any_number, "leave out the rows after this time [s]");
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("smooth",
            "Replace a column by its mean over a moving window, or smooth it otherwise; select its "
            "rows.");
  std::string column;
  SelectionOptions select;
  auto methods = by_name(smoothing_methods);
  SignalOptions options{methods["mean"]};
  tool.text("-c,--column", column, "COLUMN",
            "the column to smooth (v, else the first that is not t)");
  tool.choice("-M,--method", options.method, methods, "what takes the place of a reading (mean)");
  tool.count("-w,--width", options.width.samples, whole,
             "width of the window, an odd number of rows (11)");
  tool.number("--seconds", options.width.seconds, positive,
              "width of the window in seconds, instead");
  tool.count("--order", options.order, whole, "order of savgol's polynomial (2)");
  add_options(tool, select);
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    if (options.width.seconds > 0) tool.refuse({"width"}, "does not go with --seconds: give one");
    if (!options.method->has_order) tool.refuse({"order"}, "goes with --method savgol");
    select.width = options.width;
    const bool smooths = tool.given("width") || tool.given("seconds") || tool.given("method"),
               all = select.all(), selects = !all && !smooths;  // and changes no number
    if (selects) options.width.samples = 1;
    make_signal(options);  // refuses wrong options before anything is read
    Reader& in = tool.read({"t", "v"});
    const auto t = in.need("t");
    if (column.empty()) column = default_column(in, t);
    const auto y = in.need(column);
    const std::string name = in.columns()[in.column_of(y)].name;
    select.positions = name == "x";
    if (select.coast && name != "x" && name != "v")
      fail("--coast needs x or v, not {}: say --use v=COLUMN, or --use x=COLUMN -c x", shown(name));
    Filter filter(in, tool.out, history(name, select, options));
    filter.replace(y);
    double first = INFINITY, last = -INFINITY;
    filter.say_why_none([&] {
      return fmt::format(": the times of the file go from {:.12g} to {:.12g} s", first, last);
    });
    Told selected(tool);
    while (filter.next_run()) {
      Selection selection(select);
      const auto smoother = make_signal(options);
      std::size_t row = 0;
      const auto take = [&](std::span<const Sample> samples) {
        for (const Sample& s : samples) {
          if (std::isnan(s.y)) filter.drop(row);
          else if (selects) filter.put(s.y);
          else filter.put(smoother->push(s.t, s.y));
          ++row;
        }
      };
      while (filter.next()) {
        first = std::min(first, filter[t]), last = std::max(last, filter[t]);
        if (all) filter.put(smoother->push(filter[t], filter[y]));
        else take(selection.push(filter[t], filter[y]));
      }
      take(selection.finish());
      selected.add(selection, in.run_name(), row);
      filter.put(smoother->finish());
    }
    selected.say();
    return 0;
  });
}
