// SPDX-License-Identifier: GPL-3.0-or-later
// simulate - roll a body under a law D(v); see simulate(1)
#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/doubts.h"
#include "cli/law_file.h"
#include "cli/quantities.h"
#include "cli/tool.h"
#include "motion/scene.h"
#include "sensor/sonar.h"

using namespace rolling;

namespace {

const std::map<std::string, Method> methods = [] {
  std::map<std::string, Method> all{{"closed", {Method::closed}}, {"exact", {Method::exact}}};
  for (const Stepper stepper : steppers) all[stepper->name] = {Method::solver, stepper};
  return all;
}();

/// The arguments of a quantity.
struct Moment {
  double t, since;  ///< since t0
  double way;       ///< of the roll, whose mirror image the motion is if this is -1
  Motion& motion;
  const LawOfFile& law;
};

using Quantities = std::vector<Computed<double (*)(const Moment&)>>;
constexpr Quantities::value_type quantities[] = {
    {"t", "s", [](const Moment& m) { return m.t; }},
    {"x", "m", [](const Moment& m) { return m.way * m.motion.position(); }},
    {"v", "m/s", [](const Moment& m) { return m.way * m.motion.velocity(); }},
    {"a", "m/s^2", [](const Moment& m) { return m.way * m.motion.acceleration(); }},
    {"D", "m", [](const Moment& m) { return m.way * m.motion.shift(); }},
    {"sigma_x", "m", [](const Moment& m) { return m.law.sigma(m.motion.roll()->at(m.since).x_c); }},
    {"sigma_v", "m/s",
     [](const Moment& m) { return m.law.sigma(m.motion.roll()->at(m.since).v_c); }},
};

/// A run in the form that the software of such a sensor exports: comma-separated, with a line of
/// names and blank cells.
void write_run(Output& out, Motion& motion, const SonarOptions& sonar) {
  out.line("Time (s),Position (m),Velocity (m/s)");
  sonar_run(motion, sonar, [&](const SonarSample& sample) {
    out.number(sample.t);
    out.text(',');
    if (sample.x) out.number(*sample.x);
    out.text(',');
    if (sample.v) out.number(*sample.v);
    out.end_line();
  });
}

/// Prints the errors and the run times of the methods on this scene: a row each. A method that
/// fails has a row without numbers, and its message.
void report(Tool& tool, const Scene& scene, double rtol, double end) {
  const Reference right = reference(scene, 200, end);
  const Method best = best_method(scene);
  Output& out = tool.out;
  out.names({{"method"}, {"rtol"}, {"v_error"}, {"stop_error"}, {"evaluations"}, {"time", "s"}});
  const auto row = [&](const std::string& name, const Method& method, double tolerance) {
    const Measured m = measure([&] { return start(scene, method, tolerance); }, right);
    out.cell(name);
    if (method.kind == Method::solver || scene.body.road) out.cell(tolerance);
    else out.cell("");
    const double numbers[]{m.v_error, m.stop_error, static_cast<double>(m.evaluations), m.seconds};
    for (const double number : numbers)
      if (m.failure.empty()) out.cell(number);
      else out.cell("");
    if (!m.failure.empty()) tool.say(fmt::format("{}: {}", name, m.failure));
    out.end_line();
  };
  if (scene.body.road) {
    for (const double tolerance : {1e-6, 1e-8, rtol}) row("exact", best, tolerance);
    return;
  }
  for (const auto& [name, method] : methods)
    if (method.kind == best.kind && (best.kind != Method::solver || method.stepper == best.stepper))
      row(name, method, rtol);
  for (const char* name : {"rkf45", "rk8pd", "rk4imp", "bsimp", "msbdf"})
    for (const double tolerance : {1e-6, rtol}) row(name, methods.at(name), tolerance);
}

/// What the options and the scene describe: the roll and how it is solved.
struct Task {
  Quantities row = {};
  Scene roll{};
  double way = 1;  ///< -1 towards falling x: `roll` is the mirror image, with v0 >= 0
  double t0 = 0;
  LawOptions law{};
  std::string height;
  std::unique_ptr<const Road> road;
  std::string run;  ///< whose row of the file of laws is rolled
  LawOfFile law_of_file{};
  bool foretells = false;  ///< the uncertainties of the motion are asked for
  Method method{};
  double rtol = 1e-10;
  bool report = false;

