// SPDX-License-Identifier: GPL-3.0-or-later
// shift-from-accel - append the shift D of the contact force, from the acceleration; see
// shift-from-accel(1)
#include <cmath>

#include "cli/tool.h"
#include "contact/contact.h"
#include "text/estimate.h"
#include "text/filter.h"

using namespace rolling;

namespace {

/// The `##` line for fitpower: the numbers from which D was computed, with their uncertainties.
std::string history(const Body& body, const BodyUncertainty& given, Geometry geometry) {
  std::string line =
      fmt::format("shift-from-accel {}K {} R {} g {}", geometry == Geometry::exact ? "exact " : "",
                  to_text(Estimate{body.K, given.K}), to_text(Estimate{body.R, given.R}),
                  to_text(Estimate{body.g, given.g}));
  if (body.slope != 0 || given.slope != 0)
    line += " slope " + to_text(Estimate{body.slope, given.slope});
  return line;
}

}  // namespace

int main(int argc, char** argv) {
  using enum BodyOption;
  Tool tool("shift-from-accel",
            "Append the forward shift D of the contact force, from the acceleration.");
  Body body;
  BodyUncertainty given;
  Geometry geometry;
  tool.body(body, {radius, shape_factor, gravity, slope}, &given);
  tool.geometry(geometry);
  tool.scene();
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    tool.need({"radius", "shape-factor"});
    Reader& in = tool.filter({"t", "v", "a"});
    const auto a = in.need("a");
    Filter filter(in, tool.out, history(body, given, geometry));
    filter.append({"D", "m"});
    std::size_t beyond = 0;
    while (filter.next_run())
      while (filter.next()) {
        const double D = shift_from_acceleration(body, geometry, filter[a]);
        beyond += std::abs(D) > body.R;
        filter.put(D);
      }
    if (beyond > 0)
      tool.warn(fmt::format("{} shift{} beyond the radius {} m: the acceleration is noisy", beyond,
                            beyond == 1 ? " is" : "s are", body.R));
    return 0;
  });
}
