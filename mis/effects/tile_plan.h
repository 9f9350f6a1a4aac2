#pragma once

#include "mis/effects/blockers.h"
#include "mis/effects/effects.h"
#include "mis/effects/shaft.h"
#include "mis/scene/scene.h"
#include "mis/scene/shading_point.h"
#include "mis/trace/lights.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mis {

/// What is proved of the points of a tile and one light; bits.
enum LightProof : std::uint8_t {
    unshadowed = 1,  ///< no surface stands between them
    unhidden = 2,    ///< no other light does
    below = 4        ///< the light is wholly below the horizon of every point
};

/// What one tile calls for. Plain data.
struct TilePlan {
    /// Of effects_of_tiles; shadows and light occlusion: of any light that is not below.
    EffectSet effects = effects_of_tiles;
    std::vector<std::uint8_t> lights;          ///< [light]: its proofs; empty: none
    std::shared_ptr<const Blockers> blockers;  ///< null: the hierarchy is asked
};

/// Finds the plans of a scene's tiles: what surfaces and lights provably do not stand between the
/// points of a tile and a light, by planes that separate them from all that lies between. A gap
/// must be wider than what float rays may pass beside.
class TilePlanner {
public:
    /// frame: SurfaceTracer::origin(); scene: kept by reference. hierarchy: of its lights.
    TilePlanner(const Scene& scene, const LightHierarchy& hierarchy, const Effects& effects,
                const Vec3<double>& frame);

    /// What a tile of these points calls for. points: at least one.
    TilePlan plan(std::span<const ShadingPoint> points) const;

    /// The same with all that can be proved, whether or not that pays for the samples to come.
    TilePlan proved(std::span<const ShadingPoint> points) const;

    /// So many samples are to come of every point, of all strategies; of plans that are made then.
    void expect_samples(double of_point) const { budget_->expect_samples(of_point); }

private:
    /// A surface as the proofs see it: the hull of some corners, or a ball.
    struct Body {
        std::vector<Vec3<double>> corners;  ///< of a quad or a mesh's box; empty: a ball
        Vec3<double> center{0};
        double radius = 0;  ///< around all of it
        bool is_flat = false;
        Vec3<double> normal{0};  ///< of a quad
        double clearance = 0;    ///< of a quad: above it, rays start off it
    };

    /// How far ray origins of a tile lie above a quad's plane, and below it, at least.
    struct Heights {
        double above, below;
    };
    struct TileBounds;

    TileBounds bounds_of(std::span<const ShadingPoint> points) const;
    Heights heights(const Body& quad, std::span<const ShadingPoint> points) const;
    static bool stays_above(const TileBounds& tile, const Body& quad, const Heights& over);
    bool is_unshadowed(const TileBounds& tile, const Shaft& shaft) const;
    bool is_unhidden(const Shaft& shaft, std::size_t light) const;
    bool are_lights_above(const TileBounds& tile) const;
    bool pays_to_prove_each(std::size_t points) const;
    bool can_prove_each() const;
    TilePlan plan(std::span<const ShadingPoint> points, bool proves_each) const;
    void prove_all_at_once(const TileBounds& tile, TilePlan& plan) const;
    void prove_each(const TileBounds& tile, TilePlan& plan) const;

    const Scene* scene_;
    Effects effects_;
    Vec3<double> frame_;
    std::shared_ptr<ListBudget> budget_ = std::make_shared<ListBudget>(Blockers::most_bytes);
    std::shared_ptr<const FloatSpheres> spheres_;  ///< null where there are too many lights
    std::vector<Body> bodies_;
    Vec3<double> lights_center_{0};
    double lights_radius_ = 0;
};

}  // namespace mis
