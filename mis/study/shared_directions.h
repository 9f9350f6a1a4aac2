#pragma once

#include "mis/math/cap.h"
#include "mis/math/frame.h"
#include "mis/study/shared_mixture.h"
#include "mis/study/shared_plan.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mis {

/// A shading point that directions are drawn at, with its material.
struct SharedPoint {
    ShadingPoint point;
    int material = 0;
};

/// Directions of one group: so many towards lights, by the BSDF's lobe, and by the cosine. Where
/// there is no lobe, its directions are by the cosine, too.
struct SharedCounts {
    int light = 5, lobe = 2, cosine = 1;
    int all() const { return light + lobe + cosine; }
};

/// A light along a direction.
struct AlongLight {
    LightIndex light;
    Cap<double> cap;
    bool rises;  ///< above the horizon, with some part of its cap
};

/// One direction, with all that any strategy asks of it.
struct SharedDirection {
    std::size_t group = 0;
    Vec3<double> wi{0};           ///< unit
    Vec3<double> local{0};        ///< the same in the shading frame
    LightIndex light = no_light;  ///< that it was drawn towards, or that stands nearest
    LightHit nearest;  ///< along it; only known to be another one where nothing more was asked
    double bsdf_pdf = 0;
    double value = 0;     ///< Y(f·L) cosθ of the nearest light; 0 where a surface is nearer
    double density = 0;   ///< D of this direction together with its light
    double marginal = 0;  ///< D summed over all lights along it; where all were asked for
    std::size_t first = 0, along = 0;  ///< lights along it; the first is `light`

    bool shows_its_light() const { return nearest.light == light; }
};

/// The directions of one round at one point: drawn in groups from one mixture, each traced once.
class DirectionSet {
public:
    /// Keeps references to scene and plan. Throws Stopped.
    DirectionSet(const LitScene& scene, const SharedPlan& plan, const SharedCounts& counts,
                 const StopToken& stop);

    /// Makes all ready for a point.
    void prepare(const SharedPoint& at);
    /// Draws, traces and prices the directions of a round.
    void draw(std::uint64_t round, std::uint64_t seed);

    std::span<const SharedDirection> directions() const { return directions_; }
    /// The i-th light along a direction; the first is the direction's own.
    LightIndex light_along(const SharedDirection& d, std::size_t i) const
    {
        return along_[d.first + i].light;
    }
    /// Density of a draw towards it by a light technique of the plan. Of a light that is below the
    /// horizon, all draws are lost: they are priced as the cone's, so that each density is of total
    /// mass 1.
    double pdf(std::size_t technique, const SharedDirection& d, std::size_t i) const
    {
        return pdfs_[(d.first + i) * plan_->techniques.size() + technique];
    }
    const LightMixture& mixture() const { return mixture_; }

private:
    void add_towards(std::size_t group, LightIndex light, bool by_cosine, const Vec2<double>& u);
    void add_over_hemisphere(std::size_t group, const Vec3<double>& local);
    void find_nearest();
    void find_all_along(SharedDirection& d);
    void value();
    void hide_by_surfaces();
    void price(SharedDirection& d);
    int lobe_draws() const;
    double hemisphere_density(const SharedDirection& d) const;
    AlongLight along_light(LightIndex light) const;

    const LitScene* scene_;
    const SharedPlan* plan_;
    SharedCounts counts_;
    LightMixture mixture_;
    std::vector<ScalarBsdf> bsdfs_;
    ShadingPoint point_{};
    const ScalarBsdf* bsdf_ = nullptr;
    Frame<double> frame_{};
    Vec3<double> wo_{0};
    std::vector<SharedDirection> directions_;
    std::vector<AlongLight> along_;
    std::vector<double> pdfs_;  ///< [along_][technique]
    std::size_t towards_lights_ =
        0;  ///< so many directions were drawn towards a light; they stand first
    std::vector<ShadowRay> rays_;
    std::vector<std::uint8_t> hidden_;
    std::vector<std::size_t> ray_of_;
};

}  // namespace mis
