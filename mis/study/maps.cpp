#include "mis/study/maps.h"

#include "mis/engine/scalar_choices.h"
#include "mis/stats/winners.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace mis {
namespace {

/// Shares of lights are found at so many points × lights at most: about a second.
constexpr double most_light_looks = 1e7;

class MapMaker {
public:
    MapMaker(const LitScene& scene, const Study& study, double at, const AnyExecutor& executor)
        : scene_(scene), study_(study), at_(at), executor_(executor)
    {
        maps_.width = study.points->shading.width;
        maps_.height = study.points->shading.height;
        pixels_ = static_cast<std::size_t>(maps_.width) * static_cast<std::size_t>(maps_.height);
    }

    Maps make()
    {
        find_policies();
        find_kinds();
        draw_reference();
        for (std::size_t s = 0; s < study_.runs.size(); ++s)
            if (study_.runs[s] && study_.runs[s]->samples() > 0) draw_strategy(s);
        find_winners();
        find_lights();
        maps_.scene_lights = scene_.scene().lights;
        return std::move(maps_);
    }

private:
    const GBuffer& shading() const { return study_.points->shading; }
    std::size_t lit() const { return study_.points->figure_lit; }
    std::uint32_t pixel_of(std::size_t point) const { return shading().points[point].id; }

    void find_kinds()
    {
        maps_.kind.assign(pixels_, PixelKind::background);
        for (std::size_t p = 0; p < lit(); ++p) maps_.kind[pixel_of(p)] = PixelKind::lit;
        for (const std::uint32_t id : shading().dark)
            if (id < pixels_) maps_.kind[id] = PixelKind::dark;
    }

    /// A picture of what the camera sees where there is nothing to light.
    std::vector<Vec3<float>> background() const
    {
        std::vector<Vec3<float>> picture(pixels_, Vec3<float>(0));
        for (const Background& b : shading().background)
            if (b.light >= 0)
                picture[b.pixel] = vec_cast<float>(
                    radiance(scene_.scene().lights[static_cast<std::size_t>(b.light)]));
        return picture;
    }

    void draw_reference()
    {
        maps_.reference = background();
        const std::vector<double>& weights = study_.reference_weights;
        for (std::size_t p = 0; p < lit(); ++p) {
            Vec3<double> mean(0);
            for (std::size_t s = 0; s < weights.size(); ++s)
                if (weights[s] > 0) mean += weights[s] * study_.runs[s]->results()[p].mean();
            maps_.reference[pixel_of(p)] = vec_cast<float>(mean);
        }
    }

    void draw_strategy(std::size_t s)
    {
        const StrategyRun& run = *study_.runs[s];
        StrategyMap map{static_cast<int>(s), background(), std::vector<float>(pixels_), {}};
        for (std::size_t p = 0; p < lit(); ++p) {
            map.mean[pixel_of(p)] = vec_cast<float>(run.results()[p].mean());
            map.variance[pixel_of(p)] = static_cast<float>(study_.variance_at(s, p));
        }
        for (std::size_t t = 0; t < study_.points->figure_tiles; ++t)
            if (run.invalid_at(t) > 0)
                for (std::size_t p = 0; p < shading().tiles[t].count; ++p)
                    map.bad.push_back(pixel_of(shading().tiles[t].first + p));
        std::sort(map.bad.begin(), map.bad.end());
        maps_.strategies.push_back(std::move(map));
    }

    void find_winners()
    {
        std::vector<std::size_t> ranked;
        for (std::size_t s = 0; s < study_.runs.size(); ++s)
            if (study_.runs[s] && report(s).status == Status::ranked) ranked.push_back(s);
        std::vector<double> ones(ranked.size(), 1.0), seconds;
        double fewest = std::numeric_limits<double>::infinity();
        for (const std::size_t s : ranked) {
            seconds.push_back(report(s).seconds_per_sample.value +
                              report(s).seconds_per_point.value / at_);
            fewest = std::min(fewest, samples_per_point(s));
        }
        const bool timed = std::all_of(seconds.begin(), seconds.end(),
                                       [](double s) { return s > 0 && std::isfinite(s); });
        maps_.winner_square = winner_square(fewest);
        const std::vector<std::vector<std::size_t>> squares = lit_squares();
        find_winners(squares, ranked, ones, maps_.by_variance);
        find_winners(squares, ranked, timed ? seconds : std::vector<double>(), maps_.by_efficiency);
    }

    /// That its variance is known by.
    double samples_per_point(std::size_t s) const
    {
        if (study_.is_shared(s)) return static_cast<double>(study_.report.directions);
        return static_cast<double>(study_.runs[s]->samples()) /
               static_cast<double>(std::max<std::size_t>(lit(), 1));
    }

    /// The lit points of each square that has any.
    std::vector<std::vector<std::size_t>> lit_squares() const
    {
        const auto side = static_cast<std::uint32_t>(maps_.winner_square),
                   width = static_cast<std::uint32_t>(maps_.width),
                   across = (width + side - 1) / side,
                   down = (static_cast<std::uint32_t>(maps_.height) + side - 1) / side;
        std::vector<std::vector<std::size_t>> squares(std::size_t{across} * down);
        for (std::size_t p = 0; p < lit(); ++p)
            squares[pixel_of(p) / width / side * across + pixel_of(p) % width / side].push_back(p);
        std::erase_if(squares, [](const auto& points) { return points.empty(); });
        return squares;
    }

    /// What each of the strategies' samples came to in a square.
    std::vector<PlaceSamples> samples_in(const std::vector<std::size_t>& square,
                                         const std::vector<std::size_t>& strategies) const
    {
        std::vector<PlaceSamples> samples(strategies.size());
        for (std::size_t s = 0; s < strategies.size(); ++s)
            for (const std::size_t p : square) add(samples[s], strategies[s], p);
        return samples;
    }

