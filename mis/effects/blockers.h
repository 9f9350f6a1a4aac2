#pragma once

#include "mis/effects/direction_cells.h"
#include "mis/effects/tile_parts.h"
#include "mis/scene/shading_point.h"
#include "mis/trace/beam.h"

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace mis {

/// What may be spent on lists, and what they are expected to be asked; many threads ask.
class ListBudget {
public:
    /// Samples that a shading point is going to take in all, of all strategies; 0: not known.
    void expect_samples(double of_point) { samples_.store(of_point, std::memory_order_relaxed); }
    double expected_samples() const { return samples_.load(std::memory_order_relaxed); }

    /// So many in all.
    explicit ListBudget(std::size_t bytes) : left_(static_cast<std::ptrdiff_t>(bytes)) {}
    /// Takes some, or nothing where there are fewer left.
    bool take(std::size_t bytes)
    {
        const auto wanted = static_cast<std::ptrdiff_t>(bytes);
        if (left_.fetch_sub(wanted, std::memory_order_relaxed) >= wanted) return true;
        give(bytes);
        return false;
    }
    /// Gives back what was taken.
    void give(std::size_t bytes)
    {
        left_.fetch_add(static_cast<std::ptrdiff_t>(bytes), std::memory_order_relaxed);
    }

private:
    std::atomic<std::ptrdiff_t> left_;
    std::atomic<double> samples_ = 0;
};

/// How many draws are left to the hierarchy before a list is made for them, where a list takes as
/// long to make as it saves in `worth()` draws. Of expected draws, that a list is asked by each on
/// average: enough of them, and only the first few are left to it; too few, and lists wait for what
/// is asked far more often than others, or are not made at all. Where nothing is expected, a list
/// is made once its draws would have paid for it, which is at most twice too dear whatever comes
/// (Karlin et al. 1988, "Competitive snoopy caching").
struct ListPatience {
    static constexpr std::uintptr_t few = 3, never = ~std::uintptr_t{0};
    static double worth(std::size_t lights) { return 8 + static_cast<double>(lights) / 64; }
    static std::uintptr_t of(std::size_t lights, double expected_draws);
};

/// For the points of one tile: which lights could stand before another one at all, and which could
/// a direction meet. A list is made when it is asked for, and kept; many threads may ask. What a
/// list leaves out is not met, so whoever asks a list gets the answer that the whole hierarchy
/// gives. The beams of a list are those from parts().
class Blockers {
public:
    /// Lights beyond which lists do not pay any more, and lights that one list may hold.
    static constexpr std::size_t most_lights = 4096, most_in_a_list = 256;
    /// Of all lists together.
    static constexpr std::size_t most_bytes = std::size_t{128} << 20;
    /// Of so few lights no lists by direction are kept: to look at them all is as quick.
    static constexpr std::size_t few_lights = 32;
    /// points: of the tile, at least one. spheres: of the lights. lights: kept by reference, as
    /// they are. Null where there are too many lights, the budget is spent, or too little is going
    /// to be asked.
    static std::shared_ptr<const Blockers> of(std::shared_ptr<const FloatSpheres> spheres,
                                              const Lights& lights,
                                              std::span<const ShadingPoint> points,
                                              std::shared_ptr<ListBudget> budget);
    ~Blockers();
    Blockers(const Blockers&) = delete;
    Blockers& operator=(const Blockers&) = delete;

    const TileParts& parts() const { return parts_; }
    const FloatSpheres& spheres() const { return *spheres_; }

    /// Draws of each light, and of each cell of directions, before a list is made for them.
    std::uintptr_t patience_before() const { return patience_before_; }
    std::uintptr_t patience_along() const { return patience_along_; }

    /// Every light that may stand between a point of the tile and light j; nothing where no list
    /// is kept, and the hierarchy is to be asked.
    std::optional<LightList> before(LightIndex j) const
    {
        return kept(static_cast<std::size_t>(j), 0);
    }
    /// Every light that a direction may meet from a point of the tile.
    std::optional<LightList> along(const Vec3<float>& wi) const { return kept(place_of(wi), 0); }

    /// The same for one of many draws: the first few of them get nothing.
    std::optional<LightList> often_before(LightIndex j) const
    {
        return kept(static_cast<std::size_t>(j), patience_before_);
    }
    std::optional<LightList> often_along(const Vec3<float>& wi) const
    {
        return kept(place_of(wi), patience_along_);
    }

private:
    Blockers(std::shared_ptr<const FloatSpheres> spheres, const Lights& lights,
             std::span<const ShadingPoint> points, std::shared_ptr<ListBudget> budget);

    /// Lists before each light come first, then those along each cell of directions.
    std::size_t place_of(const Vec3<float>& wi) const
    {
        return lights_->size() + DirectionCells::of(wi);
    }
    static constexpr std::size_t places_of(std::size_t lights)
    {
        return lights + (lights > few_lights ? DirectionCells::count : 0);
    }
    std::optional<LightList> kept(std::size_t place, std::uintptr_t asks) const
    {
        if (place >= lists_.size()) return std::nullopt;
        const Words* list = lists_[place].load(std::memory_order_acquire);
        if (is_count(list)) {
            if (asks == ListPatience::never || waits(place, list, asks)) return std::nullopt;
            list = make(place);
        }
        if (list == too_long.data()) return std::nullopt;
        return LightList(list);
    }

    using Words = std::uint16_t;
    /// Is it how often it was asked for, and no list?
    static bool is_count(const Words* list)
    {
        constexpr std::uintptr_t most = 4096;  // below any address
        return reinterpret_cast<std::uintptr_t>(list) < most;
    }
    bool waits(std::size_t place, const Words* list, std::uintptr_t asks) const;
    const Words* make(std::size_t place) const;
    Beam beam_from(const BoundingBall& ball, std::size_t place) const;

    static const std::array<Words, 2> too_long, none;
    std::shared_ptr<const FloatSpheres> spheres_;
    const Lights* lights_;
    TileParts parts_;
    std::shared_ptr<ListBudget> budget_;
    std::uintptr_t patience_before_, patience_along_;
    /// A list; or how often it was asked for while it was not made.
    mutable std::vector<std::atomic<const Words*>> lists_;
};

}  // namespace mis
