#pragma once

#include "mis/math/vec.h"
#include "mis/scene/shading_point.h"
#include "mis/trace/lights.h"

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace mis {

/// Bytes that may still be spent on lists; many threads ask.
class ListBudget {
public:
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
};

/// For the points of one tile and each light: which others could stand before it at all. A list
/// is made when it is first asked for, and kept; many threads may ask. What a list leaves out can
/// hide nothing, so whoever asks a list gets the answer that the whole hierarchy gives.
class Blockers {
public:
    /// Lights beyond which a list does not pay any more, and lights that one list may hold.
    static constexpr std::size_t most_lights = 4096, most_in_a_list = 64;
    /// Of all lists together.
    static constexpr std::size_t most_bytes = 64 << 20;

    /// points: of the tile, at least one. hierarchy: of the lights; kept by reference, as they
    /// are. Null where there are too many lights, or the budget is spent.
    static std::shared_ptr<const Blockers> of(const LightHierarchy& hierarchy, const Lights& lights,
                                              std::span<const ShadingPoint> points,
                                              std::shared_ptr<ListBudget> budget);
    ~Blockers();
    Blockers(const Blockers&) = delete;
    Blockers& operator=(const Blockers&) = delete;

    /// Every light that may stand between a point of the tile and light j, in no order; nothing
    /// where no list is kept, and the hierarchy is to be asked.
    std::optional<std::span<const LightIndex>> before(LightIndex j) const
    {
        const auto& kept = lists_[static_cast<std::size_t>(j)];
        const LightIndex* list = kept.load(std::memory_order_acquire);
        if (list == nullptr) list = make(j);
        if (list == &too_long) return std::nullopt;
        return std::span(list + 1, static_cast<std::size_t>(list[0]));
    }

private:
    Blockers(const LightHierarchy& hierarchy, const Lights& lights,
             std::span<const ShadingPoint> points, std::shared_ptr<ListBudget> budget);
    const LightIndex* make(LightIndex j) const;
    std::vector<LightIndex> found_before(const Light& light, LightIndex j) const;

    static constexpr LightIndex too_long = -1, none = 0;
    const LightHierarchy* hierarchy_;
    const Lights* lights_;
    Vec3<double> middle_{0};  ///< of the ball around the points
    double radius_ = 0;
    std::shared_ptr<ListBudget> budget_;
    /// [light]: its list, how many and then which; null: not asked for yet
    mutable std::vector<std::atomic<const LightIndex*>> lists_;
};

}  // namespace mis
