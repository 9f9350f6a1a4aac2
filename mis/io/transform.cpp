#include "mis/io/transform.h"

#include <cmath>
#include <numbers>

namespace mis {
namespace {

/// cos and sin of an angle in degrees; exact at multiples of 90, so that a wall turned upright
/// stays a plane.
Vec2<double> cos_sin_degrees(double degrees)
{
    int quarters = 0;
    const double rest =
        std::remquo(degrees, 90, &quarters) * (std::numbers::pi / 180);  // within ±45°
    const double c = std::cos(rest), s = std::sin(rest);
    switch (quarters & 3) {
        case 0: return {c, s};
        case 1: return {-s, c};
        case 2: return {-c, -s};
        default: return {s, -c};
    }
}

}  // namespace

Transform::Transform(const Vec3<double>& scale, const Vec3<double>& degrees,
                     const Vec3<double>& translate)
    : scale_(scale), translate_(translate)
{
    const Vec2<double> x = cos_sin_degrees(degrees.x), y = cos_sin_degrees(degrees.y),
                       z = cos_sin_degrees(degrees.z);
    cosines_ = {x.x, y.x, z.x};
    sines_ = {x.y, y.y, z.y};
}

Vec3<double> Transform::rotate(const Vec3<double>& v) const
{
    const Vec3<double>&c = cosines_, &s = sines_;
    const Vec3<double> about_x{v.x, c.x * v.y - s.x * v.z, s.x * v.y + c.x * v.z};
    const Vec3<double> about_y{c.y * about_x.x + s.y * about_x.z, about_x.y,
                               c.y * about_x.z - s.y * about_x.x};
    return {c.z * about_y.x - s.z * about_y.y, s.z * about_y.x + c.z * about_y.y, about_y.z};
}

}  // namespace mis
