// SPDX-License-Identifier: GPL-3.0-or-later
// shift-from-accel - append the shift D of the contact force, from the acceleration; see
// shift-from-accel(1)
#include <cmath>

#include "cli/history.h"
#include "cli/tool.h"
#include "contact/contact.h"
#include "text/row_pipe.h"

int main(int argc, char** argv) {
  using namespace rolling;
  Tool tool("shift-from-accel",
            "Append the forward shift D of the contact force, from the acceleration.");
  Body body{};
  tool.body(body, {&Body::R, &Body::K, &Body::g, &Body::slope});
  tool.geometry(body.exact);
  tool.scene();
  tool.input();
  tool.output();

  return tool.run(argc, argv, [&] {
    tool.need({"radius", "shape-factor"});
    Reader& in = tool.read({"t", "v", "a"});
    const auto a = in.need("a");
    RowPipe pipe(in, tool.out, line_of(body));
    pipe.append({"D", "m"});
    std::size_t rows = 0;
    std::size_t beyond = 0;
    while (pipe.next_run())
      while (pipe.next()) {
        const double D = shift_from_acceleration(body, pipe[a]);
        ++rows;
        beyond += std::abs(D) > body.R;
        pipe.put(D);
      }
    if (beyond > 0)
      tool.warn(fmt::format("D is beyond the radius {} m in {} of {} rows: {}", body.R, beyond,
                            rows,
                            2 * beyond > rows ? "the unit of a is probably wrong: --use "
                                                "gives another one, as 'a=COLUMN[UNIT]'"
                                              : "the acceleration is noisy"));
    return 0;
  });
}
