#include "mis/scene/validate.h"

#include "mis/scene/rules.h"
#include "mis/scene/text.h"

#include <utility>

namespace mis {

std::optional<Problem> find_problem(const Scene& scene, const StopToken& stop)
{
    const auto indexed = [](const char* list, std::size_t i, MaybeProblem problem) {
        return problem ? placed_below(list + to_text(i), std::move(problem)) : MaybeProblem{};
    };
    return first_problem(
        [&] { return check_camera(scene); },
        [&] {
            return first_problem_among(scene.probes, stop, [&](const Probe& probe, std::size_t i) {
                return indexed("/probes/", i, check_probe(probe, scene));
            });
        },
        [&] {
            return first_problem_among(
                scene.materials, stop, [](const Material& material, std::size_t) {
                    return placed_below("/materials/" + pointer_token(material.name),
                                        check_material(material));
                });
        },
        [&] {
            return first_problem_among(
                scene.surfaces, stop, [&](const Surface& surface, std::size_t i) {
                    return indexed("/surfaces/", i, check_surface(surface, scene, stop));
                });
        },
        [&] { return check_triangle_count(scene); },
        [&] { return check_light_count(scene.lights); },
        [&] {
            return first_problem_among(scene.lights, stop, [&](const Light& light, std::size_t i) {
                return indexed("/lights/", i, check_kept_light(light));
            });
        },
        [&] {
            return scene.camera ? check_outside_lights(*scene.camera, scene.lights, stop)
                                : MaybeProblem{};
        },
        [&] { return check_near_lights(scene, stop); },
        [&] { return check_far_lights(scene, stop); });
}

}  // namespace mis
