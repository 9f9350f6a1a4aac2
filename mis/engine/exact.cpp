#include "mis/engine/exact.h"

#include "mis/math/irradiance.h"
#include "mis/strategy/names.h"

#include <algorithm>
#include <atomic>
#include <optional>

namespace mis {

namespace {

/// Can no light stand before another one that is above the horizon?
bool is_unhidden(const LitScene& scene, const TilePlan& plan)
{
    if (!plan.effects.has(Effect::light_occlusion)) return true;
    if (plan.blockers == nullptr) return false;
    for (LightIndex j = 0; j < static_cast<LightIndex>(scene.scene().lights.size()); ++j) {
        const auto proofs = plan.lights.empty() ? 0 : plan.lights[static_cast<std::size_t>(j)];
        if ((proofs & (below | unhidden)) != 0) continue;
        const auto others = plan.blockers->before(j);
        if (!others || others->beams() != 0) return false;
    }
    return true;
}

}  // namespace

bool has_closed_form(const LitScene& scene, const Tile& tile)
{
    return is_diffuse(scene.bsdf(tile.material)) && !tile.plan.effects.has(Effect::shadows) &&
           is_unhidden(scene, tile.plan);
}

bool has_closed_form(const LitScene& scene, const GBuffer& shading, std::size_t tiles,
                     const AnyExecutor& executor)
{
    std::atomic<bool> all = true;
    executor.for_each(tiles, [&](std::size_t t) {
        Tile tile = shading.tiles[t];
        if (!all || has_closed_form(scene, tile)) return;
        if (!is_diffuse(scene.bsdf(tile.material))) {
            all = false;
            return;
        }
        tile.plan = scene.proved(std::span(shading.points).subspan(tile.first, tile.count));
        if (!has_closed_form(scene, tile)) all = false;
    });
    return all;
}

namespace {

/// Is the luminance that a material reflects of a light the same share of the light's own, of all
/// lights?
bool have_one_colour(const Scene& scene)
{
    const auto is_grey_material = [](const Material& material) { return is_grey(material); };
    if (std::ranges::all_of(scene.materials, is_grey_material)) return true;
    std::optional<Vec3<double>> first;  // a colour of luminance 1
    for (const Light& light : scene.lights) {
        const auto colour = vec_cast<double>(light.radiance_radius);
        const double y = luminance(colour);
        if (!(y > 0)) continue;
        if (!first) first = colour / y;
        constexpr double rounding = 8 * 0x1p-23;  // of radiance · radius, to float
        if (length(colour / y - *first) > rounding * length(*first)) return false;
    }
    return true;
}

}  // namespace

bool gives_closed_form(const Scene& scene, const Strategy& s)
{
    // Of `strata`, no lobe is drawn at such points; as all lights are seen, all means are 1.
    const bool draws_lights_alone = s.heuristic == "light" || s.model == Model::strata;
    if (!s.chooses_light() || !draws_lights_alone || !draws_by_irradiance(s.technique))
        return false;
    return draws_every_light(s.policy) || scene.lights.size() == 1 ||
           (weighs_by_irradiance(s.policy) && have_one_colour(scene));
}

Vec3<double> exact_radiance(const LitScene& scene, const Tile& tile, const ShadingPoint& point)
{
    const auto n = vec_cast<double>(point.n), up = Vec3<double>{0, 0, 1};
    Vec3<double> sum(0);
    for (const Light& light : scene.scene().lights) {
        const Cap<double> cap = cap_of_sphere(light.center, light.radius, point.x);
        // One sine at a time: a radius of 1e-20 has no square.
        const double over_sine = cap.sin_max * irradiance_over_sin2(tilted(cap, n));
        sum += vec_cast<double>(light.radiance_radius) / cap.distance * over_sine;
    }
    Vec3<double> f(0);
    scene.bsdf(tile.material).visit([&](const auto& bsdf) { f = bsdf.evaluate(up, up).f; });
    return sum * f;
}

ExactShare exact_share(const LitScene& scene, const GBuffer& shading)
{
    ExactShare share{shading.dark.size(), shading.dark.size() + shading.points.size()};
    share.tiles = shading.tiles.size();
    for (const Tile& tile : shading.tiles)
        if (has_closed_form(scene, tile)) share.exact += tile.count, ++share.exact_tiles;
    return share;
}

void light_exactly(const LitScene& scene, Band& band, const AnyExecutor& executor)
{
    executor.for_each(band.shading.tiles.size(), [&](std::size_t t) {
        const Tile& tile = band.shading.tiles[t];
        for (std::size_t p = tile.first; p < std::size_t{tile.first} + tile.count; ++p) {
            PointResult& result = band.results[p];
            result.radiance_sum = exact_radiance(scene, tile, band.shading.points[p]);
            result.luminance = {.count = 1, .mean = luminance(result.radiance_sum)};
        }
    });
}

}  // namespace mis
