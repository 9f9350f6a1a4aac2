#include "mis/scene/validate.h"

#include "mis/scene/material_fields.h"
#include "mis/scene/nearest_name.h"
#include "mis/scene/text.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace mis {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A scene with one of everything, that keeps every rule.
Scene valid_scene()
{
    Scene scene;
    scene.camera = Camera{.position = {0, 1, 5}, .target = {0, 1, 0}};
    scene.probes = {
        {.position = {0, 0, 0}, .normal = {0, 1, 0}, .outgoing = {0, 1, 0}, .material = 0}};
    scene.materials = {
        {.name = "floor",
         .type = "lambert",
         .diffuse = Vec3<double>(0.5),
         .specular_probability = {}},
        {.name = "board",
         .type = "lecture",
         .diffuse = Vec3<double>(2),
         .specular = Vec3<double>(3),
         .exponent = 100,
         .specular_probability = {}},
        {.name = "plate",
         .type = "blinn",
         .diffuse = Vec3<double>(0.1),
         .specular = Vec3<double>(0.2),
         .exponent = 0,
         .specular_probability = {}},
        {.name = "a/b~c",
         .type = "ggx",
         .specular = {0.9, 0.7, 0.3},
         .alpha = 1,
         .specular_probability = 0.5},
    };
    scene.surfaces = {
        {Quad{{-9, 0, -9}, {Vec3<double>{0, 0, 18}, Vec3<double>{18, 0, 0}}}, 0},
        {SphereSurface{{0, 1, 0}, 0.5}, 3},
        {Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, {{0, 1, 2}}},
         1},
    };
    scene.lights = {make_light({0, 4, 0}, 0.1, Vec3<double>(10)),
                    make_light_of_power({1, 4, 0}, 0.5, Vec3<double>(100))};
    return scene;
}

Mesh& mesh_of(Scene& scene) { return std::get<Mesh>(scene.surfaces[2].shape); }

struct BrokenRule {
    const char* name;
    std::function<void(Scene&)> break_it;
    std::string pointer, found, allowed;  ///< the last two: what they contain
};

void PrintTo(const BrokenRule& rule, std::ostream* out) { *out << rule.name; }

class EveryRule : public testing::TestWithParam<BrokenRule> {};

TEST_P(EveryRule, IsReportedWithItsPlaceAndWhatWasFound)
{
    Scene scene = valid_scene();
    GetParam().break_it(scene);
    const std::optional<Problem> problem = find_problem(scene);
    ASSERT_TRUE(problem);
    EXPECT_EQ(problem->pointer, GetParam().pointer);
    EXPECT_NE(problem->found.find(GetParam().found), std::string::npos) << problem->found;
    EXPECT_NE(problem->allowed.find(GetParam().allowed), std::string::npos) << problem->allowed;
    EXPECT_FALSE(problem->remedy.empty());
}

