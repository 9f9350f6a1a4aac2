#include "mis/io/triangulate.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

namespace mis {
namespace {

/// How far a coordinate may be off, relative to the largest one: some steps of a double, or what
/// six digits or single precision round away.
constexpr double double_rounding = 8 * std::numeric_limits<double>::epsilon();
constexpr double six_digits = 1e-6;

/// A bound of what that adds to the cross product of two differences of coordinates.
double cross_rounding(double off, double length_a, double length_b)
{
    return off * (length_a + length_b);
}

double largest_of(const Vec3<double>& v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

double largest_coordinate(std::span<const Vec3<double>> points)
{
    double largest = 0;
    for (const Vec3<double>& p : points) largest = std::max(largest, largest_of(p));
    return largest;
}

/// The plane polygon that one sees along its mean normal, counter-clockwise, its first corner at 0.
class View {
public:
    View(std::span<const Vec3<double>> polygon, double rounding)
        : off_(rounding * largest_coordinate(polygon))
    {
        const Vec3<double>& origin = polygon[0];
        Vec3<double> normal(0);
        double bound = 0;
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
            const Vec3<double> a = polygon[i] - origin, b = polygon[i + 1] - origin;
            normal += cross(a, b);
            bound += cross_rounding(off_, largest_of(a), largest_of(b));
        }
        if (!(largest_of(normal) > bound)) return;
        project(polygon, normal);
    }

    bool has_area() const { return !points_.empty(); }
    const std::vector<Vec2<double>>& points() const { return points_; }

    /// 1 where the corners a, b, c turn to the left, −1 to the right, 0 within rounding of a line.
    int turn(std::size_t a, std::size_t b, std::size_t c) const
    {
        const Vec2<double> u = points_[b] - points_[a], v = points_[c] - points_[a];
        const double area = u.x * v.y - u.y * v.x;
        const double bound = cross_rounding(off_, std::max(std::abs(u.x), std::abs(u.y)),
                                            std::max(std::abs(v.x), std::abs(v.y)));
        return area > bound ? 1 : area < -bound ? -1 : 0;
    }

private:
    /// Along the normal onto the plane of two axes, which leaves the corners of an upright polygon
    /// as they are.
    void project(std::span<const Vec3<double>> polygon, const Vec3<double>& normal)
    {
        const Vec3<double> size = abs(normal);
        const int z = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const int x = (z + 1) % 3, y = (z + 2) % 3;
        const double tilt_x = normal[x] / normal[z], tilt_y = normal[y] / normal[z];
        const double mirror = normal[z] > 0 ? 1 : -1;
        points_.reserve(polygon.size());
        for (const Vec3<double>& corner : polygon) {
            const Vec3<double> p = corner - polygon[0];
            points_.push_back({mirror * (p[x] - tilt_x * p[z]), p[y] - tilt_y * p[z]});
        }
    }

    double off_;  ///< how far a coordinate may be off
    std::vector<Vec2<double>> points_;
};

/// How much an ear may touch of the rest of the polygon. A polygon that touches nothing of itself
/// has an ear of the first kind for as long as there are four corners.
enum class Touching { nothing, sides, diagonal };

/// Cuts one ear after the other off a polygon.
class EarClipper {
public:
    EarClipper(const View& view, std::vector<PolygonTriangle>& triangles, const StopToken& stop)
        : view_(view), points_(view.points()), triangles_(triangles), left_(points_.size()),
          check_(stop, 256), before_(left_), after_(left_), by_x_(left_)
    {
        for (std::size_t i = 0; i < left_; ++i) {
            after_[i] = (i + 1) % left_;
            before_[after_[i]] = by_x_[i] = i;
        }
        std::sort(by_x_.begin(), by_x_.end(),
                  [&](std::size_t a, std::size_t b) { return points_[a].x < points_[b].x; });
    }

    bool clip_all()
    {
        drop_spikes(by_x_);
        clip_ears(Touching::nothing);
        while (left_ > 3) {
            const std::size_t before = left_;
            drop_flat_corners();
            if (left_ == before) clip_ears(Touching::sides);
            if (left_ == before) clip_ears(Touching::diagonal);
            if (left_ == before) return false;
            clip_ears(Touching::nothing);
        }
        const int last = left_ == 3 ? turn_at(first_) : 0;
        if (last > 0) triangles_.push_back({before_[first_], first_, after_[first_]});
        return last >= 0;
    }

private:
    int turn_at(std::size_t corner) const
    {
        return view_.turn(before_[corner], corner, after_[corner]);
    }

    /// Every ear that there is, and that comes to be; every second corner first, so that no corner
    /// gets all triangles.
    void clip_ears(Touching allowed)
    {
        std::deque<std::size_t> open;
        for (const std::size_t parity : {1, 0})
            for (std::size_t i = parity; i < after_.size(); i += 2)
                if (after_[i] != removed) open.push_back(i);
        for (; left_ > 3 && !open.empty(); open.pop_front()) {
            const std::size_t tip = open.front();
            if (after_[tip] == removed || turn_at(tip) <= 0 || is_blocked(tip, allowed)) continue;
            triangles_.push_back({before_[tip], tip, after_[tip]});
            open.push_back(before_[tip]);
            open.push_back(after_[tip]);
            remove(tip);
            drop_spikes({open.back(), *(open.end() - 2)});
            if (allowed != Touching::nothing) return;
        }
    }

    /// Whether the outline turns back at a corner, or stays there.
    bool is_spike(std::size_t corner) const
    {
        return turn_at(corner) == 0 && dot(points_[before_[corner]] - points_[corner],
                                           points_[after_[corner]] - points_[corner]) >= 0;
    }

