// simulate - roll a body under a law D(v); see simulate(1)
#include <cmath>

#include "cli/law_file.h"
#include "cli/quantities.h"
#include "cli/tool.h"
#include "motion/measure.h"
#include "motion/roll.h"
#include "sensor/sonar.h"

using namespace rolling;

namespace {

const std::map<std::string, Method> methods = {
    {"closed", {Method::closed}},
    {"exact", {Method::exact}},
    {"rk2", {Method::solver, Stepper::rk2}},
    {"rk4", {Method::solver, Stepper::rk4}},
    {"rkf45", {Method::solver, Stepper::rkf45}},
    {"rkck", {Method::solver, Stepper::rkck}},
    {"rk8pd", {Method::solver, Stepper::rk8pd}},
    {"msadams", {Method::solver, Stepper::msadams}},
    {"rk1imp", {Method::solver, Stepper::rk1imp}},
    {"rk2imp", {Method::solver, Stepper::rk2imp}},
    {"rk4imp", {Method::solver, Stepper::rk4imp}},
    {"bsimp", {Method::solver, Stepper::bsimp}},
    {"msbdf", {Method::solver, Stepper::msbdf}},
};

const std::vector<Quantity<double (*)(double t, Motion&)>> quantities = {
    {{"t", "s"}, [](double t, Motion&) { return t; }},
    {{"x", "m"}, [](double, Motion& motion) { return motion.position(); }},
    {{"v", "m/s"}, [](double, Motion& motion) { return motion.velocity(); }},
    {{"a", "m/s^2"}, [](double, Motion& motion) { return motion.acceleration(); }},
    {{"D", "m"}, [](double, Motion& motion) { return motion.shift(); }},
};

/// The times 0, dt, 2 dt, ...; where 1/dt is a whole number (25 Hz), each the double nearest to
/// k/rate.
struct Clock {
  double dt, rate = std::round(1 / dt);
  bool whole = rate * dt == 1;
  double at(double k) const { return whole ? k / rate : k * dt; }
};

/// Comma-separated with a names line and blank cells, as such programs export it.
void write_record(Output& out, Motion& motion, const SonarOptions& sonar) {
  out.text("Time (s),Position (m),Velocity (m/s)");
  out.end_line();
  sonar_record(motion, sonar, [&](const SonarSample& sample) {
    out.number(sample.t);
    out.text(',');
    if (sample.x) out.number(*sample.x);
    out.text(',');
    if (sample.v) out.number(*sample.v);
    out.end_line();
  });
}

/// On standard error: what the methods cost on this scene, and how far they are off.
void report(Tool& tool, const Roll& roll, double rtol, double end) {
  const Reference right = reference(roll, 200, end);
  const Method best = best_method(roll);
  tool.say(fmt::format("{:8} {:>7} {:>9} {:>10} {:>11} {:>11} {:>8}", "method", "rtol",
                       "max|dv|/v0", "dt*/t*", "evaluations", "ns/sample", "scatter"));
  const auto row = [&](const std::string& name, const Method& method, double tolerance) {
    const Measured m = measure([&] { return start(roll, method, tolerance); }, right, roll.v0, 7);
    const std::string text = fmt::format(
        "{:8} {:>7}", name, method.kind == Method::solver ? fmt::format("{:g}", tolerance) : "-");
    if (!m.failure.empty()) return tool.say(text + " failed: " + m.failure);
    tool.say(fmt::format("{} {:10.2g} {:10.2g} {:11} {:11.4g} {:8.2g}", text, m.v_error,
                         m.stop_error, m.evaluations, 1e9 * m.seconds, 1e9 * m.scatter));
  };
  for (const auto& [name, method] : methods)
    if (method.kind == best.kind && (best.kind != Method::solver || method.stepper == best.stepper))
      row(name, method, rtol);
  for (const char* name : {"rkf45", "rk8pd", "rk4imp", "bsimp", "msbdf"})
    for (const double tolerance : {1e-6, rtol}) row(name, methods.at(name), tolerance);
  tool.say(best.kind == Method::solver ? "errors are against the first at rtol 1e-13"
                                       : "errors are against the first");
}

std::string why_endless(const Roll& roll, const Motion& motion) {
  const double last = motion.last_speed();
  if (std::isinf(last)) return "the body gains speed on this slope for ever";
  if (last > 0)
    return fmt::format("the body never stops on this slope: its speed tends to {:.4g} m/s", last);
  return roll.law.b < 0 ? "the shift grows to the radius before the body stops"
                        : "the body never stops";
}

}  // namespace