  /// Reads the law, checks that nothing is missing, and chooses the method.
  void complete(Tool& tool) {
    const auto is_sigma = [](const auto& quantity) { return quantity.name.starts_with("sigma_"); };
    foretells = std::ranges::any_of(row, is_sigma);
    if (foretells && law.file.empty())
      fail("sigma_x and sigma_v are those of a law: they need --law and a row of fitpower");
    const double given_v0 = roll.v0;
    // A roll uses no uncertainties of its body: a law of the same values is of this body.
    for (const NumberOfBody& number : uncertain_numbers) roll.body.*number.sigma = 0;
    const auto laws = read_laws(tool, law, roll.body, foretells);
    if (laws.size() > 1 && run.empty())
      fail("{}: {} rows: choose one by --run NAME", shown(law.file), laws.size());
    law_of_file = run.empty() ? laws.front() : law_of(laws, run);
    roll.law = law_of_file.law;
    roll.body = law_of_file.body;
    road = read_road(tool, height);
    roll.body.road = road.get();
    const auto take = [&](const char* option, double of_row, double& value) {
      if (!std::isnan(of_row) && !tool.on_command_line(option)) value = of_row;
    };
    take("v0", law_of_file.v0, roll.v0);
    take("x0", law_of_file.x0, roll.x0);
    take("t0", law_of_file.t0, t0);
    check_wind(roll.body, roll.law);
    if (std::isnan(roll.v0)) tool.need({"v0"});
    // They are correlated with the law, and the row does not say how.
    if (foretells && roll.v0 != given_v0)
      fail<OptionError>("sigma_x and sigma_v need the speed of a new roll: say its --v0");
    for (const auto& [name, fitted] :
         {std::pair("slope", law_of_file.slope), {"wind", law_of_file.wind}})
      if (foretells && !std::isnan(fitted) && !tool.on_command_line(name))
        fail<OptionError>(
            "sigma_x and sigma_v do not have the uncertainty of the {} of the row: say --{}", name,
            name);
    if (foretells && !std::isnan(law_of_file.steepness))
      fail("sigma_x and sigma_v do not have the uncertainty of the steepness of the row");
    if (roll.v0 < 0) {
      way = -1;
      roll.v0 *= way;
      roll.x0 *= way;
      roll.body = seen_along(roll.body, way);
    }
    if (!tool.on_command_line("method")) method = best_method(roll);
    if (road && !report) rtol = finest;
  }
  std::unique_ptr<Motion> start() const { return rolling::start(roll, method, rtol); }
};

/// Refuses every option that has no effect beside another, or without one.
void check_options(const Tool& tool, const Task& task) {
  if (task.report)
    tool.refuse({"dt", "at", "columns", "sensor"}, "does not go with --report, without a motion");
  if (tool.on_command_line("sensor"))
    tool.refuse({"dt", "at", "columns", "x0", "t0", "plain"},
                "does not go with --sensor, whose rows come at --rate, with its own columns, "
                "from 0.3 m on");
  else tool.refuse({"seed", "rate", "resolution", "noise", "lost"}, "goes with --sensor");
  if (task.law.file.empty()) tool.refuse({"run"}, "goes with --law and its rows");
  if (task.road) tool.refuse({"memory"}, "does not go with --height, which has one method");
  if (tool.on_command_line("at"))
    tool.refuse({"dt", "until"}, "does not go with --at, whose file has all times");
  if (task.method.kind != Method::solver && !task.report)
    tool.refuse({"rtol"}, "goes with a solver: there is no tolerance here");
  if (task.foretells && task.method.kind == Method::solver)
    fail("sigma_x and sigma_v go with the methods closed and exact, without --memory");
  if (task.roll.bulge.length == 0 && task.roll.bulge.damping > 0)
    fail("--damping goes with --memory");
}

/// Tells numbers that are hardly meant in these units.
void tell_doubts(Tool& tool, const Task& task, const SonarOptions& sonar) {
  const double v0 = task.roll.v0;
  if (is_hardly_so_fast(task.roll.body, v0))
    tool.warn(fmt::format("v0 = {} m/s: hardly any such body is so fast; if that is cm/s, write {}",
                          v0, v0 / 100));
  const double length = task.roll.bulge.length;
  if (length > task.roll.body.R)
    tool.warn(
        fmt::format("a memory of {} m is longer than the radius: if that is millimetres, write {}",
                    length, length / 1000));
  if (sonar.rate < 1)
    tool.warn(fmt::format("--rate {} is a row every {} s: if a row takes {} s, write --rate {}",
                          sonar.rate, 1 / sonar.rate, sonar.rate, 1 / sonar.rate));
}

/// The time where the rows end: `until`, or the stop if that is not given.
double last_time(const Task& task, Motion& motion, double until) {
  const double t0 = task.t0;
  if (until < t0) fail("--until {} is before the roll, which begins at {}", until, t0);
  const double stop = std::isnan(until) ? motion.stop_time() : until - t0;
  if (!std::isfinite(stop)) {
    const double last = std::abs(motion.last_speed());
    fail("the body does not stop: {}; say --until when to end",
         last > 0 ? fmt::format("its speed tends to {:.4g} m/s", last)
                  : "its speed falls and is never 0, or D grows to the radius");
  }
  double end = std::isnan(until) ? t0 + stop : until;
  while (end - t0 < stop) end = std::nextafter(end, INFINITY);  // v is 0 there
  return end;
}

/// How far the body has rolled at its stop, or at `end` if that comes first.
double way_to_the_stop(Motion& motion, double end) {
  motion.seek(0);
  const double begin = motion.position();
  motion.seek(std::min(end, motion.stop_time()));
  return motion.position() - begin;
}

/// Says when and where the body comes to rest, or turns, and how well the law tells it, if the rows
/// up to `last` come near: there v may be 0, and sigma_v too, before the body rests.
void say_stop(Tool& tool, const Task& task, Motion& motion, double last) {
  // Behind the rows a track may end.
  const double stop =
      task.roll.body.road ? motion.roll()->stop_until(last - task.t0) : motion.stop_time();
  if (!std::isfinite(stop)) return;
  const LawOfFile& law = task.law_of_file;
  const double sigma = law.sigma(motion.roll()->stop_time_by_c());
  if (last - task.t0 < stop - 2 * sigma) return;
  motion.seek(stop);
  const Roll::Point at = motion.roll()->at(stop);
  tool.warn(fmt::format("the body {} at t = {:.7g} +- {:.2g} s, x = {:.7g} +- {:.2g} m",
                        motion.roll()->turns() ? "turns" : "stops", task.t0 + stop, sigma,
                        task.way * motion.position(), law.sigma(at.x_c)));
}

void add_options(Tool& tool, Task& task) {
  Scene& roll = task.roll;
  roll.v0 = not_given;
  tool.body(roll.body, {&Body::R, &Body::K, &Body::g, &Body::slope, &Body::wind});
  add_height(tool, task.height);
  add_options(tool, task.law);
  tool.text("--run", task.run, "NAME", "use the row of --law with this name in its column run");
  tool.geometry(roll.body.exact);
  tool.number("--v0", roll.v0, any_number, "velocity at t0 [m/s], negative towards falling x");
  tool.number("--x0", roll.x0, any_number, "position at t0 [m] (0)");
  tool.number("--t0", task.t0, any_number, "time at which the roll begins [s] (0)");
  tool.number("--memory", roll.bulge.length, positive,
              "length over which the bulge follows the law [m]: the body rolls back before rest");
  tool.number("--damping", roll.bulge.damping, not_negative, "damping of the bulge [s] (0)");
  tool.choice("--method", task.method, methods,
              "how to find v(t): closed, exact, or a solver (the cheapest that is exact)");
  tool.number("--rtol", task.rtol,
              {"from 1e-12 to 0.1", [](double x) { return x >= 1e-12 && x <= 0.1; }},
              "tolerance of a solver, relative to the change in a step (1e-10)");
  tool.flag("--report", task.report,
            "print error against run time of the methods, instead of the motion");
}

void add_options(Tool& tool, SonarOptions& sonar) {
  tool.number("--rate", sonar.rate, positive, "rows of the sensor a second (25)");
  tool.number("--resolution", sonar.resolution, not_negative,
              "resolution of the sensor [m] (0.001)");
  tool.number("--noise", sonar.noise, not_negative,
              "noise of a position before it is rounded [m] (0.0003)");
  tool.number("--lost", sonar.lost, {"from 0 to below 1", [](double x) { return x >= 0 && x < 1; }},
              "dropouts: share of lost echoes (0.01)");
}

/// The `##` line and the names.
void write_head(Output& out, const Task& task) {
  Body body = task.roll.body;
  body.slope *= task.way;
  body.wind *= task.way;
  out.line(fmt::format("## simulate {} K {} R {} g {} v0 {}{}{}{}", words_of(task.roll.law), body.K,
                       body.R, body.g, task.way * task.roll.v0, words_of(body, task.height),
                       task.t0 == 0 ? "" : fmt::format(" t0 {}", task.t0),
                       task.roll.body.exact ? " exact" : ""));
  std::vector<Column> names;
  for (const auto& quantity : task.row) names.push_back(quantity.column());
  out.names(names);
}

void write_row(Output& out, const Task& task, double t, Motion& motion) {
  const Moment now{t, t - task.t0, task.way, motion, task.law_of_file};
  motion.seek(now.since);
  for (const auto& quantity : task.row) out.cell(0 + quantity.of(now));  // `0 +` makes -0 a 0
  out.end_line();
}

/// Rows at the times in the column t of a file; each run of the file starts the roll anew. Returns
/// the latest.
double write_at(Output& out, const Task& task, Reader& in) {
  const auto t = in.need("t");
  double last = task.t0;
  for (bool first = true; in.next_run();) {
    std::unique_ptr<Motion> motion;
    while (in.next()) {
      if (in[t] < task.t0) fail("t = {} is before the roll, which begins at {}", in[t], task.t0);
      if (!motion) {
        if (!std::exchange(first, false)) out.end_line();
        out.run_among(in.comments());
        write_head(out, task);
        motion = task.start();
      }
      write_row(out, task, in[t], *motion);
      last = std::max(last, in[t]);
    }
  }
  return last;
}

/// Rows every dt up to `end`, and there too if it is the stop.
void write_every(Output& out, const Task& task, double dt, Motion& motion, double end,
                 bool to_the_stop) {
  // The margin keeps rounding of end / dt from adding a row beside the stop or losing the last.
  const double most = (end - task.t0) / dt;
  const double margin = 1e-9 + 1e-15 * most;
  const double steps = std::floor(most + (to_the_stop ? -margin : margin));
  if (steps > 1e9) fail("these are {:.3g} rows; the most is 1e9: --dt is too small", steps);
  write_head(out, task);
  // If 1/dt is a whole number (25 Hz), the times after t0 are the doubles nearest to k/rate.
  const double rate = std::round(1 / dt);
  for (double k = 0; k <= steps; ++k)
    write_row(out, task, task.t0 + (rate * dt == 1 ? k / rate : k * dt), motion);
  if (to_the_stop) write_row(out, task, end, motion);
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("simulate", "Roll a body on a mat under a law D(v).");
  Task task;
  SonarOptions sonar;
  double dt = 0.01;
  double until = not_given;
  std::size_t seed = 1;
  std::string times_file;
  std::string columns = "t,x,v,a,D";
  bool sensor = false;
  add_options(tool, task);
  tool.number("--dt", dt, positive, "time between rows [s] (0.01)");
  tool.number("--until", until, any_number, "print rows up to this time [s] (the stop)");
  tool.text("--at", times_file, "FILE", "file with a column t: print rows at these times");
  tool.text("--columns", columns, "NAME,...",
            "print these of t,x,v,a,D,sigma_x,sigma_v (the first five)");
  tool.choice<bool>("--sensor", sensor, {{"pasco", true}},
                    "write what this motion sensor would see, push and rest included");
  tool.number("--seed", seed, whole, "seed of the sensor's noise (1)");
  add_options(tool, sonar);
  tool.scene();
  tool.output();

  return tool.run(argc, argv, [&] {
    // The columns, the method and the end are checked before the report.
    task.row = chosen(columns, quantities);
    task.complete(tool);
    check_options(tool, task);
    const auto motion = task.start();
    const bool to_the_stop = std::isnan(until);
    double end = times_file.empty() ? last_time(task, *motion, until) : not_given;
    tell_doubts(tool, task, sonar);
    if (task.report) {
      report(tool, task.roll, task.rtol, to_the_stop ? 10 : until - task.t0);
    } else if (sensor) {
      sonar.seed = seed;
      if (task.way < 0) sonar.towards = way_to_the_stop(*task.start(), end);
      if (!to_the_stop) sonar.until = until;
      write_run(tool.out, *motion, sonar);
    } else if (times_file.empty()) {
      write_every(tool.out, task, dt, *motion, end, to_the_stop);
    } else {
      end = write_at(tool.out, task, tool.read_file(times_file, {"t"}));
    }
    if (task.foretells && !task.report && !sensor) say_stop(tool, task, *motion, end);
    return 0;
  });
}
