#pragma once

#include <cstdint>

namespace host {

/// PCG32 (O'Neill 2014): one per thread of work, set to a stream of its own.
class Random {
public:
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : step_(stream << 1 | 1U)
    {
        bits(), state_ += seed, bits();
    }
    std::uint32_t bits()
    {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005ULL + step_;
        const auto mixed = static_cast<std::uint32_t>((old >> 18 ^ old) >> 27);
        const auto turn = static_cast<std::uint32_t>(old >> 59);
        return mixed >> turn | mixed << (-turn & 31U);
    }
    std::uint64_t bits64()
    {
        const std::uint64_t high = bits();
        return high << 32 | bits();
    }
    float number() { return static_cast<float>(bits() >> 8) * 0x1p-24F; }  ///< in [0, 1)

private:
    std::uint64_t state_ = 0, step_;
};

}  // namespace host
