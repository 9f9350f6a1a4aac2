#pragma once

#include "mis/cost/curve.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace mis {

/// A curve as it would be measured: error² = variance/n + bias², seconds = prepare + n·per_sample
/// of a point, both with noise.
struct SyntheticCurve {
    std::string name = "power/power";
    double variance = 0.01, bias = 0,
           reference = 0;                     ///< reference: its squared error, added to all
    double prepare = 0, per_sample = 1e-7;    ///< seconds
    double noise = 0.02, clock_noise = 0.01;  ///< relative, of one replicate
    int levels = 7;
    double carriers = 1e6;  ///< squared errors that carry a level
    std::uint64_t seed = 1;
};

inline CostMeasurements measured(const SyntheticCurve& c)
{
    constexpr int replicates = 8, regions = 4;
    std::mt19937_64 bits(c.seed);
    std::normal_distribution<double> normal;
    CostMeasurements m{.strategy = parse_strategy(c.name), .reason = {}, .levels = {}};
    for (int k = 0; k < c.levels; ++k) {
        CostLevel level{.samples = std::uint64_t{1} << k,
                        .squared_errors = {},
                        .participation = {},
                        .seconds = {}};
        const double n = static_cast<double>(level.samples),
                     square = c.variance / n + c.bias * c.bias + c.reference;
        level.participation = {c.carriers * square, c.carriers * square * square};
        for (int r = 0; r < replicates; ++r) {
            std::vector<double> of_regions;
            for (int g = 0; g < regions; ++g)
                of_regions.push_back(square / regions *
                                     (1 + c.noise * std::sqrt(regions) * normal(bits)));
            level.squared_errors.push_back(of_regions);
            level.seconds.push_back((c.prepare + n * c.per_sample) *
                                    (1 + c.clock_noise * normal(bits)));
        }
        m.levels.push_back(level);
    }
    return m;
}

}  // namespace mis
