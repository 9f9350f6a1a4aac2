// Leaves a report.html whose pictures hold what no scene file can bring about: a light whose
// radiance is no number, seen by the camera and by the left slope of a roof, not by the right one.
//     no_number FILE
// Prints, as JSON, which pixels must show as marked: of the reference, and of each strategy.
#include "mis/io/report_html.h"
#include "mis/run/serial.h"
#include "mis/study/maps.h"
#include "mis/study/study.h"
#include "mis/trace/analytic.h"

#include "tests/support/scenes.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <limits>

using namespace mis;

namespace {

Scene roof_beside_a_broken_light()
{
    Scene scene = probe_under({make_light({0, 6, 0}, 0.5, Vec3<double>(10)),
                               make_light({-3, 1, 0}, 0.3, Vec3<double>(1))},
                              grey_floor());
    scene.probes.clear();
    scene.name = "broken";
    scene.file = "broken.json";
    scene.lights[1].radiance_radius = Vec3<float>(std::numeric_limits<float>::quiet_NaN());
    scene.camera = Camera{.position = {0, 3, 8}, .target = {0, 0, 0}, .resolution = {48, 32}};
    for (const double side : {-4.0, 4.0})
        scene.surfaces.push_back({Quad{{0, 1, -4}, {Vec3<double>{side, -2, 0}, {0, 0, 8}}}, 0});
    return scene;
}

bool is_number(const Vec3<float>& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::vector<std::size_t> without_number(const std::vector<Vec3<float>>& picture)
{
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < picture.size(); ++i)
        if (!is_number(picture[i])) found.push_back(i);
    return found;
}

}  // namespace

int main(int, char** arguments)
{
    const Scene scene = roof_beside_a_broken_light();
    const AnalyticTracer tracer(scene);
    const LitScene lit(scene, &tracer, called_for(scene));
    const std::vector<Strategy> strategies{parse_strategy("uniform/light"),
                                           parse_strategy("uniform/power"), parse_strategy("brdf")};
    const AnyExecutor executor = any_executor(SerialExecutor{});
    const Study study = run_study(lit, strategies, {.spp = 64}, executor);
    const Maps maps = maps_of(lit, study, 16, executor);
    Report report{{.version = "0", .command = "none", .machine = "any"}};
    report.scenes.push_back(study.report);
    const std::vector<std::optional<PagePictures>> pictures{
        page_pictures(maps, most_page_values, "0-")};
    write_report_html(report, pictures, arguments[1]);

    nlohmann::json marked{{"reference", without_number(maps.reference)}};
    for (const StrategyMap& map : maps.strategies) {
        std::vector<std::size_t> pixels = without_number(map.mean);
        pixels.insert(pixels.end(), map.bad.begin(), map.bad.end());
        marked[std::to_string(map.strategy)] = pixels;
    }
    std::puts(marked.dump().c_str());
    return 0;
}
