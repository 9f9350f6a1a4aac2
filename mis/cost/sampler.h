#pragma once

#include "mis/cost/curve.h"
#include "mis/cost/reference.h"

#include <memory>

namespace mis {

/// The figure points that errors are measured at: each `copies` times, with random numbers of their
/// own, so that a few probes fill batches as a picture does and tell errors as well.
struct CostPoints {
    StudyPoints points;  ///< point p of the study is points [p · copies, (p + 1) · copies)
    std::size_t copies = 1;
};
CostPoints cost_points(const StudyPoints& points, bool has_camera);

/// One replicate of one level, as measured.
struct CostReplicate {
    std::vector<double> squared_errors;  ///< [region]; CostLevel
    std::vector<double> spreads;         ///< likewise
    Participation participation;
    double seconds = 0;  ///< CPU time of a point, with its preparation
    std::uint64_t invalid = 0;
};

/// Draws the samples of one strategy in one number type.
class CostSampler {
public:
    virtual ~CostSampler() = default;
    /// `samples` of every point in one go; `stream` numbers the runs, none of which share samples.
    virtual CostReplicate run(std::uint64_t samples, std::uint64_t stream) = 0;
};

/// ground.points are those that the reference is of; everything is kept by reference. Samples are
/// at most 2³⁰, streams below 2²³. is_sobol: those of a point in a run are one scrambled sequence.
std::unique_ptr<CostSampler> make_sampler(const StudyGround& ground, const CostPoints& points,
                                          const CostReference& reference, const Strategy& strategy,
                                          Precision precision, bool is_sobol = false);

}  // namespace mis