    void add(PlaceSamples& samples, std::size_t s, std::size_t point) const
    {
        const Moments& own = study_.runs[s]->results()[point].luminance;
        if (study_.is_shared(s))
            samples.add(own, study_.shared->at(*study_.shared_places[s], point));
        else samples.add(own);
    }

    /// All undecided where there is no contest.
    std::vector<int> winners_among(const std::vector<std::vector<std::size_t>>& squares,
                                   const std::vector<std::size_t>& strategies,
                                   const Contest& contest) const
    {
        constexpr std::size_t at_a_time = 1024;
        std::vector<Candidate> candidates(squares.size());
        const std::size_t parts =
            contest.is_contest() ? (squares.size() + at_a_time - 1) / at_a_time : 0;
        executor_.for_each(parts, [&](std::size_t part) {
            const std::size_t end = std::min(squares.size(), (part + 1) * at_a_time);
            for (std::size_t q = part * at_a_time; q < end; ++q)
                candidates[q] = candidate(samples_in(squares[q], strategies), contest);
        });
        return winners_of(candidates);
    }

    void find_winners(const std::vector<std::vector<std::size_t>>& squares,
                      const std::vector<std::size_t>& ranked, const std::vector<double>& costs,
                      WinnerMap& map) const
    {
        std::vector<int> strategies, policies;
        for (const std::size_t s : ranked) {
            strategies.push_back(static_cast<int>(s));
            policies.push_back(policy_of_[s]);
        }
        const auto tell = [&](const std::vector<int>& groups, std::vector<int>& winner,
                              std::vector<double>& wins) {
            winner.assign(pixels_, -1);
            const std::vector<int> found = winners_among(squares, ranked, {costs, groups});
            for (std::size_t q = 0; q < squares.size(); ++q) {
                if (found[q] < 0) continue;
                const int group = groups[static_cast<std::size_t>(found[q])];
                wins[static_cast<std::size_t>(group)] +=
                    static_cast<double>(squares[q].size()) / static_cast<double>(lit());
                for (const std::size_t p : squares[q]) winner[pixel_of(p)] = group;
            }
        };
        map.strategy_wins.assign(study_.runs.size(), 0.0);
        map.policy_wins.assign(maps_.policies.size(), 0.0);
        tell(strategies, map.strategy, map.strategy_wins);
        tell(policies, map.policy, map.policy_wins);
    }

    /// A strategy that chooses no light stands for itself.
    void find_policies()
    {
        for (const StrategyReport& s : study_.report.strategies) {
            const std::string& name =
                s.strategy.chooses_light() ? s.strategy.policy : s.strategy.technique;
            const auto known = std::find(maps_.policies.begin(), maps_.policies.end(), name);
            policy_of_.push_back(static_cast<int>(known - maps_.policies.begin()));
            if (known == maps_.policies.end()) maps_.policies.push_back(name);
        }
    }

    const StrategyReport& report(std::size_t s) const { return study_.report.strategies[s]; }

    void find_lights()
    {
        const std::size_t lights = scene_.scene().lights.size();
        LightMap& map = maps_.lights;
        const double looks = static_cast<double>(lit()) * static_cast<double>(lights);
        map.stride = std::max(1, static_cast<int>(std::ceil(std::sqrt(looks / most_light_looks))));
        map.width = (maps_.width + map.stride - 1) / map.stride;
        map.height = (maps_.height + map.stride - 1) / map.stride;
        map.lights.resize(static_cast<std::size_t>(map.width) *
                          static_cast<std::size_t>(map.height));
        if (lights == 0) return;
        executor_.for_each(study_.points->figure_tiles, [&](std::size_t t) {
            ScalarPolicy policy("irradiance", scene_.scene().lights);
            for (std::size_t p = 0; p < shading().tiles[t].count; ++p)
                find_lights(shading().points[shading().tiles[t].first + p], policy);
        });
    }

    void find_lights(const ShadingPoint& point, ScalarPolicy& policy)
    {
        LightMap& map = maps_.lights;
        const auto stride = static_cast<std::uint32_t>(map.stride),
                   width = static_cast<std::uint32_t>(maps_.width);
        const std::uint32_t column = point.id % width, row = point.id / width;
        if (column % stride != 0 || row % stride != 0) return;
        auto& most =
            map.lights[row / stride * static_cast<std::uint32_t>(map.width) + column / stride];
        const ScalarPolicy::Table& table =
            policy.at(point.x, vec_cast<double>(point.n), {0, 0, 1}, {});
        for (std::size_t j = 0; j < scene_.scene().lights.size(); ++j) {
            LightShare light{static_cast<LightIndex>(j),
                             static_cast<float>(table.probability(static_cast<LightIndex>(j)))};
            for (LightShare& place : most)
                if (light.share > place.share) std::swap(light, place);
        }
    }

    const LitScene& scene_;
    const Study& study_;
    double at_;
    const AnyExecutor& executor_;
    Maps maps_;
    std::vector<int> policy_of_;  ///< [strategy]
    std::size_t pixels_ = 0;
};

}  // namespace

Maps maps_of(const LitScene& scene, const Study& study, double at, const AnyExecutor& executor)
{
    return MapMaker(scene, study, at, executor).make();
}

std::size_t maps_bytes(std::size_t pixels, std::size_t strategies)
{
    return pixels * (sizeof(PixelKind) + 4 * sizeof(int) + sizeof(Vec3<float>) +
                     strategies * (sizeof(Vec3<float>) + sizeof(float)) +
                     sizeof(std::array<LightShare, shown_lights>));
}

}  // namespace mis
