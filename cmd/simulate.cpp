// simulate - roll a body under the law D = a v^b; see simulate(1)
#include <cmath>

#include "cli/tool.h"
#include "rolling/closed_form.h"
#include "rolling/exact_form.h"
#include "rolling/memory.h"
#include "sensor/sonar.h"

using namespace rolling;

namespace {

struct Quantity {
  Column column;
  double (*of)(double t, Motion&);
};

const std::vector<Quantity> quantities = {
    {{"t", "s"}, [](double t, Motion&) { return t; }},
    {{"x", "m"}, [](double, Motion& motion) { return motion.position(); }},
    {{"v", "m/s"}, [](double, Motion& motion) { return motion.velocity(); }},
    {{"a", "m/s^2"}, [](double, Motion& motion) { return motion.acceleration(); }},
    {{"D", "m"}, [](double, Motion& motion) { return motion.shift(); }},
};

std::vector<Quantity> chosen(const std::string& list) {
  std::vector<Quantity> chosen;
  for (const std::string& name : split_names(list, ',')) {
    const auto same = [&](const Quantity& q) { return q.column.name == name; };
    const auto found = std::find_if(quantities.begin(), quantities.end(), same);
    if (found == quantities.end() || std::any_of(chosen.begin(), chosen.end(), same))
      fail("--columns: '{}' is not a list of t, x, v, a, D", shown(list));
    chosen.push_back(*found);
  }
  return chosen;
}

/// The times 0, dt, 2 dt, ...; where 1/dt is a whole number (25 Hz), each the double nearest to k/rate.
struct Clock {
  double dt;
  double at(double k) const {
    const double rate = std::round(1 / dt);
    return rate * dt == 1 ? k / rate : k * dt;
  }
};

/// Comma-separated with a names line and blank cells, as such programs export it.
void write_record(Output& out, const std::vector<SonarSample>& record) {
  out.line() += "Time (s),Position (m),Velocity (m/s)";
  out.end_line();
  for (const SonarSample& sample : record) {
    out.number(sample.t);
    out.line() += ',';
    if (sample.x) out.number(*sample.x);
    out.line() += ',';
    if (sample.v) out.number(*sample.v);
    out.end_line();
  }
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("simulate", "Roll a body on a mat under the law D = a v^b.");
  Body body;
  PowerLaw law;
  Geometry geometry;
  Bulge bulge{0};
  SonarOptions sonar;
  double v0 = not_given, x0 = 0, dt = 0.01, until = not_given;
  std::size_t seed = 1;
  std::string times_file, law_file, columns = "t,x,v,a,D";
  bool sensor = false;
  tool.body(body, "RKg");
  tool.law(law);
  tool.geometry(geometry);
  tool.number("--v0", v0, not_negative, "speed at t = 0 [m/s]");
  tool.number("--x0", x0, any_number, "position at t = 0 [m] (0)");
  tool.number("--dt", dt, positive, "time between rows [s] (0.01)");
  tool.number("--until", until, not_negative, "time of the last row [s] (the stop)");
  tool.text("--at", times_file, "FILE", "file with a column t: the times of the rows, instead");
  tool.text("--columns", columns, "NAME,...", "what to compute, of t,x,v,a,D (all)");
  tool.text("--law", law_file, "FILE", "file (- is standard input) with a row of fitpower: a, b and v0 that are not given otherwise");
  tool.number("--memory", bulge.length, positive, "length over which the bulge follows the law [m]: rolls backwards before rest");
  tool.number("--damping", bulge.damping, not_negative, "damping of the bulge [s] (0)");
  tool.choice<bool>("--sensor", sensor, {{"pasco", true}}, "write what a motion sensor records, push and rest included: pasco");
  tool.count("--seed", seed, whole, "seed of the sensor's noise (1)");
  tool.number("--rate", sonar.rate, positive, "records of the sensor a second (25)");
  tool.number("--resolution", sonar.resolution, not_negative, "resolution of the sensor [m] (0.001)");
  tool.number("--noise", sonar.noise, not_negative, "noise of a position before it is rounded [m] (0.0003)");
  tool.number("--lost", sonar.lost, {"from 0 to below 1", [](double x) { return x >= 0 && x < 1; }}, "share of lost echoes (0.01)");
  tool.scene();
  tool.output();

  return tool.run(argc, argv, [&] {
    if (!law_file.empty()) {
      Reader& in = tool.read_file(law_file, {});
      const auto a = in.need_as_is("a"), b = in.need_as_is("b");
      const bool has_v0 = in.find("v0").has_value();
      const auto fitted_v0 = has_v0 ? in.need_as_is("v0") : a;
      if (!in.next_run() || !in.next()) fail("{}: no row of fitpower", shown(law_file));
      if (!tool.on_command_line("coefficient")) law.a = in[a];
      if (!tool.on_command_line("exponent")) law.b = in[b];
      if (has_v0 && !tool.on_command_line("v0")) v0 = in[fitted_v0];
      if (in.next() || in.next_run()) fail("more than one row: a law is one row of fitpower");
    }
    tool.need(body, "RK");
    tool.need(law);
    tool.need(v0, "--v0");
    if (bulge.length == 0 && bulge.damping > 0) fail("--damping goes with --memory");

    const auto roll = [&]() -> std::unique_ptr<Motion> {
      if (bulge.length > 0) return std::make_unique<MemoryRoll>(body, geometry, law, bulge, v0, x0);
      if (geometry == Geometry::exact) return std::make_unique<ExactForm>(body, law, v0, x0);
      return std::make_unique<ClosedForm>(body, law, v0, x0);
    };
    if (sensor) {
      sonar.seed = seed;
      if (!std::isnan(until)) sonar.until = until;
      write_record(tool.out, sonar_record(*roll(), sonar));
      return 0;
    }

    const std::vector<Quantity> row = chosen(columns);
    const auto write_header = [&] {
      std::vector<Column> names;
      for (const Quantity& quantity : row) names.push_back(quantity.column);
      tool.out.line() += fmt::format("## simulate a {} b {} K {} R {} g {} v0 {}", law.a, law.b, body.K, body.R, body.g, v0);
      tool.out.end_line();
      tool.out.names(names);
    };
    const auto write = [&](double t, Motion& motion) {
      motion.seek(t);
      for (const Quantity& quantity : row) tool.out.cell(quantity.of(t, motion));
      tool.out.end_line();
    };

    if (!times_file.empty()) {
      Reader& in = tool.read_file(times_file, {"t"});
      const auto t = in.need_time();
      write_header();
      for (bool first = true; in.next_run(); first = false) {
        if (!first) tool.out.end_line();
        const auto motion = roll();
        while (in.next()) {
          if (in[t] < 0) fail("t = {} is before the roll, which begins at 0", in[t]);
          write(in[t], *motion);
        }
      }
      return 0;
    }
    const auto motion = roll();
    const bool to_the_stop = std::isnan(until);
    const double end = to_the_stop ? motion->stop_time() : until;
    if (!std::isfinite(end)) fail("the body never stops: say --until when to end");
    const double steps = std::floor(end / dt + (to_the_stop ? -1e-9 : 1e-9));  // rounding of end / dt makes no row and loses none
    if (steps > 1e9) fail("these are {:.3g} rows; the most is 1e9: --dt is too small", steps);
    const Clock clock{dt};
    write_header();
    for (double k = 0; k <= steps; ++k) write(clock.at(k), *motion);
    if (to_the_stop) write(end, *motion);
    return 0;
  });
}