int main(int argc, char** argv) {
  using enum BodyOption;
  Tool tool("simulate", "Roll a body on a mat under a law D(v).");
  Roll roll{};
  Body& body = roll.body;
  PowerLaw& law = roll.law;
  Bulge& bulge = roll.bulge;
  double& v0 = roll.v0 = not_given;
  Method method{};
  SonarOptions sonar;
  double dt = 0.01, until = not_given, rtol = 1e-10;
  std::size_t seed = 1;
  std::string times_file, law_file, columns = "t,x,v,a,D";
  bool sensor = false, with_report = false;
  tool.body(body, {radius, shape_factor, gravity, slope});
  tool.law(law);
  tool.geometry(roll.geometry);
  tool.number("--v0", v0, not_negative, "speed at t = 0 [m/s]");
  tool.number("--x0", roll.x0, any_number, "position at t = 0 [m] (0)");
  tool.number("--dt", dt, positive, "time between rows [s] (0.01)");
  tool.number("--until", until, not_negative, "time of the last row [s] (the stop)");
  tool.text("--at", times_file, "FILE", "file with a column t: the times of the rows, instead");
  tool.text("--columns", columns, "NAME,...", "what to compute, of t,x,v,a,D (all)");
  tool.text("--law", law_file, "FILE",
            "file (- is standard input) with a table of v D, or with a row of fitpower: a, b and "
            "v0 that are not given otherwise");
  tool.number("--memory", bulge.length, positive,
              "length over which the bulge follows the law [m]: rolls backwards before rest");
  tool.number("--damping", bulge.damping, not_negative, "damping of the bulge [s] (0)");
  tool.choice("--method", method, methods,
              "how v(t) is found: closed, exact, or else a solver (the cheapest that is exact)");
  tool.number("--rtol", rtol,
              {"from 1e-14 to 0.1", [](double x) { return x >= 1e-14 && x <= 0.1; }},
              "relative tolerance of a solver's step (1e-10)");
  tool.flag("--report", with_report,
            "on standard error, error against run time of the methods on this scene");
  tool.choice<bool>("--sensor", sensor, {{"pasco", true}},
                    "write what this motion sensor records, push and rest included");
  tool.count("--seed", seed, whole, "seed of the sensor's noise (1)");
  tool.number("--rate", sonar.rate, positive, "records of the sensor a second (25)");
  tool.number("--resolution", sonar.resolution, not_negative,
              "resolution of the sensor [m] (0.001)");
  tool.number("--noise", sonar.noise, not_negative,
              "noise of a position before it is rounded [m] (0.0003)");
  tool.number("--lost", sonar.lost, {"from 0 to below 1", [](double x) { return x >= 0 && x < 1; }},
              "share of lost echoes (0.01)");
  tool.scene();
  tool.output();

  return tool.run(argc, argv, [&] {
    if (!law_file.empty()) roll.table = read_law(tool, law_file, law, body.slope, &v0);
    std::vector<std::string> needed = {"radius", "shape-factor", "v0"};
    if (!roll.table) needed.insert(needed.end(), {"coefficient", "exponent"});
    tool.need(needed);
    if (bulge.length == 0 && bulge.damping > 0) fail("--damping goes with --memory");
    if (!tool.on_command_line("method")) method = best_method(roll);
    if (method.kind != Method::solver && !with_report && tool.on_command_line("rtol"))
      fail("--rtol goes with a solver: there is no tolerance here");

    if (with_report) report(tool, roll, rtol, std::isnan(until) ? 10 : until);
    if (sensor) {
      sonar.seed = seed;
      if (!std::isnan(until)) sonar.until = until;
      write_record(tool.out, *start(roll, method, rtol), sonar);
      return 0;
    }

    const auto row = chosen(columns, quantities);
    const auto write_header = [&] {
      tool.out.text("## simulate " +
                    (roll.table ? "table" : fmt::format("a {} b {}", law.a, law.b)) +
                    fmt::format(" K {} R {} g {} v0 {}", body.K, body.R, body.g, v0) +
                    (body.slope == 0 ? "" : fmt::format(" slope {}", body.slope)));
      tool.out.end_line();
      tool.out.names(columns_of(row));
    };
    const bool only_t = row.size() == 1 && row[0].column.name == "t";
    const auto write = [&](double t, Motion& motion) {
      if (!only_t) motion.seek(t);
      for (const auto& quantity : row) tool.out.cell(quantity.of(t, motion));
      tool.out.end_line();
    };

    if (!times_file.empty()) {
      Reader& in = tool.read_file(times_file, {"t"});
      const auto t = in.need_time();
      write_header();
      for (bool first = true; in.next_run(); first = false) {
        if (!first) tool.out.end_line();
        const auto motion = start(roll, method, rtol);
        while (in.next()) {
          if (in[t] < 0) fail("t = {} is before the roll, which begins at 0", in[t]);
          write(in[t], *motion);
        }
      }
      return 0;
    }
    const auto motion = start(roll, method, rtol);
    const bool to_the_stop = std::isnan(until);
    const double end = to_the_stop ? motion->stop_time() : until;
    if (!std::isfinite(end)) fail("{}: say --until when to end", why_endless(roll, *motion));
    const double steps = std::floor(
        end / dt +
        (to_the_stop ? -1e-9 : 1e-9));  // rounding of end / dt makes no row and loses none
    if (steps > 1e9) fail("these are {:.3g} rows; the most is 1e9: --dt is too small", steps);
    const Clock clock{dt};
    write_header();
    for (double k = 0; k <= steps; ++k) write(clock.at(k), *motion);
    if (to_the_stop) write(end, *motion);
    return 0;
  });
}
