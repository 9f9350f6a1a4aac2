#include "tests/study/scalar_audit.h"

#include "mis/engine/scalar_choices.h"
#include "mis/math/cap.h"
#include "mis/sampling/cone.h"
#include "mis/sampling/random.h"
#include "mis/strategy/names.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace mis {

namespace {

/// Independent groups of draws: the spread over them gives the standard errors.
constexpr std::size_t draw_groups = 8;

/// A group looks so many times at least, all points together: few points are looked at more often.
constexpr std::size_t fewest_looks = 1024;

/// Sample numbers start here: neither a strategy nor shared samples draw from them.
constexpr std::uint64_t first_sample = std::uint64_t{1} << 49;

/// Integrals of one strategy at one point, from one group of draws: of w²F²/p of both techniques,
/// and of wF of each.
struct AuditIntegrals {
    double square = 0, light = 0, bsdf = 0;
};

/// All lights along a direction, and what is seen there.
struct Seen {
    std::vector<LightHit> hits;
    LightHit nearest;
    double luminance = 0;  ///< Y(f cos θ L) of the nearest, 0 where a surface is nearer
    double bsdf_pdf = 0;
    Vec3<double> wi{0};             ///< in the shading frame
    std::vector<Cap<double>> caps;  ///< of hits
};

/// One point and all that is prepared for it.
class Auditor {
public:
    Auditor(const LitScene& scene, std::span<const Strategy> strategies)
        : scene_(scene), strategies_(strategies)
    {
        // A mixture that reaches every light whatever is compared.
        std::set<std::string> names{"uniform", "power"};
        for (const Strategy& s : strategies)
            if (s.chooses_light()) names.insert(s.policy);
        for (const std::string& name : names)
            policies_.emplace(name, ScalarPolicy(name, scene.scene().lights));
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
            draw_groups, std::vector<AuditIntegrals>(strategies_.size()));
        std::uint32_t draw = 0;
        for (std::vector<AuditIntegrals>& sums : found) {
            for (std::size_t repeat = 0; repeat < repeats; ++repeat) {
                for (auto& [name, policy] : policies_)
                    if (!policy.draws_every_light())
                        take(sums, light_direction(name, draw++, seed));
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
        tables_.clear();
        for (auto& [name, policy] : policies_)
            tables_[name] = policy.at(point_.x, frame_.z, wo_, scene_.bsdf(at.material));
    }

    /// A direction from the cone of a light that the policy chooses, or 0 where it can choose none.
    Vec3<double> light_direction(const std::string& policy, std::uint32_t draw,
                                 std::uint64_t seed) const
    {
        const Words words = random_words(seed, {point_.id, first_sample, draw}, Block::light);
        const Choice choice = tables_.at(policy).choose(choice_bits(words));
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

    Seen look(const Vec3<double>& wi) const
    {
        Seen seen;
        const Vec3<double> local = frame_.to_local(wi);
        if (!(local.z > 0)) return seen;
        scene_.lights().for_each_along(point_.x, wi, [&](const LightHit& hit) {
            const Light& light = scene_.scene().lights[static_cast<std::size_t>(hit.light)];
            seen.hits.push_back(hit);
            seen.caps.push_back(cap_of_sphere(light.center, light.radius, point_.x));
            if (hit.distance < seen.nearest.distance ||
                (hit.distance == seen.nearest.distance && hit.light < seen.nearest.light))
                seen.nearest = hit;
        });
        if (seen.hits.empty()) return seen;
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
    double light_density(const std::string& policy, const ScalarTechnique& technique, bool sums,
                         const Seen& seen) const
    {
        double density = 0;
        const ScalarPolicy::Table& table = tables_.at(policy);
        for (std::size_t i = 0; i < seen.hits.size(); ++i)
            if (sums || seen.hits[i].light == seen.nearest.light)
                density += table.probability(seen.hits[i].light) *
                           technique.light_pdf(seen.caps[i], frame_.z, seen.wi.z);
        return density;
    }

    void take(std::vector<AuditIntegrals>& sums, const Vec3<double>& wi) const
    {
        if (length2(wi) == 0) return;
        const Seen seen = look(wi);
        if (!(seen.luminance > 0)) return;
        double mixture = seen.bsdf_pdf * (bsdf_->draws ? 1 : 0) + cosine_pdf(seen.wi.z);
        for (const auto& [name, policy] : policies_)
            if (!policy.draws_every_light()) mixture += light_density(name, cone_, true, seen);
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
            light_density(strategy.policy, techniques_[s], techniques_[s].sums_lights, seen);
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
    std::map<std::string, ScalarPolicy> policies_;
    std::vector<ScalarHeuristic> heuristics_;
    std::vector<ScalarTechnique> techniques_;
    ScalarTechnique cone_ = scalar_technique("cone");
    std::vector<ScalarBsdf> bsdfs_;
    ShadingPoint point_{};
    const ScalarBsdf* bsdf_ = nullptr;
    Frame<double> frame_{};
    Vec3<double> wo_{};
    std::map<std::string, ScalarPolicy::Table> tables_;
};

/// The square of an expectation, unbiased, from independent values: all pairs of different ones.
/// `left_out` is skipped.
template <class Value> double squared_mean(std::size_t left_out, const Value& value)
{
    double sum = 0, squares = 0, n = 0;
    for (std::size_t g = 0; g < draw_groups; ++g) {
        if (g == left_out) continue;
        sum += value(g), squares += value(g) * value(g), ++n;
    }
    return (sum * sum - squares) / (n * (n - 1));
}

/// The variance of one sample at one point, from all groups but one.
double variance_without(std::size_t left_out, const Strategy& s,
                        const std::array<AuditIntegrals, draw_groups>& g)
{
    double square = 0, n = 0;
    for (std::size_t i = 0; i < draw_groups; ++i)
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
using LeftOut = std::array<double, draw_groups + 1>;

struct FigureSums {
    LeftOut variance{}, relative{};

    void add(const FigureSums& other)
    {
        for (std::size_t g = 0; g <= draw_groups; ++g)
            variance[g] += other.variance[g], relative[g] += other.relative[g];
    }
};

/// The jackknife's: (K − 1)/K Σ (v₋g − v)².
double standard_error(const LeftOut& figure)
{
    double spread = 0;
    for (std::size_t g = 0; g < draw_groups; ++g)
        spread += (figure[g] - figure[draw_groups]) * (figure[g] - figure[draw_groups]);
    return std::sqrt(spread * (draw_groups - 1) / draw_groups);
}

}  // namespace

std::vector<AuditEstimate> scalar_audit(const LitScene& scene, std::span<const AuditPoint> points,
                                        std::span<const Strategy> strategies, std::uint64_t seed,
                                        const AnyExecutor& executor)
{
    std::vector<AuditEstimate> estimates(strategies.size());
    if (points.empty()) return estimates;
    // [part][strategy]; one part per task, added in order.
    const std::size_t repeats = std::max<std::size_t>(1, fewest_looks / points.size());
    const std::size_t parts = std::min<std::size_t>(points.size(), 64);
    const double share = 1 / static_cast<double>(points.size());
    std::vector<std::vector<FigureSums>> sums(parts);
    executor.for_each(parts, [&](std::size_t part) {
        Auditor auditor(scene, strategies);
        sums[part].resize(strategies.size());
        for (std::size_t p = part; p < points.size(); p += parts) {
            const std::vector<std::vector<AuditIntegrals>> drawn =
                auditor.integrals(points[p], repeats, seed);
            std::vector<std::array<AuditIntegrals, draw_groups>> found(strategies.size());
            for (std::size_t g = 0; g < draw_groups; ++g)
                for (std::size_t s = 0; s < strategies.size(); ++s) found[s][g] = drawn[g][s];
            for (std::size_t s = 0; s < strategies.size(); ++s)
                for (std::size_t g = 0; g <= draw_groups; ++g) {
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
        estimates[s] = {true, std::max(total.variance[draw_groups], 0.0),
                        standard_error(total.variance), std::max(total.relative[draw_groups], 0.0),
                        standard_error(total.relative)};
    }
    return estimates;
}

}  // namespace mis
