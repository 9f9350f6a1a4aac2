#pragma once

#include "mis/strategy/strategy.h"

#include "tests/support/scenes.h"

#include <vector>

namespace mis {

/// Three lamps over a floor with a ball on it, through a camera of 40 × 24 pixels.
inline Scene small_picture()
{
    Scene scene = probe_under(three_lights_apart(), grey_floor());
    scene.camera = Camera{.position = {0, 2, 6}, .target = {0, 0, 0}, .resolution = {40, 24}};
    scene.surfaces.push_back({Quad{{-5, 0, -5}, {Vec3<double>{0, 0, 10}, {10, 0, 0}}}, 0});
    scene.surfaces.push_back({SphereSurface{{0.5, 0.6, 0.5}, 0.3}, 0});
    return scene;
}

inline std::vector<Strategy> strategies_named(const std::vector<const char*>& names)
{
    std::vector<Strategy> strategies;
    for (const char* name : names) strategies.push_back(parse_strategy(name));
    return strategies;
}

}  // namespace mis
