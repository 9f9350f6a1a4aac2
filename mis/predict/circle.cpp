#include "mis/predict/circle.h"

namespace mis {

std::array<PlanePoint, 2> tangent_points(const Circle& circle)
{
    const double far = std::hypot(circle.bx, circle.by);
    if (circle.is_great() || !(circle.sine < far)) return {};  // a great circle crosses them all
    const double toward = std::atan2(circle.by, circle.bx), half = std::asin(circle.sine / far);
    const double tau = circle.a != 0
                           ? std::sqrt(circle.c / circle.a)  // the double root where one touches
                           : infinity;
    return {{{toward - half, tau}, {toward + half, tau}}};
}

std::array<PlanePoint, 2> common_points(const Circle& p, const Circle& q)
{
    // q.a · p − p.a · q has no square in it: the line N·P = h through both points.
    const double nx = 4 * (q.a * p.bx - p.a * q.bx), ny = 4 * (q.a * p.by - p.a * q.by);
    const double h = q.a * p.c - p.a * q.c;
    const double norm = std::hypot(nx, ny);
    if (!(norm > 0)) return {};
    const double fx = nx / norm * (h / norm),
                 fy = ny / norm * (h / norm);  // foot of the pole on the line
    const double ux = -ny / norm, uy = nx / norm;
    // Along the line, foot + s·u, the rounder circle is a s² − 4 (b·u) s + (a f² − 4 b·f + c) = 0.
    const Circle& round = std::abs(p.a) > std::abs(q.a) ? p : q;
    const double b = round.bx * ux + round.by * uy;
    const double rest =
        round.a * (fx * fx + fy * fy) - 4 * (round.bx * fx + round.by * fy) + round.c;
    const double root2 = 4 * b * b - round.a * rest;
    if (!(root2 >= 0) || round.a == 0) return {};
    const double s1 = (2 * b + std::sqrt(root2)) / round.a,
                 s2 = (2 * b - std::sqrt(root2)) / round.a;
    const auto point = [&](double s) {
        const double x = fx + s * ux, y = fy + s * uy;
        return PlanePoint{std::atan2(y, x), std::hypot(x, y)};
    };
    return {point(s1), point(s2)};
}

}  // namespace mis
