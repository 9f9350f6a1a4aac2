#include "mis/compare/audit.h"

#include "mis/engine/scalar_choices.h"
#include "mis/math/cap.h"
#include "mis/sampling/cone.h"
#include "mis/sampling/random.h"
#include "mis/strategy/names.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <unordered_map>

namespace mis {

namespace {

/// Independent groups of draws: the spread over them gives the standard errors.
constexpr std::size_t groups = 8;

/// A group looks so many times at least, all points together: few points are looked at more often.
constexpr std::size_t fewest_looks = 1024;

/// Lights that are met by all looks together, times the policies that weigh
/// them: about a second's work.
constexpr double most_lights_weighed = 5e7;

/// Sample numbers of the audit start here: no strategy draws from them.
constexpr std::uint64_t first_sample = std::uint64_t{1} << 48;

/// Integrals of one strategy at one point, from one group of draws: of w²F²/p of both techniques,
/// and of wF of each.
struct AuditIntegrals {
    double square = 0, light = 0, bsdf = 0;
};

/// What the point at hand knows of a light that was met, whatever the
/// direction.
struct KnownLight {
    Cap<double> cap;
    std::size_t first;  ///< of its probabilities, one for each policy
};

/// All lights along a direction, and what is seen there.
struct Seen {
    std::vector<const KnownLight*> lights;
    const KnownLight* nearest_light = nullptr;
    LightHit nearest;
    double luminance = 0;  ///< Y(f cos θ L) of the nearest, 0 where a surface is nearer
    double bsdf_pdf = 0;
    Vec3<double> wi{0};  ///< in the shading frame
};

/// A mixture that reaches every light whatever is compared.
std::vector<std::string> policies_of(std::span<const Strategy> strategies)
{
    std::set<std::string> names{"uniform", "power"};
    for (const Strategy& s : strategies)
        if (s.chooses_light()) names.insert(s.policy);
    return {names.begin(), names.end()};
}

/// One point and all that is prepared for it.
class Auditor {
public:
    Auditor(const LitScene& scene, std::span<const Strategy> strategies, const StopToken& stop)
        : scene_(scene), strategies_(strategies), stop_(stop)
    {
        const std::vector<std::string> names = policies_of(strategies);
        for (const std::string& name : names)
            policies_.emplace_back(name, scene.scene().lights, scene.policy(name, stop));
        for (const Strategy& s : strategies)
            policy_of_.push_back(static_cast<std::size_t>(
                std::find(names.begin(), names.end(), s.policy) - names.begin()));
        for (const Strategy& s : strategies)
            heuristics_.push_back(s.chooses_light() ? scalar_heuristic(s.heuristic)
                                                    : ScalarHeuristic{});
        for (const Strategy& s : strategies) techniques_.push_back(scalar_technique(s.technique));
        for (const Material& material : scene.scene().materials)
            bsdfs_.push_back(scalar_bsdf(material));
    }

    /// [group][strategy], each group the mean of `repeats` draws of every technique of the mixture.
    std::vector<std::vector<AuditIntegrals>> integrals(const AuditPoint& at, std::size_t repeats,
                                                       std::uint64_t seed)
    {
        begin(at);
        std::vector<std::vector<AuditIntegrals>> found(
            groups, std::vector<AuditIntegrals>(strategies_.size()));
        std::uint32_t draw = 0;
        for (std::vector<AuditIntegrals>& sums : found) {
            for (std::size_t repeat = 0; repeat < repeats; ++repeat) {
                for (std::size_t policy = 0; policy < policies_.size(); ++policy)
                    if (!policies_[policy].draws_every_light())
                        take(sums, light_direction(policy, draw++, seed));
                take(sums, bsdf_direction(true, draw++, seed));
                take(sums, bsdf_direction(false, draw++, seed));
            }
            const double n = static_cast<double>(repeats);
            for (AuditIntegrals& sum : sums) sum = {sum.square / n, sum.light / n, sum.bsdf / n};
        }
        return found;
    }

private:
    void begin(const AuditPoint& at)
    {
        point_ = at.point;
        bsdf_ = &bsdfs_[static_cast<std::size_t>(at.material)];
        frame_ = frame_around(normalized(vec_cast<double>(at.point.n)));
        wo_ = frame_.to_local(vec_cast<double>(at.point.wo));
        tables_.clear(), known_.clear(), probabilities_.clear();
        for (ScalarPolicy& policy : policies_) {
            stop_.check();
            tables_.push_back(&policy.at(point_.x, frame_.z, wo_, scene_.bsdf(at.material)));
        }
    }

