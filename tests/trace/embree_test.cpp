// Embree against the closed forms, on scenes at random. At an edge the two may differ: there, rays
// beside differ too.
#include "mis/trace/embree.h"

#include "mis/trace/analytic.h"
#include "mis/trace/surface_points.h"

#include "tests/support/statistics.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <set>

namespace mis {
namespace {

Mesh bumpy_mesh(Uniforms& uniforms, const Vec3<double>& center, double size)
{
    Mesh mesh;
    constexpr std::uint32_t side = 6;
    for (std::uint32_t a = 0; a <= side; ++a)
        for (std::uint32_t b = 0; b <= side; ++b)
            mesh.positions.push_back(center + Vec3<double>{a * 1.0 / side - 0.5,
                                                           uniforms.between(0, 0.2),
                                                           b * 1.0 / side - 0.5} *
                                                  size);
    for (std::uint32_t a = 0; a < side; ++a)
        for (std::uint32_t b = 0; b < side; ++b) {
            const std::uint32_t i = a * (side + 1) + b;
            mesh.triangles.push_back({i, i + 1, i + side + 1});
            mesh.triangles.push_back({i + 1, i + side + 2, i + side + 1});
        }
    return mesh;
}

/// Quads, spheres and meshes at random in a box of half-width `extent` around a place.
Scene random_scene(unsigned seed, double extent, const Vec3<double>& around)
{
    Uniforms uniforms(seed);
    Scene scene;
    scene.probes = {{around, {0, 1, 0}, {0, 1, 0}, 0}};
    for (int i = 0; i < 30; ++i) {
        const Vec3<double> place = around + uniforms.in_box(extent);
        const Vec3<double> e1 = uniforms.direction() * extent * 0.5;
        const Vec3<double> e2 = cross(normalized(e1), uniforms.direction()) * extent * 0.5;
        if (i % 3 == 0) scene.surfaces.push_back({Quad{place, {e1, e2}}, i});
        if (i % 3 == 1)
            scene.surfaces.push_back(
                {SphereSurface{place, extent * uniforms.between(0.02, 0.3)}, i});
        if (i % 3 == 2) scene.surfaces.push_back({bumpy_mesh(uniforms, place, extent * 0.5), i});
    }
    return scene;
}

struct Place {
    double extent;
    Vec3<double> around;
};
const std::vector<Place> places{{1, Vec3<double>(0)},     {1e-3, Vec3<double>(0)},
                                {1e4, Vec3<double>(0)},   {1, Vec3<double>(1e6)},
                                {1e-15, Vec3<double>(0)}, {1e13, Vec3<double>(0)}};

constexpr double edge =
    1e-5;  ///< of the extent: nearer to an edge than this, either answer is right

/// The analytic answers to rays beside a ray, `edge` apart at either end.
template <class Answer>
bool answers_differ_around(const Vec3<double>& origin, const Vec3<double>& direction,
                           const Answer& answer)
{
    Uniforms uniforms(62);
    const auto usual = answer(origin, direction);
    for (int i = 0; i < 60; ++i) {
        const Vec3<double> beside = origin + uniforms.direction() * edge;
        if (answer(beside, normalized(direction + uniforms.direction() * edge)) != usual)
            return true;
    }
    return false;
}

TEST(EmbreeTracer, SaysItsErrorsInWords)
{
    std::set<std::string> all;
    for (int code = 0; code <= 6; ++code) {  // RTC_ERROR_NONE to RTC_ERROR_CANCELLED
        all.insert(embree_error(code));
        EXPECT_EQ(embree_error(code).find(std::to_string(code)), std::string::npos);
    }
    EXPECT_EQ(all.size(), 7U);
    EXPECT_EQ(embree_error(4), "out of memory");
    EXPECT_EQ(embree_error(77), "error 77");
}

TEST(EmbreeTracer, HidesWhatTheClosedFormsHide)
{
    int rays_hidden = 0, rays_at_an_edge = 0, rays_in_all = 0;
    for (const Place& place : places) {
        const Scene scene = random_scene(61, place.extent, place.around);
        const EmbreeTracer tracer(scene);
        const AnalyticTracer exact(scene);
        ASSERT_EQ(tracer.origin(), exact.origin());
        Uniforms uniforms(63);
        std::vector<ShadowRay> rays(static_cast<std::size_t>(scaled(20'000)));
        for (ShadowRay& ray : rays)
            ray = {vec_cast<float>(uniforms.in_box(place.extent)),
                   vec_cast<float>(uniforms.direction()),
                   static_cast<float>(place.extent * uniforms.log_between(0.01, 10))};
        std::vector<std::uint8_t> found(rays.size()), expected(rays.size());
        tracer.occluded(rays, found);
        exact.occluded(rays, expected);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ++rays_in_all, rays_hidden += found[i];
            if (found[i] == expected[i]) continue;
            ++rays_at_an_edge;
            const double e = place.extent;
            const auto unit_answer = [&](const Vec3<double>& o, const Vec3<double>& d) {
                // A ray in units of the extent; its length counts to the same tolerance.
                std::array<std::uint8_t, 2> two{};
                const double distance = static_cast<double>(rays[i].distance);
                const std::array<ShadowRay, 2> both{
                    ShadowRay{vec_cast<float>(o * e), vec_cast<float>(d),
                              static_cast<float>(distance + edge * e)},
                    ShadowRay{vec_cast<float>(o * e), vec_cast<float>(d),
                              static_cast<float>(distance - edge * e)}};
                exact.occluded(both, two);
                return two[0] != two[1] ? 2 : int{two[0]};
            };
            const Vec3<double> o = vec_cast<double>(rays[i].origin) / e,
                               d = vec_cast<double>(rays[i].direction);
            EXPECT_TRUE(unit_answer(o, d) == 2 || answers_differ_around(o, d, unit_answer))
                << "extent " << e << ", ray " << i << ": found " << int{found[i]};
        }
    }
    EXPECT_GT(rays_hidden, rays_in_all / 10) << "too few to say anything";
    EXPECT_LT(rays_at_an_edge, rays_in_all / 1000 + 2);
}

TEST(EmbreeTracer, MeetsWhatTheClosedFormsMeet)
{
    int met = 0;
    for (const Place& place : places) {
        const Scene scene = random_scene(64, place.extent, place.around);
        const EmbreeTracer tracer(scene);
        const AnalyticTracer exact(scene);
        Uniforms uniforms(65);
        const auto material_at = [&](const Vec3<double>& o, const Vec3<double>& d) {
            const auto hit = exact.first_hit(place.around + o * place.extent, d);
            return hit ? hit->material : -1;
        };
        for (int i = 0; i < scaled(10'000); ++i) {
            const Vec3<double> o = uniforms.in_box(2), d = normalized(uniforms.in_box(1) - o);
            const Vec3<double> origin = place.around + o * place.extent;
            const auto found = tracer.first_hit(origin, d), expected = exact.first_hit(origin, d);
            if (found.has_value() != expected.has_value() ||
                (found && found->material != expected->material)) {
                EXPECT_TRUE(answers_differ_around(o, d, material_at))
                    << "extent " << place.extent << ", ray " << i;
                continue;
            }
            if (!found) continue;
            ++met;
            // The hit is computed in double: only at the edge between two triangles is another
            // plane the nearer one.
            const bool same =
                std::abs(found->distance - expected->distance) <= 1e-9 * expected->distance;
            EXPECT_TRUE(same ||
                        std::abs(found->distance - expected->distance) <= 20 * edge * place.extent);
            if (same) {
                EXPECT_LT(length(found->x - expected->x),
                          1e-8 * place.extent + 1e-9 * length(place.around));
            }
        }
    }
    EXPECT_GT(met, scaled(10'000)) << "too few to say anything";
}

/// From every hit, moved off its surface as told, rays along the surface and away from it do not
/// meet it again.
TEST(EmbreeTracer, ARayMovedOffItsSurfaceMissesIt)
{
    int again = 0, rays_in_all = 0;
    for (const Place& place : places) {
        Scene scene = random_scene(66, place.extent, place.around);
        for (Surface& surface : scene.surfaces) {
            Scene alone{.probes = scene.probes, .surfaces = {surface}};
            if (std::holds_alternative<Mesh>(surface.shape)) continue;  // it may shade itself
            const EmbreeTracer tracer(alone);
            Uniforms uniforms(67);
            for (int i = 0; i < scaled(2000); ++i) {
                const Vec3<double> eye = place.around + uniforms.direction() * (4 * place.extent);
                const Vec3<double> target = place.around + uniforms.in_box(place.extent);
                const auto hit = tracer.first_hit(eye, normalized(target - eye));
                if (!hit) continue;
                const Vec3<float> origin =
                    vec_cast<float>(hit->x + hit->geometric * hit->offset - tracer.origin());
                Vec3<double> away = uniforms.direction();
                away = i % 2 == 0 ? away * 1.0
                                  : normalized(cross(away, hit->geometric) + hit->geometric * 1e-7);
                if (dot(away, hit->geometric) < 0) away = -away;
                const std::array<ShadowRay, 1> ray{ShadowRay{
                    origin, vec_cast<float>(away), std::numeric_limits<float>::infinity()}};
                std::array<std::uint8_t, 1> hidden{};
                tracer.occluded(ray, hidden);
                again += hidden[0], ++rays_in_all;
            }
        }
    }
    EXPECT_EQ(again, 0) << "of " << rays_in_all;
    EXPECT_GT(rays_in_all, scaled(2000)) << "too few to say anything";
}

TEST(EmbreeTracer, AnswersMoreRaysThanOneStreamHolds)
{
    const Scene scene = random_scene(61, 1, Vec3<double>(0));
    const EmbreeTracer tracer(scene);
    std::vector<ShadowRay> rays(1000, ShadowRay{{50, 50, 50}, {1, 0, 0}, 100.F});
    const auto& sphere = std::get<SphereSurface>(scene.surfaces[1].shape);
    const Vec3<double> at = sphere.center + Vec3<double>{0, 0, 20};
    rays[999] = {vec_cast<float>(at), {0, 0, -1}, 100.F};
    std::vector<std::uint8_t> hidden(rays.size(), 9);
    tracer.occluded(rays, hidden);
    EXPECT_EQ(std::count(hidden.begin(), hidden.end(), 1), 1);
    EXPECT_EQ(hidden[999], 1);
}

}  // namespace
}  // namespace mis