const BrokenRule rules[] = {
    {"NothingToShade", [](Scene& s) { s.camera.reset(), s.probes.clear(); }, "/camera", "neither",
     "camera, or probes"},
    {"CameraPositionNan", [](Scene& s) { s.camera->position.y = nan; }, "/camera/position", "nan",
     "1e+15"},
    {"CameraPositionTooFar", [](Scene& s) { s.camera->position.y = -2e15; }, "/camera/position",
     "-2e+15", "1e+15"},
    {"CameraTargetInfinite", [](Scene& s) { s.camera->target.x = infinity; }, "/camera/target",
     "inf", "1e+15"},
    {"CameraTargetIsPosition", [](Scene& s) { s.camera->target = s.camera->position; },
     "/camera/target", "[0, 1, 5]", "another point"},
    {"CameraUpZero", [](Scene& s) { s.camera->up = Vec3<double>(0); }, "/camera/up", "[0, 0, 0]",
     "not all 0"},
    {"CameraUpNan", [](Scene& s) { s.camera->up.x = nan; }, "/camera/up", "nan", "finite"},
    {"CameraUpAlongView",
     [](Scene& s) {
         s.camera->up = {0, 0, -3};
     },
     "/camera/up", "parallel", "away from the line"},
    {"FovZero", [](Scene& s) { s.camera->vertical_fov_degrees = 0; }, "/camera/vertical_fov", "0",
     "0 and 180"},
    {"FovStraight", [](Scene& s) { s.camera->vertical_fov_degrees = 180; }, "/camera/vertical_fov",
     "180", "0 and 180"},
    {"FovNan", [](Scene& s) { s.camera->vertical_fov_degrees = nan; }, "/camera/vertical_fov",
     "nan", "0 and 180"},
    {"WidthZero", [](Scene& s) { s.camera->resolution[0] = 0; }, "/camera/resolution", "[0, 256]",
     "1 and 16384"},
    {"HeightTooLarge", [](Scene& s) { s.camera->resolution[1] = 16385; }, "/camera/resolution",
     "[256, 16385]", "1 and 16384"},
    {"CameraInsideLight",
     [](Scene& s) {
         s.camera->position = {1, 3.8, 0.1};
     },
     "/camera/position", "inside light 1", "outside all lights"},
    {"CameraOnLight",
     [](Scene& s) {
         s.camera->position = {1, 4.5, 0};
     },
     "/camera/position", "inside light 1", "outside all lights"},
    {"ProbePositionNan", [](Scene& s) { s.probes[0].position.z = nan; }, "/probes/0/position",
     "nan", "1e+15"},
    {"ProbeNormalZero", [](Scene& s) { s.probes[0].normal = Vec3<double>(0); }, "/probes/0/normal",
     "[0, 0, 0]", "zero vector"},
    {"ProbeNormalLong",
     [](Scene& s) {
         s.probes[0].normal = {0, 2, 0};
     },
     "/probes/0/normal", "of length 2", "unit vector"},
    {"ProbeOutgoingNan", [](Scene& s) { s.probes[0].outgoing.x = nan; }, "/probes/0/outgoing",
     "nan", "unit vector"},
    {"ProbeMaterialUnknown", [](Scene& s) { s.probes[0].material = 4; }, "/probes/0/material",
     "material 4", "4 materials"},
    {"MaterialTypeUnknown", [](Scene& s) { s.materials[0].type = "lamber"; },
     "/materials/floor/type", "\"lamber\"", "lambert, lecture, blinn, ggx"},
    {"AlbedoAboveOne", [](Scene& s) { s.materials[0].diffuse = Vec3<double>(1.5); },
     "/materials/floor/albedo", "1.5", "0 and 1"},
    {"AlbedoOfOneChannel", [](Scene& s) { s.materials[0].diffuse.z = -0.1; },
     "/materials/floor/albedo", "[0.5, 0.5, -0.1]", "0 and 1"},
    {"AlbedoNan", [](Scene& s) { s.materials[0].diffuse.x = nan; }, "/materials/floor/albedo",
     "nan", "0 and 1"},
    {"KdNegative", [](Scene& s) { s.materials[1].diffuse = Vec3<double>(-1); },
     "/materials/board/kd", "-1", "kd lies between 0"},
    {"KsInfinite", [](Scene& s) { s.materials[1].specular = Vec3<double>(infinity); },
     "/materials/board/ks", "inf", "1e+09"},
    {"MNegative", [](Scene& s) { s.materials[1].exponent = -1; }, "/materials/board/m", "-1",
     "m lies between 0"},
    {"DiffuseAboveOne", [](Scene& s) { s.materials[2].diffuse.y = 2; }, "/materials/plate/diffuse",
     "[0.1, 2, 0.1]", "0 and 1"},
    {"SpecularAboveOne", [](Scene& s) { s.materials[2].specular = Vec3<double>(2); },
     "/materials/plate/specular", "2", "0 and 1"},
    {"ExponentTooLarge", [](Scene& s) { s.materials[2].exponent = 2e9; },
     "/materials/plate/exponent", "2e+09", "1e+09"},
    {"F0AboveOne", [](Scene& s) { s.materials[3].specular.x = 1.1; }, "/materials/a~1b~0c/f0",
     "1.1", "0 and 1"},
    {"AlphaZero", [](Scene& s) { s.materials[3].alpha = 0; }, "/materials/a~1b~0c/alpha", "0",
     "greater than 0 and at most 1"},
    {"AlphaAboveOne", [](Scene& s) { s.materials[3].alpha = 1.01; }, "/materials/a~1b~0c/alpha",
     "1.01", "at most 1"},
    {"SpecularProbabilityAboveOne", [](Scene& s) { s.materials[3].specular_probability = 1.01; },
     "/materials/a~1b~0c/specular_probability", "1.01", "0 and 1"},
    {"SpecularProbabilityOfLambert", [](Scene& s) { s.materials[0].specular_probability = 0.5; },
     "/materials/floor/specular_probability", "0.5", "no specular lobe"},
    {"QuadCornerNan", [](Scene& s) { std::get<Quad>(s.surfaces[0].shape).corner.x = nan; },
     "/surfaces/0/corner", "nan", "1e+15"},
    {"QuadEdgeTooLong", [](Scene& s) { std::get<Quad>(s.surfaces[0].shape).edges[1].x = 1e16; },
     "/surfaces/0/edges/1", "1e+16", "1e+15"},
    {"QuadEdgesParallel",
     [](Scene& s) {
         std::get<Quad>(s.surfaces[0].shape).edges[1] = {0, 0, -1};
     },
     "/surfaces/0/edges", "[0, 0, 18]", "not parallel"},
    {"QuadEdgeZero",
     [](Scene& s) { std::get<Quad>(s.surfaces[0].shape).edges[0] = Vec3<double>(0); },
     "/surfaces/0/edges", "[0, 0, 0]", "have a length"},
    {"SphereCenterNan",
     [](Scene& s) { std::get<SphereSurface>(s.surfaces[1].shape).center.x = nan; },
     "/surfaces/1/center", "nan", "1e+15"},
    {"SphereRadiusNegative",
     [](Scene& s) { std::get<SphereSurface>(s.surfaces[1].shape).radius = -1; },
     "/surfaces/1/radius", "-1", "greater than 0"},
    {"MeshEmpty", [](Scene& s) { mesh_of(s).triangles.clear(); }, "/surfaces/2/file",
     "without triangles", "at least one triangle"},
    {"MeshIndexOutOfRange", [](Scene& s) { mesh_of(s).triangles[0][1] = 3; }, "/surfaces/2/file",
     "vertex 3 in triangle 0", "3 vertices"},
    {"MeshVertexNan", [](Scene& s) { mesh_of(s).positions[1].y = nan; }, "/surfaces/2/file",
     "vertex 1 at [1, nan, 0]", "1e+15"},
    {"MeshNormalMissing", [](Scene& s) { mesh_of(s).normals.pop_back(); }, "/surfaces/2/file",
     "2 normals for 3", "one normal per vertex"},
    {"MeshNormalLong",
     [](Scene& s) {
         mesh_of(s).normals[2] = {0, 0, 2};
     },
     "/surfaces/2/file", "at vertex 2", "unit vector"},
    {"SurfaceMaterialNegative", [](Scene& s) { s.surfaces[1].material = -1; },
     "/surfaces/1/material", "material -1", "4 materials"},
    {"NoLights", [](Scene& s) { s.lights.clear(); }, "/lights", "no lights",
     "between 1 and 10000000"},
    {"LightCenterInfinite", [](Scene& s) { s.lights[1].center.x = infinity; }, "/lights/1/center",
     "inf", "1e+15"},
    {"LightRadiusZero", [](Scene& s) { s.lights[1].radius = 0; }, "/lights/1/radius", "0",
     "greater than 0"},
    {"LightRadiusNan", [](Scene& s) { s.lights[1].radius = nan; }, "/lights/1/radius", "nan",
     "greater than 0"},
    {"LightRadiusTiny", [](Scene& s) { s.lights[1].radius = 1e-31; }, "/lights/1/radius", "1e-31",
     "between 1e-30"},
    {"LightRadiusHuge", [](Scene& s) { s.lights[1].radius = 1e16; }, "/lights/1/radius", "1e+16",
     "and 1e+15"},
    {"LightRadianceNegative", [](Scene& s) { s.lights[1].radiance_radius.y = -1; },
     "/lights/1/radiance", ", -2, ", "not negative"},
    {"LightRadianceNan",
     [](Scene& s) { s.lights[1].radiance_radius.y = std::numeric_limits<float>::quiet_NaN(); },
     "/lights/1/radiance", "nan", "finite"},
    {"LightRadianceHuge", [](Scene& s) { s.lights[1].radiance_radius = Vec3<float>(2e37f); },
     "/lights/1/radiance", "e+37, for a radius of 0.5", "and 1e+37"},
    {"ProbeNearATinyLight",
     [](Scene& s) {
         s.probes[0].position = {0, 0, 0};
         s.lights[1] = make_light({0, 2e-20, 0}, 1e-20, Vec3<double>(1));
     },
     "/probes/0/position", "2e-20 from the center of light 1", "at least 1e-18"},
    {"TinyLightFarAway",
     [](Scene& s) {
         s.lights[1] = make_light({1e10, 0, 0}, 1e-17, Vec3<double>(1));
     },
     "/lights/1/radius", "1e-17, ", "square of the distance is at least 1e-36"},
    {"CameraNearATinyLight",
     [](Scene& s) {
         s.camera->position = {0, 0, 0}, s.camera->target = {1, 0, 0};
         s.lights[1] = make_light({0, 1e-17, 0}, 1e-20, Vec3<double>(1));
     },
     "/camera/position", "1e-17 from the center of light 1", "at least 1e-15"},
    {"LightRadianceTiny", [](Scene& s) { s.lights[1].radiance_radius = Vec3<float>(5e-38f); },
     "/lights/1/radiance", "e-38", "between 1e-37"},
};
INSTANTIATE_TEST_SUITE_P(Scene, EveryRule, testing::ValuesIn(rules),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Validate, AcceptsASceneThatKeepsEveryRule)
{
    const std::optional<Problem> problem = find_problem(valid_scene());
    EXPECT_FALSE(problem) << problem->pointer << " " << problem->found;
}

