// SPDX-License-Identifier: GPL-3.0-or-later
// smooth - smooth a column and select its rows; see smooth(1)
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cli/tool.h"
#include "selection/selection.h"
#include "signal/method.h"
#include "statistics/levels.h"
#include "text/row_pipe.h"

namespace {

using namespace rolling;

/// The column where none is given: to select rows alone x, as fitpower takes it; to smooth v; else
/// the first column that is not t.
std::string default_column(const Reader& in, std::size_t t, bool selects) {
  if (selects && in.find("x")) return "x";
  if (in.find("v") || in.columns().size() == 1) return "v";
  return in.column_of(t) == 0 ? "2" : "1";
}

/// A roll is one of positions or speeds.
void require_motion(const SelectionOptions& select, const std::string& name) {
  if (select.needs_run() && name != "x" && name != "v")
    fail("{} needs x or v, not {}: say --use v=COLUMN, or --use x=COLUMN -c x",
         select.rolls ? "--rolls" : "--coast", shown(name));
}

/// The `##` lines.
std::string history(const std::string& column, EqualTimes equal_times,
                    const SelectionOptions& selected, const SignalOptions& smoothed) {
  std::string lines;
  const auto add = [&](const std::string& line) { add_item(lines, "smooth " + line, "\n## "); };
  if (equal_times == EqualTimes::first) add("t equal-times first");
  if (equal_times == EqualTimes::mean) add("t equal-times mean");
  if (std::isfinite(selected.from)) add(fmt::format("t from {}", selected.from));
  if (std::isfinite(selected.to)) add(fmt::format("t to {}", selected.to));
  if (selected.outliers > 0) add(fmt::format("{} outliers {}", column, selected.outliers));
  if (selected.coast) add(column + " coast");
  if (selected.rolls) add(column + " rolls");
  const Width& width = smoothed.width;
  if (width.seconds > 0 || width.samples > 1)  // a window of one row is no filter
    add(column + ' ' + describe(smoothed));
  return lines;
}

/// How a roll ends.
std::string end_of(const FreeRoll& roll) {
  if (roll.how == FreeRoll::End::by_itself) return "the body rolled to rest";
  if (roll.how == FreeRoll::End::goes_on) return "the run ends before the roll does";
  if (roll.how == FreeRoll::End::speeds_up)
    return fmt::format(
        "the speed grows again at {:.12g} s: if the body rolled back, make those speeds negative, "
        "and fit the slope",
        roll.after);
  if (roll.how == FreeRoll::End::stays)
    return fmt::format(
        "the speed stays at {:.3g} m/s from {:.12g} s on, and not at 0: if the body rests there, "
        "subtract that from all speeds",
        roll.speed, roll.after);
  return fmt::format(
      "something stopped the body at {:.12g} s, or b of its law is near 1 or below 0", roll.after);
}

/// Tells which rolls are kept: one roll in a line, more of them in a line for all.
class Told {
 public:
  Told(Tool& tool, bool all_rolls)
      : tool_(tool), keeps_(all_rolls ? "--rolls keeps" : "--coast keeps"), all_rolls_(all_rolls) {}

  /// Adds a run of so many rows.
  void add(const Selection& selection, const std::string& run, std::size_t rows) {
    for (const double t : selection.outliers())
      if (++outliers_ <= 10) add_item(times_, fmt::format("{:.12g}", t));
    ++runs_;
    rows_ += rows;
    for (const FreeRoll& roll : selection.rolls()) {
      const Stretch& kept = roll.kept;
      const std::size_t count = kept.end - kept.begin;
      ++rolls_;
      kept_ += count;
      ++ends_[static_cast<std::size_t>(roll.how)];
      one_ = fmt::format("{} {:.12g} to {:.12g} s ({} of {} rows); {}", keeps_, kept.from, kept.to,
                         count, rows, end_of(roll));
      if (roll.other && !all_rolls_)
        tool_.warn(run,
                   fmt::format("the free roll may also be {:.12g} to {:.12g} s, and not {:.12g} to "
                               "{:.12g} s: choose with --from and --to, or keep all with --rolls",
                               roll.other->from, roll.other->to, kept.from, kept.to));
    }
  }
  void say() const {
    if (outliers_ > 0)
      tool_.warn(fmt::format("{} left out: at {}{} s", counted(outliers_, "outlier"), times_,
                             outliers_ > 10 ? ", ..." : ""));
    if (rolls_ == 1) tool_.warn(one_);
    constexpr std::array how{"rolled to rest", "stopped by something", "still rolling at the end",
                             "slow before the speed grows again",
                             "at rest with another speed than 0"};
    std::string ends;
    for (std::size_t i = 0; i < how.size(); ++i)
      if (ends_[i] > 0) add_item(ends, fmt::format("{} {}", ends_[i], how[i]));
    if (rolls_ > 1)
      tool_.warn(fmt::format("{} {} of {} rows in {} of {}: {}", keeps_, kept_, rows_,
                             counted(rolls_, "roll"), counted(runs_, "run"), ends));
  }

