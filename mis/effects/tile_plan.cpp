#include "mis/effects/tile_plan.h"

#include "mis/math/limits.h"
#include "mis/trace/intersect.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mis {

namespace {

/// Pairs of a light and a surface, and of two lights, that are looked at for a tile: some tens of
/// microseconds, beside some hundred that one round of its samples takes.
constexpr std::size_t most_surface_pairs = 2048, most_light_pairs = 1024;

void add_corners(std::vector<Vec3<double>>& corners, const Quad& quad)
{
    for (const double u : {0.0, 1.0})
        for (const double v : {0.0, 1.0})
            corners.push_back(quad.corner + quad.edges[0] * u + quad.edges[1] * v);
}

/// The corners of the box around a mesh.
void add_corners(std::vector<Vec3<double>>& corners, const Mesh& mesh)
{
    Vec3<double> low(std::numeric_limits<double>::infinity()), high = -low;
    for (const Vec3<double>& p : mesh.positions) low = min(low, p), high = max(high, p);
    for (int k = 0; k < 8; ++k)
        corners.push_back({(k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                           (k & 4) != 0 ? high.z : low.z});
}

}  // namespace

/// What of a tile's points the proofs look at.
struct TilePlanner::TileBounds {
    Vec3<double> low, high;     ///< of the points and of their rays' origins
    Vec3<double> normal;        ///< mean of the points', unit
    double spread;              ///< no point's normal is further from it
    double lowest, highest;     ///< of normal · (x − middle)
    std::vector<Heights> over;  ///< [body]

