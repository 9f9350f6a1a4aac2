#include "mis/effects/blockers.h"

#include <algorithm>

namespace mis {

const std::array<Blockers::Words, 2> Blockers::too_long{}, Blockers::none{};

namespace {

/// What a direction may meet is found by the hierarchy as soon as by a longer list.
constexpr std::size_t most_met = 32;
static_assert(most_met <= Blockers::most_in_a_list);

std::size_t bytes_of(const std::uint16_t* list)
{
    return LightList(list).words() * sizeof(std::uint16_t);
}

/// Directions that are drawn are above a horizon.
constexpr double cells_in_use = 0.5 * DirectionCells::count;

/// Expected ones, of the points' light or BSDF halves; 0: not known.
double draws_of_tile(const ListBudget& budget, std::span<const ShadingPoint> points)
{
    return budget.expected_samples() * static_cast<double>(points.size());
}

}  // namespace

std::uintptr_t ListPatience::of(std::size_t lights, double expected_draws)
{
    const double enough = worth(lights);
    if (expected_draws <= 0) return static_cast<std::uintptr_t>(enough);
    if (expected_draws < 1.5 * enough) return never;
    if (expected_draws < 2 * enough) return static_cast<std::uintptr_t>(2 * enough);
    return few;
}

std::shared_ptr<const Blockers> Blockers::of(std::shared_ptr<const FloatSpheres> spheres,
                                             const Lights& lights,
                                             std::span<const ShadingPoint> points,
                                             std::shared_ptr<ListBudget> budget)
{
    const std::size_t places = places_of(lights.size());
    const double draws = draws_of_tile(*budget, points);
    if (ListPatience::of(lights.size(), draws / static_cast<double>(lights.size())) ==
            ListPatience::never &&
        ListPatience::of(lights.size(), draws / cells_in_use) == ListPatience::never)
        return nullptr;
    if (lights.size() > most_lights || !budget->take(places * sizeof(lists_[0]))) return nullptr;
    return std::shared_ptr<const Blockers>(
        new Blockers(std::move(spheres), lights, points, std::move(budget)));
}

Blockers::Blockers(std::shared_ptr<const FloatSpheres> spheres, const Lights& lights,
                   std::span<const ShadingPoint> points, std::shared_ptr<ListBudget> budget)
    : spheres_(std::move(spheres)), lights_(&lights), parts_(points), budget_(std::move(budget)),
      patience_before_(ListPatience::of(
          lights.size(), draws_of_tile(*budget_, points) / static_cast<double>(lights.size()))),
      patience_along_(
          ListPatience::of(lights.size(), draws_of_tile(*budget_, points) / cells_in_use)),
      lists_(places_of(lights.size()))
{
}

Blockers::~Blockers()
{
    for (const auto& place : lists_) {
        const Words* list = place.load(std::memory_order_relaxed);
        if (is_count(list) || list == too_long.data() || list == none.data()) continue;
        budget_->give(bytes_of(list));
        delete[] list;
    }
    budget_->give(lists_.size() * sizeof(lists_[0]));
}

/// All that a list is about, seen from a ball of points.
Beam Blockers::beam_from(const BoundingBall& ball, std::size_t place) const
{
    const Vec3<double> from = ball.center - spheres_->origin;
    if (place < lights_->size()) {
        const Light& light = (*lights_)[place];
        // A direction that was drawn in float may end beside its light by some 1e-7 of the radius.
        return Beam::between(from, ball.radius, light.center - spheres_->origin,
                             light.radius * (1 + 4e-6));
    }
    const DirectionCells::Cone& cone = DirectionCells::cones()[place - lights_->size()];
    return {from, ball.radius, cone.axis, cone.sine, std::numeric_limits<double>::infinity()};
}

/// One more asked for a list that is not made; is it to wait?
bool Blockers::waits(std::size_t place, const Words* list, std::uintptr_t asks) const
{
    const std::uintptr_t asked = reinterpret_cast<std::uintptr_t>(list);
    if (asked >= asks) return false;
    // Another thread that counted, or made it, may have been quicker: no matter.
    lists_[place].compare_exchange_strong(list, reinterpret_cast<const Words*>(asked + 1),
                                          std::memory_order_relaxed);
    return true;
}

const Blockers::Words* Blockers::make(std::size_t place) const
{
    std::array<ListedLight, most_lights + LightList::group> found;  // NOLINT: as far as it is read
    std::array<Words, most_in_a_list> lights, beams;                // NOLINT
    const std::size_t candidates = spheres_->meet(beam_from(parts_.around(), place), found.data());
    Beams from;
    for (std::size_t k = 0; k < parts_.balls().size(); ++k)
        from.set(k, beam_from(parts_.balls()[k], place));
    const std::uint32_t parts = (1U << parts_.balls().size()) - 1;
    const std::size_t most = place < lights_->size() ? most_in_a_list : most_met;
    std::size_t count = 0;
    for (std::size_t i = 0; i < candidates && count <= most; ++i) {
        const std::uint32_t met = BeamTests::best.meeting(from, spheres_->sphere[found[i]]) & parts;
        if (met == 0 || found[i] == place) continue;  // no light hides itself
        if (count < most) lights[count] = found[i], beams[count] = static_cast<Words>(met);
        ++count;
    }
    const Words* list = too_long.data();
    const std::size_t words = LightList::words(count), bytes = words * sizeof(Words);
    if (count == 0) {
        list = none.data();
    } else if (count <= most && budget_->take(bytes)) {
        auto* made = new Words[words];
        LightList::write(lights.data(), beams.data(), count, made);
        list = made;
    }
    const Words* before = lists_[place].load(std::memory_order_acquire);
    while (is_count(before))
        if (lists_[place].compare_exchange_weak(before, list, std::memory_order_acq_rel))
            return list;
    if (list != too_long.data() && list != none.data()) {  // another thread was quicker
        budget_->give(bytes);
        delete[] list;
    }
    return before;
}

}  // namespace mis
