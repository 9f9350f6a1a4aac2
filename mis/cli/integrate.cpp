#include "mis/cli/commands.h"

#include "mis/cli/interrupt.h"
#include "mis/cli/progress.h"
#include "mis/cli/values.h"
#include "mis/io/atomic_file.h"
#include "mis/io/integral_report.h"
#include "mis/scene/nearest_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace mis::cli {

namespace {

using Entry = IntegralReport::Entry;

constexpr std::array<std::string_view, 5> pdf_names{"hemisphere", "cosine", "angles", "blinn",
                                                    "all"};
constexpr std::uint64_t most_samples = 1'000'000'000;

std::uint64_t samples_of(const IntegrateOptions& options)
{
    const std::optional<double> n = number_in(options.samples);
    if (!n || !(*n >= 1 && *n <= double(most_samples)) || *n != std::floor(*n))
        throw UsageError(fmt::format("-n: found \"{}\"; a number of draws is whole, from 1 to {}",
                                     options.samples, most_samples));
    return static_cast<std::uint64_t>(*n);
}

double exponent_of(const IntegrateOptions& options)
{
    constexpr double usual = 10;
    if (!options.exponent) return usual;
    const std::optional<double> m = number_in(*options.exponent);
    if (!m || !(*m >= 0) || !std::isfinite(*m))
        throw UsageError(
            fmt::format("--exponent: found \"{}\"; an exponent is a finite number, at least 0",
                        *options.exponent));
    if (options.pdf != "blinn" && options.pdf != "all")
        throw UsageError(fmt::format("--exponent: found with --pdf {}; only blinn has an exponent",
                                     options.pdf));
    return *m;
}

/// Of one name those of its density; angles come with the mistake that they are known for.
std::vector<Entry> entries_of(const IntegrateOptions& options)
{
    if (std::find(pdf_names.begin(), pdf_names.end(), options.pdf) == pdf_names.end())
        refuse_name("--pdf: found", options.pdf, pdf_names);
    const double exponent = exponent_of(options);
    std::vector<Entry> entries;
    for (const HemisphereDensity density : hemisphere_densities) {
        const bool is_mistake = density == HemisphereDensity::angles_as_uniform;
        const HemisphereDensity meant = is_mistake ? HemisphereDensity::angles : density;
        if (options.pdf == "all" || options.pdf == text_of(meant).name)
            entries.push_back({.estimator = {density, exponent}, .running = {}});
    }
    return entries;
}

/// What the file "-" leaves of standard output to people.
class Console {
public:
    explicit Console(const OutputOptions& output)
        : is_free_(output.json != "-" && output.csv != "-")
    {
    }
    void print(const std::string& text) const
    {
        if (is_free_) write_text("-", text);
    }

private:
    bool is_free_;
};

/// Short, and never wider than ten columns.
std::string figure(double x)
{
    if (std::isnan(x)) return "-";
    if (x == 0) return "0";
    const double size = std::fabs(x);
    if (size >= 1e-4 && size < 1000) return fmt::format("{:.6f}", x);
    return size > 1e-99 && size < 1e99 ? fmt::format("{:.3e}", x) : fmt::format("{:.2e}", x);
}

/// 10^log10 where `x` itself is beyond a double.
std::string figure(double x, double log10)
{
    return std::isfinite(x) ? figure(x) : fmt::format("10^{:.5g}", log10);
}

std::string table_head(std::span<const Entry> block)
{
    std::string names = fmt::format("{:>10}", ""), columns = fmt::format("{:>10}", "draws");
    for (const Entry& entry : block) {
        names += fmt::format("{:>12}{:<22}", "", text_of(entry.estimator.density).name);
        columns += fmt::format("{:>12}{:>11}{:>11}", "estimate", "error", "std error");
    }
    while (names.ends_with(' ')) names.pop_back();
    return names + "\n" + columns + "\n";
}

std::string table_row(std::span<const Entry> block)
{
    std::string row = fmt::format("{:>10}", block[0].running.back().values.count);
    for (const Entry& entry : block) {
        const Moments& values = entry.running.back().values;
        row += fmt::format("{:>12}{:>11}{:>11}", figure(values.mean),
                           figure(values.mean - hemisphere_integral), figure(values.mean_se()));
    }
    return row + "\n";
}

/// All draws of some densities side by side, a row at every doubling. False where interrupted; what
/// was drawn is kept.
bool run_block(std::span<Entry> block, const IntegralReport& report, const Console& console)
{
    constexpr std::uint64_t step = HemisphereRun::chunk * 256;  // between two looks at Ctrl-C
    Progress progress(true);
    std::vector<HemisphereRun> runs;
    for (const Entry& entry : block)
        runs.push_back({.estimator = entry.estimator, .seed = report.seed});
    console.print("\n" + table_head(block));
    const double whole = double(report.samples) * double(block.size());
    std::uint64_t count = 0;
    while (count < report.samples) {
        const std::uint64_t before = count;
        count = std::min(std::max<std::uint64_t>(1, 2 * before), report.samples);
        for (std::size_t i = 0; i < block.size(); ++i) {
            std::uint64_t& drawn = runs[i].values.count;
            while (drawn < count && !interrupt_flag()) {
                runs[i].advance_to(std::min(count, drawn + step));
                progress.show("drawing", (double(before) * double(block.size() - i - 1) +
                                          double(count) * double(i) + double(drawn)) /
                                             whole);
            }
            if (drawn > before) block[i].running.push_back(runs[i]);
            if (drawn < count) return false;
        }
        progress.clear();
        console.print(table_row(block));
    }
    return true;
}

std::string summary_row(const Entry& entry)
{
    const Moments& values = entry.running.back().values;
    const ExactHemisphere e = exact(entry.estimator);
    return fmt::format("{:<17} {:>10} ± {:<10} {:>11} {:>12} {:>11}\n",
                       text_of(entry.estimator.density).name, figure(values.mean),
                       figure(values.mean_se()), figure(values.mean - hemisphere_integral),
                       figure(e.variance, e.log10_variance), figure(values.variance()));
}

/// What there is to say of a run by `blinn`: the draws lost below the horizon, and whether it saw
/// what matters.
std::string blinn_remarks(const Entry& entry)
{
    const HemisphereRun& run = entry.running.back();
    const auto n = static_cast<double>(run.values.count);
    const double expected = exact(entry.estimator).below_horizon,
                 found = static_cast<double>(run.below_horizon) / n;
    std::string text = fmt::format(
        "    Lost below the horizon (θ_h > 45°): {:.4g} % of the draws expected,\n"
        "    {:.4g} ± {:.2g} % found.\n",
        100 * expected, 100 * found, 100 * std::sqrt(expected * (1 - expected) / n));
    const Unseen hidden = unseen(entry.estimator, run.values.count);
    constexpr double most = 0.5;
    if (run.values.count > 1 && hidden.of_second_moment > most)
        text += fmt::format(
            "    This run cannot show it: in directions that carry {:.3g} % of the integral and\n"
            "    {:.3g} % of the mean square, fewer than 1 of the {} draws is expected.\n"
            "    The standard error found is too small, and the estimate most likely too low.\n",
            100 * hidden.of_integral, 100 * hidden.of_second_moment, run.values.count);
    return text;
}

std::string remarks(const Entry& entry)
{
    const HemisphereDensity density = entry.estimator.density;
    const HemisphereDensityText& words = text_of(density);
    const ExactHemisphere e = exact(entry.estimator);
    const bool is_blinn = density == HemisphereDensity::blinn;
    const std::string exponent =
        is_blinn ? fmt::format(", m = {:g}", entry.estimator.exponent) : "";
    std::string text =
        fmt::format("\n{}: {}{}\n    pdf {}.\n", words.name, words.draws, exponent, words.pdf);
    if (e.mean != hemisphere_integral)
        text += fmt::format("    WRONG: it tends to {:g}, not to π.\n", e.mean);
    text += std::isfinite(e.log10_largest_value)
                ? fmt::format("    Variance finite, as no value exceeds {}.\n",
                              figure(e.largest_value, e.log10_largest_value))
                : std::string("    Variance INFINITE: the standard error means nothing.\n");
    text += fmt::format("    Variance {}.\n", words.variance);
    return is_blinn ? text + blinn_remarks(entry) : text;
}

std::string summary(const IntegralReport& report)
{
    std::string text =
        fmt::format("\n{:>74}\n{:<17} {:>10} ± {:<10} {:>11} {:>12} {:>11}\n", "variance", "",
                    "estimate", "std error", "error", "exact", "measured");
    for (const Entry& entry : report.densities)
        if (!entry.running.empty()) text += summary_row(entry);
    for (const Entry& entry : report.densities)
        if (!entry.running.empty()) text += remarks(entry);
    return text;
}

}  // namespace

