// The scenes of tests/cases as files: the reader gives back every bit of them.
#include "mis/io/scene_json.h"
#include "mis/scene/direction.h"

#include "tests/cases/cases.h"
#include "tests/support/scene_text.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

void expect_same(const Scene& read, const Scene& made)
{
    ASSERT_EQ(read.probes.size(), made.probes.size());
    for (std::size_t i = 0; i < made.probes.size(); ++i) {
        EXPECT_EQ(read.probes[i].position, made.probes[i].position);
        EXPECT_EQ(read.probes[i].normal, unit_or_zero(made.probes[i].normal));
        EXPECT_EQ(read.probes[i].outgoing, unit_or_zero(made.probes[i].outgoing));
    }
    ASSERT_EQ(read.materials.size(), made.materials.size());
    for (std::size_t i = 0; i < made.materials.size(); ++i) {
        EXPECT_EQ(read.materials[i].type, made.materials[i].type);
        EXPECT_EQ(read.materials[i].specular, made.materials[i].specular);
    }
    ASSERT_EQ(read.lights.size(), made.lights.size());
    for (std::size_t j = 0; j < made.lights.size(); ++j) {
        EXPECT_EQ(read.lights[j].center, made.lights[j].center) << j;
        EXPECT_EQ(read.lights[j].radius, made.lights[j].radius) << j;
        EXPECT_EQ(read.lights[j].radiance_radius, made.lights[j].radiance_radius) << j;
    }
    ASSERT_EQ(read.surfaces.size(), made.surfaces.size());
    for (std::size_t i = 0; i < made.surfaces.size(); ++i)
        EXPECT_EQ(read.surfaces[i].shape.index(), made.surfaces[i].shape.index());
}

TEST(CaseFiles, ReadBackToTheBit)
{
    for (const Case& c : all_cases()) {
        SCOPED_TRACE(c.name);
        const std::string text = scene_text(c.scene);
        expect_same(parse_scene(text, "/nowhere/" + c.name + ".json"), c.scene);
    }
}

}  // namespace
}  // namespace mis
