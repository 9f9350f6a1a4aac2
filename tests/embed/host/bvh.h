#pragma once

#include "vec.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace host {

struct Ray {
    Vec origin, direction;  ///< unit
    float end = std::numeric_limits<float>::infinity();
};

/// A triangle, or a sphere where edges are 0 and the radius is not.
struct Primitive {
    Vec at, edge1, edge2;  ///< a corner, or the centre
    float radius = 0;
    int material = 0;

    /// Where a ray hits it before ray.end, or infinity.
    float hit(const Ray& ray) const { return radius > 0 ? hit_sphere(ray) : hit_triangle(ray); }
    Vec normal(const Vec& x) const { return unit(radius > 0 ? x - at : cross(edge1, edge2)); }
    std::array<Vec, 2> box() const
    {
        const Vec r{radius, radius, radius}, a = at - r, b = at + r;
        const auto corner = [&](auto pick, float Vec::*axis) {
            return pick(pick(a.*axis, b.*axis), pick((at + edge1).*axis, (at + edge2).*axis));
        };
        const auto low = [](float s, float t) { return std::min(s, t); };
        const auto high = [](float s, float t) { return std::max(s, t); };
        return {Vec{corner(low, &Vec::x), corner(low, &Vec::y), corner(low, &Vec::z)},
                Vec{corner(high, &Vec::x), corner(high, &Vec::y), corner(high, &Vec::z)}};
    }

private:
    static constexpr float never = std::numeric_limits<float>::infinity();

    float hit_sphere(const Ray& ray) const
    {
        const Vec to_center = at - ray.origin;
        const float middle = dot(to_center, ray.direction);
        const Vec off = to_center - ray.direction * middle;
        const float half2 = radius * radius - dot(off, off);
        if (!(half2 > 0)) return never;
        const float half = std::sqrt(half2);
        const float t = middle - half > 0 ? middle - half : middle + half;
        return t > 0 && t < ray.end ? t : never;
    }
    float hit_triangle(const Ray& ray) const  // Möller and Trumbore 1997
    {
        const Vec p = cross(ray.direction, edge2), s = ray.origin - at, q = cross(s, edge1);
        const float inverse = 1 / dot(edge1, p);
        const float u = dot(s, p) * inverse, v = dot(ray.direction, q) * inverse;
        const float t = dot(edge2, q) * inverse;
        return u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < ray.end ? t : never;
    }
};

/// Boxes around primitives, halved at the middle one along their longest axis.
class Bvh {
public:
    explicit Bvh(std::vector<Primitive> primitives) : primitives_(std::move(primitives))
    {
        if (!primitives_.empty()) build(0, static_cast<int>(primitives_.size()));
    }
    const Primitive& operator[](int i) const { return primitives_[static_cast<std::size_t>(i)]; }

    /// The nearest primitive before ray.end, which becomes its distance; −1 without one.
    int nearest(Ray& ray) const
    {
        int found = -1;
        walk(ray, [&](int i) {
            const float t = (*this)[i].hit(ray);
            if (t < ray.end) ray.end = t, found = i;
            return false;
        });
        return found;
    }
    bool is_occluded(Ray ray) const
    {
        return walk(ray, [&](int i) { return (*this)[i].hit(ray) < ray.end; });
    }

private:
    static constexpr int leaf_size = 2;
    struct Node {
        std::array<Vec, 2> box;
        int first, count;  ///< primitives; of an inner node, count is 0
        int second;        ///< the other child; the first follows its parent
    };

    int build(int first, int count)
    {
        Node node{box_of(first, count), first, count, 0};
        const auto place = static_cast<int>(nodes_.size());
        nodes_.push_back(node);
        if (count <= leaf_size) return place;
        const Vec size = node.box[1] - node.box[0];
        float Vec::*const axis = size.x > size.y && size.x > size.z ? &Vec::x
                                 : size.y > size.z                  ? &Vec::y
                                                                    : &Vec::z;
        const auto begin = primitives_.begin() + first;
        std::nth_element(begin, begin + count / 2, begin + count,
                         [=](const Primitive& a, const Primitive& b) {
                             const auto p = a.box(), q = b.box();
                             return (p[0] + p[1]).*axis < (q[0] + q[1]).*axis;
                         });
        build(first, count / 2);
        node.second = build(first + count / 2, count - count / 2);
        node.count = 0;
        nodes_[static_cast<std::size_t>(place)] = node;
        return place;
    }
    std::array<Vec, 2> box_of(int first, int count) const
    {
        std::array<Vec, 2> all = (*this)[first].box();
        for (int i = first + 1; i < first + count; ++i) {
            const auto [low, high] = (*this)[i].box();
            for (float Vec::*axis : {&Vec::x, &Vec::y, &Vec::z}) {
                all[0].*axis = std::min(all[0].*axis, low.*axis);
                all[1].*axis = std::max(all[1].*axis, high.*axis);
            }
        }
        return all;
    }
    /// visit(i) for primitives whose box the ray meets, until it says true.
    template <class Visit> bool walk(const Ray& ray, const Visit& visit) const
    {
        if (nodes_.empty()) return false;
        std::array<int, 64> open{};
        int height = 1;
        const Vec inverse{1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z};
        while (height > 0) {
            const int at = open[static_cast<std::size_t>(--height)];
            const Node& node = nodes_[static_cast<std::size_t>(at)];
            if (!meets(node.box, ray, inverse)) continue;
            for (int i = node.first; i < node.first + node.count; ++i)
                if (visit(i)) return true;
            if (node.count > 0) continue;
            open[static_cast<std::size_t>(height++)] = node.second;
            open[static_cast<std::size_t>(height++)] = at + 1;
        }
        return false;
    }
    static bool meets(const std::array<Vec, 2>& box, const Ray& ray, const Vec& inverse)
    {
        float begin = 0, end = ray.end;
        for (float Vec::*axis : {&Vec::x, &Vec::y, &Vec::z}) {
            const float a = (box[0].*axis - ray.origin.*axis) * inverse.*axis;
            const float b = (box[1].*axis - ray.origin.*axis) * inverse.*axis;
            begin = std::max(begin, std::min(a, b)), end = std::min(end, std::max(a, b));
        }
        return begin <= end * 1.000001F;
    }

    std::vector<Primitive> primitives_;
    std::vector<Node> nodes_;
};

}  // namespace host