    /// A direction from the cone of a light that the policy chooses, or 0 where it can choose none.
    Vec3<double> light_direction(std::size_t policy, std::uint32_t draw, std::uint64_t seed) const
    {
        const Words words = random_words(seed, {point_.id, first_sample, draw}, Block::light);
        const Choice choice = tables_[policy]->choose(choice_bits(words));
        if (choice.light < 0) return Vec3<double>(0);
        const Light& light = scene_.scene().lights[static_cast<std::size_t>(choice.light)];
        const Cap<double> cap = cap_of_sphere(light.center, light.radius, point_.x);
        return sample_cone(cap, {unit_number<double>(words[2]), unit_number<double>(words[3])}).wi;
    }

    Vec3<double> bsdf_direction(bool by_bsdf, std::uint32_t draw, std::uint64_t seed) const
    {
        const Words words = random_words(seed, {point_.id, first_sample, draw}, Block::bsdf);
        const Vec2<double> u{unit_number<double>(words[2]), unit_number<double>(words[3])};
        if (by_bsdf && !bsdf_->draws) return Vec3<double>(0);
        const Vec3<double> local =
            by_bsdf ? bsdf_->sample(wo_, unit_number<double>(words[1]), u) : sample_cosine(u);
        return local.z > 0 ? frame_.to_world(local) : Vec3<double>(0);
    }

    /// The cap of a light, and its probabilities: asked for once, however many
    /// directions meet it.
    const KnownLight& known(LightIndex j)
    {
        const auto [found, is_new] = known_.try_emplace(j);
        KnownLight& light = found->second;
        if (!is_new) return light;
        check_();
        const Light& sphere = scene_.scene().lights[static_cast<std::size_t>(j)];
        light = {cap_of_sphere(sphere.center, sphere.radius, point_.x), probabilities_.size()};
        for (const ScalarPolicy::Table* table : tables_)
            probabilities_.push_back(table->probability(j));
        return light;
    }

    Seen look(const Vec3<double>& wi)
    {
        Seen seen;
        const Vec3<double> local = frame_.to_local(wi);
        if (!(local.z > 0)) return seen;
        scene_.lights().for_each_along(point_.x, wi, [&](const LightHit& hit) {
            check_();
            seen.lights.push_back(&known(hit.light));
            if (stands_before(hit, seen.nearest))
                seen.nearest = hit, seen.nearest_light = seen.lights.back();
        });
        if (seen.lights.empty()) return seen;
        const BsdfValue<double> value = bsdf_->evaluate(wo_, local);
        seen.bsdf_pdf = value.pdf;
        seen.wi = local;
        const Vec3<double> light =
            radiance(scene_.scene().lights[static_cast<std::size_t>(seen.nearest.light)]);
        seen.luminance = luminance(Vec3<double>(value.f * light)) * local.z;
        if (seen.luminance > 0 && scene_.surfaces() != nullptr) {
            const ShadowRay ray{point_.ray_origin, vec_cast<float>(wi),
                                static_cast<float>(seen.nearest.distance)};
            std::uint8_t hidden = 0;
            scene_.surfaces()->occluded({&ray, 1}, {&hidden, 1});
            if (hidden != 0) seen.luminance = 0;
        }
        return seen;
    }

    /// Of a light technique, at the direction seen: of the nearest light alone, or summed over all
    /// lights there.
    double light_density(std::size_t policy, const ScalarTechnique& technique, bool sums,
                         const Seen& seen) const
    {
        const auto of = [&](const KnownLight& light) {
            return probabilities_[light.first + policy] *
                   technique.light_pdf(light.cap, frame_.z, seen.wi.z);
        };
        if (!sums) return of(*seen.nearest_light);
        double density = 0;
        for (const KnownLight* light : seen.lights) density += of(*light);
        return density;
    }

