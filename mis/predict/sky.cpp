#include "mis/predict/sky.h"

#include "mis/trace/intersect.h"

#include <algorithm>
#include <cmath>

namespace mis {

namespace {

void measure(Ball& ball)
{
    const double d = length(ball.to_center);
    ball.cap = cap_towards(ball.to_center, ball.radius, (d - ball.radius) * (d + ball.radius));
    ball.sin_max = ball.cap.sin_max;
    ball.one_minus_cos = ball.cap.one_minus_cos();
}

Ball light_ball(const Light& light, LightIndex index, const Vec3<double>& x)
{
    Ball ball{.to_center = light.center - x,
              .radius = light.radius,
              .light = index,
              .radiance = radiance(light)};
    measure(ball);
    return ball;
}

/// A surface as the engine's shadow rays see it: they start off the surface that the point lies on,
/// along n.
Ball surface_ball(const SphereSurface& sphere, const Probe& probe)
{
    Ball ball{.to_center = sphere.center - probe.position, .radius = sphere.radius};
    const double d = length(ball.to_center);
    const double largest = std::max(largest_coordinate(probe.position),
                                    largest_coordinate(sphere.center) + sphere.radius);
    const bool is_on = std::abs(d - sphere.radius) <= 4 * float_offset(largest);
    const bool looks_out = dot(ball.to_center, probe.normal) <= 0;
    if (d > sphere.radius && !is_on) {
        measure(ball);
    } else if (is_on && looks_out) {
        ball.stands = Ball::Stands::beneath;
        ball.cap.axis = ball.to_center / d;
        ball.sin_max = ball.one_minus_cos = 1;
    } else {
        ball.stands = Ball::Stands::around;
        ball.cap.gap2 = std::min((d - ball.radius) * (d + ball.radius), 0.0);
    }
    return ball;
}

double half_angle(const Ball& ball)
{
    return 2 * std::asin(std::min(1.0, std::sqrt(ball.one_minus_cos / 2)));
}

}  // namespace

namespace {

std::vector<int> neighbours_of(const Sky& sky, std::size_t light)
{
    const Ball& self = sky.balls[light];
    const double half = half_angle(self);
    std::vector<int> found;
    for (std::size_t k = 0; k < sky.balls.size(); ++k) {
        const Ball& other = sky.balls[k];
        if (k == light) continue;
        // Most stand far apart: the cosine says so without an arc sine.
        const double sum = half + half_angle(other);
        const bool is_far = other.stands == Ball::Stands::apart && sum < 3 &&
                            dot(self.cap.axis, other.cap.axis) < std::cos(sum) - 1e-9;
        if (!is_far && (other.stands != Ball::Stands::apart || overlap(self, other)))
            found.push_back(static_cast<int>(k));
    }
    return found;
}

}  // namespace

Sky sky_of(const Scene& scene, const Probe& probe, const StopToken& stop)
{
    Sky sky{.n = probe.normal, .lights = scene.lights.size()};
    sky.balls.reserve(scene.lights.size() + scene.surfaces.size());
    for (std::size_t j = 0; j < scene.lights.size(); ++j) {
        sky.balls.push_back(
            light_ball(scene.lights[j], static_cast<LightIndex>(j), probe.position));
        sky.is_dark = sky.is_dark || !(length(sky.balls.back().to_center) > scene.lights[j].radius);
    }
    for (const Surface& surface : scene.surfaces)
        if (const auto* sphere = std::get_if<SphereSurface>(&surface.shape))
            sky.balls.push_back(surface_ball(*sphere, probe));
    sky.neighbours.resize(sky.lights);
    for (std::size_t j = 0; j < sky.lights && !sky.is_dark; ++j) {
        stop.check();
        sky.neighbours[j] = neighbours_of(sky, j);
    }
    return sky;
}

Vec3<double> between_axes(const Ball& a, const Ball& b)
{
    if (a.stands != Ball::Stands::apart || b.stands != Ball::Stands::apart)
        return b.cap.axis - a.cap.axis;
    const Vec3<double> step = b.to_center - a.to_center;
    const double longer =
        dot(step, a.to_center + b.to_center) / (a.cap.distance + b.cap.distance);  // d_b − d_a
    return (step - a.cap.axis * longer) / b.cap.distance;
}

bool overlap(const Ball& a, const Ball& b)
{
    const double chord = length(between_axes(a, b));
    const double angle = 2 * std::asin(std::min(1.0, chord / 2));
    return angle <= (half_angle(a) + half_angle(b)) * (1 + 1e-12);
}

bool interlock(const Ball& a, const Ball& b)
{
    const double apart = length(a.to_center - b.to_center);
    return apart <= a.radius + b.radius && apart >= std::abs(a.radius - b.radius);
}

bool could_hide(const Ball& front, const Ball& back)
{
    if (front.stands == Ball::Stands::beneath)
        return dot(front.cap.axis, back.cap.axis) > -back.sin_max;
    if (front.stands == Ball::Stands::around)
        return length(front.to_center - back.to_center) + back.radius >= front.radius;
    if (!overlap(front, back)) return false;
    // A ray meets `back` no farther off than where it touches the sphere.
    return front.cap.distance - front.radius < std::sqrt(back.cap.gap2) || interlock(front, back);
}

bool is_above(const Ball& ball, const Vec3<double>& n)
{
    return dot(n, ball.cap.axis) >= ball.sin_max;
}
bool is_below(const Ball& ball, const Vec3<double>& n)
{
    return dot(n, ball.cap.axis) <= -ball.sin_max;
}

}  // namespace mis