    Shaft towards(const Vec3<double>& center, double radius) const
    {
        return {low, high, center, radius};
    }
    bool is_below(const Light& light) const;
    bool is_above(const Vec3<double>& center, double radius) const;
};

TilePlanner::TilePlanner(const Scene& scene, const LightHierarchy& hierarchy,
                         const Effects& effects, const Vec3<double>& frame)
    : scene_(&scene), effects_(effects), frame_(frame)
{
    for (const Surface& surface : scene.surfaces) {
        Body body;
        if (const auto* sphere = std::get_if<SphereSurface>(&surface.shape)) {
            body.center = sphere->center, body.radius = sphere->radius;
        } else if (const auto* mesh = std::get_if<Mesh>(&surface.shape)) {
            add_corners(body.corners, *mesh);
        } else {
            const Quad& quad = std::get<Quad>(surface.shape);
            add_corners(body.corners, quad);
            body.is_flat = true;
            body.normal = normalized(cross(quad.edges[0], quad.edges[1]));
        }
        double largest = 0;
        for (const Vec3<double>& p : body.corners) {
            body.center += p / static_cast<double>(body.corners.size());
            largest = std::max(largest, largest_coordinate(p - frame));
        }
        for (const Vec3<double>& p : body.corners)
            body.radius = std::max(body.radius, length(p - body.center));
        body.clearance = 0.5 * float_offset(largest);
        bodies_.push_back(std::move(body));
    }
    if (scene.lights.size() <= Blockers::most_lights)
        spheres_ =
            std::make_shared<FloatSpheres>(scene.lights, hierarchy.origin(), hierarchy.order());
    for (const Light& light : scene.lights)
        lights_center_ += light.center / static_cast<double>(scene.lights.size());
    for (const Light& light : scene.lights)
        lights_radius_ =
            std::max(lights_radius_, length(light.center - lights_center_) + light.radius);
}

TilePlanner::Heights TilePlanner::heights(const Body& quad,
                                          std::span<const ShadingPoint> points) const
{
    Heights over{infinity, infinity};
    if (!quad.is_flat) return over;
    const double plane = dot(quad.normal, quad.corners[0] - frame_);
    for (const ShadingPoint& point : points) {
        const double height = dot(quad.normal, vec_cast<double>(point.ray_origin)) - plane;
        over = {std::min(over.above, height), std::min(over.below, -height)};
    }
    return over;
}

TilePlanner::TileBounds TilePlanner::bounds_of(std::span<const ShadingPoint> points) const
{
    TileBounds tile{points[0].x, points[0].x, Vec3<double>(0), 0, 0, 0, {}};
    for (const ShadingPoint& point : points) {
        // Without surfaces there are no rays.
        const Vec3<double> origin =
            bodies_.empty() ? point.x : vec_cast<double>(point.ray_origin) + frame_;
        tile.low = min(tile.low, min(point.x, origin));
        tile.high = max(tile.high, max(point.x, origin));
        tile.normal += vec_cast<double>(point.n);
    }
    const double sum = length(tile.normal);
    tile.normal = sum > 0 ? tile.normal / sum : Vec3<double>(0, 0, 1);
    const Vec3<double> middle = 0.5 * (tile.low + tile.high);
    tile.lowest = std::numeric_limits<double>::infinity(), tile.highest = -tile.lowest;
    for (const ShadingPoint& point : points) {
        tile.spread = std::max(tile.spread, length(vec_cast<double>(point.n) - tile.normal));
        const double height = dot(tile.normal, point.x - middle);
        tile.lowest = std::min(tile.lowest, height), tile.highest = std::max(tile.highest, height);
    }
    for (const Body& body : bodies_) tile.over.push_back(heights(body, points));
    return tile;
}

/// n·(c − x) ≤ n̄·(c − x) + |n − n̄| |c − x| for every point; what is below by less than 1e-5 rad
/// may be above to floats.
bool TilePlanner::TileBounds::is_below(const Light& light) const
{
    const Vec3<double> to_center = light.center - 0.5 * (low + high);
    const double reach = length(to_center) + 0.5 * length(high - low);
    const double most = dot(normal, to_center) - lowest + spread * reach + light.radius;
    return most < -1e-5 * (reach + light.radius);
}

/// The same from the other side, of a ball: n·(c − x) ≥ n̄·(c − x) − |n − n̄| |c − x|.
bool TilePlanner::TileBounds::is_above(const Vec3<double>& center, double radius) const
{
    const Vec3<double> to_center = center - 0.5 * (low + high);
    const double reach = length(to_center) + 0.5 * length(high - low);
    const double least = dot(normal, to_center) - highest - spread * reach - radius;
    return least > 1e-5 * (reach + radius);
}

/// One by one, or of many the ball around them all.
bool TilePlanner::are_lights_above(const TileBounds& tile) const
{
    const Lights& lights = scene_->lights;
    if (lights.size() > most_light_pairs) return tile.is_above(lights_center_, lights_radius_);
    return std::all_of(lights.begin(), lights.end(), [&](const Light& light) {
        return tile.is_above(light.center, light.radius);
    });
}

/// Does no direction above the points' horizons come down to the quad, as of the floor that they
/// lie on? Where their normals are its own, but for a tilt: a ray sinks by that at most times the
/// way to the quad's far end.
bool TilePlanner::stays_above(const TileBounds& tile, const Body& quad, const Heights& over)
{
    const double side = over.above > over.below ? 1 : -1, height = std::max(over.above, over.below);
    const double off = length(tile.normal - quad.normal * side) + tile.spread;
    constexpr double rounding = 1.2e-7;  // of n·wi; none along an axis
    const double tilt = off > 0 ? off + rounding : 0;
    const double way = length(quad.center - 0.5 * (tile.low + tile.high)) + quad.radius +
                       0.5 * length(tile.high - tile.low);
    return height - tilt * way > quad.clearance;
}

bool TilePlanner::is_unshadowed(const TileBounds& tile, const Shaft& shaft) const
{
    const Vec3<double> middle = shaft.middle();
    const double far = length(shaft.center - middle) + shaft.radius;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const Body& body = bodies_[b];
        // What rounding to floats may move a ray by where it passes the body.
        const double margin = 4e-6 * (length(body.center - middle) + body.radius +
                                      shaft.box_radius() + length(middle - frame_)) +
                              1e-13 * far;
        if (body.is_flat) {
            const double height = dot(body.normal, shaft.center - body.corners[0]);
            const double nearest = std::abs(height) - shaft.radius;
            const double origins = height > 0 ? tile.over[b].above : tile.over[b].below;
            if (nearest > margin && origins > body.clearance) continue;
            if (stays_above(tile, body, tile.over[b])) continue;
        }
        const bool is_clear = body.corners.empty()
                                  ? is_clear_of(shaft, body.center, body.radius, margin)
                                  : is_clear_of(shaft, body.corners, margin);
        if (!is_clear) return false;
    }
    return true;
}