 private:
  Tool& tool_;
  std::string keeps_;
  bool all_rolls_;
  std::size_t outliers_ = 0, runs_ = 0, rolls_ = 0, kept_ = 0, rows_ = 0;
  std::array<std::size_t, 5> ends_{};
  std::string times_, one_;
};

void add_options(Tool& tool, std::string& column, SignalOptions& options,
                 SelectionOptions& select) {
  tool.text("-c,--column", column, "COLUMN",
            "the column to smooth (v, else the first that is not t); to select rows, x before v");
  tool.choice("-M,--method", options.method, by_name(smoothing_methods),
              "what replaces a reading (mean)");
  tool.number("-w,--width", options.width.samples, whole,
              "width of the window, an odd number of rows (11)");
  tool.number("--seconds", options.width.seconds, positive,
              "width of the window in seconds, instead of rows");
  tool.number("--order", options.order, whole, "order of savgol's polynomial (2)");
  tool.number("--outliers", select.outliers, positive,
              "leave out readings this many times the scatter off the motion of their neighbours");
  tool.flag("--coast", select.coast,
            "keep the free roll only: without push, hold, hand, brake and rest");
  tool.flag("--rolls", select.rolls, "keep every free roll, each as a run of its own");
  tool.number("--from", select.from, any_number, "leave out the rows before this time [s]");
  tool.number("--to", select.to, any_number, "leave out the rows after this time [s]");
  tool.equal_times();
}

void refuse_pairs(const Tool& tool, const SelectionOptions& select, const SignalOptions& options) {
  if (options.width.seconds > 0) tool.refuse({"width"}, "does not go with --seconds: give one");
  if (!options.method->has_order) tool.refuse({"order"}, "goes with --method savgol");
  if (select.from > select.to) tool.refuse({"from"}, "is after --to: no row is between them");
  if (select.coast && select.rolls) tool.refuse({"coast"}, "does not go with --rolls: give one");
}

/// What is done to the rows.
struct Task {
  std::string column;
  SelectionOptions select;
  SignalOptions options{by_name(smoothing_methods)["mean"]};
  bool selects = false;       ///< and changes no number
  bool tells_window = false;  ///< the width was asked for
};

/// A run on its way into the pipe: its rows are selected, each roll of --rolls becomes a run of its
/// own, and the numbers of the column are smoothed.
class RunOfPipe {
 public:
  RunOfPipe(const Task& task, RowPipe& pipe, std::string name)
      : task_(task), pipe_(pipe), name_(std::move(name)), selection_(task.select),
        smoother_(make_signal(task.options)) {}

  void push(double t, double y) {
    if (rows_++ == 0) begin_ = t;
    end_ = t;
    if (task_.select.all()) pipe_.put(smoother_->push(t, y));
    else take(selection_.push(t, y));
  }
  /// The place across x, where a file has it.
  void push_across(double t, double x, double y) { places_.push_back({t, x, y}); }
  void finish(Tool& tool, Told& told) {
    take(selection_.finish());
    told.add(selection_, name_, taken_);
    for (const FreeRoll& roll : selection_.rolls()) tell_oblique(tool, roll.kept);
    pipe_.put(smoother_->finish());
    if (task_.tells_window) tell_window(tool);
  }

