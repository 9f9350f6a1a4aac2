#pragma once

#include "mis/scene/light.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace mis {

/// What a pixel shows.
enum class PixelKind : std::uint8_t {
    background,  ///< nothing, or a light that the camera sees
    dark,        ///< a surface that no light can reach: mean and variance are 0
    lit,         ///< a shading point that samples are drawn at
};

/// What one strategy's samples came to, pixel by pixel.
struct StrategyMap {
    int strategy = 0;                ///< in SceneReport::strategies
    std::vector<Vec3<float>> mean;   ///< RGB radiance
    std::vector<float> variance;     ///< of one sample's luminance; NaN where it has fewer than two
    std::vector<std::uint32_t> bad;  ///< pixels of tiles where samples were no numbers; ascending
};

/// A light, and its share of what all lights would give a white surface that nothing shades.
struct LightShare {
    LightIndex light = no_light;
    float share = 0;
};
inline constexpr std::size_t shown_lights = 4;

/// The lights that matter most at pixels (i · stride, j · stride), row by row.
struct LightMap {
    int stride = 1, width = 0, height = 0;
    std::vector<std::array<LightShare, shown_lights>> lights;
};

/// Of all places that are given a winner, at most this share has a wrong one, in expectation.
inline constexpr double false_winners = 0.05;

/// The ranked strategy that is sure to have the least variance, or variance × time, pixel by pixel;
/// and its policy, which is sure more often, since heuristics are often close. −1: undecided.
struct WinnerMap {
    std::vector<int> strategy, policy;
    std::vector<double> strategy_wins, policy_wins;  ///< the share of the lit pixels of each
};

/// A scene's pictures: one value per pixel, row by row from the top.
struct Maps {
    int width = 0, height = 0;
    std::vector<PixelKind> kind;
    std::vector<Vec3<float>> reference;   ///< RGB radiance: the samples that make the reference
    std::vector<StrategyMap> strategies;  ///< that were run
    std::vector<std::string> policies;    ///< what WinnerMap::policy counts
    WinnerMap by_variance, by_efficiency;
    int winner_square = 1;  ///< winners are told for squares of so many pixels, from all lit ones
    LightMap lights;
    Lights scene_lights;  ///< [LightIndex]
};

}  // namespace mis
