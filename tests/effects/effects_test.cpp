#include "mis/effects/effects.h"

#include "mis/bsdf/registry.h"
#include "tests/support/scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <type_traits>
#include <vector>

namespace mis {
namespace {

TEST(HasLobes, AsksTheMaterialsOfSurfacesAndProbesAlone)
{
    Scene scene = probe_under(three_lights_apart(), grey_floor());
    Material glossy = grey_floor();
    glossy.type = "blinn", glossy.specular = Vec3<double>(0.2), glossy.exponent = 20;
    Material black_lobe = glossy;
    black_lobe.specular = Vec3<double>(0);
    scene.materials.push_back(glossy);
    scene.materials.push_back(black_lobe);
    EXPECT_FALSE(has_lobes(scene)) << "nothing is made of it";
    scene.probes.push_back(scene.probes.at(0));
    scene.probes.back().material = 2;
    EXPECT_FALSE(has_lobes(scene)) << "a black lobe";
    scene.probes.back().material = 1;
    EXPECT_TRUE(has_lobes(scene));
    scene.probes.pop_back();
    scene.surfaces.push_back({.shape = SphereSurface{{0, 0, -5}, 1}, .material = 1});
    EXPECT_TRUE(has_lobes(scene));
}

std::vector<Effect> listed(EffectSet set)
{
    std::vector<Effect> effects;
    std::ranges::copy(set, std::back_inserter(effects));
    return effects;
}

TEST(EffectSet, IsARangeOfItsEffectsInTheirOrder)
{
    using enum Effect;
    using testing::ElementsAre;
    EXPECT_THAT(listed({colour, shadows, horizon}), ElementsAre(shadows, horizon, colour));
    EXPECT_THAT(listed({}), ElementsAre());
    EXPECT_THAT(listed(EffectSet::all()),
                ElementsAre(shadows, light_occlusion, horizon, specular, choice, colour));
    std::set<std::size_t> bits;
    for (std::size_t k = 0; k < 1U << effect_count; ++k) {
        const EffectSet set = EffectSet::of_bits(k);
        EffectSet again;
        for (const Effect effect : set) again.set(effect, true);
        EXPECT_EQ(again, set);
        bits.insert(set.bits());
    }
    EXPECT_EQ(bits.size(), 1U << effect_count);
}

TEST(EffectSet, IsCutJoinedAndTakenAwayFrom)
{
    using enum Effect;
    const EffectSet a{shadows, specular}, b{specular, choice};
    EXPECT_EQ(a | b, (EffectSet{shadows, specular, choice}));
    EXPECT_EQ(a & b, EffectSet{specular});
    EXPECT_EQ(a - b, EffectSet{shadows});
    EffectSet changed = a;
    changed.set(shadows, false), changed.set(specular, true);
    EXPECT_EQ(changed, EffectSet{specular});
    EXPECT_FALSE(changed.has(shadows));
}

TEST(EffectNames, FindTheirEffects)
{
    for (const Effect effect : EffectSet::all()) EXPECT_EQ(find_effect(name_of(effect)), effect);
    for (const char* other : {"", "shadow", "Shadows", "light occlusion"})
        EXPECT_EQ(find_effect(other), std::nullopt) << other;
}

TEST(Explained, HasAnEntryOfEachEffectInOrder)
{
    const Scene scene = probe_under(three_lights_apart(), grey_floor());
    for (const Effects& effects : {all_effects(scene), called_for(scene)}) {
        const auto plans = explained(scene, effects, {});
        ASSERT_EQ(plans.size(), effect_count);
        for (std::size_t i = 0; i < effect_count; ++i) {
            EXPECT_EQ(plans[i].name, effect_names[i]);
            EXPECT_FALSE(plans[i].why.empty()) << plans[i].name;
        }
    }
}

/// Every colour that a material has. It names all members of Material: with one more it does not
/// compile, and the new one is to be added.
std::vector<Vec3<double>*> colours_of(Material& material)
{
    auto& [name, type, diffuse, specular, exponent, alpha, probability] = material;
    std::vector<Vec3<double>*> colours;
    const auto add = [&](auto& member) {
        if constexpr (std::is_same_v<decltype(member), Vec3<double>&>) colours.push_back(&member);
    };
    add(name), add(type), add(diffuse), add(specular), add(exponent), add(alpha), add(probability);
    return colours;
}

/// Of a material whose every colour is grey, but for the k-th.
template <class B> Material grey_but_for(std::size_t k)
{
    Material material{.type = std::string(B::name), .exponent = 3, .alpha = 0.5};
    const std::vector<Vec3<double>*> colours = colours_of(material);
    for (std::size_t c = 0; c < colours.size(); ++c)
        *colours[c] = c == k ? Vec3<double>(0.3, 0.2, 0.1) : Vec3<double>(0.2);
    return material;
}

/// What it reflects, of some directions.
template <class B> bool reflects_grey(const Material& material)
{
    const B bsdf(material);
    for (const double x : {0.0, 0.3, 0.7, 0.95}) {
        const Vec3<double> w = normalized(Vec3<double>{x, 0.1, 1}), mirrored{-w.x, -w.y, w.z};
        for (const Vec3<double>& wi : {w, mirrored}) {
            const Vec3<double> f = bsdf.evaluate(w, wi).f;
            if (std::abs(f.x - f.y) > 1e-12 || std::abs(f.y - f.z) > 1e-12) return false;
        }
    }
    return true;
}

/// Whatever type the registry gains: no colour that its BSDF reads is forgotten.
TEST(IsGrey, SaysOfEveryBsdfWhetherWhatItReflectsIsGrey)
{
    for_each_type(Bsdfs{}, [&]<class B>() {
        Material none = grey_but_for<B>(1000);
        EXPECT_TRUE(is_grey(none)) << B::name;
        EXPECT_TRUE(reflects_grey<B>(none)) << B::name;
        for (std::size_t k = 0; k < colours_of(none).size(); ++k) {
            const Material material = grey_but_for<B>(k);
            EXPECT_EQ(is_grey(material), reflects_grey<B>(material)) << B::name << ", colour " << k;
        }
    });
}

TEST(IsGrey, IsNotSaidOfATypeThatNothingIsKnownOf)
{
    Material material = grey_floor();
    EXPECT_TRUE(is_grey(material));
    material.type = "velvet";
    EXPECT_FALSE(is_grey(material));
}

}  // namespace
}  // namespace mis
