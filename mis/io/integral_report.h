#pragma once

#include "mis/sampling/hemisphere_integral.h"

#include <string>
#include <vector>

namespace mis {

/// What `mis integrate` found.
struct IntegralReport {
    /// One density's estimator, and its run as it stood after 1, 2, 4, … and all draws.
    struct Entry {
        HemisphereEstimator estimator;
        std::vector<HemisphereRun> running;
    };

    std::string version, command;
    std::uint64_t seed = 1;
    std::uint64_t samples = 0;  ///< asked for; fewer were drawn where partial
    bool partial = false;
    std::vector<Entry> densities;
};

/// As `mis-integrate/1`: the outer shape of `mis-report/1`, then one entry per density. Numbers
/// keep all their digits; what is not known or beyond a double is null. Ends with a line feed.
std::string integral_json(const IntegralReport& report);

/// As a table: a header, then one row per density and number of draws, lines ended by CR LF (RFC
/// 4180). What is not known or beyond a double is empty.
std::string integral_csv(const IntegralReport& report);

}  // namespace mis
