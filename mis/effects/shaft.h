#pragma once

#include "mis/math/vec.h"

#include <span>

namespace mis {

/// All that lies between the points of a tile and a light: the convex hull of a box and a ball.
struct Shaft {
    Vec3<double> low;     ///< least corner of the box
    Vec3<double> high;    ///< greatest corner of the box
    Vec3<double> center;  ///< of the ball
    double radius;        ///< of the ball

    /// Of the box.
    Vec3<double> middle() const { return 0.5 * (low + high); }
    /// Half the diagonal of the box.
    double box_radius() const { return 0.5 * length(high - low); }
};

/// Is there a plane between the shaft and the convex hull of some points, further than `margin`
/// from one of them? True is a proof; false may be want of trying. The plane is looked for by
/// Gilbert's algorithm on the difference of both bodies (Gilbert 1966, "An Iterative Procedure for
/// Computing the Minimum of a Quadratic Form on a Convex Set", SIAM J. Control 4).
bool is_clear_of(const Shaft& shaft, std::span<const Vec3<double>> hull, double margin);

/// The same for a ball.
bool is_clear_of(const Shaft& shaft, const Vec3<double>& center, double radius, double margin);

}  // namespace mis
