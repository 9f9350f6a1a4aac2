#include "mis/study/shared_directions.h"

#include "mis/engine/shadow_ray.h"
#include "mis/math/irradiance.h"
#include "mis/math/sphere.h"
#include "mis/sampling/cone.h"
#include "mis/sampling/projected.h"
#include "mis/sampling/random.h"
#include "mis/sampling/warp.h"
#include "mis/stats/centred_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mis {

namespace {

/// Sample numbers of shared directions start here: no strategy draws from them.
constexpr std::uint64_t first_sample = std::uint64_t{1} << 48;

Vec2<double> last_two(const Words& words)
{
    return {unit_number<double>(words[2]), unit_number<double>(words[3])};
}

}  // namespace

DirectionSet::DirectionSet(const LitScene& scene, const SharedPlan& plan,
                           const SharedCounts& counts, const StopToken& stop)
    : scene_(&scene), plan_(&plan), counts_(counts),
      mixture_(scene, plan.policies, plan.every_light > 0, stop)
{
    for (const Material& material : scene.scene().materials)
        bsdfs_.push_back(scalar_bsdf(material));
    const std::size_t most = shared_groups * static_cast<std::size_t>(counts.all());
    directions_.reserve(most), along_.reserve(most), rays_.reserve(most), ray_of_.reserve(most);
    hidden_.resize(most);
}

void DirectionSet::prepare(const SharedPoint& at)
{
    point_ = at.point;
    bsdf_ = &bsdfs_[static_cast<std::size_t>(at.material)];
    frame_ = frame_around(normalized(vec_cast<double>(at.point.n)));
    wo_ = frame_.to_local(vec_cast<double>(at.point.wo));
    mixture_.prepare(point_.x, frame_.z, wo_, at.material);
}

void DirectionSet::draw(std::uint64_t round, std::uint64_t seed)
{
    directions_.clear(), along_.clear(), pdfs_.clear();
    const std::uint64_t sample = first_sample + round;
    std::uint32_t number = 0;
    const auto words_of = [&](Block block) {
        return random_words(seed, {point_.id, sample, number++}, block);
    };
    // A group's choices stand at even steps from a random start: each of them alone is uniform.
    const std::uint64_t step =
        ~std::uint64_t{0} / static_cast<std::uint64_t>(std::max(counts_.light, 1));
    for (std::size_t g = 0; g < shared_groups; ++g) {
        std::uint64_t bits = choice_bits(words_of(Block::light));
        for (int i = 0; i < counts_.light; ++i, bits += step)
            add_towards(g, mixture_.choose(bits), i % 2 == 1, last_two(words_of(Block::light)));
    }
    towards_lights_ = directions_.size();
    for (std::size_t g = 0; g < shared_groups; ++g)
        for (int i = 0; i < counts_.lobe + counts_.cosine; ++i) {
            const Vec2<double> u = last_two(words_of(Block::bsdf));
            if (i < lobe_draws()) add_over_hemisphere(g, bsdf_->sample(wo_, 0, u));
            else add_over_hemisphere(g, sample_cosine(u));
        }
    if (plan_->asks_all_along)
        for (SharedDirection& d : directions_) find_all_along(d);
    else find_nearest();
    std::erase_if(directions_, [](const SharedDirection& d) { return d.light == no_light; });
    value();
    hide_by_surfaces();
    for (SharedDirection& d : directions_) price(d);
}

void DirectionSet::add_towards(std::size_t group, LightIndex light, bool by_cosine,
                               const Vec2<double>& u)
{
    if (light == no_light) return;
    const AlongLight towards = along_light(light);
    const bool projects = by_cosine && towards.rises;
    const CapDraw<double> draw =
        projects ? sample_projected(towards.cap, frame_.z, u) : sample_cone(towards.cap, u);
    SharedDirection d;
    d.group = group, d.wi = draw.wi, d.local = frame_.to_local(draw.wi);
    // By the formula that other lights' distances come from: coincident ones are equally far.
    const Light& at = scene_->scene().lights[static_cast<std::size_t>(light)];
    const double met = hit_distance(at.center - point_.x, at.radius, draw.wi);
    d.light = light, d.nearest = {light, std::isfinite(met) ? met : draw.distance};
    d.first = along_.size(), d.along = 1;
    directions_.push_back(d);
    along_.push_back(towards);
}

void DirectionSet::add_over_hemisphere(std::size_t group, const Vec3<double>& local)
{
    if (!(local.z > 0)) return;
    SharedDirection d;
    d.group = group, d.wi = frame_.to_world(local), d.local = local;
    directions_.push_back(d);
}

AlongLight DirectionSet::along_light(LightIndex j) const
{
    const Light& light = scene_->scene().lights[static_cast<std::size_t>(j)];
    const Cap<double> cap = cap_of_sphere(light.center, light.radius, point_.x);
    return {j, cap, irradiance_over_sin2(tilted(cap, frame_.z)) > 0};
}