bool TilePlanner::is_unhidden(const Shaft& shaft, std::size_t light) const
{
    const double far = length(shaft.center - shaft.middle()) + shaft.radius;
    for (std::size_t k = 0; k < scene_->lights.size(); ++k) {
        const Light& other = scene_->lights[k];
        // What a direction in float may pass beside its light, where it passes the other one.
        const double margin =
            4e-6 * (length(other.center - shaft.middle()) + other.radius + shaft.box_radius()) +
            1e-13 * far + 1e-15 * length(shaft.middle());
        if (k != light && !is_clear_of(shaft, other.center, other.radius, margin)) return false;
    }
    return true;
}

void TilePlanner::prove_all_at_once(const TileBounds& tile, TilePlan& plan) const
{
    if (plan.effects.has(Effect::shadows) &&
        is_unshadowed(tile, tile.towards(lights_center_, lights_radius_)))
        plan.effects.set(Effect::shadows, false);
}

void TilePlanner::prove_each(const TileBounds& tile, TilePlan& plan) const
{
    const Lights& lights = scene_->lights;
    const bool has_shadows = plan.effects.has(Effect::shadows),
               has_occlusion = plan.effects.has(Effect::light_occlusion);
    const bool asks_lights = has_occlusion && lights.size() * lights.size() <= most_light_pairs;
    bool shadows = false, light_occlusion = false;
    plan.lights.resize(lights.size());
    for (std::size_t j = 0; j < lights.size(); ++j) {
        if (tile.is_below(lights[j])) {
            plan.lights[j] = below | unshadowed | unhidden;
            continue;
        }
        const Shaft shaft = tile.towards(lights[j].center, lights[j].radius);
        const bool is_lit = !has_shadows || is_unshadowed(tile, shaft);
        const bool is_first = !has_occlusion || (asks_lights && is_unhidden(shaft, j));
        plan.lights[j] =
            static_cast<std::uint8_t>((is_lit ? unshadowed : 0) | (is_first ? unhidden : 0));
        shadows |= !is_lit, light_occlusion |= !is_first;
    }
    plan.effects.set(Effect::shadows, shadows);
    plan.effects.set(Effect::light_occlusion, light_occlusion);
}

/// Few enough pairs of a light and a surface?
bool TilePlanner::can_prove_each() const
{
    return scene_->lights.size() * std::max<std::size_t>(bodies_.size(), 1) <= most_surface_pairs;
}

/// Few enough pairs of a light and a surface; and where it is known how many samples are to come,
/// no more than some hundredths of the time that these take.
bool TilePlanner::pays_to_prove_each(std::size_t points) const
{
    if (!can_prove_each()) return false;
    const std::size_t pairs = scene_->lights.size() * std::max<std::size_t>(bodies_.size(), 1);
    const double samples = budget_->expected_samples() * static_cast<double>(points);
    constexpr double samples_per_pair = 16;  // a pair takes some hundredths of their time
    return samples <= 0 || static_cast<double>(pairs) * samples_per_pair <= samples;
}

TilePlan TilePlanner::plan(std::span<const ShadingPoint> points) const
{
    return plan(points, pays_to_prove_each(points.size()));
}

TilePlan TilePlanner::proved(std::span<const ShadingPoint> points) const
{
    return plan(points, can_prove_each());
}

TilePlan TilePlanner::plan(std::span<const ShadingPoint> points, bool proves_each) const
{
    const TileBounds tile = bounds_of(points);
    TilePlan plan{.effects = effects_.on & effects_of_tiles, .lights = {}, .blockers = nullptr};
    if (plan.effects.has(Effect::horizon))
        plan.effects.set(Effect::horizon, !are_lights_above(tile));
    if (proves_each) prove_each(tile, plan);
    else prove_all_at_once(tile, plan);
    if (plan.effects.has(Effect::light_occlusion))
        plan.blockers = Blockers::of(spheres_, scene_->lights, points, budget_);
    return plan;
}

}  // namespace mis
