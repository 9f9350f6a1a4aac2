#include "mis/words/changes_remarks.h"

#include "mis/words/numbers.h"

#include <cstdint>

namespace mis {
namespace {

/// "a, then b", behind a label; or nothing where both are the same.
void add(std::string& list, const std::string& label, const std::string& before,
         const std::string& after)
{
    if (before == after) return;
    list += (list.empty() ? "" : "; ") + label + (label.empty() ? "" : " ") + before + ", then " +
            after;
}

std::string unsigned_text(std::uint64_t n) { return std::to_string(n); }

std::string size_of(const SceneReport& s)
{
    return s.width > 0 ? std::to_string(s.width) + "x" + std::to_string(s.height) : "no camera";
}

/// Of each strategy that was run, in the mean.
std::string samples_per_point(const SceneReport& s)
{
    double sum = 0, run = 0;
    for (const StrategyReport& strategy : s.strategies)
        if (strategy.status != Status::not_run) sum += static_cast<double>(strategy.samples), ++run;
    const double points = static_cast<double>(s.shading_points);
    return run > 0 && points > 0 ? number(sum / run / points) : "no";
}

/// How the scene's content and points differ; empty where they do not.
std::string other_points(const SceneReport& b, const SceneReport& a)
{
    std::string list;
    add(list, "lights", unsigned_text(b.lights), unsigned_text(a.lights));
    add(list, "surfaces", unsigned_text(b.surfaces), unsigned_text(a.surfaces));
    add(list, "triangles", unsigned_text(b.triangles), unsigned_text(a.triangles));
    add(list, "resolution", size_of(b), size_of(a));
    add(list, "shading points", unsigned_text(b.shading_points), unsigned_text(a.shading_points));
    return list;
}

void add_sentence(std::vector<std::string>& sentences, const std::string& lead,
                  const std::string& list, const std::string& end = ".")
{
    if (!list.empty()) sentences.push_back(lead + list + end);
}

std::vector<std::string> remarks_on(const Report& b, const Report& a)
{
    std::vector<std::string> sentences;
    std::string run, times, at;
    add(run, "version", b.version, a.version);
    add(run, "seed", unsigned_text(b.seed), unsigned_text(a.seed));
    add(run, "sampler", sampler_name(b.is_sobol), sampler_name(a.is_sobol));
    add_sentence(sentences, "The runs differ: ", run);
    add(times, "machine", b.machine, a.machine);
    add(times, "instruction set", b.instruction_set, a.instruction_set);
    add(times, "threads", std::to_string(b.threads), std::to_string(a.threads));
    add_sentence(sentences, "Warning: ", times,
                 ": times and efficiencies differ by that too, not by mis alone.");
    add(at, "", number(b.at, 15), number(a.at, 15));
    add_sentence(sentences, "Efficiencies are not compared: they are for ", at,
                 " samples per point.");
    if (b.is_sobol != a.is_sobol || (b.is_sobol && b.at != a.at))
        sentences.push_back(
            "Warning: variances differ by the sampler and its samples per scrambling, too.");
    if (b.partial) sentences.push_back("The first run was stopped before its end.");
    if (a.partial) sentences.push_back("The second run was stopped before its end.");
    return sentences;
}

std::vector<std::string> remarks_on(const SceneReport& b, const SceneReport& a)
{
    std::vector<std::string> sentences;
    std::string files, samples;
    add(files, "", b.file, a.file);
    add_sentence(sentences, "Matched by name, as the files differ: ", files);
    add_sentence(sentences, "Warning: not the same points: ", other_points(b, a),
                 ". Means are not compared, and the other figures are of different things.");
    add(samples, "", samples_per_point(b), samples_per_point(a));
    add_sentence(sentences, "Samples per point: ", samples);
    return sentences;
}

std::vector<std::string> remarks_on(const SceneChange& scene, const Report& before,
                                    const Report& after)
{
    if (scene.after == SceneChange::none) return {"Only the first report has this scene."};
    if (scene.before == SceneChange::none) return {"Only the second report has this scene."};
    return remarks_on(before.scenes[scene.before], after.scenes[scene.after]);
}

}  // namespace

void add_remarks(Changes& changes, const Report& before, const Report& after)
{
    changes.remarks = remarks_on(before, after);
    for (SceneChange& scene : changes.scenes) scene.remarks = remarks_on(scene, before, after);
}

}  // namespace mis