TEST(Validate, AcceptsTheLimitsThemselves)
{
    Scene scene = valid_scene();
    scene.camera->resolution = {1, limits::resolution};
    scene.camera->vertical_fov_degrees = 179.99;
    scene.materials[3].alpha = limits::min_alpha;
    scene.materials[3].specular_probability = 0;
    scene.materials[2].diffuse = {0, 1, 0};
    scene.lights = {make_light({0, 4, 0}, limits::min_radius,
                               Vec3<double>(limits::max_radiance_radius / limits::min_radius)),
                    make_light({1e15, 4e14, 0}, 1e10, {limits::min_radiance_radius / 1e10, 0, 0}),
                    make_light({0, 9, 0}, 1, Vec3<double>(0))};
    const std::optional<Problem> problem = find_problem(scene);
    EXPECT_FALSE(problem) << problem->pointer << " " << problem->found << " " << problem->allowed;
}

TEST(Validate, AcceptsAProbeInsideALightWhichIsMerelyDark)
{
    Scene scene = valid_scene();
    scene.probes[0].position = scene.lights[0].center;
    EXPECT_FALSE(find_problem(scene));
}

TEST(Validate, AcceptsAProbeThatIsSeenFromBelow)
{
    Scene scene = valid_scene();
    scene.probes[0].outgoing = {0, -1, 0};
    EXPECT_FALSE(find_problem(scene));
}

