// The 16-point Gauss-Legendre rule.
#pragma once

#include <array>

namespace rolling {

struct GaussNode {
  double x, weight;
};
/// The nodes on (-1, 1), from the ends to the middle.
inline constexpr auto gauss_legendre = [] {
  constexpr GaussNode positive[]{{0.9894009349916499326, 0.027152459411754094852},
                                 {0.94457502307323257608, 0.062253523938647892863},
                                 {0.86563120238783174388, 0.09515851168249278481},
                                 {0.7554044083550030339, 0.12462897125553387205},
                                 {0.61787624440264374845, 0.14959598881657673208},
                                 {0.45801677765722738634, 0.16915651939500253819},
                                 {0.28160355077925891323, 0.18260341504492358887},
                                 {0.095012509837637440185, 0.18945061045506849629}};
  std::array<GaussNode, 16> nodes{};
  auto to = nodes.begin();
  for (const auto& [x, weight] : positive) *to++ = {x, weight}, *to++ = {-x, weight};
  return nodes;
}();

}  // namespace rolling
