#pragma once

#include "mis/cli/interrupt.h"
#include "mis/cli/options.h"
#include "mis/engine/lit_scene.h"
#include "mis/engine/stopwatch.h"
#include "mis/report/setup_seconds.h"
#include "mis/scene/named.h"
#include "mis/study/explain.h"
#include "mis/trace/embree.h"

#include <fmt/format.h>

#include <memory>

namespace mis::cli {

/// What make() gives; `seconds` becomes how long it took.
auto timed(double& seconds, const auto& make)
{
    struct Watch {
        double& seconds;
        Clock::time_point start = Clock::now();
        ~Watch() { seconds = seconds_since(start); }
    } const watch{seconds};
    return make();
}

/// A scene file read and made ready: what every command that runs starts from. Throws what reading
/// throws, and Stopped once interrupted.
struct ReadyScene {
    ReadyScene(const std::string& file, const RunOptions& options)
        : executor(make_executor(options)),
          scene(timed(setup.reading, [&] { return read_scene_for(file, options); })),
          tracer(timed(setup.surfaces,
                       [&]() -> std::unique_ptr<SurfaceTracer> {
                           if (scene.surfaces.empty() && options.effects != "all") return nullptr;
                           return std::make_unique<EmbreeTracer>(scene, interrupt_token());
                       })),
          lit(timed(setup.lights, [&] {
              return LitScene(scene, tracer.get(),
                              options.effects == "all" ? all_effects(scene) : called_for(scene),
                              interrupt_token());
          }))
    {
        if (const std::string name = effect_off(options); !name.empty()) require_off(name);
    }
    ReadyScene(const ReadyScene&) = delete;
    ReadyScene& operator=(const ReadyScene&) = delete;

    /// Throws UsageError where some tile calls for that effect.
    void require_off(const std::string& name) const
    {
        const Explanation explanation = explain(lit, stoppable_executor(), interrupt_token());
        const EffectPlan* plan = find_named(explanation.effects, name);
        if (plan != nullptr && plan->on)
            throw UsageError(
                fmt::format("--effects {}=off: {:.3g} % of the tiles of {} call for it: {}", name,
                            100 * plan->share, scene.file, plan->why));
    }

    /// For work that is worth nothing before it is done: throws Stopped once interrupted.
    AnyExecutor stoppable_executor() const { return stoppable(executor, interrupt_token()); }

    SetupSeconds setup;
    AnyExecutor executor;
    Scene scene;
    std::unique_ptr<SurfaceTracer> tracer;  ///< nullptr where there is nothing to trace
    LitScene lit;
};

}  // namespace mis::cli
