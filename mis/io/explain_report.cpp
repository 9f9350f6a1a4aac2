#include "mis/io/explain_report.h"

#include "mis/io/atomic_file.h"
#include "mis/io/json_writer.h"
#include "mis/words/numbers.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace mis {

namespace {

/// Words behind a label.
std::string labelled(const std::string& label, const std::string& text)
{
    return fmt::format("{:<18}{}\n", label, text);
}

std::string saving(const EffectPlan& effect)
{
    const bool has_rays = effect.saved_rays_per_sample > 0,
               has_time = std::isfinite(effect.saved_seconds_per_sample);
    if (!has_rays && !has_time) return "";
    std::string figures;
    if (has_rays) figures += fmt::format("{:.2f} rays", effect.saved_rays_per_sample);
    if (has_rays && has_time) figures += " and ";
    if (has_time) figures += fmt::format("{:.0f} ns", 1e9 * effect.saved_seconds_per_sample);
    return fmt::format("; saves {} a sample of uniform/power", figures);
}

std::string state(const EffectPlan& effect)
{
    if (!effect.on) return "off";
    return effect.share < 1 ? fmt::format("on for {:.3g} % of the tiles", 100 * effect.share)
                            : "on";
}

std::string sees(std::size_t points)
{
    return fmt::format("{} {}", points, points == 1 ? "sees" : "see");
}

/// How many points there are, why some are dark, and whose normals lean away.
std::string points_text(const Explanation& found)
{
    std::string text = fmt::format("{} in {}", found.shading_points, many(found.tiles, "tile"));
    std::string reasons;
    const auto give = [&](std::size_t count, std::string_view reason) {
        if (count > 0)
            reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", count, reason);
    };
    give(found.counts.seen_from_below, "seen from below");
    give(found.counts.inside_light, "inside a light");
    give(found.counts.facing_no_light, "facing none");
    if (!reasons.empty())
        text += fmt::format("; {} no light: {}", sees(found.dark_points), reasons);
    if (found.counts.turned_normals > 0)
        text += fmt::format(
            "; of {} the shading normal leans away from the viewer and is turned to him, of these "
            "{} no "
            "light",
            found.counts.turned_normals, sees(found.counts.turned_and_dark));
    return text;
}

}  // namespace

std::string explanation_text(const Explanation& found, const TextLook& look)
{
    std::string text = labelled(
        "scene", printable(found.name.empty() ? found.file : found.name + " (" + found.file + ")"));
    std::string lights = many(found.lights, "light");
    if (found.black_lights > 0) lights += fmt::format(", {} of them black", found.black_lights);
    lights += fmt::format("; radius {:.4g} to {:.4g}, power {:.4g} to {:.4g} W (luminance)",
                          found.radius.low, found.radius.high, found.power.low, found.power.high);
    text += labelled("lights", lights);
    text += labelled("surfaces", many(found.quads, "quad") + ", " + many(found.spheres, "sphere") +
                                     ", " + fmt::format("{} of ", many(found.meshes, "mesh")) +
                                     many(found.triangles, "triangle"));
    if (found.width > 0)
        text += labelled("picture", fmt::format("{} x {} pixels, of which {} {} no surface",
                                                found.width, found.height, found.background_pixels,
                                                found.background_pixels == 1 ? "shows" : "show"));
    if (found.probes > 0) text += labelled("probes", std::to_string(found.probes));
    text += labelled("shading points", points_text(found));
    for (const MaterialUse& material : found.materials)
        text +=
            labelled("material", fmt::format("{} ({}), {}", printable(material.name), material.type,
                                             many(material.shading_points, "point")));
    text += labelled("memory", fmt::format("lights {:.3g} MB, hierarchy over them {:.3g} MB",
                                           static_cast<double>(found.light_bytes) / 1e6,
                                           static_cast<double>(found.hierarchy_bytes) / 1e6));
    text += "\n";
    for (const EffectPlan& effect : found.effects)
        text += labelled(effect.name, state(effect) + ": " + effect.why + saving(effect));
    return fitted(text, look.columns);
}

void write_explanation_json(const Explanation& found, const RunHeader& run, const std::string& path)
{
    OrderedJson effects = OrderedJson::object(), materials = OrderedJson::array();
    for (const EffectPlan& e : found.effects) effects[e.name] = described_json(e);
    for (const MaterialUse& m : found.materials)
        materials.push_back(
            {{"name", m.name}, {"type", m.type}, {"shading_points", m.shading_points}});
    const OrderedJson scene{
        {"file", found.file},
        {"name", found.name},
        {"lights", found.lights},
        {"black_lights", found.black_lights},
        {"light_radius", {{"low", found.radius.low}, {"high", found.radius.high}}},
        {"light_power", {{"low", found.power.low}, {"high", found.power.high}}},
        {"quads", found.quads},
        {"spheres", found.spheres},
        {"meshes", found.meshes},
        {"triangles", found.triangles},
        {"resolution", json_resolution(found.width, found.height)},
        {"shading_points", found.shading_points},
        {"dark_points", found.dark_points},
        {"dark_because",
         {{"seen_from_below", found.counts.seen_from_below},
          {"inside_light", found.counts.inside_light},
          {"facing_no_light", found.counts.facing_no_light}}},
        {"turned_normals", found.counts.turned_normals},
        {"turned_and_dark", found.counts.turned_and_dark},
        {"background_pixels", found.background_pixels},
        {"tiles", found.tiles},
        {"probes", found.probes},
        {"materials", materials},
        {"effects", effects}};
    const OrderedJson report{{"format", "mis-explain/1"}, {"version", MIS_VERSION},
                             {"command", run.command},    {"seed", run.seed},
                             {"threads", run.threads},    {"scenes", OrderedJson::array({scene})}};
    write_text(path, json_text(report));
}

}  // namespace mis
