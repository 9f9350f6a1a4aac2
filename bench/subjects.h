#pragma once

#include "bench/figures.h"

namespace mis::bench {

// Each subject registers its benchmarks, and reads its bars from what they measured.

void add_kernels();
Bars kernel_bars(const Figures& figures);

/// The figure of bar 1: ns of a sample without rays, by the best instruction set; of the BSDFs the
/// dearest.
Middle sample_without_rays(const Figures& figures);

void add_rays();
Bars ray_bars(const Figures& figures);

void add_counters();
Bars counter_bars(const Figures& figures);

void add_threads();
Bars thread_bars(const Figures& figures);

void add_light_counts();
Bars light_count_bars(const Figures& figures);

void add_memory();
Bars memory_bars(const Figures& figures);

void add_effects();
Bars effect_bars(const Figures& figures);

void add_scenes();

}  // namespace mis::bench
