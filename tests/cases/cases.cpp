#include "tests/cases/cases.h"

#include "tests/predict/predict_cases.h"
#include "tests/support/scenes.h"
#include "tests/support/uniforms.h"

#include <numbers>

namespace mis {

namespace {

constexpr double quarter_turn = std::numbers::pi / 2;

Material glossy(const std::string& type, double exponent, double alpha)
{
    Material material;
    material.type = type, material.exponent = exponent, material.alpha = alpha;
    material.diffuse = {0.1, 0.2, 0.1}, material.specular = {0.5, 0.4, 0.6};
    return material;
}

Vec3<double> grey(double radiance) { return Vec3<double>(radiance); }

/// Cases in the order in which they are added; each has its probe at the origin, normal +z.
class Cases {
public:
    Case& add(const std::string& name, const std::string& why, const Lights& lights,
              const Material& material = lambert(0.5), double outgoing = 0.3)
    {
        // What the engine keeps as floats is a float here: the rest is the engine's own.
        const Vec3<double> wo = direction(outgoing, std::numbers::pi);
        Scene scene = empty_scene(material, vec_cast<double>(vec_cast<float>(wo)));
        scene.lights = lights;
        return add(name, why, std::move(scene));
    }
    Case& add(const std::string& name, const std::string& why, Scene scene)
    {
        scene.name = name;
        list_.push_back({name, why, std::move(scene)});
        return list_.back();
    }
    void add_dark(const std::string& name, const std::string& why, const Lights& lights,
                  const Material& material = lambert(0.5))
    {
        add(name, why, lights, material).is_dark = true;
    }
    std::vector<Case> take() { return std::move(list_); }

private:
    std::vector<Case> list_;
};

/// A plain lamp, so that there is a choice to make.
Light lamp() { return light_at(direction(0.7, 2.5), 0.15, 2); }

void add_sizes(Cases& cases)
{
    struct Size {
        const char* name;
        double half_angle;
    };
    for (const auto& [name, half_angle] :
         {Size{"cap_1e-8", 1e-8}, Size{"cap_1e-6", 1e-6}, Size{"cap_1e-4", 1e-4},
          Size{"cap_1e-2", 1e-2}, Size{"cap_1", 1.0}, Size{"cap_89.9_degrees", 1.5690},
          Size{"cap_89.999_degrees", 1.57078}})
        cases.add(name, "its solid angle is 2*pi*(1 - cos), which cancels at one end or the other",
                  {make_light(direction(0.4) * 2.0, 2 * std::sin(half_angle),
                              grey(std::pow(std::sin(half_angle), -2))),
                   lamp()});
    cases
        .add("sky_of_one_light", "the point is 1e-13 radii under a light that fills the sky",
             {make_light({0, 0, 1 + 1e-13}, 1, grey(2))})
        .cosine_ties = true;
    cases.add("radius_1e-20",
              "the square of its radius is no normal float, and its radiance is huge",
              {make_light_of_power(direction(0.4) * 2.0, 1e-20, grey(40)), lamp()});
    cases.add("radius_1e6_nearby", "d - r is a millionth of either",
              {make_light(direction(0.2) * (1e6 + 1), 1e6, grey(1)), lamp()},
              glossy("blinn", 40, 0));
    cases.add("sun_and_lamp", "distances of 1.5e11 and 1 in one scene",
              {make_light(direction(0.5) * 1.5e11, 7e8, grey(4e4)),
               make_light(direction(0.6, 2), 0.1, grey(20))},
              glossy("ggx", 0, 0.3));
    cases.add("radiance_ratio_1e12", "the dim light must not be lost beside the bright one",
              {light_at(direction(0.5), 1e-6, 1e12), light_at(direction(0.6, 2), 0.3, 1)});
}

void add_near_points(Cases& cases)
{
    const Light ball = make_light(direction(0.4), 1, grey(2));
    const auto at = [&](double distance) { return make_light(ball.center * distance, 1, grey(2)); };
    cases.add("just_above_a_light", "the point is 1e-6 radii above the light",
              {at(1 + 1e-6), lamp()}, glossy("lecture", 20, 0));
    cases.add("a_thousandth_above_a_light", "the light fills all but a rim of the sky",
              {at(1 + 1e-3), lamp()}, glossy("blinn", 50, 0));
    cases.add_dark("on_a_light", "a point on a light sees its dark inner side alone",
                   {make_light({0, 0, 1}, 1, grey(2)), lamp()});
    cases.add_dark("inside_a_light", "a point inside a light sees its dark inner side alone",
                   {at(0.5), lamp()});
}

void add_horizon(Cases& cases)
{
    const auto low = [](double height, double half_angle, double radiance = 3) {
        return light_at(direction(quarter_turn - height * half_angle), half_angle, radiance);
    };
    cases.add("tangent_to_the_horizon_from_above", "its lowest direction has cos 0",
              {low(1, 0.3), lamp()}, glossy("blinn", 10, 0));
    cases.add("cut_by_the_horizon", "half of its draws are lost", {low(0, 0.3), lamp()},
              glossy("ggx", 0, 0.4));
    cases.add("small_and_cut_by_the_horizon", "all of its directions are nearly grazing",
              {low(0.2, 1e-3, 1e8), lamp()});
    cases.add("a_sliver_above_the_horizon", "all but a thousandth of its height is below",
              {low(-0.999, 0.3, 1e6), lamp()});
    cases.add("tangent_to_the_horizon_from_below", "it touches the horizon, and gives nothing",
              {low(-1, 0.3), lamp()});
    cases.add_dark("just_below_the_horizon", "all lights are out of sight by a millionth",
                   {low(-1.000001, 0.3), low(-1.000001, 1e-3)}, glossy("ggx", 0, 0.2));
    cases.add_dark("all_lights_behind", "every light is below the horizon",
                   {low(-2, 0.3), low(-5, 0.2), light_at(direction(3), 0.1, 1)},
                   glossy("blinn", 100, 0));
}

void add_lobes(Cases& cases)
{
    const auto at = [](double theta) { return light_at(direction(theta), 0.1, 1); };
    const Material sharp = glossy("blinn", 1e6, 0), mirror = glossy("ggx", 0, 1e-4);
    cases.add("m_1e6_inside_a_light", "the lobe is a hundredth as wide as the light",
              {at(0.45), lamp()}, sharp, 0.5);
    cases.add("m_1e6_at_the_edge_of_a_light", "the edge of the light cuts the lobe",
              {at(0.4), lamp()}, sharp, 0.5);
    cases.add("m_1e6_off_a_light", "no light is in the lobe", {at(0.35), lamp()}, sharp, 0.5);
    cases.add("lecture_m_1e6", "its lobe is not normalised, and next to nothing",
              {at(0.45), lamp()}, glossy("lecture", 1e6, 0), 0.5);
    cases.add("alpha_1e-4_inside_a_light", "a mirror but for 1e-4 rad", {at(0.45), lamp()}, mirror,
              0.5);
    cases.add("alpha_1e-4_at_the_edge_of_a_light",
              "the edge of the light cuts such a mirror's lobe", {at(0.4), lamp()}, mirror, 0.5);
    cases.add("light_as_wide_as_the_lobe", "light and lobe are 2e-4 rad wide",
              {light_at(direction(0.5001), 2e-4, 1e6), lamp()}, mirror, 0.5);
    cases.add("grazing_lambert", "the viewer is 1e-4 rad above the surface", {at(1.3), lamp()},
              lambert(0.5), quarter_turn - 1e-4);
    cases.add("grazing_blinn", "so flat that half of the lobe is below the horizon",
              {at(1.5), lamp()}, glossy("blinn", 100, 0), quarter_turn - 1e-3);
    cases.add("grazing_ggx", "so flat that Fresnel and masking are near their ends",
              {at(1.5), lamp()}, glossy("ggx", 0, 0.05), quarter_turn - 1e-4);
}

void add_overlaps(Cases& cases)
{
    const Light big = light_at(direction(0.5), 0.5, 1, 4), small = light_at(direction(0.4), 0.1, 5);
    cases.add("big_behind_small", "the small light hides a part of the big one", {big, small},
              glossy("ggx", 0, 0.3));
    cases.add("small_behind_big", "the small light is hidden altogether",
              {light_at(direction(0.5), 0.5, 1, 2), light_at(direction(0.4), 0.1, 5, 9)});
    cases.add("coincident", "at equal distance the light listed first is nearer",
              {small, small, make_light(small.center, small.radius, grey(7)), lamp()});
    cases.add("interlocked", "two spheres change places along a curve",
              {make_light({0.2, 0, 2}, 0.8, grey(1)), make_light({0.9, 0.3, 1.7}, 0.7, grey(3)),
               make_light({0.5, -0.5, 1.9}, 0.75, grey(0.5))},
              glossy("ggx", 0, 0.3), 0.7);
    cases.add("nested", "a light within a light is never seen",
              {make_light({0, 0.5, 2}, 0.8, grey(1)), make_light({0, 0.5, 2.2}, 0.3, grey(9))});
    cases.add("black_before_bright", "a black light hides, and is worth no draw",
              {light_at(direction(0.4), 0.08, 0, 1), light_at(direction(0.5), 0.2, 3), lamp()});
    cases.add_dark("black_lights_alone", "no light shines",
                   {light_at(direction(0.4), 0.2, 0), light_at(direction(0.9), 0.1, 0)},
                   glossy("blinn", 30, 0));
}

/// Small lights all over the back of a black ball, and one beside it.
Lights hidden_crowd()
{
    Lights lights;
    for (int i = 0; i < 40; ++i)
        lights.push_back(light_at(direction(0.3 * std::sqrt((i + 0.5) / 40), 2.4 * i), 1e-3,
                                  1 + i % 7, 3 + 0.01 * (i % 50)));
    lights.push_back(light_at(direction(0.9, 1), 0.1, 2));
    lights.push_back(light_at(direction(0), 0.35, 0));
    return lights;
}

Lights crowd_below()
{
    Uniforms u(3);
    Lights lights;
    for (int i = 0; i < 999; ++i)
        lights.push_back(light_at(direction(u.between(1.8, 3.1), u.between(0, 6)),
                                  u.log_between(1e-3, 0.1), u.log_between(1, 100)));
    lights.insert(lights.begin() + 500, light_at(direction(0.6, 1), 0.2, 2));
    return lights;
}

/// Three lamps about a point, from one apart to close by.
Lights lamps_about(const Vec3<double>& x, double unit)
{
    return {make_light(x + direction(0.5) * unit, 0.2 * unit, grey(3)),
            make_light(x + direction(0.7, 2) * (0.5 * unit), 1e-3 * unit, grey(1e5)),
            make_light(x + direction(1.1, 4) * unit, 0.1 * unit, {9, 6, 3})};
}

void add_places(Cases& cases)
{
    const Vec3<double> far{1e6, -1e6, 1e6};
    Scene scene = empty_scene(glossy("blinn", 30, 0), direction(0.4, 3));
    scene.probes[0].position = far;
    scene.lights = lamps_about(far, 1);
    cases.add("far_from_the_origin", "1e6 units out, details of 1e-3 must survive", scene);
    scene.lights = lamps_about(far, 1e-2);
    cases.add("small_and_far_from_the_origin", "1e6 units out, lights 1e-5 units wide", scene);
    for (const double unit : {1e-6, 1e6})
        cases.add(unit < 1 ? "scaled_by_1e-6" : "scaled_by_1e6", "lengths in other units",
                  lamps_about(Vec3<double>(0), unit), glossy("ggx", 0, 0.2));
    cases.add("one_of_a_thousand_above", "999 lights are below the horizon", crowd_below());
    cases.add("one_beside_forty_hidden", "forty lights stand behind a black ball", hidden_crowd());
}

}  // namespace

std::vector<Case> hard_cases()
{
    Cases cases;
    add_sizes(cases);
    add_near_points(cases);
    add_horizon(cases);
    add_lobes(cases);
    add_overlaps(cases);
    add_places(cases);
    return cases.take();
}

std::vector<Case> ordinary_cases()
{
    Cases cases;
    cases.add("three_lamps", "nothing", probe_under(three_lights_apart(), grey_floor()));
    cases.add("eclipse", "a lamp stands before the middle of another",
              probe_under(eclipse(), grey_floor()));
    for (unsigned seed = 0; seed < 12; ++seed)
        cases.add("random_" + std::to_string(seed), "a random scene; every third has an occluder",
                  random_scene(seed));
    return cases.take();
}

std::vector<Case> all_cases()
{
    std::vector<Case> all = ordinary_cases();
    for (Case& hard : hard_cases()) all.push_back(std::move(hard));
    return all;
}

}  // namespace mis