TEST(Validate, RefusesMoreLightsThanTheLimit)
{
    Scene scene = valid_scene();
    scene.lights.resize(limits::lights + 1, scene.lights[0]);
    const std::optional<Problem> problem = find_problem(scene);
    ASSERT_TRUE(problem);
    EXPECT_EQ(problem->pointer, "/lights");
    EXPECT_EQ(problem->found, "10000001 lights");
}

TEST(Validate, RefusesMoreTrianglesThanTheLimitOverAllMeshes)
{
    Scene scene = valid_scene();
    mesh_of(scene).triangles.resize(limits::triangles / 2 + 1, {0, 1, 2});
    scene.surfaces.push_back(scene.surfaces[2]);
    const std::optional<Problem> problem = find_problem(scene);
    ASSERT_TRUE(problem);
    EXPECT_EQ(problem->pointer, "/surfaces");
    EXPECT_EQ(problem->found, "50000002 triangles");
}

TEST(Validate, JudgesAPowerByTheRadianceThatItGives)
{
    const auto problem_of = [](double radius, double power) {
        return find_light_problem({0, 0, 0}, radius, Emission::power, Vec3<double>(power));
    };
    EXPECT_FALSE(problem_of(1e-30, 100));
    EXPECT_FALSE(problem_of(1e12, 1e-20));
    EXPECT_EQ(problem_of(1e-30, 1e10).value().pointer, "/power");
    EXPECT_EQ(problem_of(1e15, 1e-30).value().pointer, "/power");
    EXPECT_EQ(problem_of(1, -1).value().pointer, "/power");
}

