#pragma once

#include "mis/cli/options.h"

#include <string>

namespace mis::cli {

struct PredictOptions {
    std::string scene;
    std::string policies, heuristics, techniques, models,
        strategies;   ///< lists; empty: the default
    int threads = 0;  ///< 0: as many as the machine has
    bool quiet = false;
    std::string command_line;
    OutputOptions output;
};
void add_predict(CLI::App& app, PredictOptions& options);

/// Mean and variance of every strategy at each probe of a scene, by quadrature. Returns `failed`
/// where a probe cannot be predicted (a mesh or quad could hide its lights), `interrupted` after
/// Ctrl-C. Throws as commands.h says.
int run_predict(const PredictOptions& options);

}  // namespace mis::cli
