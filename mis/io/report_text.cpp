#include "mis/io/report_text.h"

#include "mis/io/text_layout.h"
#include "mis/words/numbers.h"
#include "mis/words/troubles.h"
#include "mis/words/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mis {
namespace {

constexpr std::size_t most_probes = 4;  // columns of them; the others are in --json

std::string heading(const SceneReport& scene, const Report& report, const TextLook& look)
{
    std::string text = scene.name.empty() ? scene.file : scene.name;
    if (scene.file != text && !scene.file.empty()) text += fmt::format(" ({})", scene.file);
    text += ": ";
    if (scene.width > 0) text += fmt::format("{}x{}, ", scene.width, scene.height);
    text += fmt::format("{}, {}, {}, {}", many(scene.shading_points, "shading point"),
                        many(scene.lights, "light"), many(scene.surfaces, "surface"),
                        scene.directions > 0
                            ? many(scene.directions, "shared direction") + " per point"
                            : many(static_cast<std::size_t>(scene.replicates), "replicate"));
    if (report.is_sobol) text += fmt::format(", Sobol' sequences of {:.0f} samples", report.at);
    if (scene.seconds > 0) text += fmt::format(", {}", short_duration(scene.seconds));
    text += setup_text(scene.setup);
    text += scene.partial   ? ", stopped early"
            : scene.settled ? ", settled"
            : scene.decided ? ", decided"
                            : ", not decided";
    return paragraph(text, look);
}

std::string effects(const SceneReport& scene, const TextLook& look)
{
    std::string on, off;
    for (const EffectPlan& e : scene.effects) {
        std::string& list = e.on ? on : off;
        list += (list.empty() ? "" : ", ") + e.name;
        if (e.on && e.share < 1) list += fmt::format(" ({:.0f} % of tiles)", 100 * e.share);
    }
    if (scene.effects.empty()) return "";
    return paragraph(
        "effects: " + (on.empty() ? "none" : on) + (off.empty() ? "" : "; not called for: " + off),
        look);
}

std::string places(const StrategyReport& s)
{
    return s.rank_low == s.rank_high ? fmt::format("{}", s.rank)
                                     : fmt::format("{}-{}", s.rank_low, s.rank_high);
}

/// "~": not decided against some other. "=": tied with one.
char mark(const SceneReport& scene, const StrategyReport& s)
{
    const auto is_open = [&](const PairReport& p) {
        return p.verdict == Verdict::undecided &&
               (&scene.strategies[static_cast<std::size_t>(p.a)] == &s ||
                &scene.strategies[static_cast<std::size_t>(p.b)] == &s);
    };
    return std::ranges::any_of(scene.pairs, is_open) ? '~' : s.tied_with.empty() ? ' ' : '=';
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

constexpr std::size_t wide_columns = 96;  ///< room for whole words above the columns

TextTable table_of_ranks(const TextLook& look)
{
    const std::vector<std::size_t> first_to_go{5, 6, 4, 3, 7};
    if (look.columns >= wide_columns)
        return TextTable(
            {{"rank", " strategy", "variance", "rel. var", "ns", "rays", "efficiency", "time to"},
             {"", "", "±", "±", "per sample", "per sample", "", "1 %"}},
            first_to_go);
    return TextTable({{"rank", " strategy", "variance", "rel. var", "ns", "rays", "effic.", "time"},
                      {"", "", "±", "±", " per", "sample", "", "to 1 %"}},
                     first_to_go);
}

std::string legend(const SceneReport& scene, const TextLook& look)
{
    const auto is_used = [&](char sign) {
        return std::ranges::any_of(scene.strategies, [&](const StrategyReport& s) {
            return s.status == Status::ranked && mark(scene, s) == sign;
        });
    };
    Legend legend;
    legend.add(is_used('~'), "~ undecided against another");
    legend.add(is_used('='), "= tied with another");
    legend.add(look.columns < wide_columns, "effic.: efficiency");
    return legend.text(look);
}

std::string table(const SceneReport& scene, const TextLook& look)
{
    TextTable table = table_of_ranks(look);
    for (const StrategyReport* s : in_order(scene)) {
        if (s->status != Status::ranked) {
            table.add_remark("-", " " + name_of(s->strategy), words_of(s->status));
            continue;
        }
        table.add({places(*s), mark(scene, *s) + name_of(s->strategy),
                   s->exact ? "exact" : short_interval(s->variance),
                   s->exact ? "exact" : short_interval(s->relative_variance),
                   short_number(1e9 * s->seconds_per_sample.value),
                   fmt::format("{:.2f}", s->rays_per_sample),
                   s->exact ? "" : short_number(s->efficiency.value),
                   short_duration(s->seconds_to_1_percent.value)});
    }
    return table.text(look);
}

std::string probes(const SceneReport& scene, const TextLook& look)
{
    std::size_t count = 0;
    for (const StrategyReport& s : scene.strategies) count = std::max(count, s.probes.size());
    if (count == 0 || (scene.width == 0 && count == 1))
        return "";  // a single probe is the table itself
    const std::size_t shown = std::min(count, most_probes);
    std::vector<std::string> head{"", " variance at"};
    for (std::size_t i = 0; i < shown; ++i) head.push_back(fmt::format("probe {}", i));
    TextTable table({head});
    for (const StrategyReport* s : in_order(scene)) {
        if (s->probes.empty()) continue;
        std::vector<std::string> row{"", " " + name_of(s->strategy)};
        for (std::size_t i = 0; i < shown && i < s->probes.size(); ++i)
            row.push_back(short_interval(s->probes[i].variance));
        table.add(row);
    }
    return "\n" + table.text(look) +
           (count > shown ? fmt::format(" ({} in --json)\n", many(count - shown, "more probe"))
                          : "");
}

/// The variance per draw where a point gets more samples or fewer, if several numbers were asked
/// for.
std::string variances_at_counts(const SceneReport& scene, const TextLook& look)
{
    constexpr std::size_t most_columns = 5;  // the others are in --json
    std::vector<std::string> head{"", " rel. variance per"}, below{"", " draw at n ="};
    const auto has_many = [](const StrategyReport* s) { return s->at_counts.size() > 1; };
    const auto varies = [](const StrategyReport* s) {
        return std::ranges::any_of(s->at_counts, [&](const CountFigures& c) {
            return c.status != Status::ranked || c.variance.value != s->variance.value;
        });
    };
    const std::vector<const StrategyReport*> order = in_order(scene);
    const auto first = std::ranges::find_if(order, has_many);
    if (first == order.end()) return "";
    if (std::ranges::none_of(order, varies))
        return "\n" + paragraph(
                          "Of independent samples the variance per draw is the same at every "
                          "--at; --json has the efficiency and the error at each.",
                          look);
    const std::vector<CountFigures>& counts = (*first)->at_counts;
    const std::size_t shown = std::min(counts.size(), most_columns);
    for (std::size_t k = 0; k < shown; ++k) head.push_back(fmt::format("{:.6g}", counts[k].n));
    for (std::size_t k = 0; k < shown; ++k) below.push_back("±");
    TextTable table({head, below});
    for (const StrategyReport* s : order) {
        if (!has_many(s)) continue;
        std::vector<std::string> row{"", " " + name_of(s->strategy)};
        for (std::size_t k = 0; k < shown && k < s->at_counts.size(); ++k) {
            const CountFigures& c = s->at_counts[k];
            row.push_back(c.status != Status::ranked ? words_of(c.status)
                          : s->exact                 ? "exact"
                                                     : short_interval(c.relative_variance));
        }
        table.add(row);
    }
    return "\n" + table.text(look) +
           (counts.size() > shown
                ? fmt::format(" ({} in --json)\n", many(counts.size() - shown, "more number"))
                : "");
}

/// "-" where every scene has exact ones and this is none of them.
std::string ratio(const Interval& x) { return std::isfinite(x.value) ? short_interval(x) : "-"; }

std::string overall_table(const std::vector<OverallReport>& overall, const TextLook& look)
{
    TextTable table({{"rank", " strategy", "variance", "variance", "time to", "beaten"},
                     {"", "", "", "x time", "1 %", "by exact"}},
                    {5, 3, 2});
    for (const OverallReport& o : overall)
        table.add({fmt::format("{}", o.rank), " " + o.name, ratio(o.variance_ratio),
                   ratio(o.cost_ratio), ratio(o.time_ratio),
                   many(static_cast<std::size_t>(o.beaten_by_exact), "time")});
    return table.text(look);
}

/// What is not sure, which a terminal may show apart.
bool is_doubt(const std::string& sentence)
{
    return sentence.starts_with("Not yet sure") || sentence.starts_with("Not decided") ||
           sentence.starts_with("No strategy") || sentence.starts_with("There was no time");
}

/// The first of them is what the run was for.
std::string answer(const std::vector<std::string>& sentences, const TextLook& look)
{
    std::string text;
    for (const std::string& sentence : sentences)
        text += paragraph(sentence, look,
                          is_doubt(sentence) ? Style::doubt
                          : text.empty()     ? Style::answer
                                             : Style::plain);
    return text;
}

std::string details(const SceneReport& scene, const SceneWords& words, const TextLook& look)
{
    std::string text;
    for (const std::string& sentence : look.is_verbose ? words.details : kinds_of_trouble(scene))
        text += paragraph(sentence, look, Style::plain);
    return text.empty() ? "" : text + "\n";
}

}  // namespace

std::string scene_text(const SceneReport& scene, const Report& report, const TextLook& look)
{
    const SceneWords words = words_of(scene, report.threads, report.margin);
    return heading(scene, report, look) + effects(scene, look) + "\n" + table(scene, look) +
           legend(scene, look) + variances_at_counts(scene, look) + probes(scene, look) + "\n" +
           details(scene, words, look) + answer(words.answer, look);
}

std::string ranking_text(const SceneReport& scene, const TextLook& look)
{
    return table(scene, look);
}

std::string overall_text(const Report& report, const TextLook& look)
{
    if (report.scenes.size() < 2) return "";
    std::string text =
        paragraph(fmt::format("All {} scenes (geometric means of the ratios to each scene's best)",
                              report.scenes.size()),
                  look);
    text += "\n";
    if (!report.overall.empty()) text += overall_table(report.overall, look) + "\n";
    return text + answer(overall_sentences_of(report), look);
}

std::string report_text(const Report& report, const TextLook& look)
{
    std::string text;
    for (const SceneReport& scene : report.scenes)
        text += (text.empty() ? "" : "\n") + scene_text(scene, report, look);
    if (const std::string overall = overall_text(report, look); !overall.empty())
        text += "\n" + overall;
    return text;
}

}  // namespace mis
