#pragma once

#include "mis/engine/rows.h"
#include "mis/trace/beam.h"

namespace mis {

/// The rays of a batch's rows, asked of the lists that their tile keeps: first which rows have
/// anything to ask at all, without a branch for each, then those alone.
template <class T> class ListedRays {
public:
    ListedRays(const TileJob<T>& job, const Batch<T>& batch) : job_(job), batch_(batch) {}

    /// Notes the row, and the list that list_of(the tile's lists) gives for it; false where there
    /// is none, and the hierarchy is to be asked.
    template <class ListOf> bool note(int row, const ListOf& list_of)
    {
        if (job_.blockers == nullptr) return false;
        const std::int32_t point = batch_.point[static_cast<std::size_t>(row)];
        if (point != point_) go_to(shading_point(job_, batch_, row).x), point_ = point;
        if (part_ == 0) return false;
        const std::optional<LightList> list = list_of(*job_.blockers);
        if (!list) return false;
        noted_[count_] = {row, part_, *list};
        count_ += (list->beams() & part_) != 0;
        return true;
    }

    /// met(row, lights) for each row that was noted and could meet some of its list within
    /// distance_of(row).
    template <class DistanceOf, class Met>
    void for_each_met(const DistanceOf& distance_of, const Met& met)
    {
        const BeamTests tests = BeamTests::best;
        std::array<ListedLight, Blockers::most_in_a_list>
            found;  // NOLINT: filled before it is read
        Beam ray;
        std::int32_t from = -1;
        for (const Noted& noted : std::span(noted_).first(count_)) {
            const std::int32_t point = batch_.point[static_cast<std::size_t>(noted.row)];
            if (point != from) {
                const Vec3<double>& x = shading_point(job_, batch_, noted.row).x;
                ray = Beam(x - job_.blockers->spheres().origin, 0, {0, 0, 1}, 0, 0);
                from = point;
            }
            const Vec3<float> wi = vec_cast<float>(batch_.wi.at(noted.row));
            ray.axis = {wi.x, wi.y, wi.z};
            // Another light that stands before the one drawn may seem to be behind, by rounding.
            ray.end = static_cast<float>(distance_of(noted.row)) * 1.00001F + ray.radius;
            const std::size_t lights =
                tests.meet(ray, job_.blockers->spheres(), noted.list, noted.part, found.data());
            if (lights > 0) met(noted.row, std::span<const ListedLight>(found).first(lights));
        }
    }

private:
    /// A row, and whom to ask.
    struct Noted {
        std::int32_t row;
        std::uint32_t part;  ///< of the tile, a bit
        LightList list;
    };

    void go_to(const Vec3<double>& x)
    {
        const TileParts& parts = job_.blockers->parts();
        guess_ = parts.holding(x, guess_);
        part_ = guess_ < parts.balls().size() ? 1U << guess_ : 0;
    }

    const TileJob<T>& job_;
    const Batch<T>& batch_;
    std::int32_t point_ = -1;  ///< at which the last row stands
    std::size_t guess_ = 0;    ///< its part of the tile
    std::uint32_t part_ = 0;
    std::size_t count_ = 0;
    std::array<Noted, batch_capacity + 1> noted_;  // NOLINT: filled before it is read
};

}  // namespace mis
