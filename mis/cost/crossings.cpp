#include "mis/cost/crossings.h"

#include "mis/stats/estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace mis {
namespace {

constexpr double steps_per_decade = 64;

/// Logarithms of the times to a row of errors, from large to small.
struct TimeRow {
    const CostModel* model;
    std::vector<LogEstimate> log_seconds;
};

bool takes_part(const CostModel& model)
{
    return !std::isnan(model.log_variance.value) && !model.times.empty();
}

/// The error of one sample.
double first_error(const CostModel& model) { return std::exp(0.5 * model.log_variance.value); }

/// From the largest that one sample of any makes, but not above 100 %: black has no larger one.
std::vector<double> row_of_errors(std::span<const CostModel> models)
{
    double largest = 0;
    for (const CostModel& model : models)
        if (takes_part(model)) largest = std::max(largest, first_error(model));
    std::vector<double> errors;
    const double step = std::pow(10.0, -1 / steps_per_decade);
    for (double e = std::min(largest, 1.0); e >= least_crossing_error; e *= step)
        errors.push_back(e);
    return errors;
}

/// How one pair stands at one error. lead: −1 where a is surely sooner, +1 where b is, else 0.
struct Stand {
    double log_ratio = 0, log_seconds = 0;  ///< of the times; of their geometric mean
    int lead = 0;
};

Stand stand_of(const LogEstimate& a, const LogEstimate& b, double tail)
{
    Stand stand{a.value - b.value, 0.5 * (a.value + b.value), 0};
    LogEstimate turned = b;
    turned.value = -b.value;
    const LogEstimate ratio = product(a, turned);
    if (!(ratio.se >= 0) || stand.log_ratio == 0) return stand;
    const double bound = ratio.se > 0 ? t_quantile(tail, ratio.dof) * ratio.se : 0;
    if (std::fabs(stand.log_ratio) > bound) stand.lead = stand.log_ratio < 0 ? -1 : 1;
    return stand;
}

/// The crossing between stands `from` and `to`, which have different sure leads, those between
/// them none.
CrossingReport crossing(std::span<const Stand> stands, std::span<const double> errors,
                        std::size_t from, std::size_t to)
{
    std::size_t k = from;
    while (k + 1 < to && stands[k + 1].log_ratio * stands[from].log_ratio > 0) ++k;
    const double part =
        stands[k].log_ratio / (stands[k].log_ratio - stands[k + 1].log_ratio);  // in [0, 1]
    const auto between = [&](double a, double b) { return std::exp(a + part * (b - a)); };
    CrossingReport found;
    found.error = {between(std::log(errors[k]), std::log(errors[k + 1])), errors[to], errors[from]};
    found.seconds = {between(stands[k].log_seconds, stands[k + 1].log_seconds),
                     std::exp(stands[from].log_seconds), std::exp(stands[to].log_seconds)};
    return found;
}

void add_crossings(std::vector<CrossingReport>& found, std::span<const TimeRow> rows,
                   std::span<const double> errors, std::pair<std::size_t, std::size_t> pair,
                   double tail)
{
    const auto [a, b] = pair;
    std::vector<Stand> stands;
    for (std::size_t i = 0; i < errors.size(); ++i)
        stands.push_back(stand_of(rows[a].log_seconds[i], rows[b].log_seconds[i], tail));
    const double first = std::min(first_error(*rows[a].model), first_error(*rows[b].model));
    std::optional<std::size_t> last;  // with a sure lead
    for (std::size_t i = 0; i < stands.size(); ++i) {
        if (stands[i].lead == 0 || errors[i] > first) continue;
        if (last && stands[*last].lead != stands[i].lead) {
            CrossingReport c = crossing(stands, errors, *last, i);
            const bool a_leads = stands[*last].lead < 0;
            c.before = static_cast<int>(a_leads ? a : b);
            c.after = static_cast<int>(a_leads ? b : a);
            c.is_extrapolated =
                c.error.value < std::max(rows[a].model->least_error, rows[b].model->least_error);
            found.push_back(c);
        }
        last = i;
    }
}

}  // namespace

std::vector<CrossingReport> find_crossings(std::span<const CostModel> models)
{
    const std::vector<double> errors = row_of_errors(models);
    std::vector<TimeRow> rows;
    std::size_t members = 0;
    for (const CostModel& model : models) {
        rows.push_back({&model, {}});
        if (!takes_part(model)) continue;
        ++members;
        for (const double error : errors)
            rows.back().log_seconds.push_back(log_seconds_to(model, error));
    }
    std::vector<CrossingReport> found;
    if (members < 2 || errors.empty()) return found;
    // Either side of a crossing can be wrong.
    const double tail = interval_tail / (0.5 * double(members) * double(members - 1));
    for (std::size_t a = 0; a < models.size(); ++a)
        for (std::size_t b = a + 1; b < models.size(); ++b)
            if (takes_part(models[a]) && takes_part(models[b]))
                add_crossings(found, rows, errors, {a, b}, tail);
    std::stable_sort(found.begin(), found.end(), [](const auto& x, const auto& y) {
        return x.seconds.value < y.seconds.value;
    });
    return found;
}

}  // namespace mis
