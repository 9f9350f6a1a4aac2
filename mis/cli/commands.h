#pragma once

#include "mis/cli/options.h"

#include <array>
#include <optional>
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
    std::optional<std::string> policies, heuristics, techniques, models,
        strategies;                            ///< lists; the default where not given
    std::vector<double> at{16};                ///< samples per point: the first ranks
    std::optional<double> fail_on_regression;  ///< percent; of two reports
    std::vector<std::string>
        given_for_scenes;  ///< options on the line that two reports do not take
    std::string out;       ///< folder, or empty
    bool force = false, trap = false;
    bool own_samples = false;  ///< variances come from these alone
    RunOptions run;
    StopOptions stop;
    OutputOptions output;
};
int run_compare(const CompareOptions& options);
/// The same where the files are two reports: what changed. Returns `failed` after a regression, if
/// --fail-on-regression is given.
int run_changes(const CompareOptions& options);

struct CostCommandOptions {
    std::string scene;
    std::optional<std::string> policies, heuristics, techniques, models,
        strategies;  ///< lists; the default where not given
    std::optional<std::string>
        precisions;  ///< float, double; not given: float, and the best one in double
    RunOptions run;
    StopOptions stop;
    OutputOptions output;
};
/// Error against time of every strategy, measured by doubling its samples. Returns `interrupted`
/// after Ctrl-C, with what there is. Throws as all do.
int run_cost(const CostCommandOptions& options);

struct ExplainOptions {
    std::string scene;
    RunOptions run;
    OutputOptions output;
};
int run_explain(const ExplainOptions& options);

struct ReplayOptions {
    std::string scene, strategy;
    std::optional<std::uint32_t> point;
    std::optional<std::array<int, 2>> pixel;  ///< in place of the point: column, row
    std::uint64_t sample = 0;
    std::optional<std::uint64_t> at;  ///< samples per scrambling
    RunOptions run;
};
int run_replay(const ReplayOptions& options);

struct IntegrateOptions {
    std::string pdf = "all";              ///< hemisphere, cosine, angles, blinn; or all
    std::optional<std::string> exponent;  ///< of the lobe, as typed; 10 where it is not
    std::string samples = "10000";        ///< as typed
    std::uint64_t seed = 1;
    std::string command_line;
    OutputOptions output;
};
/// The densities and how each draws, line by line.
std::string densities_help();
/// Their names, and all.
std::string densities();
int run_integrate(const IntegrateOptions& options);

struct PredictOptions {
    std::string scene;
    std::optional<std::string> policies, heuristics, techniques, models,
        strategies;   ///< lists; the default where not given
    int threads = 0;  ///< 0: as many as the machine has
    bool quiet = false;
    std::string command_line;
    OutputOptions output;
};
/// Mean and variance of every strategy at each probe of a scene, by quadrature. Returns `failed`
/// where a probe cannot be predicted (a mesh or quad could hide its lights), `interrupted` after
/// Ctrl-C. Throws as all do.
int run_predict(const PredictOptions& options);

}  // namespace mis::cli
