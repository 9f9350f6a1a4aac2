#pragma once

#include "bench/ready.h"
#include "mis/trace/visibility.h"

namespace mis::bench {

/// Passes rays on to another tracer, and keeps them and the answers. For one thread.
class RecordingTracer final : public SurfaceTracer {
public:
    explicit RecordingTracer(const SurfaceTracer& asked) : asked_(&asked) {}

    void occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> hidden) const override
    {
        asked_->occluded(rays, hidden);
        rays_.insert(rays_.end(), rays.begin(), rays.end());
        for (const std::uint8_t h : hidden) hidden_ += h;
    }
    std::optional<SurfaceHit> first_hit(const Vec3<double>& origin,
                                        const Vec3<double>& direction) const override
    {
        return asked_->first_hit(origin, direction);
    }
    Vec3<double> origin() const override { return asked_->origin(); }
    double offset_at(const Vec3<double>& x) const override { return asked_->offset_at(x); }

    const std::vector<ShadowRay>& rays() const { return rays_; }
    std::size_t hidden() const { return hidden_; }

private:
    const SurfaceTracer* asked_;
    mutable std::vector<ShadowRay> rays_;
    mutable std::size_t hidden_ = 0;
};

/// The shadow rays of a strategy: 16 samples of every point of the picture, as run_tiles() takes
/// them.
struct Recording {
    Recording(const Ready& ready, const std::string& strategy);

    std::vector<ShadowRay> rays;
    std::size_t hidden = 0;  ///< of them, says the engine's tracer
    std::uint64_t samples = 0;
};

}  // namespace mis::bench