    void take(std::vector<AuditIntegrals>& sums, const Vec3<double>& wi)
    {
        if (length2(wi) == 0) return;
        const Seen seen = look(wi);
        if (!(seen.luminance > 0)) return;
        double mixture = seen.bsdf_pdf * (bsdf_->draws ? 1 : 0) + cosine_pdf(seen.wi.z);
        for (std::size_t policy = 0; policy < policies_.size(); ++policy)
            if (!policies_[policy].draws_every_light())
                mixture += light_density(policy, cone_, true, seen);
        for (std::size_t s = 0; s < strategies_.size(); ++s) add(sums[s], s, seen, mixture);
    }

    void add(AuditIntegrals& sum, std::size_t s, const Seen& seen, double mixture) const
    {
        const Strategy& strategy = strategies_[s];
        const double f = seen.luminance;
        if (!strategy.chooses_light()) {
            const double pdf = techniques_[s].direction_pdf(seen.bsdf_pdf, seen.wi);
            if (pdf > 0) sum.square += f * f / pdf / mixture;
            sum.bsdf += f / mixture;
            return;
        }
        const bool one_sample = strategy.model == Model::one_sample;
        const double l = one_sample ? 0.5 : strategy.counts[0],
                     b = one_sample ? 0.5 : strategy.counts[1];
        const double light_pdf =
            light_density(policy_of_[s], techniques_[s], techniques_[s].sums_lights, seen);
        const std::array<double, 2> density{l * light_pdf, b * seen.bsdf_pdf};
        for (std::size_t i = 0; i < 2; ++i) {
            if (!(density[i] > 0)) continue;
            const double wf = heuristics_[s](density, i) * f;
            sum.square += wf * wf / density[i] / mixture;
            (i == 0 ? sum.light : sum.bsdf) += wf / mixture;
        }
    }

    const LitScene& scene_;
    std::span<const Strategy> strategies_;
    const StopToken& stop_;
    StopEvery check_{stop_, 1024};
    std::vector<ScalarPolicy> policies_;
    std::vector<std::size_t> policy_of_;  ///< [strategy]
    std::vector<ScalarHeuristic> heuristics_;
    std::vector<ScalarTechnique> techniques_;
    ScalarTechnique cone_ = scalar_technique("cone");
    std::vector<ScalarBsdf> bsdfs_;
    ShadingPoint point_{};
    const ScalarBsdf* bsdf_ = nullptr;
    Frame<double> frame_{};
    Vec3<double> wo_{};
    std::vector<const ScalarPolicy::Table*> tables_;  ///< [policy], of the point at hand
    std::unordered_map<LightIndex, KnownLight> known_;
    std::vector<double> probabilities_;
};

/// The square of an expectation, unbiased, from independent values: all pairs of different ones.
/// `left_out` is skipped.
template <class Value> double squared_mean(std::size_t left_out, const Value& value)
{
    double sum = 0, squares = 0, n = 0;
    for (std::size_t g = 0; g < groups; ++g) {
        if (g == left_out) continue;
        sum += value(g), squares += value(g) * value(g), ++n;
    }
    return (sum * sum - squares) / (n * (n - 1));
}

/// The variance of one sample at one point, from all groups but one.
double variance_without(std::size_t left_out, const Strategy& s,
                        const std::array<AuditIntegrals, groups>& g)
{
    double square = 0, n = 0;
    for (std::size_t i = 0; i < groups; ++i)
        if (i != left_out) square += g[i].square, ++n;
    square /= n;
    if (!s.chooses_light())
        return square - squared_mean(left_out, [&](std::size_t i) { return g[i].bsdf; });
    if (s.model == Model::one_sample)
        return square -
               squared_mean(left_out, [&](std::size_t i) { return g[i].light + g[i].bsdf; });
    const double light =
        squared_mean(left_out, [&](std::size_t i) { return g[i].light; }) / s.counts[0];
    const double bsdf =
        s.counts[1] > 0
            ? squared_mean(left_out, [&](std::size_t i) { return g[i].bsdf; }) / s.counts[1]
            : 0;
    return square - light - bsdf;
}

/// One figure of one strategy, with each group left out in turn and, last, with none.
using LeftOut = std::array<double, groups + 1>;

struct FigureSums {
    LeftOut variance{}, relative{};

