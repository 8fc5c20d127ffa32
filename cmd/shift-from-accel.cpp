// shift-from-accel - append the shift D of the contact force, from the acceleration; see
// shift-from-accel(1)
#include "cli/tool.h"
#include "contact/contact.h"
#include "text/filter.h"

int main(int argc, char** argv) {
  using namespace rolling;
  using enum BodyOption;
  Tool tool("shift-from-accel",
            "Append the forward shift D of the contact force, from the acceleration.");
  Body body;
  Geometry geometry;
  tool.body(body, {radius, shape_factor, gravity});
  tool.geometry(geometry);
  tool.scene();
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    tool.need({"radius", "shape-factor"});
    Reader& in = tool.read({"t", "v", "a"});
    const auto a = in.need("a");
    Filter filter(in, tool.out,
                  fmt::format("shift-from-accel {}K {} R {} g {}",
                              geometry == Geometry::exact ? "exact " : "", body.K, body.R, body.g));
    filter.append({"D", "m"});
    while (filter.next_run())
      while (filter.next()) filter.put(shift_from_acceleration(body, geometry, filter[a]));
    return 0;
  });
}
