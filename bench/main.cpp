// mis_bench [--out FILE] [--quick] [--benchmark_…]: every bar of docs/performance.md in one run.
// The table goes to standard output, all figures to FILE.
#include "bench/report.h"
#include "bench/subjects.h"
#include "mis/engine/kernels.h"
#include "mis/io/atomic_file.h"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <optional>
#include <span>
#include <thread>

namespace mis::bench {
namespace {

/// Keeps the counters of each repetition.
class Collector final : public benchmark::BenchmarkReporter {
public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override
    {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration) continue;
            if (run.error_occurred) failure_ = run.benchmark_name() + ": " + run.error_message;
            repetitions_ = std::max(repetitions_, static_cast<int>(run.repetitions));
            for (const auto& [name, counter] : run.counters)
                figures_.add(run.run_name.function_name, name, counter.value);
        }
    }
    const Figures& figures() const { return figures_; }
    const std::string& failure() const { return failure_; }
    int repetitions() const { return repetitions_; }

private:
    Figures figures_;
    std::string failure_;
    int repetitions_ = 0;
};

std::string machine()
{
    std::ifstream file("/proc/cpuinfo");
    std::string line, model = "unknown processor";
    while (std::getline(file, line))
        if (line.starts_with("model name")) {
            model = line.substr(line.find(':') + 2);
            break;
        }
    return model + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores";
}

struct Options {
    std::string out;
    bool is_quick = false;
    std::vector<std::string> passed_on;  ///< to Google Benchmark
};

Options options_of(std::span<char*> arguments)
{
    Options options;
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        const std::string argument = arguments[i];
        if (argument == "--quick") options.is_quick = true;
        else if (argument == "--out" && i + 1 < arguments.size()) options.out = arguments[++i];
        else options.passed_on.push_back(argument);
    }
    return options;
}

/// False where an argument is not known, which has been said.
bool start_benchmark(const std::string& program, const Options& options)
{
    std::vector<std::string> arguments{
        program, options.is_quick ? "--benchmark_repetitions=3" : "--benchmark_repetitions=9",
        options.is_quick ? "--benchmark_min_time=0.005" : "--benchmark_min_time=0.04",
        "--benchmark_enable_random_interleaving=true"};
    arguments.insert(arguments.end(), options.passed_on.begin(), options.passed_on.end());
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    auto count = static_cast<int>(pointers.size());
    benchmark::Initialize(&count, pointers.data());
    return !benchmark::ReportUnrecognizedArguments(count, pointers.data());
}

Bars all_bars(const Figures& figures)
{
    Bars bars;
    for (const auto& subject : {kernel_bars, ray_bars, counter_bars, thread_bars, light_count_bars,
                                memory_bars, effect_bars})
        for (Bar& bar : subject(figures)) bars.push_back(std::move(bar));
    std::stable_sort(bars.begin(), bars.end(),
                     [](const Bar& a, const Bar& b) { return a.number < b.number; });
    return bars;
}

int run(std::span<char*> arguments)
{
    const Options options = options_of(arguments);
    if (!start_benchmark(arguments[0], options)) return 2;
    add_kernels();
    add_rays();
    add_counters();
    add_threads();
    add_light_counts();
    add_memory();
    add_effects();
    add_scenes();
    std::optional<AtomicFile> out;  // opened first: minutes must not be lost to a wrong path
    if (!options.out.empty()) out.emplace(options.out);
    Collector collector;
    if (benchmark::RunSpecifiedBenchmarks(&collector) == 0) {
        std::fputs("bench: no benchmark has such a name; --benchmark_list_tests lists them\n",
                   stderr);
        return 2;
    }
    if (!collector.failure().empty()) {
        std::fprintf(stderr, "bench: %s\n", collector.failure().c_str());
        return 1;
    }
    const Figures& figures = collector.figures();
    if (figures.all().empty()) return 0;  // they were only listed
    const Bars bars = all_bars(figures);
    const Setting setting{machine(), std::string(kernels<float>().instruction_set),
                          collector.repetitions()};
    std::fputs(table_of(bars, figures, setting).c_str(), stdout);
    if (out) out->write(json_of(bars, figures, setting)), out->commit();
    return 0;
}

}  // namespace
}  // namespace mis::bench

int main(int argc, char** argv)
{
    try {
        return mis::bench::run(std::span(argv, static_cast<std::size_t>(argc)));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench: %s\n", error.what());
        return 1;
    }
}
