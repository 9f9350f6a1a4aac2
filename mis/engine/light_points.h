#pragma once

#include "mis/engine/lit_scene.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace mis {

// Direct lighting of many points at once, for a host that has shading points and rays of his own:
// structure of arrays in, radiance out, by the lanes and batches of the engine.

/// Shading points, one array per component, all of one length. Neighbours next to each other are
/// lit best: floats are relative to the first of each 256.
struct PointArrays {
    std::array<std::span<const double>, 3> x;           ///< scene units
    std::array<std::span<const float>, 3> n;            ///< unit shading normal
    std::array<std::span<const float>, 3> wo;           ///< unit, to the viewer
    std::array<std::span<const double>, 3> ray_origin;  ///< scene units: x, off its own surface
    std::span<const std::int32_t> material;             ///< index into Scene::materials
    std::span<const std::uint32_t> id;  ///< of their random numbers: points with one id share them

    /// How many points.
    std::size_t size() const { return id.size(); }
};

/// RGB radiance, W·sr⁻¹·m⁻², one array per channel, as long as the points.
using RadianceArrays = std::array<std::span<float>, 3>;

/// A host's shadow rays, in packets of some hundred: a callback in place of surfaces that mis
/// knows.
class HostTracer final : public SurfaceTracer {
public:
    /// hidden[i] = 1 where a surface stands on ray i strictly before its distance, else 0. Many
    /// threads may call it at once.
    using Occluded =
        std::function<void(std::span<const ShadowRay> rays, std::span<std::uint8_t> hidden)>;

    /// origin: what the rays' origins are relative to, scene units: amid the scene, so that floats
    /// are fine.
    explicit HostTracer(Occluded occluded, const Vec3<double>& origin = Vec3<double>(0))
        : occluded_(std::move(occluded)), origin_(origin)
    {
    }
    void occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> hidden) const override
    {
        occluded_(rays, hidden);
    }
    Vec3<double> origin() const override { return origin_; }

    /// Nothing: the host finds his points himself.
    std::optional<SurfaceHit> first_hit(const Vec3<double>&, const Vec3<double>&) const override
    {
        return std::nullopt;
    }
    double offset_at(const Vec3<double>&) const override { return 0; }

private:
    Occluded occluded_;
    Vec3<double> origin_;
};

/// Lights a host's points by one strategy. One per thread. Allocates in its first call, and no
/// more.
class PointLighter {
public:
    /// Keeps references. The scene has the lights and materials; its tracer is the host's, and its
    /// effects are all_effects(scene), since mis does not see the host's surfaces.
    PointLighter(const LitScene& scene, const ReadyStrategy<float>& strategy)
        : scene_(&scene), strategy_(&strategy)
    {
    }

    /// Means of samples [first, first + count) at each point; the same numbers whichever points are
    /// asked for together, to rounding. With `strata@N`, both are multiples of N, and points that
    /// are asked for together learn from each other: neighbours, some 256 at a time. 0 where a
    /// point is inside a light, seen from below, or not finite, which counts its samples as
    /// invalid. count ≥ 1. Returns what it cost, with the samples that were not finite.
    TileTotals light(const PointArrays& points, std::uint64_t first, int count,
                     const RadianceArrays& radiance);

private:
    void light_some(const PointArrays& points, std::size_t begin, std::size_t end,
                    std::uint64_t first, int count, const RadianceArrays& radiance);
    void light_tile(int material, std::uint64_t first, int count, const RadianceArrays& radiance);

    const LitScene* scene_;
    const ReadyStrategy<float>* strategy_;
    Workspace<float> workspace_;
    std::vector<std::uint32_t> order_;  ///< of the points at hand, by material
    std::vector<std::uint32_t> places_;
    std::vector<ShadingPoint> points_;  ///< those of one material
    std::vector<PointResult> results_;
    TileTotals totals_;
};

}  // namespace mis