void DirectionSet::find_nearest()
{
    const LightHierarchy& lights = scene_->lights();
    const auto ray_at = [&](std::size_t i) {
        return LightHierarchy::Ray{point_.x, directions_[i].wi};
    };
    lights.hides_each(
        towards_lights_, ray_at, [&](std::size_t i, const auto&) { return directions_[i].nearest; },
        [&](std::size_t i, bool is_hidden) {
            if (is_hidden) directions_[i].nearest = {};
        });
    lights.nearest_each(
        directions_.size() - towards_lights_,
        [&](std::size_t i) { return ray_at(towards_lights_ + i); },
        [&](std::size_t i, const LightHit& hit) {
            directions_[towards_lights_ + i].nearest = hit;
        });
    for (std::size_t i = towards_lights_; i < directions_.size(); ++i) {
        SharedDirection& d = directions_[i];
        d.light = d.nearest.light;
        if (d.light == no_light) continue;
        d.first = along_.size(), d.along = 1;
        along_.push_back(along_light(d.light));
    }
}

void DirectionSet::find_all_along(SharedDirection& d)
{
    const std::size_t first = along_.size();
    // By its own light it is met by construction, where rounding says that it is not.
    LightHit nearest = d.nearest;
    if (d.light != no_light) along_.push_back(along_[d.first]);
    scene_->lights().for_each_along(point_.x, d.wi, [&](const LightHit& hit) {
        if (stands_before(hit, nearest)) nearest = hit;
        if (hit.light != d.light) along_.push_back(along_light(hit.light));
    });
    d.first = first, d.along = along_.size() - first, d.nearest = nearest;
    if (d.light != no_light || nearest.light == no_light) return;
    d.light = nearest.light;
    const auto own = std::find_if(along_.begin() + static_cast<std::ptrdiff_t>(first), along_.end(),
                                  [&](const AlongLight& a) { return a.light == d.light; });
    std::swap(along_[first], *own);
}

void DirectionSet::value()
{
    for (SharedDirection& d : directions_) {
        if (!(d.local.z > 0) || d.nearest.light == no_light) continue;
        const BsdfValue<double> value = bsdf_->evaluate(wo_, d.local);
        const Light& light = scene_->scene().lights[static_cast<std::size_t>(d.nearest.light)];
        d.bsdf_pdf = bsdf_->draws ? value.pdf : 0;
        d.value = luminance(Vec3<double>(value.f * radiance(light))) * d.local.z;
    }
}

void DirectionSet::hide_by_surfaces()
{
    if (scene_->surfaces() == nullptr) return;
    rays_.clear(), ray_of_.clear();
    for (std::size_t i = 0; i < directions_.size(); ++i) {
        const SharedDirection& d = directions_[i];
        if (!(d.value > 0)) continue;
        ray_of_.push_back(i);
        rays_.push_back(shadow_ray(point_, vec_cast<float>(d.wi), d.nearest.distance));
    }
    scene_->surfaces()->occluded(rays_, std::span(hidden_).first(rays_.size()));
    for (std::size_t i = 0; i < rays_.size(); ++i)
        if (hidden_[i] != 0) directions_[ray_of_[i]].value = 0;
}

int DirectionSet::lobe_draws() const
{
    return bsdf_->draws && bsdf_->lobe_share > 0 ? counts_.lobe : 0;
}

double DirectionSet::hemisphere_density(const SharedDirection& d) const
{
    const double cosine = cosine_pdf(d.local.z);
    if (lobe_draws() == 0) return (counts_.lobe + counts_.cosine) * cosine;
    const double s = bsdf_->lobe_share;
    const double lobe = std::max((d.bsdf_pdf - (1 - s) * cosine) / s, 0.0);
    return lobe_draws() * lobe + counts_.cosine * cosine;
}

void DirectionSet::price(SharedDirection& d)
{
    const double n_projected = counts_.light / 2, n_cone = counts_.light - counts_.light / 2;
    double own = 0, all = 0;
    pdfs_.resize(along_.size() * plan_->techniques.size());
    for (std::size_t i = 0; i < d.along; ++i) {
        const AlongLight& a = along_[d.first + i];
        const double cone = cone_pdf(a.cap);
        const double projected = a.rises ? projected_pdf(a.cap, frame_.z, d.local.z) : cone;
        all += mixture_.probability(a.light) * (n_cone * cone + n_projected * projected);
        if (i == 0) own = all;
        for (std::size_t t = 0; t < plan_->techniques.size(); ++t)
            pdfs_[(d.first + i) * plan_->techniques.size() + t] =
                a.rises ? plan_->techniques[t].light_pdf(a.cap, frame_.z, d.local.z) : cone;
    }
    const double over_hemisphere = d.local.z > 0 ? hemisphere_density(d) : 0;
    d.marginal = all + over_hemisphere;
    d.density = own + (d.shows_its_light() ? over_hemisphere : 0);
}

}  // namespace mis
