#pragma once

#include "mis/scene/scene.h"
#include "mis/trace/visibility.h"

namespace mis {

/// Surface by surface, closed form, in double: the reference for other tracers, and all that a bare
/// core needs. Keeps a reference to the scene. A ray costs time in proportion to the number of
/// triangles.
class AnalyticTracer final : public SurfaceTracer {
public:
    /// Keeps a reference to the scene.
    explicit AnalyticTracer(const Scene& scene);

    void occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> hidden) const override;
    std::optional<SurfaceHit> first_hit(const Vec3<double>& start,
                                        const Vec3<double>& direction) const override;
    Vec3<double> origin() const override;
    double offset_at(const Vec3<double>& x) const override;
    void offsets_at(std::span<const Vec3<double>> points, std::span<double> offsets,
                    const ForEach& for_each) const override;

private:
    const Scene* scene_;
};

}  // namespace mis
