#pragma once

#include "mis/cli/options.h"
#include "mis/engine/lit_scene.h"
#include "mis/scene/named.h"
#include "mis/study/explain.h"
#include "mis/trace/embree.h"

#include <fmt/format.h>

#include <memory>

namespace mis::cli {

/// A scene file read and made ready: what every command that runs starts from. Throws what reading
/// throws.
struct ReadyScene {
    ReadyScene(const std::string& file, const RunOptions& options)
        : executor(make_executor(options)), scene(read_scene_for(file, options)),
          tracer(scene.surfaces.empty() && options.effects != "all"
                     ? nullptr
                     : std::make_unique<EmbreeTracer>(scene)),
          lit(scene, tracer.get(),
              options.effects == "all" ? all_effects(scene) : called_for(scene))
    {
        if (const std::string name = effect_off(options); !name.empty()) require_off(name);
    }
    ReadyScene(const ReadyScene&) = delete;
    ReadyScene& operator=(const ReadyScene&) = delete;

    /// Throws UsageError where some tile calls for that effect.
    void require_off(const std::string& name) const
    {
        const Explanation explanation = explain(lit, executor);
        const EffectPlan* plan = find_named(explanation.effects, name);
        if (plan != nullptr && plan->on)
            throw UsageError(
                fmt::format("--effects {}=off: {:.3g} % of the tiles of {} call for it: {}", name,
                            100 * plan->share, scene.file, plan->why));
    }

    AnyExecutor executor;
    Scene scene;
    std::unique_ptr<SurfaceTracer> tracer;  ///< nullptr where there is nothing to trace
    LitScene lit;
};

}  // namespace mis::cli
