#include "mis/predict/heuristics.h"

#include "mis/heuristic/registry.h"
#include "mis/scene/named.h"

#include <cmath>

namespace mis {

namespace {

template <class H> double weight_at(double ratio)
{
    return H::template weight<double, 2>({1, ratio}, 0);
}

/// Weights depend on the ratio of the densities alone. Wherever they change over a step of the
/// ratio, the step is halved until it is one rounding wide: what is left of the change there is a
/// jump.
template <class H> std::vector<double> jumps_of()
{
    std::vector<double> jumps;
    constexpr int steps_per_octave = 8;
    for (int k = -40 * steps_per_octave; k < 40 * steps_per_octave; ++k) {
        double low = std::exp2((k - 0.37) / steps_per_octave),
               high = std::exp2((k + 0.63) / steps_per_octave);
        while (std::nextafter(low, high) < high) {
            const double middle = low + (high - low) / 2;
            const bool more_below = std::abs(weight_at<H>(low) - weight_at<H>(middle)) >
                                    std::abs(weight_at<H>(middle) - weight_at<H>(high));
            (more_below ? high : low) = middle;
        }
        if (std::abs(weight_at<H>(low) - weight_at<H>(high)) > 1e-9)
            jumps.push_back(low + (high - low) / 2);
    }
    return jumps;
}

template <class H>
void weigh(const NodeColumn& light, const NodeColumn& bsdf, NodeColumn& light_weight,
           NodeColumn& bsdf_weight)
{
    for (std::size_t i = 0; i < Rule::padded; ++i) {
        const std::array<double, 2> density{light[i], bsdf[i]};
        light_weight[i] = H::weight(density, 0);
        bsdf_weight[i] = H::weight(density, 1);
    }
}

}  // namespace

const WeightRule& weight_rule(std::string_view heuristic)
{
    return *require_named(Heuristics{}, "heuristic", heuristic, []<class H>() {
        static const WeightRule rule{weigh<H>, jumps_of<H>()};
        return &rule;
    });
}

}  // namespace mis
