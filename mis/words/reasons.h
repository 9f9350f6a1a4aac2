#pragma once

#include "mis/report/reason.h"

#include <string>

namespace mis {

/// Why a strategy is not ranked, as the end of a sentence: "the other strategies' samples find …".
/// Empty where there is no reason.
std::string reason_words(const Reason& why);

/// Why a curve has no points.
std::string reason_words(const CostReason& why);

}  // namespace mis
