#pragma once

#include "mis/cost/choices.h"
#include "mis/cost/sampler.h"

#include <memory>
#include <vector>

namespace mis {

/// Independent replicates of every level of a curve.
inline constexpr int replicate_count = 8;

/// What curves are sampled on, and against what. Everything is kept by reference.
struct CurveGround {
    const StudyGround& study;
    const CostPoints& points;
    const CostReference& reference;
    bool is_sobol = false;  ///< a replicate of a point is one scrambled sequence
};

/// One curve under way: doublings of one strategy in one number type.
struct CurveRun {
    explicit CurveRun(const CostChoice& choice)
    {
        measured.strategy = choice.strategy;
        measured.precision = choice.precision;
    }

    CostMeasurements measured;
    std::unique_ptr<CostSampler> sampler;
    double level_seconds = 0, all_seconds = 0;  ///< wall, of the last level and of all
    bool is_done = false;

    CostChoice choice() const { return {measured.strategy, measured.precision}; }

    /// It gets no more samples. why counts only where it has no level.
    void end(const CostReason& why);

    /// Makes the sampler. The first touch of memory is no cost of the strategy, nor are the lists
    /// that its first draws make for all strategies, so a few samples count for nothing. Ends the
    /// curve where is_timed and there is no time for replicates of such samples. Is it ready?
    bool make_ready(const CurveGround& ground, double seconds_left, bool is_timed);
};

/// A level of one curve while its replicates come in.
struct LevelRun {
    CostLevel level;
    double seconds = 0;  ///< wall

    /// Takes the next replicate: `samples` of every point. stream: numbers the runs.
    void add_replicate(CurveRun& curve, std::uint64_t samples, std::uint64_t stream, bool is_sobol);
    /// All replicates are there.
    void end(CurveRun& curve, std::uint64_t samples) &&;
};

}  // namespace mis
