#pragma once

#include "mis/math/stop_token.h"
#include "mis/scene/scene.h"
#include "mis/trace/visibility.h"

#include <memory>
#include <string>

struct RTCSceneTy;  // what Embree's RTCScene points to

namespace mis {

/// Shadow rays against a host's own Embree scene, committed, of the Embree that mis is built with:
/// hidden[i] = 1 where a surface stands on ray i before its distance, else 0. The rays are in the
/// scene's coordinates: HostTracer's origin (engine/light_points.h) is 0 then.
void occluded_in(RTCSceneTy* scene, std::span<const ShadowRay> rays,
                 std::span<std::uint8_t> hidden);

/// An error of Embree in words, by its number (RTCError).
std::string embree_error(int code);

/// The surfaces of a scene in Embree's trees (3.13 or 4); lights are not among them. Owns device
/// and scene; keeps a reference to the scene. Triangles and quads are intersected by Embree in
/// float, relative to the middle of the surfaces; spheres in double. What a camera ray hits is
/// computed again in double. Throws std::runtime_error where Embree fails (no memory), and Stopped.
class EmbreeTracer final : public SurfaceTracer {
public:
    /// Builds the trees. Keeps a reference to the scene.
    explicit EmbreeTracer(const Scene& scene, const StopToken& stop = {});
    ~EmbreeTracer() override;

    void occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> hidden) const override;
    std::optional<SurfaceHit> first_hit(const Vec3<double>& origin,
                                        const Vec3<double>& direction) const override;
    Vec3<double> origin() const override;
    double offset_at(const Vec3<double>& x) const override;
    void offsets_at(std::span<const Vec3<double>> points, std::span<double> offsets,
                    const ForEach& for_each) const override;

private:
    struct Trees;
    std::unique_ptr<Trees> trees_;
};

}  // namespace mis
