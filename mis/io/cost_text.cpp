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

std::string many(std::size_t count, const char* what)
{
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string heading(const CostSceneReport& s, int threads)
{
    std::string text = s.name.empty() ? s.file : s.name;
    if (s.file != text && !s.file.empty()) text += fmt::format(" ({})", s.file);
    text += ": ";
    if (s.width > 0) text += fmt::format("{}x{}, ", s.width, s.height);
    text += fmt::format("{}, {}, {} replicates", many(s.shading_points, "shading point"),
                        many(s.lights, "light"), s.replicates);
    if (s.copies > 1) text += fmt::format(" of {} copies", s.copies);
    if (s.is_sobol) text += ", each a scrambled Sobol' sequence";
    text += fmt::format(", times on {}, {}{}", many(static_cast<std::size_t>(threads), "thread"),
                        short_duration(s.seconds) + setup_text(s.setup),
                        s.partial ? ", stopped early" : "");
    return wrapped(text);
}

std::string reference(const ReferenceReport& r)
{
    if (r.exact)
        return wrapped("reference: exact, by quadrature; its error is at most " + percent(r.error));
    if (r.samples == 0) return "";
    const std::string others =
        r.sources.size() < 2 ? ""
                             : ", pooled with fewer of " + listed(std::span(r.sources).subspan(1));
    return wrapped(
        fmt::format("reference: {} samples per point of {}{}; its own error of {} is "
                    "taken off, and errors below it are not trusted",
                    r.samples, r.sources.front(), others, percent(r.error)));
}

/// What an error is, of which all tables are.
std::string definition(double epsilon)
{
    const std::string square =
        epsilon > 0 ? "(reference^2 + " + number(epsilon, 2) + "^2)" : std::string("reference^2");
    return wrapped(
        "error: the root of the mean, over points and replicates, of (estimate - reference)^2/" +
        square);
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
    const double value = std::fabs(x.value) < 5e-4 ? 0 : x.value;
    if (!std::isfinite(x.high)) return fmt::format("{:.3f}", value);
    const double half_width = std::max(0.0, std::ceil(1e3 * (x.high - x.value) - 1e-9));
    return fmt::format("{:.3f}±{:.3f}", value, half_width / 1e3);
}

/// "3.45±0.07", in percent: "<0.02" where only a bound is known; "~3.4" where rare samples carry
/// it.
std::string error(const CostPoint& p)
{
    if (p.error.high == 0) return "0";
    if (p.trust == Trust::below_reference) return "<" + short_number(100 * p.error.high);
    const std::string value = fmt::format("{:.3g}", 100 * p.error.value);
    if (p.trust == Trust::rare_samples) return "~" + value;
    return value;
}

std::string error_with_interval(const CostPoint& p)
{
    if (p.trust != Trust::trusted) return error(p);
    return short_interval({100 * p.error.value, 100 * p.error.low, 100 * p.error.high});
}

std::string slopes(const CostSceneReport& scene)
{
    TextTable table({{"", "strategy", "most", "error", "slope", "slope"},
                     {"", "", "samples", "there, %", "in samples", "in time"}});
    for (const CostCurveReport* c : in_order(scene)) {
        if (c->points.empty()) {
            table.add_remark("", name_of(*c), "not run");
            continue;
        }
        table.add({"", name_of(*c), fmt::format("{}", c->points.back().samples),
                   error_with_interval(c->points.back()), slope(c->slope) + (c->fits ? " " : "!"),
                   slope(c->slope_in_time)});
    }
    table.add({"", "theory", "", "", "-0.5    ", ""});
    return table.text();
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

std::string errors(const CostSceneReport& scene)
{
    const std::vector<std::size_t> shown = shown_levels(scene);
    if (shown.empty()) return "";
    std::vector<std::string> head{"", "error in % after"};
    for (const std::size_t k : shown) head.push_back(fmt::format("{}", std::size_t{1} << k));
    while (head.size() < 4) head.emplace_back();  // three cells would be a remark
    TextTable table({head});
    for (const CostCurveReport* c : in_order(scene)) {
        if (c->points.empty()) continue;
        std::vector<std::string> row{"", name_of(*c)};
        for (const std::size_t k : shown)
            row.push_back(k < c->points.size() ? error(c->points[k]) : "");
        row.resize(head.size());
        table.add(row);
    }
    return "\n" + table.text();
}

/// "0.83s±3%", with "*" where extrapolated; "<0.83s" where that is a bound.
std::string time_cell(const TimeToError& t)
{
    if (t.reach == Reach::unknown) return "- ";
    if (t.reach == Reach::at_most) return "<" + short_duration(t.seconds.high) + " ";
    const double error =
        std::max(t.seconds.high - t.seconds.value, t.seconds.value - t.seconds.low) /
        t.seconds.value;
    std::string text = short_duration(t.seconds.value);
    if (error > 1) text += "±>100%";
    else if (error > 0) text += fmt::format("±{:.0f}%", std::ceil(100 * error - 1e-9));
    return text + (t.reach == Reach::extrapolated ? "*" : " ");
}

/// "12±1", "~12" where rare samples carry it.
std::string gain_cell(const CostPoint& p)
{
    if (!std::isfinite(p.gain.value)) return "- ";
    if (p.trust == Trust::rare_samples) return "~" + fmt::format("{:.3g}", p.gain.value);
    return short_interval(p.gain);
}

/// Variance of independent samples over that of as many of a sequence.
std::string gains(const CostSceneReport& scene)
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
    return "\n" + table.text();
}

std::string times(const CostSceneReport& scene)
{
    std::vector<std::string> head{"", "time to"};
    for (const double target : cost_targets) head.push_back(fmt::format("{:g} % ", 100 * target));
    TextTable table({head});
    bool any_beyond = false, any = false;
    for (const CostCurveReport* c : in_order(scene)) {
        if (c->points.empty()) continue;
        std::vector<std::string> row{"", name_of(*c)};
        for (const TimeToError& t : c->times) {
            row.push_back(time_cell(t));
            any_beyond = any_beyond || t.reach == Reach::extrapolated;
        }
        table.add(row);
        any = true;
    }
    if (!any) return "";
    return "\n" + table.text() +
           (any_beyond ? "* beyond what is measured surely, by error = sqrt(V/samples)\n" : "");
}

}  // namespace

std::string cost_text(const CostSceneReport& scene, int threads)
{
    std::string text = heading(scene, threads) + reference(scene.reference) +
                       definition(scene.epsilon) + "\n" + slopes(scene) + errors(scene) +
                       gains(scene) + times(scene);
    const std::vector<std::string> sentences = sentences_of(scene);
    if (!sentences.empty()) text += "\n";
    for (const std::string& sentence : sentences) text += wrapped(sentence);
    return text;
}

}  // namespace mis
