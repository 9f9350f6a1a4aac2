#pragma once

#include "mis/engine/light_order.h"
#include "mis/policy/light_choice.h"

#include <algorithm>
#include <array>
#include <vector>

namespace mis {

/// The lights as columns relative to `origin`, in `storage`; in an order of their own, or the
/// scene's; luminances times `scale`. Linear in the number of lights.
template <class T>
LightColumns<T> fill_light_columns(const Lights& lights, const Vec3<double>& origin,
                                   LargeVector<T>& storage, const LightOrder* order = nullptr,
                                   double scale = 1)
{
    const std::size_t count = lights.size(), padded = (count + 15) / 16 * 16;
    storage.resize(padded * 5);
    std::array<std::span<T>, 5> column;
    for (std::size_t k = 0; k < 5; ++k) {
        column[k] = std::span(storage).subspan(k * padded, padded);
        // The padding is a light of radius 1 at distance √3: finite, and never drawn.
        std::fill(column[k].begin() + static_cast<std::ptrdiff_t>(count), column[k].end(), T(1));
    }
    double largest = lights.empty() ? 1 : 0;  // of no lights nothing is read
    for (std::size_t j = 0; j < count; ++j) {
        const Light& light =
            lights[order == nullptr ? j : static_cast<std::size_t>(order->light_at[j])];
        const Vec3<T> center = vec_cast<T>(light.center - origin);
        column[0][j] = center.x, column[1][j] = center.y, column[2][j] = center.z;
        column[3][j] = static_cast<T>(light.radius);
        column[4][j] = static_cast<T>(luminance_radius(light) * scale);
        largest = std::max(largest, light.radius);
    }
    return {
        count, column[0], column[1], column[2], column[3], column[4], static_cast<T>(1 / largest)};
}

}  // namespace mis
