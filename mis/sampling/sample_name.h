#pragma once

#include <cstdint>

namespace mis {

/// Which sample it was, as `mis replay` takes it.
struct SampleName {
    std::uint32_t point = 0;   ///< id of the shading point
    std::uint64_t sample = 0;  ///< its number at that point
};

}  // namespace mis
