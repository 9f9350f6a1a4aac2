#pragma once

#include "mis/predict/response.h"

#include <vector>

namespace mis {

/// Where a surface reflects most, and how sharply: a hint for where to look closely, not a part of
/// any figure.
struct Lobe {
    Vec3<double> direction{0, 0, 1};
    double width = 4;  ///< radians, in its narrowest direction; 4 where there is no peak
    /// Where the BSDF's density, or that over the cosine, is largest or least along the plane of
    /// incidence: curves of equal density can be small rings there.
    std::vector<Vec3<double>> turns;
    bool is_narrower_than(double angle) const { return width < angle; }
};

/// Looks around the mirror direction of wo for the angle at which f or the density has fallen
/// half-way, and along the plane of incidence for the turns.
Lobe lobe_of(const Response& response);

}  // namespace mis
