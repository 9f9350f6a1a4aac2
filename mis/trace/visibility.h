#pragma once

#include "mis/math/vec.h"
#include "mis/scene/light.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace mis {

/// Is anything between `origin` and `distance` along `direction`? In the tracer's frame, in float.
struct ShadowRay {
    Vec3<float> origin;     ///< off its own surface
    Vec3<float> direction;  ///< unit
    float distance;         ///< scene units; infinity is allowed
};

/// What a camera ray meets first, in scene coordinates.
struct SurfaceHit {
    Vec3<double> x;          ///< on the surface, in double
    Vec3<double> geometric;  ///< unit normal of the surface, towards the ray's origin
    Vec3<double> n;          ///< unit shading normal, towards the ray's origin, too
    double distance;         ///< along the ray
    double offset;  ///< how far a ray that starts at x must be moved off this surface to miss it;
                    ///< scene units
    int material;   ///< index into Scene::materials

    /// Does n lean to the side of the surface that is not seen? On a coarse mesh with smooth
    /// normals it does along the outline: turned to the viewer, it is turned off the surface.
    bool is_n_behind() const { return dot(n, geometric) < 0; }
};

/// Runs body(0) … body(n − 1), each once, on any thread and in any order: AnyExecutor::for_each.
using ForEach = std::function<void(std::size_t n, const std::function<void(std::size_t)>& body)>;

/// What surfaces do to rays; an embedder may bring his own. Lights are no surfaces: trace/lights.h.
class SurfaceTracer {
public:
    virtual ~SurfaceTracer() = default;

    /// hidden[i] = 1 where something lies on ray i strictly before its distance, else 0.
    virtual void occluded(std::span<const ShadowRay> rays,
                          std::span<std::uint8_t> hidden) const = 0;

    /// The nearest surface along a ray, or nothing. direction: unit.
    virtual std::optional<SurfaceHit> first_hit(const Vec3<double>& origin,
                                                const Vec3<double>& direction) const = 0;

    /// The point of the scene that shadow rays' origins are measured from: near the surfaces, so
    /// that floats are fine.
    virtual Vec3<double> origin() const = 0;

    /// SurfaceHit::offset for a point that no ray found: of the surface it lies on, if on any.
    virtual double offset_at(const Vec3<double>& x) const = 0;

    /// The same of many points: offsets[i] of points[i].
    virtual void offsets_at(std::span<const Vec3<double>> points, std::span<double> offsets,
                            const ForEach& for_each) const
    {
        for_each(points.size(), [&](std::size_t i) { offsets[i] = offset_at(points[i]); });
    }
};

}  // namespace mis
