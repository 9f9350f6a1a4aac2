#pragma once

#include <cstdint>
#include <string>

namespace mis {

/// What a report says of the run that made it.
struct RunHead {
    std::string version, command, machine, instruction_set;
    std::uint64_t seed = 1;
    bool is_sobol = false;  ///< scrambled sequences; else independent samples
    int threads = 1;
    bool partial = false;
};

}  // namespace mis
