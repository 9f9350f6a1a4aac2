#include "mis/study/measured.h"

#include "mis/engine/exact.h"
#include "mis/math/limits.h"
#include "mis/stats/exactness.h"
#include "mis/stats/resolved.h"

#include <algorithm>

namespace mis {

namespace {

/// A strategy's variance is from shared directions unless a first look, of so many turns, says that
/// they would not resolve it by the end.
constexpr std::size_t turns_of_look = 3;

}  // namespace

MeasuredStrategies::MeasuredStrategies(const StudyGround& ground,
                                       const std::vector<Strategy>& strategies, SetUp& set_up,
                                       bool has_closed_form)
    : ground_(ground), strategies_(strategies), set_up_(set_up), has_closed_form_(has_closed_form),
      of_shared_(strategies.size())
{
    for (const Strategy& s : strategies) is_own_.push_back(!set_up.shared || !can_share(s));
}

std::optional<std::size_t> MeasuredStrategies::place_of(std::size_t s) const
{
    const auto found = std::ranges::find(set_up_.sharing, strategies_[s]);
    if (found == set_up_.sharing.end()) return std::nullopt;
    return static_cast<std::size_t>(found - set_up_.sharing.begin());
}

std::optional<std::size_t> MeasuredStrategies::shared_place(std::size_t s) const
{
    return is_shared() && !is_own_[s] ? place_of(s) : std::nullopt;
}

bool MeasuredStrategies::is_dark() const
{
    const Lights& lights = ground_.scene.scene().lights;
    return ground_.points.figure_lit == 0 || std::ranges::all_of(lights, [](const Light& light) {
               return light.radiance_radius == Vec3<float>(0.0F);
           });
}

void MeasuredStrategies::choose_sources(double times)
{
    if (has_chosen_ || set_up_.shared->count() < turns_of_look) return;
    has_chosen_ = true;
    for (std::size_t s = 0; s < strategies_.size(); ++s) {
        const std::optional<std::size_t> place = place_of(s);
        is_own_[s] =
            !place || !(set_up_.shared->relative_error(*place, times) <= largest_relative_error);
        if (is_own_[s]) set_up_.how.apart[s] = {};
    }
}

void MeasuredStrategies::look()
{
    if (!is_shared()) return;
    const SharedTurns& shared = *set_up_.shared;
    set_up_.audit.emplace(shared, ground_.points.figure_lit, set_up_.how.weights, set_up_.sharing);
    ground_.executor.for_each(strategies_.size(), [&](std::size_t s) {
        const std::optional<std::size_t> place = place_of(s);
        if (!set_up_.runs[s]) return;
        if (place) of_shared_[s].figures = shared.figures(*place);
        of_shared_[s].means = mean_checks(*set_up_.runs[s], ground_.points, shared, place);
    });
}

std::optional<double> MeasuredStrategies::shared_variance(std::size_t s) const
{
    const std::optional<std::size_t> place = shared_place(s);
    if (!place) return std::nullopt;
    const ValueAndError variance = set_up_.shared->mean(*place);
    return std::max(variance.value, 0.0) + 2 * variance.se;
}

StrategyMeasurements MeasuredStrategies::of(std::size_t s, const RelativeScale& scale) const
{
    const StrategyRun* run = set_up_.runs[s].get();
    if (!run || (ground_.points.figure_lit > 0 && run->samples() == 0)) return not_run(s);
    StrategyMeasurements m = run->measurements(scale);
    if (is_shared()) {
        if (!is_own_[s] && place_of(s)) m.shared = of_shared_[s].figures;
        m.mean_checks = of_shared_[s].means;
    }
    if (set_up_.audit) set_up_.audit->add_to(m, run->results());
    m.is_proved_exact =
        is_dark() || (has_closed_form_ && gives_closed_form(ground_.scene.scene(), strategies_[s]));
    m.all_samples_equal_reference =
        exactness_of(m) != Exactness::none && !(m.shared && is_refuted(m));
    return m;
}

StrategyMeasurements MeasuredStrategies::not_run(std::size_t s) const
{
    const CostEstimate& cost = set_up_.costs[s];
    StrategyMeasurements m;
    m.strategy = strategies_[s];
    m.was_run = false;
    m.estimated_seconds = cost.is_known ? cost.seconds : nan;
    m.not_run_reason = set_up_.runs[s] && !ground_.is_stopped()
                           ? Reason(reason::NotReady{})
                           : why_not_run(cost, set_up_.first_samples, ground_.is_stopped());
    return m;
}

}  // namespace mis
