#pragma once

#include "mis/cli/options.h"

#include <string>
#include <vector>

namespace mis::cli {

// One function per command: runs it and returns its exit code. They throw UsageError,
// StrategyError, SceneError (exit 2), and std::runtime_error for what failed while running (exit
// 1).

struct RenderOptions {
    std::string scene, strategy = "radiant-solid-angle/power", out;
    RunOptions run;
    StopOptions stop;
};
int run_render(const RenderOptions& options);

struct CompareOptions {
    std::vector<std::string> scenes;
    std::string policies, heuristics, techniques, models,
        strategies;  ///< lists; empty: the default
    double at = 16;
    std::string out;  ///< folder, or empty
    bool force = false;
    RunOptions run;
    StopOptions stop;
    OutputOptions output;
};
int run_compare(const CompareOptions& options);

struct ExplainOptions {
    std::string scene;
    RunOptions run;
    OutputOptions output;
};
int run_explain(const ExplainOptions& options);

struct IntegrateOptions {
    std::string pdf = "all";              ///< hemisphere, cosine, angles, blinn; or all
    std::optional<std::string> exponent;  ///< of the lobe, as typed; 10 where it is not
    std::string samples = "10000";        ///< as typed
    std::uint64_t seed = 1;
    std::string command_line;
    OutputOptions output;
};
void add_integrate(CLI::App& app, IntegrateOptions& options);
int run_integrate(const IntegrateOptions& options);

}  // namespace mis::cli
