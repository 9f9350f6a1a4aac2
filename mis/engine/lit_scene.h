#pragma once

#include "mis/bsdf/any_bsdf.h"
#include "mis/effects/effects.h"
#include "mis/effects/tile_plan.h"
#include "mis/engine/gbuffer.h"
#include "mis/engine/light_order.h"
#include "mis/engine/tile.h"
#include "mis/math/stop_token.h"
#include "mis/run/made_once.h"
#include "mis/run/pool.h"
#include "mis/scene/scene.h"
#include "mis/trace/lights.h"
#include "mis/trace/visibility.h"

#include <memory>
#include <string>
#include <vector>

namespace mis {

/// A scene made ready to be lit: the hierarchy over its lights, its BSDFs, and who answers for its
/// surfaces. Keeps references to the scene and the tracer.
class LitScene {
public:
    /// surfaces: nullptr where the scene has none. Throws Stopped.
    LitScene(const Scene& scene, const SurfaceTracer* surfaces, const Effects& effects,
             const StopToken& stop = {});

    /// What it was made of.
    const Scene& scene() const { return *scene_; }
    /// What is simulated.
    const Effects& effects() const { return effects_; }
    /// Which light does a ray meet?
    const LightHierarchy& lights() const { return hierarchy_; }
    /// Who answers shadow rays; nullptr where there are no surfaces.
    const SurfaceTracer* surfaces() const { return surfaces_; }
    /// So many samples are to come of every point, of all strategies, which says what pays to be
    /// prepared; before plan().
    void expect_samples(double of_point) const { planner_.expect_samples(of_point); }
    /// Finds out what each tile calls for, where that is asked for.
    void plan(GBuffer& buffer, const AnyExecutor& executor) const
    {
        if (effects_.by_tile) plan_tiles(buffer, planner_, executor);
    }
    /// What is simulated on surfaces of a material.
    Effects effects(int material) const;
    /// What a tile of these points calls for, by all that can be proved of it, whatever is
    /// simulated.
    TilePlan proved(std::span<const ShadingPoint> points) const { return planner_.proved(points); }
    /// How many of a buffer's tiles call for an effect.
    EffectShares tiles_that_call(const GBuffer& buffer) const;
    /// A view of a material's BSDF.
    AnyBsdf bsdf(int material) const
    {
        const auto i = static_cast<std::size_t>(material);
        return {bsdfs_[i].get(), bsdf_number(scene_->materials[i].type)};
    }

    /// The lobe of a material's BSDF alone, of the same type; nullptr where it has none.
    const void* lobe(int material) const
    {
        return lobes_[static_cast<std::size_t>(material)].get();
    }

    /// What kernels multiply radiance by, and results are divided by (engine/radiance_scale.h).
    double radiance_scale() const { return radiance_scale_; }
    /// A policy's tables, an object of its type (engine/choices.h), made when it
    /// is first asked for and then shared by all strategies. Throws Stopped.
    std::shared_ptr<const void> policy(const std::string& name, const StopToken& stop = {}) const;
    /// The order of Sobol' numbers, made once. Throws Stopped.
    std::shared_ptr<const LightOrder> order(const StopToken& stop = {}) const;
    /// A policy's tables in that order, made once, as well. Throws Stopped.
    std::shared_ptr<const void> policy_in_order(const std::string& name,
                                                const StopToken& stop = {}) const;

private:
    const Scene* scene_;
    const SurfaceTracer* surfaces_;
    Effects effects_;
    LightHierarchy hierarchy_;
    TilePlanner planner_;
    std::vector<std::shared_ptr<const void>> bsdfs_, lobes_;
    bool has_grey_lights_;
    double radiance_scale_;
    using Made = MadeOnce<std::shared_ptr<const void>>;
    std::shared_ptr<Made> policies_ = std::make_shared<Made>(),
                          policies_in_order_ = std::make_shared<Made>(),
                          orders_ = std::make_shared<Made>();
};

/// One strategy made ready on a scene: its policy's tables, and pipelines for each material, from
/// all that the scene calls for down to what the leanest tile does.
template <class T> class ReadyStrategy {
public:
    /// strategy: checked (strategy/strategy.h). kernels: kernels<T>(). Keeps references to scene
    /// and kernels. also: effects that no scene, tile or material has left out, whatever it calls
    /// for. Throws Stopped, and StrategyError where there are more lights than `strata` takes.
    ReadyStrategy(const LitScene& scene, const Strategy& strategy, const Kernels<T>& kernels,
                  NumberSource numbers, EffectSet also = {}, const StopToken& stop = {});

    /// A job over some points of a tile, or all of them; they are kept by reference.
    TileJob<T> job(const Tile& tile, std::span<const ShadingPoint> points) const;
    /// The stages for points of a material, whatever their tile calls for.
    const Pipeline<T>& pipeline(int material) const { return pipeline(material, TilePlan{}); }
    /// The stages for the points of a tile.
    const Pipeline<T>& pipeline(const Tile& tile) const
    {
        return pipeline(tile.material, tile.plan);
    }
    /// What it was made of.
    const Strategy& strategy() const { return strategy_; }

private:
    const Pipeline<T>& pipeline(int material, const TilePlan& plan) const
    {
        return pipelines_[static_cast<std::size_t>(material)][plan.effects.bits()];
    }

    const LitScene* scene_;
    Strategy strategy_;
    std::shared_ptr<const LightOrder> order_;  ///< of Sobol' numbers; else the scene's
    std::shared_ptr<const void> policy_;
    static_assert((effects_of_tiles.bits() & (effects_of_tiles.bits() + 1)) == 0, "the first ones");
    /// [material][bits of a tile's effects]
    std::vector<std::array<Pipeline<T>, effects_of_tiles.bits() + 1>> pipelines_;
    TileJob<T> common_;
};

extern template class ReadyStrategy<float>;
extern template class ReadyStrategy<double>;

/// Workspaces that threads borrow.
template <class T> using WorkspacePool = Pool<Workspace<T>>;

}  // namespace mis