TEST(Light, OfGivenPowerHasTheRadianceOfDesignSection2)
{
    constexpr double pi = 3.14159265358979323846;
    for (const double radius : {1e-30, 1e-6, 1.0, 1e10}) {
        const Light light = make_light_of_power({0, 0, 0}, radius, {100, 50, 0});
        const double expected = 100 / (4 * pi * pi * radius * radius);
        EXPECT_NEAR(radiance(light).x / expected, 1, 1e-7) << radius;
        EXPECT_NEAR(radiance(light).y / expected, 0.5, 1e-7) << radius;
        EXPECT_EQ(radiance(light).z, 0);
    }
}

TEST(NearestName, OffersWhatWasProbablyMeantAndNothingElse)
{
    EXPECT_EQ(nearest_name("lamber", material_type_names), "lambert");
    EXPECT_EQ(nearest_name("GGX", material_type_names), "ggx");
    EXPECT_EQ(nearest_name("bilnn", material_type_names), "blinn");
    EXPECT_EQ(nearest_name("lectures", material_type_names), "lecture");
    EXPECT_EQ(nearest_name("lam", material_type_names), "lambert");
    EXPECT_EQ(nearest_name("l", material_type_names), "");
    EXPECT_EQ(nearest_name("mirror", material_type_names), "");
    EXPECT_EQ(nearest_name("", material_type_names), "");

    constexpr std::array<std::string_view, 5> options{"--help", "--quiet", "--out", "--sampler",
                                                      "-n"};
    EXPECT_EQ(nearest_name("--seed", options), "") << "two of four letters and the dashes";
    EXPECT_EQ(nearest_name("--sobol", options), "");
    EXPECT_EQ(nearest_name("--sampl", options), "--sampler");
    EXPECT_EQ(nearest_name("--hlep", options), "--help");
    EXPECT_EQ(nearest_name("quite", options), "--quiet");
    EXPECT_EQ(nearest_name("--output", options), "--out") << "it begins so";
    EXPECT_EQ(nearest_name("--", options), "");
}

TEST(Text, CountsInWordsThatAgree)
{
    EXPECT_EQ(many(1, "light"), "1 light");
    EXPECT_EQ(many(0, "light"), "0 lights");
    EXPECT_EQ(many(2, "mesh"), "2 meshes");
    EXPECT_EQ(many(3, "vertex"), "3 vertices");
    EXPECT_EQ(many(4, "strategy"), "4 strategies");
    EXPECT_EQ(many(5, "ray"), "5 rays");
}

TEST(Text, WritesTheShortestNumberThatReadsBack)
{
    EXPECT_EQ(to_text(0.1), "0.1");
    EXPECT_EQ(to_text(-2e15), "-2e+15");
    EXPECT_EQ(to_text(Vec3<double>{1, 2.5, nan}), "[1, 2.5, nan]");
    EXPECT_EQ(pointer_token("a/b~c"), "a~1b~0c");
}

}  // namespace
}  // namespace mis
