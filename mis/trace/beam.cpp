#include "mis/trace/beam.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mis {

namespace {

/// Of a radius or a distance, for its own rounding.
constexpr double wider = 1 + 2e-6;

}  // namespace

FloatSpheres::FloatSpheres(const Lights& lights, const Vec3<double>& from) : origin(from)
{
    constexpr std::size_t group = LightList::group;
    sphere.resize((lights.size() + group - 1) / group * group);
    for (std::size_t j = 0; j < lights.size(); ++j) {
        const Vec3<double> center = lights[j].center - origin;
        const Vec3<float> c = vec_cast<float>(center);
        // The last term: squares of smaller numbers are none.
        const double reach = lights[j].radius * wider + rounding_of(center) + 1e-18;
        sphere[j] = {c.x, c.y, c.z, static_cast<float>(reach)};
    }
    std::vector<ListedLight> numbers(lights.size());
    std::iota(numbers.begin(), numbers.end(), ListedLight{0});
    all_.resize(LightList::words(lights.size()));
    LightList::write(numbers.data(), std::vector<std::uint16_t>(lights.size(), 1).data(),
                     lights.size(), all_.data());
}

LightList FloatSpheres::all() const { return LightList(all_.data()); }

Beam::Beam(const Vec3<double>& start, double start_radius, const Vec3<double>& direction,
           double growth, double last)
    : from{static_cast<float>(start.x), static_cast<float>(start.y), static_cast<float>(start.z)},
      axis{static_cast<float>(direction.x), static_cast<float>(direction.y),
           static_cast<float>(direction.z)},
      radius(static_cast<float>(start_radius * wider + rounding_of(start))),
      slope(static_cast<float>(growth)),
      cos2(static_cast<float>((1 - growth) * (1 + growth) * (2 - wider))),
      end(static_cast<float>(last * wider + rounding_of(start)))
{
}

Beam Beam::between(const Vec3<double>& from, double from_radius, const Vec3<double>& to,
                   double to_radius)
{
    const double away = length(to - from), growth = (to_radius - from_radius) / away;
    if (std::abs(growth) < 1)
        return {from, from_radius, (to - from) / away, growth, away + to_radius};
    // One holds the other: a ball around both.
    const double all = std::max(from_radius, away + to_radius);
    return {from, all, {0, 0, 1}, 1, all};
}

void Beams::set(std::size_t k, const Beam& beam)
{
    for (std::size_t a = 0; a < 3; ++a) from[a][k] = beam.from[a], axis[a][k] = beam.axis[a];
    radius[k] = beam.radius, slope[k] = beam.slope, cos2[k] = beam.cos2, end[k] = beam.end;
}

void LightList::write(const ListedLight* lights, const std::uint16_t* beams, std::size_t count,
                      std::uint16_t* to)
{
    std::fill_n(to, words(count), std::uint16_t{0});
    to[1] = static_cast<std::uint16_t>(groups(count));
    for (std::size_t i = 0; i < count; ++i) {
        std::uint16_t* in_group = to + 2 + i / group * 2 * group + i % group;
        in_group[0] = lights[i], in_group[group] = beams[i];
        to[0] = static_cast<std::uint16_t>(to[0] | beams[i]);
    }
}

}  // namespace mis
