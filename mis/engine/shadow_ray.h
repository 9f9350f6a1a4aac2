#pragma once

#include "mis/scene/shading_point.h"
#include "mis/trace/intersect.h"
#include "mis/trace/visibility.h"

#include <algorithm>

namespace mis {

/// To a light, and no further than to what may touch it: rays start some way off their point and
/// are traced in float, so what is met that little before the light is not nearer than it.
inline ShadowRay shadow_ray(const ShadingPoint& point, const Vec3<float>& wi, double distance)
{
    const double off = float_offset(largest_coordinate(vec_cast<double>(point.ray_origin)));
    return {point.ray_origin, wi, static_cast<float>(std::max(distance * (1 - 1e-6) - off, 0.0))};
}

}  // namespace mis