 private:
  void take(std::span<const Sample> samples) {
    for (const Sample& s : samples) {
      if (std::isnan(s.y)) {
        pipe_.drop(taken_);
      } else {
        begin_roll(s.t);
        if (task_.selects) pipe_.put(s.y);
        else pipe_.put(smoother_->push(s.t, s.y));
      }
      ++taken_;
    }
  }
  /// The smoothing of a roll begins anew.
  void begin_roll(double t) {
    const auto& rolls = selection_.rolls();
    if (!task_.select.rolls || roll_ == rolls.size() || t < rolls[roll_].kept.from) return;
    pipe_.put(smoother_->finish());
    smoother_ = make_signal(task_.options);
    ++roll_;
    pipe_.split(taken_, fmt::format("{} roll {} of {}", name_, roll_, rolls.size()));
  }
  /// Tells a roll that is oblique to the axes of a video: its x is not the way.
  void tell_oblique(Tool& tool, const Stretch& kept) const {
    const auto range = [&](std::size_t of) {
      double least = INFINITY;
      double most = -INFINITY;
      for (const auto& place : places_) {
        if (place[0] < kept.from || place[0] > kept.to) continue;
        least = std::fmin(least, place[of]);
        most = std::fmax(most, place[of]);
      }
      return most - least;
    };
    const double ratio = range(2) / range(1);
    if (ratio > levels::oblique)
      tool.warn(name_, fmt::format("y changes by {:.2g} times as much as x, so that x is not the "
                                   "way: turn the axes along the motion, or give a column "
                                   "sqrt(x^2 + y^2)",
                                   ratio));
  }
  /// Tells a window that is far longer than the run, or holds one row.
  void tell_window(Tool& tool) const {
    const Width& width = task_.options.width;
    const double seconds = end_ - begin_;
    const double step = seconds / (static_cast<double>(rows_) - 1);
    const double window =
        width.seconds > 0 ? width.seconds : static_cast<double>(width.samples) * step;
    if (window > 2 * (seconds + step))
      tool.warn(name_, fmt::format("the run lasts {:.4g} s, and the window more than twice as long",
                                   seconds));
    if (width.seconds > 0 && window < step)
      tool.warn(name_, fmt::format("the window holds one row: one comes every {:.4g} s", step));
  }

  const Task& task_;
  RowPipe& pipe_;
  std::string name_;
  Selection selection_;
  std::unique_ptr<Signal> smoother_;
  std::size_t rows_ = 0;   // that were pushed
  std::size_t taken_ = 0;  // whose selection is known
  std::size_t roll_ = 0;
  double begin_ = 0, end_ = 0;
  std::vector<std::array<double, 3>> places_;  // t, x, y
};

/// Reads the runs, and writes them.
void smooth(Tool& tool, Task& task) {
  Reader& in = tool.read({"t", "v"});
  const auto t = in.need("t");
  if (task.column.empty()) task.column = default_column(in, t, task.selects);
  const auto y = in.need(task.column);
  const std::string name = in.columns()[in.column_of(y)].name;
  if (in.column_of(y) == in.column_of(t)) fail("t is the time: -c names another column, x or v");
  task.select.positions = name == "x";
  require_motion(task.select, name);
  std::optional<std::size_t> across;
  if (task.select.needs_run() && name == "x") across = in.want_beside("y");
  RowPipe pipe(in, tool.out, history(name, in.equal_times(), task.select, task.options));
  pipe.replace(y);
  double first = INFINITY;
  double last = -INFINITY;
  pipe.say_why_none([&] {
    return fmt::format(": the times of the file go from {:.12g} to {:.12g} s", first, last);
  });
  Told told(tool, task.select.rolls);
  while (pipe.next_run()) {
    RunOfPipe run(task, pipe, in.run_name());
    while (pipe.next()) {
      first = std::min(first, pipe[t]);
      last = std::max(last, pipe[t]);
      run.push(pipe[t], pipe[y]);
      if (across) run.push_across(pipe[t], pipe[y], pipe[*across]);
    }
    run.finish(tool, told);
  }
  told.say();
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("smooth",
            "Replace a column by its mean over a moving window, or smooth it otherwise; select its "
            "rows.");
  Task task;
  add_options(tool, task.column, task.options, task.select);
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    refuse_pairs(tool, task.select, task.options);
    task.select.width = task.options.width;
    task.tells_window = tool.given("width") || tool.given("seconds");
    const bool smooths = task.tells_window || tool.given("method");
    task.selects = !smooths && (!task.select.all() || tool.given("equal-times"));
    if (task.selects) task.options.width.samples = 1;
    make_signal(task.options);  // refuses wrong options before anything is read
    smooth(tool, task);
    return 0;
  });
}
