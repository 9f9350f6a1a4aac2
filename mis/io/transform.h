#pragma once

#include "mis/scene/direction.h"

#include <array>

namespace mis {

/// Where a mesh stands: scaled, then turned about x, y and z in this order, then moved. All in
/// double.
class Transform {
public:
    Transform() = default;
    /// `degrees`: right-handed angles about x, y, z. `scale`: per axis, none 0; a negative one
    /// mirrors.
    Transform(const Vec3<double>& scale, const Vec3<double>& degrees,
              const Vec3<double>& translate);

    Vec3<double> place(const Vec3<double>& position) const
    {
        return rotate(position * scale_) + translate_;
    }

    /// A unit normal of the placed mesh: by the inverse transpose, so that it stays upright under
    /// unequal scales.
    Vec3<double> place_normal(const Vec3<double>& normal) const
    {
        return unit_or_zero(rotate(normal / scale_));
    }

private:
    Vec3<double> rotate(const Vec3<double>& v) const;

    Vec3<double> scale_{1}, cosines_{1}, sines_{0}, translate_{0};
};

}  // namespace mis
