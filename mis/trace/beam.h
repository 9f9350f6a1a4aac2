#pragma once

#include "mis/math/vec.h"
#include "mis/scene/light.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace mis {

// Which of many spheres could a ray meet, or all the rays between two balls? In float, eight at a
// time, with room for every rounding: what is ruled out here is not met, what is not is asked again
// in double.

/// A light's number where there are few.
using ListedLight = std::uint16_t;

/// What rounding may move a point by: its own, and that of a beam from there (docs/theory.md,
/// section 9).
inline double rounding_of(const Vec3<double>& p)
{
    constexpr double share = 0x1p-19;  // 32 halves of a last digit
    return share * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
}

class LightList;
struct Beam;

/// The lights' spheres as beams see them.
struct FloatSpheres {
    /// origin: amid the lights. At most 65536 lights. order: of all of them, such that neighbours
    /// stand together; empty: as they are listed.
    FloatSpheres(const Lights& lights, const Vec3<double>& origin,
                 std::span<const LightIndex> order = {});
    /// All lights, in beam 0.
    LightList all() const;
    /// Those that the beam could meet → found, which has room for all and a group more; how many.
    std::size_t meet(const Beam& beam, ListedLight* found) const;

    Vec3<double> origin;  ///< scene units; of all that follows
    /// [light]: its centre, and its radius with room for rounding; padded to a multiple of eight.
    std::vector<std::array<float, 4>> sphere;

private:
    /// Balls around the groups of all_, eight of them a group of their own.
    explicit FloatSpheres(const FloatSpheres& fine);

    std::vector<std::uint16_t> all_;
    std::shared_ptr<const FloatSpheres> groups_;  ///< of a few lights: null
};

/// All balls whose centres run along a line and whose radii grow or shrink evenly: a ray, the
/// hull of two balls, a cone of directions before a ball.
struct Beam {
    /// from: of the first centre, relative to the spheres' origin. radius: there. axis: unit.
    /// slope: what the radius grows by per length, in [−1, 1]. end: how far the last centre lies,
    /// and the last radius beyond.
    Beam(const Vec3<double>& from, double radius, const Vec3<double>& axis, double slope,
         double end);
    Beam() = default;

    /// All that lies between the points of two balls.
    static Beam between(const Vec3<double>& from, double from_radius, const Vec3<double>& to,
                        double to_radius);

    std::array<float, 3> from{}, axis{};
    float radius = 0, slope = 0, cos2 = 1, end = 0;  ///< cos2: 1 − slope²
};

/// Sixteen of them, of which those after the last hold nothing.
struct Beams {
    static constexpr std::size_t most = 16;
    void set(std::size_t k, const Beam& beam);

    using Each = std::array<float, most>;
    alignas(32) std::array<Each, 3> from{}, axis{};
    alignas(32) Each radius{}, slope{}, cos2{}, end{};
};

/// Some lights, eight by eight, each with the beams (bits) that it could be met in; a view. What
/// is beyond the last one is in no beam.
class LightList {
public:
    static constexpr std::size_t group = 8;

    /// Entries of a list of so many lights: all beams, groups, and these.
    static constexpr std::size_t words(std::size_t lights)
    {
        return 2 + groups(lights) * 2 * group;
    }
    /// Fills the words.
    static void write(const ListedLight* lights, const std::uint16_t* beams, std::size_t count,
                      std::uint16_t* to);

    LightList() = default;
    explicit LightList(const std::uint16_t* words) : words_(words) {}
    std::uint32_t beams() const { return words_[0]; }  ///< in which some light could be met
    std::size_t size_in_groups() const { return words_[1]; }
    const std::uint16_t* lights_of(std::size_t g) const { return words_ + 2 + 2 * group * g; }
    const std::uint16_t* beams_of(std::size_t g) const { return lights_of(g) + group; }
    std::size_t words() const { return words(group * size_in_groups()); }

private:
    static constexpr std::size_t groups(std::size_t lights) { return (lights + group - 1) / group; }
    const std::uint16_t* words_ = nullptr;
};

/// The functions by the widest vectors that this processor has; they may differ in what they do
/// not rule out, by rounding.
struct BeamTests {
    /// The lights of the list that have a bit of `beams` and that `beam` could meet → found, which
    /// has room for all; how many.
    std::size_t (*meet)(const Beam& beam, const FloatSpheres& spheres, LightList list,
                        std::uint32_t beams, ListedLight* found);
    /// Bit k: beam k could meet the sphere.
    std::uint32_t (*meeting)(const Beams& beams, const std::array<float, 4>& sphere);

    static const BeamTests best;
    static const BeamTests by_fours;  ///< what every processor has
};

}  // namespace mis
