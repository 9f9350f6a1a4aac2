#include "mis/trace/beam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace mis {

namespace {

/// Of a radius or a distance, for its own rounding.
constexpr double wider = 1 + 2e-6;

constexpr std::size_t group = LightList::group;
/// Lights of which groups are looked at first.
constexpr std::size_t most_in_groups = 8192;

std::vector<ListedLight> counted(std::size_t count)
{
    std::vector<ListedLight> numbers(count);
    std::iota(numbers.begin(), numbers.end(), ListedLight{0});
    return numbers;
}

/// All of them, in beam 0.
std::vector<std::uint16_t> list_of(const std::vector<ListedLight>& numbers)
{
    std::vector<std::uint16_t> list(LightList::words(numbers.size()));
    LightList::write(numbers.data(), std::vector<std::uint16_t>(numbers.size(), 1).data(),
                     numbers.size(), list.data());
    return list;
}

}  // namespace

FloatSpheres::FloatSpheres(const Lights& lights, const Vec3<double>& from,
                           std::span<const LightIndex> order)
    : origin(from)
{
    sphere.resize((lights.size() + group - 1) / group * group);
    for (std::size_t j = 0; j < lights.size(); ++j) {
        const Vec3<double> center = lights[j].center - origin;
        const Vec3<float> c = vec_cast<float>(center);
        // The last term: squares of smaller numbers are none.
        const double reach = lights[j].radius * wider + rounding_of(center) + 1e-18;
        sphere[j] = {c.x, c.y, c.z, static_cast<float>(reach)};
    }
    std::vector<ListedLight> numbers(order.begin(), order.end());
    if (order.empty()) numbers = counted(lights.size());
    all_ = list_of(numbers);
    constexpr std::size_t few = 8 * group;
    if (lights.size() > few) groups_.reset(new FloatSpheres(*this));
}

FloatSpheres::FloatSpheres(const FloatSpheres& fine) : origin(fine.origin)
{
    const LightList all = fine.all();
    const std::size_t count = all.size_in_groups();
    sphere.resize((count + group - 1) / group * group);
    for (std::size_t g = 0; g < count; ++g) {
        Vec3<double> low(std::numeric_limits<double>::infinity()), high = -low;
        double reach = 0;
        const auto for_each = [&](const auto& body) {
            for (std::size_t k = 0; k < group && all.beams_of(g)[k] != 0; ++k) {
                const std::array<float, 4>& s = fine.sphere[all.lights_of(g)[k]];
                body(vec_cast<double>(Vec3<float>{s[0], s[1], s[2]}), static_cast<double>(s[3]));
            }
        };
        for_each([&](const Vec3<double>& c, double r) {
            low = glm::min(low, c - r), high = glm::max(high, c + r);
        });
        const Vec3<float> center = vec_cast<float>((low + high) * 0.5);
        for_each([&](const Vec3<double>& c, double r) {
            reach = std::max(reach, length(c - vec_cast<double>(center)) + r);
        });
        sphere[g] = {center.x, center.y, center.z, static_cast<float>(reach * wider)};
    }
    all_ = list_of(counted(count));
}

std::size_t FloatSpheres::meet(const Beam& beam, ListedLight* found) const
{
    const BeamTests& tests = BeamTests::best;
    if (!groups_) return tests.meet(beam, *this, all(), 1, found);
    std::array<ListedLight, most_in_groups / group> met;  // NOLINT: filled as far as it is read
    std::array<std::uint16_t, LightList::words(most_in_groups)> near;  // NOLINT: likewise
    const LightList all_lights = all();
    if (all_lights.size_in_groups() * group > most_in_groups)
        return tests.meet(beam, *this, all_lights, 1, found);
    const std::size_t count = tests.meet(beam, *groups_, groups_->all(), 1, met.data());
    near[0] = 1, near[1] = static_cast<std::uint16_t>(count);
    for (std::size_t k = 0; k < count; ++k)
        std::copy_n(all_lights.lights_of(met[k]), 2 * group, &near[2 + 2 * group * k]);
    return tests.meet(beam, *this, LightList(near.data()), 1, found);
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
