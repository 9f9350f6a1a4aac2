#pragma once

#include "mis/stats/overall.h"
#include "mis/stats/rank.h"
#include "tests/support/simulated.h"

#include <string>

namespace mis {

/// A scene with a strategy in every state: ranked, tied, exact, not resolved, biased, not run, and
/// one that chooses no light.
inline SceneReport sample_scene(const std::string& name, std::uint64_t seed = 1)
{
    const Simulation sim{.seed = seed};
    StrategyMeasurements best = simulate("solid-angle", uniform_samples(0.02), sim), twin = best;
    twin.strategy = {.policy = "radiant-solid-angle", .heuristic = "balance"};
    best.stage_seconds = {{"choose", 1e-4}, {"occlusion", 2e-4}};
    best.rays = 30000;
    for (int i = 0; i < 2; ++i)
        best.probes.push_back(
            Moments::of(std::span<const double>(std::vector<double>{1, 2, 0.5, 1})));
    StrategyMeasurements exact = simulate_exact("uniform", sim);
    exact.strategy.heuristic = "light";
    exact.strategy.counts = {1, 0};
    StrategyMeasurements wrong = simulate(
        "power", [](Random& bits) { return 1.2 * uniform_samples(0.1)(bits); }, sim);
    wrong.strategy.model = Model::one_sample;
    StrategyMeasurements brdf = simulate("", rare_samples(1e-4), sim);
    brdf.strategy = {.policy = "", .heuristic = "", .technique = "brdf"};
    StrategyMeasurements dear;
    dear.strategy = {.policy = "all", .heuristic = "balance", .counts = {4, 1}};
    dear.was_run = false;
    dear.not_run_reason = reason::AsWritten{"its budget is past, said \"enough\""};
    dear.estimated_seconds = 600;

    Ranking ranking = rank({.points = 64,
                            .strategies = {best, twin, exact, wrong, brdf, dear,
                                           simulate("uniform", uniform_samples(0.9), sim)}},
                           {.threads = 2});
    SceneReport scene;
    scene.file = "scenes/" + name + ".json";
    scene.name = name;
    scene.lights = 5;
    scene.surfaces = 7;
    scene.width = scene.height = 8;
    scene.shading_points = 64;
    scene.epsilon = 0.01;
    scene.effects = {{"shadows", true, 0.8, "surfaces lie between points and lights", 0, 0},
                     {"horizon", false, 0, "no light is cut", 0.2, 1e-9}};
    put_ranking(std::move(ranking), 1.5, scene);
    return scene;
}

inline Report sample_report()
{
    Report report;
    report.version = "0.1.0";
    report.command = "mis compare a.json \"b, c.json\"";
    report.machine = "a machine";
    report.instruction_set = "avx2";
    report.threads = 2;
    report.scenes = {sample_scene("plates"), sample_scene("a, \"quoted\" name", 2)};
    report.overall = rank_overall(report.scenes);
    return report;
}

}  // namespace mis
