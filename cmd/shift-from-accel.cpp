// shift-from-accel - append the shift D of the contact force, from the acceleration; see
// shift-from-accel(1)
#include <cmath>

#include "cli/tool.h"
#include "contact/contact.h"
#include "text/filter.h"

int main(int argc, char** argv) {
  using namespace rolling;
  Tool tool("shift-from-accel",
            "Append the forward shift D of the contact force, from the acceleration.");
  Body body;
  Geometry geometry;
  tool.body(body, "KRg");
  tool.number("--slope", body.slope, any_number,
              "slope of the mat: it rises by so many metres a metre along growing x (0)");
  tool.geometry(geometry);
  tool.scene();
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    tool.need(body, "KR");
    Reader& in = tool.read({"t", "v", "a"});
    const auto a = in.need("a");
    Filter filter(in, tool.out,
                  fmt::format("shift-from-accel {}K {} R {} g {}{}",
                              geometry == Geometry::exact ? "exact " : "", body.K, body.R, body.g,
                              body.slope == 0 ? "" : fmt::format(" slope {}", body.slope)));
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
