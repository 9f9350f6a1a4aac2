#pragma once

#include "mis/math/cap.h"
#include "mis/sampling/cone.h"
#include "mis/sampling/warp.h"

#include <concepts>
#include <string_view>

namespace mis {

// Which direction, and how dense? Light techniques draw inside the cap of a chosen light; direction
// techniques draw over the hemisphere, from the BSDF or without it; they are strategies
// by themselves, and may have ranked_by_default(lights, has_lobes), as a policy
// (policy/light_choice.h). A light technique may have ranked_by_default_with: the policy and
// heuristic, "product/light", with which it is ranked where nothing is named.

/// A technique that draws in a cap. `n` is the shading normal. sums_lights: its density is the sum
/// over all lights whose cap holds the direction, and its radiance that of whichever is nearest
/// (`union`).
// clang-format off
template <class K, class T>
concept LightTechnique = requires(const Cap<T>& cap, const Vec2<T>& u, const Vec3<T>& n,
                                  const T& cos_theta) {
    { K::name } -> std::convertible_to<std::string_view>;
    { K::sums_lights } -> std::convertible_to<bool>;
    { K::draw(cap, n, u) } -> std::same_as<CapDraw<T>>;
    { K::pdf(cap, n, cos_theta) } -> std::same_as<T>;
};
// clang-format on

/// A technique that draws over the hemisphere of the shading frame: sample and pdf are a pair.
/// asks_bsdf: false where any object will do for the BSDF.
// clang-format off
template <class K, class B, class T>
concept DirectionTechnique = requires(const B& bsdf, const Vec3<T>& w, const T& lobe,
                                      const Vec2<T>& u, const T& pdf) {
    { K::name } -> std::convertible_to<std::string_view>;
    { K::asks_bsdf } -> std::convertible_to<bool>;
    { K::sample(bsdf, w, lobe, u) } -> std::same_as<Vec3<T>>;
    { K::pdf(pdf, w) } -> std::same_as<T>;
    { K::draws(bsdf) } -> std::same_as<bool>;
};
// clang-format on

}  // namespace mis
