#include "mis/cost/curve_run.h"

#include "mis/engine/stopwatch.h"

#include <utility>

namespace mis {
namespace {

constexpr std::uint64_t apart = std::uint64_t{1} << 20;  // a stream that no replicate has

}  // namespace

void CurveRun::end(const CostReason& why)
{
    is_done = true;
    if (measured.levels.empty() && is_none(measured.reason)) measured.reason = why;
}

bool CurveRun::make_ready(const CurveGround& ground, double seconds_left, bool is_timed)
{
    if (sampler) return true;
    sampler = make_sampler(ground.study, ground.points, ground.reference, measured.strategy,
                           measured.precision, ground.is_sobol);
    const Clock::time_point start = Clock::now();
    sampler->run(1, apart);
    const double seconds = seconds_since(start);
    constexpr double little = 0.002;  // of the time that is left
    if (seconds < little * seconds_left) sampler->run(3, apart + 1);
    if (!is_timed || seconds * replicate_count < 0.5 * seconds_left) return true;
    end(reason::SampleTooDear{seconds, replicate_count});
    return false;
}

void LevelRun::add_replicate(CurveRun& curve, std::uint64_t samples, std::uint64_t stream,
                             bool is_sobol)
{
    const Clock::time_point start = Clock::now();
    CostReplicate replicate = curve.sampler->run(samples, stream);
    level.squared_errors.push_back(std::move(replicate.squared_errors));
    if (is_sobol) level.spreads.push_back(std::move(replicate.spreads));
    level.participation.sum_d2 += replicate.participation.sum_d2;
    level.participation.sum_d4 += replicate.participation.sum_d4;
    level.seconds.push_back(replicate.seconds);
    curve.measured.invalid_samples += replicate.invalid;
    seconds += seconds_since(start);
}

void LevelRun::end(CurveRun& curve, std::uint64_t samples) &&
{
    level.samples = samples;
    curve.measured.levels.push_back(std::move(level));
    curve.level_seconds = seconds;
    curve.all_seconds += seconds;
}

}  // namespace mis
