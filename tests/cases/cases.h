#pragma once

#include "mis/scene/scene.h"

#include <ostream>
#include <string>
#include <vector>

namespace mis {

/// A scene with one probe, and what is hard about it.
struct Case {
    std::string name;  ///< lower case and underscores
    std::string why;   ///< one sentence
    Scene scene;
    bool is_dark = false;  ///< the probe sees no light: every sample is exactly 0
    /// Both techniques of `maximum/projected` have the same density everywhere: which of two equal
    /// numbers is the larger is rounding's say.
    bool cosine_ties = false;
};

/// For googletest's messages.
inline void PrintTo(const Case& c, std::ostream* out) { *out << c.name << ": " << c.why; }

/// Scenes as users have them: all materials, lights of all sizes, occluders.
std::vector<Case> ordinary_cases();

/// Scenes at the ends of what a number can hold.
std::vector<Case> hard_cases();

/// Both, the ordinary first.
std::vector<Case> all_cases();

}  // namespace mis
