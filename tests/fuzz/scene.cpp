// SPDX-License-Identifier: GPL-3.0-or-later
// A scene file of any bytes: taken with values of the right kind, or refused.
#include <cmath>
#include <cstdint>

#include "cli/law_file.h"
#include "cli/tool.h"
#include "streams.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rolling;
  const MemoryFile file({reinterpret_cast<const char*>(data), size});
  Body body{};
  LawOptions law;
  double v0 = 0;
  const Ran ran = with_streams("", [&] {
    Tool tool("scene", "");
    tool.body(body, {&Body::m, &Body::R, &Body::K, &Body::g, &Body::slope});
    add_options(tool, law);
    tool.geometry(body.exact);
    tool.number("--v0", v0, not_negative, "");
    tool.scene();
    std::string program = "scene", option = "--scene", path = file.path();
    char* arguments[] = {program.data(), option.data(), path.data(), nullptr};
    return tool.run(3, arguments, [&] { return tool.out.text("read\n"), 0; });
  });
  check_contract(ran, "scene");
  if (ran.status != 0) return 0;
  const auto holds = [](double value, const Domain& domain) {
    return std::isnan(value) || (std::isfinite(value) && domain.holds(value));
  };
  require(holds(body.m, positive) && holds(body.R, positive) && holds(body.K, not_negative) &&
              holds(body.g, positive),
          "a body that is none");
  require(holds(law.power.a, positive) && holds(law.power.b, any_number) && holds(v0, not_negative),
          "a law that is none");
  return 0;
}
