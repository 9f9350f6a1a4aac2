#include "mis/engine/light_points.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace mis {

namespace {

constexpr std::size_t most_points = 256;  // at hand at a time

template <class T, class U>
Vec3<T> at(const std::array<std::span<const U>, 3>& arrays, std::size_t i)
{
    return {static_cast<T>(arrays[0][i]), static_cast<T>(arrays[1][i]),
            static_cast<T>(arrays[2][i])};
}

template <class U> bool are_as_long(const std::array<std::span<U>, 3>& arrays, std::size_t size)
{
    return std::ranges::all_of(arrays, [=](const auto& a) { return a.size() == size; });
}

}  // namespace

TileTotals PointLighter::light(const PointArrays& points, std::uint64_t first, int count,
                               const RadianceArrays& radiance)
{
    const std::size_t size = points.size();
    assert(count >= 1 && "count: at least one sample");
    assert(are_as_long(points.x, size) && are_as_long(points.n, size) &&
           are_as_long(points.wo, size) && are_as_long(points.ray_origin, size) &&
           points.material.size() == size && "points: arrays of one length");
    assert(are_as_long(radiance, size) && "radiance: as long as the points");
    totals_ = {};
    for (std::vector<std::uint32_t>* places : {&order_, &places_}) places->reserve(most_points);
    points_.reserve(most_points), results_.reserve(most_points);
    for (std::size_t begin = 0; begin < size; begin += most_points)
        light_some(points, begin, std::min(begin + most_points, size), first, count, radiance);
    return totals_;
}

/// Points [begin, end): one tile for each of their materials.
void PointLighter::light_some(const PointArrays& points, std::size_t begin, std::size_t end,
                              std::uint64_t first, int count, const RadianceArrays& radiance)
{
    order_.clear();
    for (std::size_t i = begin; i < end; ++i) order_.push_back(static_cast<std::uint32_t>(i));
    const auto material = [&](std::uint32_t i) { return points.material[i]; };
    std::ranges::sort(order_, [&](std::uint32_t a, std::uint32_t b) {
        return material(a) != material(b) ? material(a) < material(b) : a < b;
    });
    const Vec3<double> frame =
        scene_->surfaces() != nullptr ? scene_->surfaces()->origin() : Vec3<double>(0);
    for (std::size_t k = 0; k < order_.size();) {
        const int here = material(order_[k]);
        const bool is_known =
            here >= 0 && here < static_cast<int>(scene_->scene().materials.size());
        assert(is_known && "points.material: a number of one of the scene's materials");
        points_.clear(), places_.clear();
        for (; k < order_.size() && material(order_[k]) == here; ++k) {
            const std::uint32_t i = order_[k];
            const ShadingPoint point{
                at<double>(points.x, i), at<float>(points.n, i), at<float>(points.wo, i),
                vec_cast<float>(at<double>(points.ray_origin, i) - frame), points.id[i]};
            for (const std::span<float>& channel : radiance) channel[i] = 0;
            const float cos_out = dot(point.n, point.wo);
            if (!is_known || !std::isfinite(point.x.x + point.x.y + point.x.z) ||
                !std::isfinite(cos_out)) {
                totals_.invalid += static_cast<std::uint64_t>(count);
                continue;
            }
            const bool is_lit = cos_out > 0 && !scene_->lights().contains(point.x);
            if (is_lit) points_.push_back(point), places_.push_back(i);
        }
        if (!points_.empty()) light_tile(here, first, count, radiance);
    }
}

void PointLighter::light_tile(int material, std::uint64_t first, int count,
                              const RadianceArrays& radiance)
{
    results_.assign(points_.size(), {});
    const int each = samples_together(strategy_->strategy());
    assert(count % each == 0 && "count: as many samples as come together, or some times that");
    const Tile tile{0, static_cast<std::uint32_t>(points_.size()), material, points_.front().x};
    totals_.add(
        workspace_.run(strategy_->job(tile, points_), strategy_->pipeline(material),
                       {.first = first, .chunk = count / each, .samples_per_observation = each},
                       results_, {}, {}));
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const Vec3<double> mean = results_[p].mean();
        for (std::size_t c = 0; c < 3; ++c)
            radiance[c][places_[p]] = static_cast<float>(mean[static_cast<int>(c)]);
    }
}

}  // namespace mis
