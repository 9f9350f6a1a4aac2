#include "mis/io/changes_text.h"

#include "mis/io/report_json.h"
#include "mis/io/text_layout.h"
#include "mis/words/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mis {
namespace {

constexpr std::array shown_figures{ChangingFigure::variance, ChangingFigure::efficiency,
                                   ChangingFigure::seconds_to_1_percent};

/// "~<5%": no change is seen, and if there is one, it is smaller than 5 %.
std::string unchanged(const Interval& ratio)
{
    const double within = 100 * std::max(ratio.high - 1, 1 / ratio.low - 1);
    return within < 999.5 ? fmt::format("~<{:.0f}%", std::ceil(within - 1e-9)) : "~";
}

std::string ratio_cell(const Change& change)
{
    if (!change.is_compared()) return "-";
    if (change.is_changed) return short_interval(change.by);
    return unchanged(change.by);
}

/// Where one of the two is exact, its variance is 0 and its efficiency infinite.
std::string cell(const StrategyChange& s, ChangingFigure figure)
{
    const bool says_exact =
        figure != ChangingFigure::seconds_to_1_percent && s[figure].is_compared();
    if (!says_exact || !(s.exact_before || s.exact_after)) return ratio_cell(s[figure]);
    return !s.exact_before ? "now exact" : s.exact_after ? "exact" : "was exact";
}

std::string mean_cell(const Change& mean)
{
    if (!mean.is_compared()) return "-";
    return mean.is_changed ? fmt::format("{:+.1f} se", mean.by.value) : "~";
}

std::string in_words(Status status)
{
    std::string words = name_of(status);
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

/// Why no figures are compared.
std::string remark(const StrategyChange& s)
{
    if (!s.status_before) return "new: " + in_words(*s.status_after);
    if (!s.status_after) return "gone; was " + in_words(*s.status_before);
    if (s.status_before == s.status_after) return in_words(*s.status_after) + " in both";
    return "was " + in_words(*s.status_before) + ", is " + in_words(*s.status_after);
}

const char* mark(const StrategyChange& s)
{
    return s.is_regression() ? "!" : s.is_changed() ? "*" : "~";
}

bool has_figures(const StrategyChange& s)
{
    return s.status_before == Status::ranked && s.status_after == Status::ranked;
}

std::string legend(const SceneChange& scene, const TextLook& look)
{
    const auto is_used = [&](const std::string& sign) {
        return std::ranges::any_of(scene.strategies,
                                   [&](const StrategyChange& s) { return mark(s) == sign; });
    };
    Legend legend;
    legend.add(is_used("!"), "! worse");
    legend.add(is_used("*"), "* changed");
    legend.add(is_used("~"), "~ no change is seen; ~<9% it is below 9 % (95 %)");
    return legend.text(look);
}

std::string table(const SceneChange& scene, const TextLook& look)
{
    TextTable table({{"", "strategy", "variance", "efficiency", "time to 1 %", "mean"}},
                    {3, 5, 2, 4});
    for (const StrategyChange& s : scene.strategies) {
        if (!has_figures(s)) {
            table.add_remark(mark(s), s.name, remark(s));
            continue;
        }
        std::vector<std::string> row{mark(s), s.name};
        for (const ChangingFigure figure : shown_figures) row.push_back(cell(s, figure));
        row.push_back(mean_cell(s[ChangingFigure::mean]));
        table.add(std::move(row));
    }
    return scene.strategies.empty() ? "" : table.text(look) + legend(scene, look);
}

std::string in_words(ChangingFigure figure)
{
    return figure == ChangingFigure::seconds_to_1_percent ? "time to 1 %" : name_of(figure);
}

/// "variance 1.12 ± 0.03 times what it was"
std::string in_words(const StrategyChange& s, ChangingFigure figure)
{
    const Change& change = s[figure];
    if (figure == ChangingFigure::mean)
        return fmt::format("mean {} instead of {}, {} standard errors away",
                           number(change.after, 6), number(change.before, 6),
                           number(std::fabs(change.by.value)));
    if (change.estimate.se == 0)
        return in_words(figure) + (s.exact_after ? " now exact" : " no longer exact");
    return in_words(figure) + " " + with_error(change.by) + " times what it was";
}

/// What is true of some of a strategy's figures, one by one.
std::string listed_figures(const StrategyChange& s, bool Change::*holds)
{
    std::vector<std::string> all;
    for (std::size_t i = 0; i < figures_that_change; ++i)
        if (s.figures[i].*holds) all.push_back(in_words(s, static_cast<ChangingFigure>(i)));
    return listed(all);
}

std::string sentences(const SceneChange& scene, const TextLook& look)
{
    std::string text;
    for (const StrategyChange& s : scene.strategies)
        if (const std::string all = listed_figures(s, &Change::is_changed); !all.empty())
            text += paragraph(s.name + ": " + all + ".", look);
    return text.empty() ? "" : "\n" + text;
}

std::string title(const SceneChange& scene)
{
    const std::string& file = scene.file_after.empty() ? scene.file_before : scene.file_after;
    return scene.name.empty() ? file : scene.name;
}

std::string scene_text(const SceneChange& scene, const TextLook& look)
{
    const std::string name = title(scene);
    const std::string& file = scene.file_before.empty() ? scene.file_after : scene.file_before;
    std::string text =
        paragraph(file == name || file.empty() ? name : name + " (" + file + ")", look);
    for (const std::string& sentence : scene.remarks) text += paragraph(sentence, look);
    if (!scene.strategies.empty()) text += "\n" + table(scene, look);
    return text + sentences(scene, look);
}

bool times_changed(const Changes& changes)
{
    for (const SceneChange& scene : changes.scenes)
        for (const StrategyChange& s : scene.strategies)
            if ((s[ChangingFigure::efficiency].is_changed ||
                 s[ChangingFigure::seconds_to_1_percent].is_changed) &&
                !s[ChangingFigure::variance].is_changed)
                return true;
    return false;
}

std::string summary(const Changes& changes, const TextLook& look)
{
    std::string text = paragraph(
        fmt::format("{} compared, {} changed; at most {} that chance alone made any of these.",
                    many(changes.comparisons, "figure"), changes.changed, percent(changes.error)),
        look);
    if (times_changed(changes))
        text += paragraph(
            "Times also change with what else the machine was doing: each interval knows its own "
            "run alone.",
            look);
    return text;
}

std::string regressions(const Changes& changes, const TextLook& look)
{
    if (!changes.worse_by) return "";
    const std::string limit = percent(*changes.worse_by);
    if (!changes.has_regression())
        return paragraph("No regression: nothing is surely worse by more than " + limit + ".", look,
                         Style::answer);
    std::string text =
        paragraph("Regressions (worse by more than " + limit + ", biased, or another mean):", look);
    for (const SceneChange& scene : changes.scenes)
        for (const StrategyChange& s : scene.strategies) {
            if (!s.is_regression()) continue;
            std::string what = listed_figures(s, &Change::is_regression);
            if (s.is_newly_biased()) what = what.empty() ? "now biased" : "now biased; " + what;
            text += paragraph(title(scene) + ": " + s.name + ": " + what + ".", look);
        }
    return text;
}

}  // namespace

std::string changes_text(const Changes& changes, const TextLook& look)
{
    std::string text;
    for (const std::string& sentence : changes.remarks) text += paragraph(sentence, look);
    for (const SceneChange& scene : changes.scenes)
        text += (text.empty() ? "" : "\n") + scene_text(scene, look);
    return text + (text.empty() ? "" : "\n") + summary(changes, look) + regressions(changes, look);
}

}  // namespace mis
