#pragma once

#include "mis/math/cap.h"
#include "mis/math/stop_token.h"
#include "mis/scene/scene.h"

#include <vector>

namespace mis {

/// A sphere as a point sees it: a light, or a surface that hides lights.
struct Ball {
    enum class Stands {
        apart,    ///< the point is outside it: the ball is a cap of directions
        beneath,  ///< the point lies on it, outside: half of all directions start
                  ///< into it
        around    ///< the point is inside it (surfaces alone): every direction ends at
                  ///< its far wall
    };
    Vec3<double> to_center;
    double radius = 0;
    Cap<double> cap{};   ///< its gap2 is negative for `around`; unused for
                         ///< `beneath` but for the axis
    double sin_max = 0;  ///< of the cap's half-angle
    double one_minus_cos = 0;
    LightIndex light = no_light;
    Vec3<double> radiance{0};  ///< W·sr⁻¹·m⁻²; 0 for surfaces
    Stands stands = Stands::apart;

    bool is_light() const { return light != no_light; }
    bool shines() const { return radiance.x > 0 || radiance.y > 0 || radiance.z > 0; }
};

/// What one probe could see: its lights (ball j is light j), then the spheres that occlude.
struct Sky {
    Vec3<double> n;  ///< unit shading normal
    std::vector<Ball> balls;
    std::vector<std::vector<int>> neighbours;  ///< of each light: the balls that could share a
                                               ///< direction with its cap
    std::size_t lights = 0;
    bool is_dark = false;  ///< the point is inside a light or on it

    const Ball& ball(int index) const { return balls[static_cast<std::size_t>(index)]; }
};

/// Throws Stopped.
Sky sky_of(const Scene& scene, const Probe& probe, const StopToken& stop = {});

/// axis of b − axis of a, with full relative precision for neighbours (docs/theory-predict.md,
/// P14).
Vec3<double> between_axes(const Ball& a, const Ball& b);

/// Could their caps have a direction in common? True at the edge.
bool overlap(const Ball& a, const Ball& b);

/// Do the two spheres' surfaces meet in space? Then neither need be the nearer one all over their
/// common directions.
bool interlock(const Ball& a, const Ball& b);

/// Could `front` hide a part of `back`? False only where it provably cannot.
bool could_hide(const Ball& front, const Ball& back);

/// Is the whole cap above the horizon? Is none of it?
bool is_above(const Ball& ball, const Vec3<double>& n);
bool is_below(const Ball& ball, const Vec3<double>& n);

}  // namespace mis
