#pragma once

#include "mis/engine/pipeline.h"
#include "mis/math/moments.h"

#include <memory>
#include <span>

namespace mis {

/// What all observations of one shading point come to. An observation is a sample; where samples
/// depend on one another, it is the mean of all that do (SampleRange).
struct PointResult {
    Moments luminance;
    Vec3<double> radiance_sum{0};  ///< RGB, over all observations

    Vec3<double> mean() const
    {
        return luminance.count == 0 ? Vec3<double>(0) : radiance_sum / double(luminance.count);
    }
};

/// Which samples of every point to take: `chunks` chunks of `chunk` observations of so many
/// samples each, numbered from sample `first` on. A chunk belongs to one replicate.
struct SampleRange {
    std::uint64_t first = 0;
    int chunk = 1, chunks = 1;
    int samples_per_observation = 1;
    int observations() const { return chunk * chunks; }
    std::uint64_t samples() const
    {
        return static_cast<std::uint64_t>(observations()) *
               static_cast<std::uint64_t>(samples_per_observation);
    }
};

/// Sums over the points of a tile, of one chunk's observations alone.
struct ChunkTotals {
    double mean = 0;
    double variance = 0;           ///< of one observation, unbiased; 0 for chunks of one
    double relative_variance = 0;  ///< the same, times the point's weight

    /// A point's observations, and its weight.
    void add(const Spread& observations, double weight);
};

/// What a tile's run cost.
struct TileTotals {
    std::array<double, stage_names.size()> stage_seconds{};  ///< CPU
    double seconds = 0;                                      ///< CPU, all together
    std::uint64_t samples = 0, shadow_rays = 0, invalid = 0;
    SampleName first_invalid;  ///< where invalid > 0

    void add(const TileTotals& other);
};

template <class T> struct StrataMemory;

/// Room to run tiles in, one per thread: a batch, the tables of its points, the lights' columns.
template <class T> class Workspace {
public:
    Workspace();
    ~Workspace();

    /// Runs a pipeline over a tile. job.points are its points; results, weights (1/(μ² + ε²), or
    /// empty) run along with them, totals along with range.chunks (or empty). Moments are merged in
    /// the order of the samples.
    /// Throws Stopped once job.stop is up; the results keep what was taken in
    /// before, so that some points have more samples than others.
    TileTotals run(TileJob<T> job, const Pipeline<T>& pipeline, const SampleRange& range,
                   std::span<PointResult> results, std::span<const double> weights,
                   std::span<ChunkTotals> totals);

private:
    struct Run;

    std::unique_ptr<Batch<T>> batch_;
    std::unique_ptr<StrataMemory<T>> strata_;
    std::unique_ptr<Scratch> scratch_;
    LargeVector<T> columns_;
    Column<double> luminance_;
};

extern template class Workspace<float>;
extern template class Workspace<double>;

}  // namespace mis
