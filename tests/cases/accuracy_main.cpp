// Prints the tables of docs/accuracy.md: how far the engine's means are from quadrature on hard
// cases, and the irradiance of a cap from its closed form. Nodes of a lattice take the place of
// random numbers, so that rounding is seen and not noise.
#include "mis/predict/predict.h"
#include "mis/sampling/random.h"

#include "tests/cases/cases.h"
#include "tests/cases/irradiance_table.h"
#include "tests/cases/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mis {
namespace {

constexpr int shifts = 8;

/// Nodes of one shift; fewer where every light is drawn and there are many.
int nodes_for(std::size_t lights) { return lights > 100 ? 1 << 10 : 1 << 17; }

/// A node in [0, 1)³, as random words. Rank-1 lattice of Cools, Kuo and Nuyens (2006), folded, so
/// that the error falls with the square of the number of nodes where the integrand is smooth
/// (Hickernell 2002); shifted at random, so that several shifts tell the error.
std::array<std::uint32_t, 3> lattice_words(std::uint64_t sample, std::uint64_t nodes)
{
    constexpr std::array<std::uint64_t, 3> generator{1, 182'667, 469'891};
    const std::uint64_t i = sample % nodes, shift = sample / nodes;
    const Words random = random_words(7, {0, shift, 0}, Block::light);
    std::array<std::uint32_t, 3> words{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint64_t turn = (i * generator[k] % nodes << 32) / nodes;
        const std::uint64_t x = (turn + random[k]) & 0xffff'ffffU;
        words[k] = static_cast<std::uint32_t>(x < 0x8000'0000U ? 2 * x : 2 * (0xffff'ffffU - x));
    }
    return words;
}

template <class T> void lattice_numbers(const TileJob<T>& job, Batch<T>& batch)
{
    const auto nodes = static_cast<std::uint64_t>(nodes_for(job.lights->size()));
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.rows); ++i) {
        const auto words =
            lattice_words(batch.sample_number[static_cast<std::size_t>(batch.slot[i])], nodes);
        batch.bits[i] = 0;  // `all` chooses no light
        batch.u[i] = unit_number<T>(words[0]), batch.v[i] = unit_number<T>(words[1]);
        batch.lobe[i] = unit_number<T>(words[2]);
    }
}

template <class T> void use_lattice(Pipeline<T>& pipeline)
{
    for (auto* half : {&pipeline.light, &pipeline.bsdf})
        for (NamedStage<T>& stage : *half)
            if (stage.kind == StageKind::numbers) stage.run = lattice_numbers<T>;
}

struct Measured {
    double mean = 0, error = 0;  ///< of the mean, from the shifts
};

template <class T>
Measured measured(const ReadyCase& ready, const Strategy& strategy, std::string_view set)
{
    const ReadyStrategy<T> strategy_here(ready.test.lit, strategy, kernels_of<T>(set), 1);
    const Tile& tile = ready.test.probes.tiles.at(0);
    Pipeline<T> pipeline = strategy_here.pipeline(tile.material);
    use_lattice(pipeline);
    const int nodes = nodes_for(ready.test.scene.lights.size());
    Workspace<T> workspace;
    Moments means;
    for (int shift = 0; shift < shifts; ++shift) {
        PointResult result;
        workspace.run(
            strategy_here.job(tile, ready.test.probes.points), pipeline,
            {.first = static_cast<std::uint64_t>(shift) * nodes, .chunk = nodes, .chunks = 1},
            std::span(&result, 1), {}, {});
        means.add(result.luminance.mean);
    }
    return {means.mean, means.mean_se()};
}

/// The largest that were found.
struct Worst {
    double rounding = 0;  ///< between float and double, which take the same nodes
    double sigmas = 0;    ///< between double and quadrature, in the noise (and 1e-7 for rounding)
};

/// A strategy's row, if its noise is small enough to see rounding, or in any case.
bool print_row(const Case& c, const ReadyCase& ready, const std::string& name, bool in_any_case,
               Worst& worst)
{
    const Strategy strategy = parse_strategy(name);
    const Predicted p = predict(c.scene, c.scene.probes[0], std::span(&strategy, 1))[0];
    // Where the nodes seldom meet what matters, their scatter says nothing.
    const double samples = shifts * nodes_for(c.scene.lights.size());
    if (!in_any_case && samples * square(p.variance) < 100 * p.fourth) return false;
    const Measured exact = measured<double>(ready, strategy, "");
    const double noise = (exact.error + p.mean_error) / p.mean;
    if (!in_any_case && !(noise < 1e-4)) return false;
    const auto off = [&](const Measured& m) { return m.mean / p.mean - 1; };
    const double scalar = off(measured<float>(ready, strategy, "scalar")),
                 lanes = off(measured<float>(ready, strategy, "")), both = off(exact);
    fmt::print("| {} | `{}` | {:.6g} | {:+.1e} | {:+.1e} | {:+.1e} | {:.0e} |\n", c.name, name,
               p.mean, scalar, lanes, both, noise);
    worst.rounding = std::max({worst.rounding, std::abs(scalar - both), std::abs(lanes - both)});
    worst.sigmas = std::max(worst.sigmas, std::abs(both) / (noise + 1e-7));
    return true;
}

void print_dark(const Case& c, const ReadyCase& ready)
{
    double sum = 0;
    if (!ready.has_no_tile())
        for (const std::string_view set : instruction_sets())
            sum += measured<float>(ready, parse_strategy("all/power"), set).mean +
                   measured<double>(ready, parse_strategy("all/power"), set).mean;
    fmt::print("| {} | `all/power` | 0 | {} | {} | {} | 0 |\n", c.name, sum, sum, sum);
}

void print_tables()
{
    const std::vector<Case> cases = hard_cases();
    fmt::print("| case | what is hard about it |\n| --- | --- |\n");
    for (const Case& c : cases) fmt::print("| {} | {} |\n", c.name, c.why);
    fmt::print("\nFloat lanes and double: {}.\n\n", kernels<float>().instruction_set);
    fmt::print(
        "| case | strategy | predicted mean | float, scalar | float, lanes | double | noise "
        "|\n| --- | --- | ---: | ---: | ---: | ---: | ---: |\n");
    Worst worst;
    for (const Case& c : cases) {
        const ReadyCase ready(c.scene);
        if (c.is_dark) {
            print_dark(c, ready);
            continue;
        }
        bool is_shown = false;
        for (const char* name : {"all/light", "all/light/projected", "all/power", "brdf"})
            is_shown |= print_row(c, ready, name, false, worst);
        if (!is_shown) print_row(c, ready, "all/light", true, worst);
    }
    fmt::print(
        "\nLargest difference between float and double: {:.1e}. Largest between double and "
        "quadrature: {:.1f} times the noise.\n",
        worst.rounding, worst.sigmas);
}

}  // namespace
}  // namespace mis

int main()
{
    mis::print_tables();
    fmt::print("\n");
    mis::print_irradiance_table();
}
