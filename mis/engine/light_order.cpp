#include "mis/engine/light_order.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace mis {

namespace {

/// The coordinate that these lights' centres differ most in.
int widest_axis(const Lights& lights, std::span<const LightIndex> some)
{
    Vec3<double> low(std::numeric_limits<double>::infinity()), high(-low);
    for (const LightIndex j : some) {
        const Vec3<double>& c = lights[static_cast<std::size_t>(j)].center;
        for (int k = 0; k < 3; ++k)
            low[k] = std::min(low[k], c[k]), high[k] = std::max(high[k], c[k]);
    }
    const Vec3<double> extent = high - low;
    const int yz = extent.y >= extent.z ? 1 : 2;
    return extent.x >= extent[yz] ? 0 : yz;
}

void sort_by_halves(const Lights& lights, std::span<LightIndex> some, const StopToken& stop)
{
    while (some.size() > 1) {
        stop.check();
        const int axis = widest_axis(lights, some);
        const auto half = static_cast<std::ptrdiff_t>(some.size() / 2);
        const auto place = [&](LightIndex j) {
            return std::pair(lights[static_cast<std::size_t>(j)].center[axis], j);
        };
        std::nth_element(some.begin(), some.begin() + half, some.end(),
                         [&](LightIndex a, LightIndex b) { return place(a) < place(b); });
        sort_by_halves(lights, some.first(some.size() / 2), stop);
        some = some.subspan(some.size() / 2);
    }
}

}  // namespace

LightOrder spatial_order(const Lights& lights, const StopToken& stop)
{
    LightOrder order;
    order.light_at.resize(lights.size());
    std::iota(order.light_at.begin(), order.light_at.end(), LightIndex{0});
    sort_by_halves(lights, order.light_at, stop);
    order.place_of.resize(lights.size());
    for (std::size_t k = 0; k < lights.size(); ++k)
        order.place_of[static_cast<std::size_t>(order.light_at[k])] = static_cast<LightIndex>(k);
    return order;
}

Lights in_order(const Lights& lights, const LightOrder& order)
{
    Lights sorted;
    sorted.reserve(lights.size());
    for (const LightIndex j : order.light_at) sorted.push_back(lights[static_cast<std::size_t>(j)]);
    return sorted;
}

}  // namespace mis
