#pragma once

#include <limits>

namespace mis {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
/// A figure that there is not.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace mis
