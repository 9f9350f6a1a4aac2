#include "mis/effects/effects.h"

#include "tests/support/scenes.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace mis
