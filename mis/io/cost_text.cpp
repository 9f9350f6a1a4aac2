#include "mis/io/cost_text.h"

#include "mis/io/text_layout.h"
#include "mis/words/cost_remarks.h"
#include "mis/words/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace mis {
namespace {

constexpr std::size_t most_columns = 6;  // of samples; the others are in --json

std::string heading(const CostSceneReport& s, int threads, const TextLook& look)
{
    std::string text = s.name.empty() ? s.file : s.name;
    if (s.file != text && !s.file.empty()) text += fmt::format(" ({})", s.file);
    text += ": ";
    if (s.width > 0) text += fmt::format("{}x{}, ", s.width, s.height);
    text +=
        fmt::format("{}, {}, {}", many(s.shading_points, "shading point"), many(s.lights, "light"),
                    many(static_cast<std::size_t>(s.replicates), "replicate"));
    if (s.copies > 1) text += fmt::format(" of {} copies", s.copies);
    if (s.is_sobol) text += ", each a scrambled Sobol' sequence";
    text += fmt::format(", times on {}, {}{}", many(static_cast<std::size_t>(threads), "thread"),
                        short_duration(s.seconds) + setup_text(s.setup),
                        s.partial ? ", stopped early" : "");
    return paragraph(text, look);
}

std::string reference(const ReferenceReport& r, const TextLook& look)
{
    if (r.exact)
        return paragraph(
            "reference: exact, by quadrature; its error is at most " + percent(r.error), look);
    if (r.samples == 0) return "";
    const std::string others =
        r.sources.size() < 2 ? ""
                             : ", pooled with fewer of " + listed(std::span(r.sources).subspan(1));
    return paragraph(
        fmt::format("reference: {} per point of {}{}; its own error of {} is taken off, and errors "
                    "below it are not trusted",
                    many(r.samples, "sample"), r.sources.front(), others, percent(r.error)),
        look);
}

/// What an error is, of which all tables are.
std::string definition(double epsilon, const TextLook& look)
{
    const std::string square =
        epsilon > 0 ? "(reference^2 + " + number(epsilon, 2) + "^2)" : std::string("reference^2");
    return paragraph(
        "error: the root of the mean, over points and replicates, of (estimate - reference)^2/" +
            square,
        look);
}

/// Soonest to 1 % first, those without a curve last.
std::vector<const CostCurveReport*> in_order(const CostSceneReport& scene)
{
    std::vector<const CostCurveReport*> order;
    for (const CostCurveReport& c : scene.curves) order.push_back(&c);
    const auto key = [](const CostCurveReport* c) {
        for (const TimeToError& t : c->times)
            if (t.error == 0.01 && t.reach != Reach::unknown)
                return t.reach == Reach::at_most ? t.seconds.high : t.seconds.value;
        return c->points.empty() ? std::numeric_limits<double>::infinity() : 1e300;
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](const auto* a, const auto* b) { return key(a) < key(b); });
    return order;
}

/// "-0.500±0.004".
std::string slope(const Interval& x)
{
    if (!std::isfinite(x.value)) return "-";
    return std::isfinite(x.high) ? short_interval(x) : fmt::format("{:.3f}", x.value);
}

/// In percent: "<0.02" where only a bound is known; "~3.4" where rare samples carry it.
std::string error(const CostPoint& p)
{
    if (p.error.high == 0) return "0";
    if (p.trust == Trust::below_reference) return "<" + short_number(100 * p.error.high);
    const std::string value = short_number(100 * p.error.value);
    if (p.trust == Trust::rare_samples) return "~" + value;
    return value;
}

std::string error_with_interval(const CostPoint& p)
{
    if (p.trust != Trust::trusted) return error(p);
    return short_interval({100 * p.error.value, 100 * p.error.low, 100 * p.error.high});
}

std::string slopes(const CostSceneReport& scene, const TextLook& look)
{
    TextTable table({{"", "strategy", "most", "error", "slope", "slope"},
                     {"", "", "samples", "there, %", "in samples", "in time"}},
                    {2, 3});
    for (const CostCurveReport* c : in_order(scene)) {
        if (c->points.empty()) {
            table.add_remark("", name_of(*c), "not run");
            continue;
        }
        table.add({"", name_of(*c), fmt::format("{}", c->points.back().samples),
                   error_with_interval(c->points.back()), slope(c->slope) + (c->fits ? " " : "!"),
                   slope(c->slope_in_time)});
    }
    table.add({"", "theory", "", "", "-0.5    ", "-0.5"});
    return table.text(look);
}

/// Samples that columns are for: at most so many, evenly spread over the doublings.
std::vector<std::size_t> shown_levels(const CostSceneReport& scene)
{
    std::size_t levels = 0;
    for (const CostCurveReport& c : scene.curves) levels = std::max(levels, c.points.size());
    const std::size_t step = (levels + most_columns - 1) / most_columns;
    std::vector<std::size_t> shown;
    for (std::size_t k = 0; step > 0 && k < levels; k += step) shown.push_back(k);
    return shown;
}

