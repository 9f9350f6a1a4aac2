#pragma once

#include "bench/figures.h"

#include <string>

namespace mis::bench {

/// The machine and the build, in words.
struct Setting {
    std::string machine, instruction_set;
    int repetitions = 0;
};

/// Each bar with its limit, what was measured, and whether it is reached; then the time of every
/// benchmark by stage. What was not run is left out.
std::string table_of(const Bars& bars, const Figures& figures, const Setting& setting);

/// The same, with every repetition: mis-bench/1, docs/performance.md.
std::string json_of(const Bars& bars, const Figures& figures, const Setting& setting);

}  // namespace mis::bench