    /// What is left of a bridge once there is nothing more at its end is no part of an ear.
    void drop_spikes(std::vector<std::size_t> open)
    {
        while (left_ > 3 && !open.empty()) {
            const std::size_t corner = open.back();
            open.pop_back();
            if (after_[corner] == removed || !is_spike(corner)) continue;
            open.push_back(before_[corner]);
            open.push_back(after_[corner]);
            remove(corner);
        }
    }

    /// Corners on the line of their neighbours.
    void drop_flat_corners()
    {
        for (std::size_t i = 0; i < after_.size() && left_ > 3; ++i)
            if (after_[i] != removed && turn_at(i) == 0) remove(i);
    }

    void remove(std::size_t corner)
    {
        const std::size_t next = after_[corner];
        after_[before_[corner]] = next;
        before_[next] = before_[corner];
        after_[corner] = removed;
        first_ = next;
        --left_;
    }

    bool is_blocked(std::size_t tip, Touching allowed)
    {
        check_();
        const std::size_t a = before_[tip], c = after_[tip];
        const auto [low, high] = std::minmax({points_[a].x, points_[tip].x, points_[c].x});
        const auto first =
            std::lower_bound(by_x_.begin(), by_x_.end(), low,
                             [&](std::size_t corner, double x) { return points_[corner].x < x; });
        for (auto p = first; p != by_x_.end() && points_[*p].x <= high; ++p)
            if (after_[*p] != removed && blocks(*p, a, tip, c, allowed)) return true;
        return false;
    }

    /// Whether corner p lies in the ear a, b, c. Where it coincides with one of the three, its own
    /// sides say more, and the next corner along them is asked in its turn.
    bool blocks(std::size_t p, std::size_t a, std::size_t b, std::size_t c, Touching allowed) const
    {
        if (p == a || p == b || p == c) return false;
        if (points_[p] == points_[a] || points_[p] == points_[b] || points_[p] == points_[c])
            return false;
        const int ab = view_.turn(a, b, p);
        if (ab < 0) return false;
        const int bc = view_.turn(b, c, p), ca = view_.turn(c, a, p);
        if (bc < 0 || ca < 0) return false;
        if (allowed == Touching::nothing) return true;
        return ab > 0 && bc > 0 && (ca > 0 || allowed == Touching::sides);
    }

    static constexpr std::size_t removed = std::numeric_limits<std::size_t>::max();

    const View& view_;
    const std::vector<Vec2<double>>& points_;
    std::vector<PolygonTriangle>& triangles_;
    std::size_t left_, first_ = 0;  ///< of the corners still there: how many, and one of them
    StopEvery check_;
    std::vector<std::size_t> before_, after_;  ///< the corners still there, in a ring
    std::vector<std::size_t> by_x_;            ///< all corners
};

/// One of the two diagonals of a quadrilateral; the first wherever both do.
bool halve(const View& view, std::vector<PolygonTriangle>& triangles)
{
    const int left = view.turn(0, 1, 2), right = view.turn(0, 2, 3);
    const int upper = view.turn(1, 2, 3), lower = view.turn(0, 1, 3);
    const auto add = [&](int area, const PolygonTriangle& triangle) {
        if (area > 0) triangles.push_back(triangle);
    };
    const bool by_first = left > 0 && right > 0, by_second = upper > 0 && lower > 0;
    if (by_first || (!by_second && left >= 0 && right >= 0)) {
        add(left, {0, 1, 2});
        add(right, {0, 2, 3});
        return true;
    }
    if (upper < 0 || lower < 0) return false;
    add(lower, {0, 1, 3});
    add(upper, {1, 2, 3});
    return true;
}

/// Normal times twice the area of a triangle; 0 within the rounding of coordinates that are off by
/// so much.
Vec3<double> area_beyond(double off, const Vec3<double>& a, const Vec3<double>& b,
                         const Vec3<double>& c)
{
    const Vec3<double> u = b - a, v = c - a, area = cross(u, v);
    return largest_of(area) > cross_rounding(off, largest_of(u), largest_of(v)) ? area
                                                                                : Vec3<double>(0);
}

/// Whether no three corners span a triangle with the first.
bool is_on_a_line(std::span<const Vec3<double>> polygon, double rounding)
{
    const double off = rounding * largest_coordinate(polygon);
    const auto farthest = std::max_element(
        polygon.begin(), polygon.end(), [&](const Vec3<double>& a, const Vec3<double>& b) {
            return length(a - polygon[0]) < length(b - polygon[0]);
        });
    return std::all_of(polygon.begin(), polygon.end(), [&](const Vec3<double>& p) {
        return area_beyond(off, polygon[0], *farthest, p) == Vec3<double>(0);
    });
}

/// triangulate() of coordinates that are rounded so.
bool cut(std::span<const Vec3<double>> polygon, double rounding,
         std::vector<PolygonTriangle>& triangles, const StopToken& stop)
{
    triangles.clear();
    const View view(polygon, rounding);
    if (!view.has_area()) return is_on_a_line(polygon, rounding);
    if (polygon.size() == 4) return halve(view, triangles);
    return EarClipper(view, triangles, stop).clip_all();
}

}  // namespace

Vec3<double> area_vector(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c)
{
    const double largest = std::max({largest_of(a), largest_of(b), largest_of(c)});
    return area_beyond(double_rounding * largest, a, b, c);
}

bool triangulate(std::span<const Vec3<double>> polygon, std::vector<PolygonTriangle>& triangles,
                 const StopToken& stop)
{
    triangles.clear();
    if (polygon.size() < 3) return true;
    if (polygon.size() == 3) {
        triangles.push_back({0, 1, 2});
        return true;
    }
    return cut(polygon, double_rounding, triangles, stop) ||
           cut(polygon, six_digits, triangles, stop);
}

}  // namespace mis
