#include "mis/study/shared_samples.h"

#include <algorithm>
#include <cmath>

namespace mis {

namespace {

/// Of one light's own sums, at all points: no more are kept. Beyond, they are not centred.
constexpr std::size_t most_light_sums = 10'000'000;

/// Points that are one task.
constexpr std::size_t points_of_part = 16;

}  // namespace

SharedSamples::SharedSamples(const LitScene& scene, std::vector<SharedPoint> points,
                             std::span<const Strategy> strategies, const SharedRun& run)
    : scene_(&scene), points_(std::move(points)), plan_(strategies), run_(run),
      sums_(points_.size() * strategies.size()), point_sums_(points_.size()),
      missed_(strategies.size())
{
    const std::size_t lights = points_.size() * plan_.every_light * scene.scene().lights.size();
    if (lights <= most_light_sums) lights_.resize(lights);
}

void SharedSamples::take(int rounds, const AnyExecutor& executor)
{
    const std::size_t parts = (points_.size() + points_of_part - 1) / points_of_part;
    std::vector<std::vector<double>> missed(parts, std::vector<double>(plan_.entries.size()));
    executor.for_each(parts, [&](std::size_t part) {
        workers_.with([&](std::unique_ptr<Worker>& worker) {
            const std::size_t end = std::min((part + 1) * points_of_part, points_.size());
            for (std::size_t p = part * points_of_part; p < end; ++p) {
                begin_take(p);
                if (run_.stop.is_up()) continue;
                if (!worker)
                    worker = std::make_unique<Worker>(
                        Worker{DirectionSet(*scene_, plan_, run_.counts, run_.stop),
                               SharedIntegrals(plan_, scene_->scene().lights.size())});
                take_at(p, rounds, *worker, missed[part]);
            }
        });
    });
    for (const std::vector<double>& of_part : missed)
        for (std::size_t s = 0; s < missed_.size(); ++s) missed_[s] += of_part[s];
    rounds_ += rounds;
}

void SharedSamples::begin_take(std::size_t point)
{
    for (std::size_t s = 0; s < plan_.entries.size(); ++s) sums_[place(s, point)].last = 0;
    point_sums_[point].last = 0;
}

void SharedSamples::take_at(std::size_t point, int rounds, Worker& worker, std::span<double> missed)
{
    const std::size_t strategies = plan_.entries.size();
    const std::span sums = std::span(sums_).subspan(point * strategies, strategies);
    const std::size_t per_point = plan_.every_light * scene_->scene().lights.size();
    const std::span lights = lights_.empty()
                                 ? std::span<LightSums>()
                                 : std::span(lights_).subspan(point * per_point, per_point);
    worker.directions.prepare(points_[point]);
    PointSums& of_point = point_sums_[point];
    for (int i = 0; i < rounds && !run_.stop.is_up(); ++i) {
        const int round = of_point.rounds++;
        worker.directions.draw(static_cast<std::uint64_t>(round), run_.seed);
        worker.integrals.take(worker.directions, sums, lights, round > 0);
        if (round > 0) {
            of_point.luminance.add(worker.integrals.mean());
            of_point.last += worker.integrals.mean();
            for (std::size_t s = 0; s < strategies; ++s) missed[s] += worker.integrals.missed()[s];
        }
    }
}

bool SharedSamples::is_even() const
{
    return std::all_of(point_sums_.begin(), point_sums_.end(),
                       [&](const PointSums& p) { return p.rounds == rounds_; });
}

ValueAndError SharedSamples::at(std::size_t strategy, std::size_t point) const
{
    const ReplicateSquares& sums = sums_[place(strategy, point)].variance;
    const int n = point_sums_[point].counted();
    return {sums.mean(n), std::sqrt(sums.squared_error(n))};
}

ValueAndError SharedSamples::mean(std::size_t strategy, std::span<const double> weights) const
{
    double sum = 0, squares = 0;
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const ValueAndError found = at(strategy, p);
        const double weight = weights.empty() ? 1 : weights[p];
        sum += weight * found.value, squares += weight * found.se * (weight * found.se);
    }
    const auto n = static_cast<double>(points_.size());
    return {sum / n, std::sqrt(squares) / n};
}

ValueAndError SharedSamples::luminance(std::size_t point) const
{
    const PointSums& of_point = point_sums_[point];
    const int n = of_point.counted();
    return {of_point.luminance.mean(n), std::sqrt(of_point.luminance.squared_error(n))};
}

double SharedSamples::covariance(std::size_t strategy, std::size_t point) const
{
    const SharedSums& sums = sums_[place(strategy, point)];
    const PointSums& of_point = point_sums_[point];
    const double n = of_point.counted();
    return (sums.with_luminance / n - sums.variance.mean(n) * of_point.luminance.mean(n)) / (n - 1);
}

double SharedSamples::missed(std::size_t strategy) const
{
    return missed_[strategy] /
           (static_cast<double>(shared_groups) * rounds() * static_cast<double>(points_.size()));
}

}  // namespace mis
