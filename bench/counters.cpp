// Bar 3: no shadow ray without need. Each ray that the engine traces is looked at by itself.
#include "bench/recording.h"
#include "bench/subjects.h"
#include "mis/math/frame.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <unordered_map>

namespace mis::bench {

namespace {

/// Scenes where BSDF draws miss most of the time; scenes with lights below the horizon.
const std::vector<std::string> bsdf_scenes{"veach", "hundred", "street"},
    light_scenes{"horizon", "lecture", "street"};

std::string bsdf_run(const std::string& scene) { return "counters/bsdf/" + scene; }
std::string light_run(const std::string& scene) { return "counters/light/" + scene; }

/// Does the ray end on a light? To rounding, and to what its origin was moved off the surface.
bool ends_on_light(const ShadowRay& ray, const Ready& ready)
{
    const Vec3<double> end = ready.tracer->origin() + vec_cast<double>(ray.origin) +
                             vec_cast<double>(ray.direction) * static_cast<double>(ray.distance);
    const double slack = 1e-3 * (1 + static_cast<double>(ray.distance));
    for (const Light& light : ready.scene.lights)
        if (std::abs(length(end - light.center) - light.radius) < slack) return true;
    return false;
}

void count_bsdf_rays(benchmark::State& state, const Ready& ready)
{
    for (auto _ : state) {
        const Recording recording(ready, "brdf");
        std::size_t idle = 0;
        for (const ShadowRay& ray : recording.rays) idle += !ends_on_light(ray, ready);
        state.counters["needless_rays"] = static_cast<double>(idle);
        state.counters["rays_per_draw"] =
            static_cast<double>(recording.rays.size()) / static_cast<double>(recording.samples);
    }
}

/// The shading point that a ray starts from, by the ray's origin.
class Origins {
public:
    struct Point {
        const ShadingPoint* point;
        int material;
    };
    explicit Origins(const Ready& ready)
    {
        for (const Tile& tile : ready.shading.tiles)
            for (const ShadingPoint& point : ready.points_of(tile))
                points_[key(point.ray_origin)] = {&point, tile.material};
    }
    const Point& of(const ShadowRay& ray) const { return points_.at(key(ray.origin)); }

private:
    static std::string key(const Vec3<float>& v)
    {
        std::string text(sizeof v, '\0');
        std::memcpy(text.data(), &v, sizeof v);
        return text;
    }
    std::unordered_map<std::string, Point> points_;
};

/// Is f cos θ > 0, in double? A direction within rounding of the horizon counts as above it.
bool contributes(const ShadowRay& ray, const Origins& origins, const Ready& ready)
{
    const auto [point, material] = origins.of(ray);
    const Frame<double> frame = frame_around(normalized(vec_cast<double>(point->n)));
    Vec3<double> wi = frame.to_local(normalized(vec_cast<double>(ray.direction)));
    const Vec3<double> wo = frame.to_local(normalized(vec_cast<double>(point->wo)));
    if (wi.z <= -1e-6) return false;
    wi.z = std::max(wi.z, 1e-12);
    double f = 0;
    ready.lit.bsdf(material).visit(
        [&](const auto& bsdf) { f = luminance(bsdf.evaluate(wo, wi).f); });
    return f > 0;
}

void count_light_rays(benchmark::State& state, const Ready& ready)
{
    for (auto _ : state) {
        const Recording recording(ready, "uniform/light");
        const Origins origins(ready);
        std::size_t idle = 0;
        for (const ShadowRay& ray : recording.rays) idle += !contributes(ray, origins, ready);
        state.counters["needless_rays"] = static_cast<double>(idle);
        state.counters["rays_per_draw"] =
            static_cast<double>(recording.rays.size()) / static_cast<double>(recording.samples);
    }
}

}  // namespace

void add_counters()
{
    // Rays are asked for wherever a draw is worth something, whatever is proved of its tile.
    const auto add = [](const std::string& name, const std::string& scene, auto count) {
        const LazyReady ready =
            ready_lazily([=] { return shipped_scene(scene); }, Effect::everything);
        benchmark::RegisterBenchmark(name.c_str(),
                                     [=](benchmark::State& state) { count(state, ready()); })
            ->Iterations(1)
            ->Repetitions(1);
    };
    for (const std::string& scene : bsdf_scenes) add(bsdf_run(scene), scene, count_bsdf_rays);
    for (const std::string& scene : light_scenes) add(light_run(scene), scene, count_light_rays);
}

Bars counter_bars(const Figures& figures)
{
    Bars bars;
    const auto add = [&](const std::string& what, const std::string& run) {
        bars.push_back(
            {3, what, figures.at(run, "needless_rays"), Bar::Sense::at_most, 0,
             fmt::format("{:.4f} rays per draw", figures.at(run, "rays_per_draw").median)});
    };
    for (const std::string& scene : bsdf_scenes)
        add("rays of BSDF draws that meet no light, " + scene, bsdf_run(scene));
    for (const std::string& scene : light_scenes)
        add("rays of light draws worth 0, " + scene, light_run(scene));
    return bars;
}

}  // namespace mis::bench