    void add(const FigureSums& other)
    {
        for (std::size_t g = 0; g <= groups; ++g)
            variance[g] += other.variance[g], relative[g] += other.relative[g];
    }
};

/// The jackknife's: (K − 1)/K Σ (v₋g − v)².
double standard_error(const LeftOut& figure)
{
    double spread = 0;
    for (std::size_t g = 0; g < groups; ++g)
        spread += (figure[g] - figure[groups]) * (figure[g] - figure[groups]);
    return std::sqrt(spread * (groups - 1) / groups);
}

}  // namespace

double lights_along_a_direction(const LitScene& scene, std::span<const AuditPoint> points,
                                std::uint64_t seed, const StopToken& stop)
{
    constexpr std::size_t most_points = 16, looks = 4;
    const Lights& lights = scene.scene().lights;
    const std::size_t count = std::min(points.size(), most_points);
    if (lights.empty() || count == 0) return 0;
    StopEvery check(stop, 1024);
    double met = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const ShadingPoint& point = points[i * points.size() / count].point;
        for (std::uint32_t k = 0; k < looks; ++k) {
            const Words words = random_words(seed, {point.id, first_sample + 1, k}, Block::light);
            const auto j = static_cast<std::size_t>(unit_number<double>(words[0]) *
                                                    static_cast<double>(lights.size()));
            const Cap<double> cap = cap_of_sphere(lights[j].center, lights[j].radius, point.x);
            const Vec3<double> wi =
                sample_cone(cap, {unit_number<double>(words[1]), unit_number<double>(words[2])}).wi;
            scene.lights().for_each_along(point.x, wi, [&](const LightHit&) { check(), ++met; });
        }
    }
    return met / static_cast<double>(count * looks);
}

AuditEffort audit_effort(std::size_t points, std::span<const Strategy> strategies,
                         double lights_along)
{
    const auto techniques = static_cast<double>(policies_of(strategies).size() + 2);
    // A draw of every technique, in every group: each light that is met is looked
    // up, and weighed by every policy.
    const double weighed =
        static_cast<double>(groups) * techniques * std::max(1.0, lights_along) * (2 + techniques);
    const double most = most_lights_weighed / weighed;  // repeats, of all points together
    constexpr double hardly_any = 0.1;
    if (points == 0 || most < hardly_any) return {0, 1};
    const auto repeats = static_cast<std::size_t>(std::max(1.0, most));
    const std::size_t count = std::min(points, repeats);
    return {count, std::max<std::size_t>(1, std::min(fewest_looks, repeats) / count)};
}

std::vector<AuditEstimate> audit(const LitScene& scene, std::span<const AuditPoint> points,
                                 std::span<const Strategy> strategies, std::size_t repeats,
                                 std::uint64_t seed, const AnyExecutor& executor,
                                 const StopToken& stop)
{
    std::vector<AuditEstimate> estimates(strategies.size());
    if (points.empty()) return estimates;
    // [part][strategy]; one part per task, added in order.
    const std::size_t parts = std::min<std::size_t>(points.size(), 64);
    const double share = 1 / static_cast<double>(points.size());
    std::vector<std::vector<FigureSums>> sums(parts);
    executor.for_each(parts, [&](std::size_t part) {
        Auditor auditor(scene, strategies, stop);
        sums[part].resize(strategies.size());
        for (std::size_t p = part; p < points.size(); p += parts) {
            stop.check();
            const std::vector<std::vector<AuditIntegrals>> drawn =
                auditor.integrals(points[p], repeats, seed);
            std::vector<std::array<AuditIntegrals, groups>> found(strategies.size());
            for (std::size_t g = 0; g < groups; ++g)
                for (std::size_t s = 0; s < strategies.size(); ++s) found[s][g] = drawn[g][s];
            for (std::size_t s = 0; s < strategies.size(); ++s)
                for (std::size_t g = 0; g <= groups; ++g) {
                    const double v = share * variance_without(g, strategies[s], found[s]);
                    sums[part][s].variance[g] += v;
                    sums[part][s].relative[g] += v * points[p].weight;
                }
        }
    });
    for (std::size_t s = 0; s < strategies.size(); ++s) {
        if (draws_every_light(strategies[s].policy)) continue;
        FigureSums total;
        for (std::size_t part = 0; part < parts; ++part) total.add(sums[part][s]);
        estimates[s] = {true, std::max(total.variance[groups], 0.0), standard_error(total.variance),
                        std::max(total.relative[groups], 0.0), standard_error(total.relative)};
    }
    return estimates;
}

}  // namespace mis
