// Draws at the ends of their numbers and of the horizon: none is lost by rounding, in any number
// type and instruction set.
#include "mis/sampling/horizon.h"

#include "mis/engine/light_columns.h"
#include "mis/engine/scalar_choices.h"
#include "mis/math/irradiance.h"
#include "mis/trace/embree.h"

#include "tests/engine/bench.h"
#include "tests/support/ends.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>

namespace mis {
namespace {

/// A half of a strategy at a scene's probe, with numbers of the test's own.
template <class T> class HalfWithNumbers {
public:
    HalfWithNumbers(const TestScene& test, const std::string& strategy, std::string_view set)
        : ready_(test.lit, parse_strategy(strategy), kernels_of<T>(set), 1),
          batch_(std::make_unique<Batch<T>>())
    {
        const Tile& tile = test.probes.tiles.at(0);
        job_ = ready_.job(tile, test.probes.points);
        pipeline_ = &ready_.pipeline(tile);
        if (pipeline_->reads_all_lights || job_.lights->size() <= most_screened_lights)
            job_.columns = fill_light_columns(*job_.lights, job_.origin, columns_, job_.order);
        scratch_ = std::make_unique<Scratch>(std::max<std::size_t>(pipeline_->table_bytes, 1));
    }

    /// The batch after these numbers went through the stages, up to a kind of them or to the end.
    const Batch<T>& run(std::span<const Vec2<T>> u, T lobe, std::optional<StageKind> last = {})
    {
        start(u.size());
        const bool is_light = pipeline_->light_draws > 0;
        for (const NamedStage<T>& stage : is_light ? pipeline_->light : pipeline_->bsdf) {
            if (stage.kind == StageKind::numbers)
                for (std::size_t i = 0; i < u.size(); ++i)
                    batch_->u[i] = u[i].x, batch_->v[i] = u[i].y, batch_->lobe[i] = lobe,
                    batch_->bits[i] = 0;
            else stage.run(job_, *batch_);
            if (stage.kind == last) break;
        }
        return *batch_;
    }

private:
    void start(std::size_t samples)
    {
        *batch_ = {};
        batch_->samples = static_cast<int>(samples);
        batch_->points = 1;
        for (std::size_t i = 0; i < samples; ++i)
            batch_->sample_point[i] = 0, batch_->sample_number[i] = i;
        batch_->tile_point[0] = 0;
        scratch_->clear();
        if (pipeline_->prepare != nullptr) pipeline_->prepare(job_, *batch_, 0, *scratch_);
    }

    ReadyStrategy<T> ready_;
    TileJob<T> job_;
    const Pipeline<T>* pipeline_;
    LargeVector<T> columns_;
    std::unique_ptr<Scratch> scratch_;
    std::unique_ptr<Batch<T>> batch_;
};

/// body(numbers) for the ends of the square, some hundred at a time.
template <class T, class Body> void for_each_batch(const Body& body)
{
    const std::vector<Vec2<T>> ends = ends_of_square<T>(scaled(32), 2);
    for (std::size_t first = 0; first < ends.size(); first += batch_capacity)
        body(std::span(ends).subspan(first,
                                     std::min<std::size_t>(batch_capacity, ends.size() - first)));
}

template <class Body> void for_each_set_and_number(const Body& body)
{
    for (const std::string_view set : instruction_sets()) {
        SCOPED_TRACE(set);
        body(set, float{});
        body(set, double{});
    }
}

/// A point of a large floor, tilted or not, and a lamp whose centre stands so high over it, in
/// radii.
Scene floor_under_a_lamp(const Vec3<double>& n, double height, double radius)
{
    const Frame<double> frame = frame_around(n);
    const Light lamp = make_light(frame.x * 2.0 + n * (height * radius), radius, Vec3<double>(7));
    Scene scene = probe_under({lamp}, grey_floor());
    scene.probes[0].position = Vec3<double>(0);
    scene.probes[0].normal = scene.probes[0].outgoing = n;
    scene.surfaces.push_back(
        {Quad{(frame.x + frame.y) * -50.0, {frame.x * 100.0, frame.y * 100.0}}, 0});
    return scene;
}

constexpr std::array heights{3.0, 1.0, 0.4, 0.0, -0.4, -0.95, -1 + 1e-6};

template <class T> void expect_every_draw_is_the_answer(const Scene& scene, std::string_view set)
{
    const EmbreeTracer tracer(scene);
    const TestScene test(scene, &tracer, all_effects(scene));  // with shadow rays
    const Light& lamp = scene.lights[0];
    const auto n = vec_cast<T>(test.probes.points.at(0).n);
    const Cap<T> cap =
        cap_towards(vec_cast<T>(lamp.center), static_cast<T>(lamp.radius),
                    static_cast<T>(length2(lamp.center) - lamp.radius * lamp.radius));
    const double answer = 0.5 / pi<double> * static_cast<double>(lamp.radiance_radius.x) /
                          static_cast<double>(cap.distance) * static_cast<double>(cap.sin_max) *
                          static_cast<double>(irradiance_over_sin2(tilted(cap, n)));
    if (!(answer > 0)) return;  // rounded to below the horizon
    for (const char* name : {"all/light/projected", "irradiance/light/projected"}) {
        HalfWithNumbers<T> half(test, name, set);
        for_each_batch<T>([&](std::span<const Vec2<T>> u) {
            const Batch<T>& batch = half.run(u, T(0.5));
            for (std::size_t i = 0; i < u.size(); ++i)
                ASSERT_NEAR(batch.value.x[i] / answer, 1,
                            16 * static_cast<double>(std::numeric_limits<T>::epsilon()))
                    << name << ": " << u[i].x << ", " << u[i].y;
        });
    }
}

TEST(Horizon, EveryProjectedDrawIsTheClosedFormWhateverItsNumbersAre)
{
    const Vec3<double> tilt = normalized(Vec3<double>{0.3, -0.5, 0.8});
    for_each_set_and_number([&](std::string_view set, auto number) {
        for (const Vec3<double>& n : {Vec3<double>{0, 0, 1}, tilt})
            for (const double height : heights)
                for (const double radius : {1e-3, 0.1, 0.5, 1.9}) {
                    if (std::abs(height) * radius >= 2) continue;
                    SCOPED_TRACE(std::to_string(height) + " radii of " + std::to_string(radius) +
                                 (n.x == 0 ? "" : ", tilted"));
                    const Scene scene = floor_under_a_lamp(n, height, radius);
                    expect_every_draw_is_the_answer<decltype(number)>(scene, set);
                }
    });
}

/// What of the drawn direction is left: all but what is drawn below the horizon.
template <class T>
void expect_only_those_below_are_lost(const std::string& technique, const Material& material,
                                      const Vec3<double>& n, std::string_view set)
{
    Scene scene = probe_under({make_light({0, 0, 9}, 0.5, Vec3<double>(1))}, material);
    scene.probes[0].normal = n;
    scene.probes[0].outgoing = normalized(n + frame_around(n).x * 1.5);
    TestScene test(scene);
    if (test.probes.tiles.empty()) test.sample_the_dark();
    HalfWithNumbers<T> half(test, technique, set);
    const ScalarBsdf bsdf = scalar_bsdf(material);
    const Vec3<double> wo = frame_around(n).to_local(scene.probes[0].outgoing);
    const auto normal = vec_cast<T>(test.probes.points.at(0).n);
    for (const T lobe : {T(0), T(1) - std::numeric_limits<T>::epsilon()})
        for_each_batch<T>([&](std::span<const Vec2<T>> u) {
            const Batch<T>& batch = half.run(u, lobe, StageKind::draw);
            for (std::size_t i = 0; i < u.size(); ++i) {
                const double height =
                    technique != "brdf"
                        ? 1
                        : bsdf.sample(wo, static_cast<double>(lobe), Vec2<double>(u[i])).z;
                const Vec3<T> wi = batch.wi.at(static_cast<int>(i));
                ASSERT_TRUE(std::isfinite(wi.x + wi.y + wi.z));
                if (height > 1e-5) {
                    ASSERT_GT(batch.cos_theta[i], 0) << u[i].x << ", " << u[i].y;
                    ASSERT_GT(dot(normal, wi), 0);
                }
                if (height < -1e-5) {
                    ASSERT_EQ(wi, Vec3<T>(0)) << u[i].x << ", " << u[i].y;
                }
            }
        });
}

TEST(Horizon, NoDirectionDrawnAboveItIsLost)
{
    const Vec3<double> tilt = normalized(Vec3<double>{0.3, -0.5, 0.8});
    for_each_set_and_number([&](std::string_view set, auto number) {
        for (const char* type : {"lambert", "lecture", "blinn", "ggx"})
            for (const char* technique : {"brdf", "cosine", "hemisphere"})
                for (const Vec3<double>& n : {Vec3<double>{0, 0, 1}, tilt}) {
                    SCOPED_TRACE(std::string(type) + ", " + technique);
                    Material material{.type = type, .exponent = 40, .alpha = 0.3};
                    material.diffuse = Vec3<double>(0.3), material.specular = Vec3<double>(0.4);
                    expect_only_those_below_are_lost<decltype(number)>(technique, material, n, set);
                }
    });
}

template <class T> void expect_raised_only_at_the_horizon()
{
    const Vec3<T> n = normalized(Vec3<T>{T(0.3), T(-0.5), T(0.8)}), along = frame_around(n).x;
    const T ulp = std::numeric_limits<T>::epsilon();
    const Vec3<T> high = normalized(along + n * (16 * ulp)), low = normalized(along - n * ulp);
    EXPECT_EQ(kept_above(high, n, 16 * ulp), high);
    EXPECT_EQ(kept_above(high, n, ulp), high);  // as it was rounded
    EXPECT_GT(dot(n, kept_above(low, n, ulp)), 0);
    EXPECT_LE(length(kept_above(low, n, ulp) - low), 8 * ulp);
    EXPECT_EQ(kept_above(low, n, T(0)), low);  // is below, as it was drawn
}

TEST(Horizon, OnlyWhatIsWithinFourUlpOfItIsRaised)
{
    expect_raised_only_at_the_horizon<float>();
    expect_raised_only_at_the_horizon<double>();
}

}  // namespace
}  // namespace mis
