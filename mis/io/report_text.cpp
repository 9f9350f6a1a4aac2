#include "mis/io/report_text.h"

#include "mis/io/text_layout.h"
#include "mis/words/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mis {
namespace {

constexpr std::size_t most_probes = 4;  // columns of them; the others are in --json

std::string heading(const SceneReport& scene, const Report& report)
{
    std::string text = scene.name.empty() ? scene.file : scene.name;
    if (scene.file != text && !scene.file.empty()) text += fmt::format(" ({})", scene.file);
    text += ": ";
    if (scene.width > 0) text += fmt::format("{}x{}, ", scene.width, scene.height);
    text += fmt::format("{}, {}, {}, {}", many(scene.shading_points, "shading point"),
                        many(scene.lights, "light"), many(scene.surfaces, "surface"),
                        many(static_cast<std::size_t>(scene.replicates), "replicate"));
    if (report.is_sobol) text += fmt::format(", Sobol' sequences of {:.0f} samples", report.at);
    if (scene.seconds > 0) text += fmt::format(", {}", short_duration(scene.seconds));
    text += setup_text(scene.setup);
    text += scene.partial   ? ", stopped early"
            : scene.settled ? ", settled"
            : scene.decided ? ", decided"
                            : ", not decided";
    return wrapped(text);
}

std::string effects(const SceneReport& scene)
{
    std::string on, off;
    for (const EffectPlan& e : scene.effects) {
        std::string& list = e.on ? on : off;
        list += (list.empty() ? "" : ", ") + e.name;
        if (e.on && e.share < 1) list += fmt::format(" ({:.0f} % of tiles)", 100 * e.share);
    }
    if (scene.effects.empty()) return "";
    return wrapped("effects: " + (on.empty() ? "none" : on) +
                   (off.empty() ? "" : "; not called for: " + off));
}

std::string places(const StrategyReport& s)
{
    return s.rank_low == s.rank_high ? fmt::format("{}", s.rank)
                                     : fmt::format("{}-{}", s.rank_low, s.rank_high);
}

/// "~": not decided against some other. "=": tied with one.
std::string marked(const SceneReport& scene, const StrategyReport& s)
{
    const auto is_open = [&](const PairReport& p) {
        return p.verdict == Verdict::undecided &&
               (&scene.strategies[static_cast<std::size_t>(p.a)] == &s ||
                &scene.strategies[static_cast<std::size_t>(p.b)] == &s);
    };
    const char* mark = std::ranges::any_of(scene.pairs, is_open) ? "~"
                       : s.tied_with.empty()                     ? " "
                                                                 : "=";
    return mark + name_of(s.strategy);
}

const char* words_of(Status status)
{
    return status == Status::not_run  ? "not run"
           : status == Status::biased ? "biased"
                                      : "not resolved";
}

/// Ranked ones first, by rank; then the others, by state.
std::vector<const StrategyReport*> in_order(const SceneReport& scene)
{
    std::vector<const StrategyReport*> order;
    for (const StrategyReport& s : scene.strategies) order.push_back(&s);
    std::stable_sort(order.begin(), order.end(),
                     [](const StrategyReport* a, const StrategyReport* b) {
                         return std::pair(-static_cast<int>(a->status), a->rank) <
                                std::pair(-static_cast<int>(b->status), b->rank);
                     });
    return order;
}

std::string table(const SceneReport& scene)
{
    TextTable table({{"rank", " strategy", "variance", "rel. var", "ns", "rays", "effic-", "time"},
                     {"", "", "±", "±", " per", "sample", "iency", "to 1 %"}});
    for (const StrategyReport* s : in_order(scene)) {
        if (s->status != Status::ranked) {
            table.add_remark("-", " " + name_of(s->strategy), words_of(s->status));
            continue;
        }
        table.add({places(*s), marked(scene, *s), s->exact ? "exact" : short_interval(s->variance),
                   s->exact ? "exact" : short_interval(s->relative_variance),
                   short_number(1e9 * s->seconds_per_sample.value),
                   fmt::format("{:.2f}", s->rays_per_sample),
                   s->exact ? "" : short_number(s->efficiency.value),
                   short_duration(s->seconds_to_1_percent.value)});
    }
    return table.text();
}

std::string probes(const SceneReport& scene)
{
    std::size_t count = 0;
    for (const StrategyReport& s : scene.strategies) count = std::max(count, s.probes.size());
    if (count == 0 || (scene.width == 0 && count == 1))
        return "";  // a single probe is the table itself
    const std::size_t shown = std::min(count, most_probes);
    std::vector<std::string> head{"", " variance at"};
    for (std::size_t i = 0; i < shown; ++i) head.push_back(fmt::format("probe {}", i));
    if (shown == 1) head.push_back("");  // three cells would be a remark
    TextTable table({head});
    for (const StrategyReport* s : in_order(scene)) {
        if (s->probes.empty()) continue;
        std::vector<std::string> row{"", " " + name_of(s->strategy)};
        for (std::size_t i = 0; i < shown && i < s->probes.size(); ++i)
            row.push_back(short_interval(s->probes[i].variance));
        if (shown == 1) row.push_back("");
        table.add(row);
    }
    return "\n" + table.text() +
           (count > shown ? fmt::format(" ({} in --json)\n", many(count - shown, "more probe"))
                          : "");
}

/// "-" where every scene has exact ones and this is none of them.
std::string ratio(const Interval& x) { return std::isfinite(x.value) ? short_interval(x) : "-"; }

std::string overall_table(const std::vector<OverallReport>& overall)
{
    TextTable table({{"rank", " strategy", "variance", "variance", "time to", "beaten"},
                     {"", "", "", "x time", "1 %", "by exact"}});
    for (const OverallReport& o : overall)
        table.add({fmt::format("{}", o.rank), " " + o.name, ratio(o.variance_ratio),
                   ratio(o.cost_ratio), ratio(o.time_ratio),
                   many(static_cast<std::size_t>(o.beaten_by_exact), "time")});
    return table.text();
}

std::string paragraphs(const std::vector<std::string>& sentences)
{
    std::string text;
    for (const std::string& sentence : sentences) text += wrapped(sentence);
    return text;
}

}  // namespace

std::string scene_text(const SceneReport& scene, const Report& report)
{
    return heading(scene, report) + effects(scene) + "\n" + table(scene) + probes(scene) + "\n" +
           paragraphs(sentences_of(scene, report.threads, report.margin));
}

std::string ranking_text(const SceneReport& scene) { return table(scene); }

std::string overall_text(const Report& report)
{
    if (report.scenes.size() < 2) return "";
    std::string text =
        fmt::format("All {} scenes (geometric means of the ratios to each scene's best)\n\n",
                    report.scenes.size());
    if (!report.overall.empty()) text += overall_table(report.overall) + "\n";
    return text + paragraphs(overall_sentences_of(report));
}

std::string report_text(const Report& report)
{
    std::string text;
    for (const SceneReport& scene : report.scenes)
        text += (text.empty() ? "" : "\n") + scene_text(scene, report);
    if (const std::string overall = overall_text(report); !overall.empty()) text += "\n" + overall;
    return text;
}

}  // namespace mis