std::string errors(const CostSceneReport& scene, const TextLook& look)
{
    const std::vector<std::size_t> shown = shown_levels(scene);
    if (shown.empty()) return "";
    std::vector<std::string> head{"", "error in % after"};
    for (const std::size_t k : shown) head.push_back(fmt::format("{}", std::size_t{1} << k));
    TextTable table({head}, {3, 5, 2, 4});
    for (const CostCurveReport* c : in_order(scene)) {
        if (c->points.empty()) continue;
        std::vector<std::string> row{"", name_of(*c)};
        for (const std::size_t k : shown)
            row.push_back(k < c->points.size() ? error(c->points[k]) : "");
        table.add(row);
    }
    return "\n" + table.text(look);
}

/// "830±30ms", with "*" where extrapolated; "<0.83s" where that is a bound.
std::string time_cell(const TimeToError& t)
{
    if (t.reach == Reach::unknown) return "- ";
    if (t.reach == Reach::at_most) return "<" + short_duration(t.seconds.high) + " ";
    if (!(t.seconds.low > 0)) return "<" + short_duration(t.seconds.high) + " ";
    return short_duration(t.seconds) + (t.reach == Reach::extrapolated ? "*" : " ");
}

/// "12±1", "~12" where rare samples carry it.
std::string gain_cell(const CostPoint& p)
{
    if (!std::isfinite(p.gain.value)) return "- ";
    if (p.trust == Trust::rare_samples) return "~" + fmt::format("{:.3g}", p.gain.value);
    return short_interval(p.gain);
}

/// Variance of independent samples over that of as many of a sequence.
std::string gains(const CostSceneReport& scene, const TextLook& look)
{
    constexpr std::array<std::uint64_t, 4> samples{4, 16, 64, 256};
    if (!scene.is_sobol) return "";
    std::vector<std::string> head{"", "gain over independent, after"};
    for (const std::uint64_t n : samples) head.push_back(fmt::format("{}", n));
    TextTable table({head});
    for (const CostCurveReport* c : in_order(scene)) {
        if (c->points.empty()) continue;
        std::vector<std::string> row{"", name_of(*c)};
        for (const std::uint64_t n : samples) {
            const auto at = std::find_if(c->points.begin(), c->points.end(),
                                         [&](const CostPoint& p) { return p.samples == n; });
            row.push_back(at == c->points.end() ? "- " : gain_cell(*at));
        }
        table.add(row);
    }
    return "\n" + table.text(look);
}

std::string times(const CostSceneReport& scene, const TextLook& look)
{
    std::vector<std::string> head{"", "time to"};
    for (const double target : cost_targets) head.push_back(fmt::format("{:g} % ", 100 * target));
    TextTable table({head}, {2, 3, 6, 4});
    bool any = false;
    for (const CostCurveReport* c : in_order(scene)) {
        if (c->points.empty()) continue;
        std::vector<std::string> row{"", name_of(*c)};
        for (const TimeToError& t : c->times) row.push_back(time_cell(t));
        table.add(row);
        any = true;
    }
    return any ? "\n" + table.text(look) : "";
}

std::string legend(const CostSceneReport& scene, const TextLook& look)
{
    const auto any_curve = [&](const auto& is_it) {
        return std::ranges::any_of(scene.curves, is_it);
    };
    const auto any_point = [&](Trust trust) {
        return any_curve([&](const CostCurveReport& c) {
            return std::ranges::count(c.points, trust, &CostPoint::trust) > 0;
        });
    };
    const auto any_time = [&](Reach reach) {
        return any_curve([&](const CostCurveReport& c) {
            return std::ranges::count(c.times, reach, &TimeToError::reach) > 0;
        });
    };
    const bool any_bound = any_curve([](const CostCurveReport& c) {
        return std::ranges::any_of(c.times, [](const TimeToError& t) {
            return t.reach != Reach::unknown && !(t.seconds.low > 0);
        });
    });
    Legend legend;
    legend.add(any_curve([](const auto& c) { return !c.points.empty() && !c.fits; }), "! not -0.5");
    legend.add(any_point(Trust::rare_samples), "~ few samples carry it");
    legend.add(any_point(Trust::below_reference) || any_time(Reach::at_most) || any_bound,
               "< at most");
    legend.add(any_time(Reach::extrapolated), "* extrapolated");
    legend.add(any_time(Reach::unknown), "- not known");
    return legend.text(look);
}

std::string said(const std::vector<std::string>& sentences, const TextLook& look,
                 Style style = Style::plain)
{
    std::string text;
    for (const std::string& sentence : sentences)
        text += paragraph(sentence, look, text.empty() ? style : Style::plain);
    return text.empty() ? "" : "\n" + text;
}

}  // namespace

std::string cost_text(const CostSceneReport& scene, int threads, const TextLook& look)
{
    const CostWords words = words_of(scene);
    return heading(scene, threads, look) + reference(scene.reference, look) +
           definition(scene.epsilon, look) + "\n" + slopes(scene, look) + errors(scene, look) +
           gains(scene, look) + times(scene, look) + legend(scene, look) +
           said(look.is_verbose ? words.details : kinds_of_doubt(scene), look) +
           said(words.answer, look, Style::answer);
}

}  // namespace mis
