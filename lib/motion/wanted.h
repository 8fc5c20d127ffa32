// The quantities of a roll that a caller requests for one time.
#pragma once

namespace rolling {

/// The speed with its derivatives by the parameters, or the distance with its derivatives as well,
/// which takes about twice as long.
enum class Wanted { speed, speed_and_distance };

}  // namespace rolling
