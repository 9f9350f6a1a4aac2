#include "mis/effects/blockers.h"

#include "mis/effects/round_cone.h"

#include <algorithm>

namespace mis {

namespace {

std::size_t bytes_of(const LightIndex* list)
{
    return (static_cast<std::size_t>(list[0]) + 1) * sizeof(LightIndex);
}

}  // namespace

std::shared_ptr<const Blockers> Blockers::of(const LightHierarchy& hierarchy, const Lights& lights,
                                             std::span<const ShadingPoint> points,
                                             std::shared_ptr<ListBudget> budget)
{
    if (lights.size() > most_lights ||
        !budget->take(lights.size() * sizeof(std::atomic<const LightIndex*>)))
        return nullptr;
    return std::shared_ptr<const Blockers>(
        new Blockers(hierarchy, lights, points, std::move(budget)));
}

Blockers::Blockers(const LightHierarchy& hierarchy, const Lights& lights,
                   std::span<const ShadingPoint> points, std::shared_ptr<ListBudget> budget)
    : hierarchy_(&hierarchy), lights_(&lights), budget_(std::move(budget)), lists_(lights.size())
{
    Vec3<double> low = points[0].x, high = low;
    for (const ShadingPoint& p : points) low = min(low, p.x), high = max(high, p.x);
    middle_ = 0.5 * (low + high);
    for (const ShadingPoint& p : points) radius_ = std::max(radius_, length(p.x - middle_));
}

Blockers::~Blockers()
{
    for (const auto& kept : lists_) {
        const LightIndex* list = kept.load(std::memory_order_relaxed);
        if (list == nullptr || list == &too_long || list == &none) continue;
        budget_->give(bytes_of(list));
        delete[] list;
    }
    budget_->give(lists_.size() * sizeof(lists_[0]));
}

/// One more than may be listed where there are too many.
std::vector<LightIndex> Blockers::found_before(const Light& light, LightIndex j) const
{
    // A direction that was drawn in float may end beside its light by some 1e-7 of the radius.
    const RoundCone between(middle_, radius_, light.center, light.radius * (1 + 4e-6));
    const auto room_at = [this, here = radius_ + length(middle_)](const Vec3<double>& p) {
        return 1e-11 * (here + length(p - middle_));  // for rounding
    };
    std::vector<LightIndex> found;
    hierarchy_->for_each_touching(
        [&](const Vec3<double>& center, double radius) {
            return between.distance(center) <= radius + room_at(center);
        },
        [&](LightIndex k) {
            if (k != j) found.push_back(k);
            return found.size() <= most_in_a_list;
        });
    return found;
}

const LightIndex* Blockers::make(LightIndex j) const
{
    const std::vector<LightIndex> found = found_before((*lights_)[static_cast<std::size_t>(j)], j);
    const LightIndex* list = &too_long;
    const std::size_t bytes = (found.size() + 1) * sizeof(LightIndex);
    if (found.empty()) {
        list = &none;
    } else if (found.size() <= most_in_a_list && budget_->take(bytes)) {
        auto* made = new LightIndex[found.size() + 1];
        made[0] = static_cast<LightIndex>(found.size());
        std::copy(found.begin(), found.end(), made + 1);
        list = made;
    }
    const LightIndex* before = nullptr;
    auto& kept = lists_[static_cast<std::size_t>(j)];
    if (kept.compare_exchange_strong(before, list, std::memory_order_acq_rel)) return list;
    if (list != &too_long && list != &none) {  // another thread was quicker
        budget_->give(bytes);
        delete[] list;
    }
    return before;
}

}  // namespace mis
