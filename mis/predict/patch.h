#pragma once

#include "mis/math/stop_token.h"
#include "mis/predict/circle.h"
#include "mis/predict/lobe.h"
#include "mis/predict/sky.h"

#include <span>
#include <vector>

namespace mis {

/// A stretch of a meridian over which the same lights stand in the same order.
struct Stretch {
    double begin, end;               ///< θ from the pole, radians
    int nearest;                     ///< ball that is met first: a light that shines
    std::size_t first_along, along;  ///< of Meridian::along: the lights whose caps
                                     ///< hold it, as numbers in Patch::lights()
    int nearest_local;               ///< `nearest` as such a number
};

/// What stands along one meridian of a patch.
struct Meridian {
    Vec3<double> around;  ///< unit tangent at the pole
    std::vector<Stretch> stretches;
    std::vector<int> along;
    std::vector<double> hints;  ///< θ, ascending: where the lobe may peak, and how wide it is
};

/// The directions above the horizon whose smallest cap is that of one light: what of the sky is
/// integrated in that light's own coordinates, so that the smallest structures are seen from near
/// by (docs/theory-predict.md, P11).
class Patch {
public:
    /// neighbours: the balls that could share a direction with the light's cap, itself excluded.
    /// Throws Stopped, as meridian() does.
    Patch(const Sky& sky, int light, std::span<const int> neighbours, const Lobe& lobe,
          const StopToken& stop = {});

    const Polar& polar() const { return polar_; }
    /// Lights whose caps overlap this one's, itself first.
    const std::vector<int>& lights() const { return lights_; }
    /// Ascending; the last is the first + 2π. Between two, what a meridian meets changes smoothly.
    const std::vector<double>& azimuths() const { return azimuths_; }
    void meridian(double phi, Meridian& out) const;

private:
    /// Two balls whose surfaces meet: numbers of their circles or, for walls, −1 − their numbers in
    /// walls_. What the curve of equal distance (P15) takes from them, o being the pole.
    struct Pair {
        int first, second;
        Vec3<double> m, center;
        double h, gap, mo, co;
    };

    void add_circle(int ball);
    void add_pairs();
    int ball_of(int circle_or_wall) const;
    std::vector<double> all_azimuths() const;
    std::vector<double> known_azimuths() const;
    bool is_clearly_elsewhere(const PlanePoint& point, const std::array<std::size_t, 2>& on) const;
    double distance_to_cap(std::size_t circle, const Vec3<double>& offset) const;
    double distance_to_wall(int ball, const Vec3<double>& offset) const;
    void add_hints(double high, Meridian& out) const;
    bool find_held(double theta, const std::vector<Chord>& chords, std::vector<char>& held) const;
    void add_swaps(const Vec3<double>& around, double begin, double end,
                   const std::vector<char>& held, std::vector<double>& breaks) const;
    void add_stretches(double begin, double end, const std::vector<char>& held,
                       Meridian& out) const;
    bool describe(double theta, const std::vector<char>& held, Meridian& out,
                  Stretch& stretch) const;

    /// Places in circles_.
    static constexpr std::size_t own = 0, horizon = 1;

    const Sky* sky_;
    int light_;
    Polar polar_;
    Lobe lobe_;
    bool pole_is_lobe_ = false;
    std::vector<int> lights_, walls_;   ///< walls: surfaces that the point is inside of
    std::vector<Circle> circles_;       ///< own, horizon, then the neighbours'
    std::vector<Vec3<double>> deltas_;  ///< of the circles' axes from the pole
    std::vector<int> local_of_circle_;  ///< number in lights_, −1 for none
    std::vector<bool> smaller_;         ///< is the circle's cap that of a smaller light?
    std::vector<Pair> interlocked_;
    std::vector<double> azimuths_;
    StopToken stop_;
};

}  // namespace mis
