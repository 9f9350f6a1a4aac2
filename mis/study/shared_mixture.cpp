#include "mis/study/shared_mixture.h"

#include "mis/engine/light_columns.h"
#include "mis/study/shared_plan.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace mis {

namespace {

/// Up to so many lights, each is given a probability of its own at every point.
constexpr std::size_t most_dense = 10'000;

/// Shares of the mixture: of `product`; of what makes second moments even; of the policies
/// themselves; of `uniform`, which reaches every light.
constexpr double product_share = 0.3, even_share = 0.35, policies_share = 0.25, uniform_share = 0.1;

/// Of many lights, what is mixed with the policies at hand.
constexpr std::array<std::string_view, 3> of_many{"tree", "power", "uniform"};

/// A number in [0, 1) as 64 bits.
std::uint64_t bits_of(double u)
{
    return static_cast<std::uint64_t>(std::min(u, 1 - 0x1p-53) * 0x1p64);
}

}  // namespace

LightMixture::LightMixture(const LitScene& scene, std::span<const std::string> policies,
                           bool draws_every_light, const StopToken& stop)
    : scene_(&scene), lights_(scene.scene().lights.size()), listed_(policies.size()),
      draws_every_light_(draws_every_light), is_dense_(lights_ <= most_dense)
{
    std::vector<std::string> names(policies.begin(), policies.end());
    guess_ = place_of(is_dense_ ? "product" : "tree", names);
    if (!is_dense_)
        for (const std::string_view name : of_many) place_of(name, names);
    for (const std::string& name : names)
        policies_.emplace_back(name, scene.scene().lights, scene.policy(name, stop));
    tables_.resize(policies_.size());
    if (!is_dense_) return;
    for (std::size_t p = 0; p < listed_; ++p)
        if (walked_ == none && policies_[p].walks()) walked_ = p;
    if (walked_ != none) walked_share_ = policies_share / policies_that_count();
    dense_.resize(policies_.size() * lights_);
    weights_.resize(lights_);
    sums_.resize(lights_);
}

void LightMixture::prepare(const Vec3<double>& x, const Vec3<double>& n, const Vec3<double>& wo,
                           int material)
{
    const bool reads_all = std::any_of(policies_.begin(), policies_.end(),
                                       [](const auto& p) { return p.reads_all_lights(); });
    const LightColumns<double> columns =
        reads_all ? fill_light_columns(scene_->scene().lights, x, columns_)
                  : LightColumns<double>{};
    const ChoicePoint<double> point{Vec3<double>(0), n, wo, scene_->bsdf(material), x};
    for (std::size_t p = 0; p < policies_.size(); ++p) {
        tables_[p] = &policies_[p].at(point, columns);
        if (!is_dense_ || p == walked_) continue;
        for (std::size_t j = 0; j < lights_; ++j)
            dense_[p * lights_ + j] = tables_[p]->probability(static_cast<LightIndex>(j));
    }
    if (is_dense_) mix();
}

double LightMixture::policies_that_count() const
{
    return static_cast<double>(std::max<std::size_t>(listed_ + (draws_every_light_ ? 1 : 0), 1));
}

void LightMixture::mix()
{
    const double* product = &dense_[guess_ * lights_];
    const double in_all = policies_that_count();
    std::fill(weights_.begin(), weights_.end(), uniform_share / static_cast<double>(lights_));
    for (std::size_t j = 0; j < lights_; ++j) weights_[j] += product_share * product[j];
    // P̂²/P: the second moment that this light adds, were it what `product` takes it for.
    const auto add = [&](const double* policy) {
        double sum = 0;
        const auto moment = [&](std::size_t j) {
            if (policy == nullptr) return product[j] * product[j];
            return policy[j] > 0 ? product[j] * product[j] / policy[j] : 0;
        };
        for (std::size_t j = 0; j < lights_; ++j) sum += moment(j);
        if (!(sum > 0)) return;
        for (std::size_t j = 0; j < lights_; ++j)
            weights_[j] += even_share / in_all * moment(j) / sum +
                           (policy == nullptr ? 0 : policies_share / in_all * policy[j]);
    };
    for (std::size_t p = 0; p < listed_; ++p)
        if (p != walked_) add(&dense_[p * lights_]);
    if (draws_every_light_) add(nullptr);
    mixed_ = RunningSum::over(std::span<const double>(weights_), std::span<double>(sums_));
}

LightIndex LightMixture::choose(std::uint64_t bits) const
{
    if (lights_ == 0) return no_light;
    if (is_dense_) {
        const double u = static_cast<double>(bits >> 11) * 0x1p-53;
        if (u < walked_share_) return tables_[walked_]->choose(bits_of(u / walked_share_)).light;
        return mixed_.choose(bits_of((u - walked_share_) / (1 - walked_share_))).light;
    }
    // The upper part chooses the policy, what is left over the light.
    __extension__ using Wide = unsigned __int128;
    const Wide product = static_cast<Wide>(bits) * tables_.size();
    return tables_[static_cast<std::size_t>(product >> 64)]
        ->choose(static_cast<std::uint64_t>(product))
        .light;
}

double LightMixture::probability(LightIndex j) const
{
    if (is_dense_) {
        const double walked = walked_ == none ? 0 : tables_[walked_]->probability(j);
        return (1 - walked_share_) * mixed_.probability(j) + walked_share_ * walked;
    }
    double sum = 0;
    for (const auto* table : tables_) sum += table->probability(j);
    return sum / static_cast<double>(tables_.size());
}

}  // namespace mis