std::string densities() { return comma_list(pdf_names); }

std::string densities_help()
{
    std::string text;
    for (const HemisphereDensity density : hemisphere_densities)
        text += fmt::format("  {:<18} {}\n", text_of(density).name, text_of(density).draws);
    return text;
}

int run_integrate(const IntegrateOptions& options)
{
    IntegralReport report{.version = MIS_VERSION,
                          .command = options.command_line,
                          .seed = options.seed,
                          .samples = samples_of(options),
                          .densities = entries_of(options)};
    check(options.output);
    const Console console(options.output);
    console.print(fmt::format("∫ cos θ dω over the hemisphere = π = {:.6f}, seed {}\n",
                              hemisphere_integral, options.seed));
    const std::span<Entry> all(report.densities);
    constexpr std::size_t side_by_side = 2;
    for (std::size_t i = 0; i < all.size() && !report.partial; i += side_by_side)
        report.partial =
            !run_block(all.subspan(i, std::min(side_by_side, all.size() - i)), report, console);
    console.print(summary(report) + (report.partial ? "\nPartial: interrupted.\n" : ""));
    if (!options.output.json.empty()) write_text(options.output.json, integral_json(report));
    if (!options.output.csv.empty()) write_text(options.output.csv, integral_csv(report));
    return report.partial ? interrupted : ok;
}

}  // namespace mis::cli
