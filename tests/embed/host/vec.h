#pragma once

#include <cmath>

namespace host {

inline constexpr float pi = 3.14159265F;

/// Positions, directions and colours.
struct Vec {
    float x = 0, y = 0, z = 0;

    Vec& operator+=(const Vec& b) { return x += b.x, y += b.y, z += b.z, *this; }
};
inline Vec operator+(Vec a, const Vec& b) { return a += b; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator-(const Vec& a) { return {-a.x, -a.y, -a.z}; }
inline Vec operator*(const Vec& a, const Vec& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Vec operator*(const Vec& a, float s) { return {a.x * s, a.y * s, a.z * s}; }
inline float dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline float length(const Vec& a) { return std::sqrt(dot(a, a)); }
inline Vec unit(const Vec& a) { return a * (1 / length(a)); }
inline Vec cross(const Vec& a, const Vec& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Three axes around z, a unit vector.
struct Frame {
    Vec x, y, z;

    explicit Frame(const Vec& axis)
        : x(unit(std::abs(axis.x) > 0.5F ? cross(axis, {0, 1, 0}) : cross(axis, {1, 0, 0}))),
          y(cross(axis, x)), z(axis)
    {
    }
    Vec to_local(const Vec& w) const { return {dot(w, x), dot(w, y), dot(w, z)}; }
    Vec to_world(const Vec& w) const { return x * w.x + y * w.y + z * w.z; }
};

}  // namespace host
