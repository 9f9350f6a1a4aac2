#pragma once

#include "mis/io/text_layout.h"
#include "mis/report/explanation.h"

#include <cstdint>
#include <string>

namespace mis {

/// What a report says of the run itself.
struct RunHeader {
    std::string command;
    std::uint64_t seed = 1;
    int threads = 1;
};

/// As a terminal shows it.
std::string explanation_text(const Explanation& found, const TextLook& look = {});

/// As `mis-explain/1`: the outer shape of mis-report/1. "-" is standard output. Throws WriteError.
void write_explanation_json(const Explanation& found, const RunHeader& run,
                            const std::string& path);

}  // namespace mis
