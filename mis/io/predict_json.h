#pragma once

#include "mis/io/text_layout.h"
#include "mis/predict/predict.h"

#include <string>
#include <vector>

namespace mis {

/// What `mis predict` found.
struct PredictReport {
    /// One probe: the figures of every strategy, in their order; or why there are none.
    struct Probe {
        std::vector<Predicted> figures;
        std::string refusal;  ///< empty where there are figures
    };
    struct Scene {
        std::string file, name;
        std::size_t lights = 0;
        std::vector<Strategy> strategies;
        std::vector<Probe> probes;
    };

    std::string version, command;
    int threads = 1;
    bool partial = false;  ///< interrupted: the probes left out are refused with that reason
    PredictTolerance tolerance;
    std::vector<Scene> scenes;
};

/// As `mis-predict/1`: the outer shape of `mis-report/1`, each strategy with its figures and bounds
/// of their errors at every probe. Numbers keep all their digits; what is beyond a double, or
/// refused, is null. Ends with a line feed.
std::string predict_json(const PredictReport& report);

/// As a table: a header, then one row per scene, probe and strategy, lines ended by CR LF (RFC
/// 4180). What is beyond a double, or refused, is empty.
std::string predict_csv(const PredictReport& report);

/// As a terminal shows it: a table, and at its end which strategy has the least variance.
std::string predict_text(const PredictReport::Scene& scene, const TextLook& look = {});

}  // namespace mis
