#include "mis/io/mesh_builder.h"

#include "mis/scene/text.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace mis {
namespace {

constexpr std::uint32_t free_slot = std::numeric_limits<std::uint32_t>::max();

std::uint64_t mixed(std::uint64_t hash, std::uint64_t bits)
{
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15u;
    return hash ^ (hash >> 32);
}

/// −0 and 0 are equal, so they have one hash.
std::uint64_t hash_of(const Vec3<double>& position, const Vec3<float>& normal)
{
    std::uint64_t hash = 0;
    for (int i = 0; i < 3; ++i) hash = mixed(hash, std::bit_cast<std::uint64_t>(position[i] + 0.0));
    for (int i = 0; i < 3; ++i) hash = mixed(hash, std::bit_cast<std::uint32_t>(normal[i] + 0.0f));
    return hash;
}

}  // namespace

void MeshBuilder::add_polygon(std::span<const MeshCorner> polygon)
{
    if (polygon.size() == 3) {
        add_triangle({polygon[0], polygon[1], polygon[2]});
        return;
    }
    polygon_.clear();
    for (const MeshCorner& corner : polygon) polygon_.push_back(positions[corner.position]);
    if (!triangulate(polygon_, triangles_, stop_))
        throw PolygonError{{"", "a face that crosses itself",
                            "the outline of a face does not cross itself, seen along its normal",
                            "Cut the face into triangles."}};
    for (const auto& [a, b, c] : triangles_) add_triangle({polygon[a], polygon[b], polygon[c]});
}

void MeshBuilder::add_triangle(const std::array<MeshCorner, 3>& corners)
{
    check_();
    const std::array<Vec3<double>, 3> p{positions[corners[0].position],
                                        positions[corners[1].position],
                                        positions[corners[2].position]};
    const Vec3<double> area = area_vector(p[0], p[1], p[2]);
    if (area == Vec3<double>(0)) return;
    if (mesh_.triangles.size() >= limits::triangles)
        throw PolygonError{{"", "one more triangle than a scene may have",
                            "a scene has at most " + to_text(limits::triangles) + " triangles",
                            "Use a coarser mesh."}};
    const auto has_normal = [](const MeshCorner& c) { return c.normal != MeshCorner::no_normal; };
    if (!has_normals_ && std::any_of(corners.begin(), corners.end(), has_normal)) use_normals();
    std::array<std::uint32_t, 3> triangle;
    const Vec3<double> normal = has_normals_ ? unit_or_zero(area) : Vec3<double>(0);
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = vertex(corners[i], normal);
    mesh_.triangles.push_back(triangle);
}

/// From here on vertices have normals, so those of the triangles so far get theirs.
void MeshBuilder::use_normals()
{
    const Mesh flat = std::exchange(mesh_, {});
    has_normals_ = true;
    known_.clear();
    slots_.clear();
    for (std::array<std::uint32_t, 3> triangle : flat.triangles) {
        check_();
        const std::array<Vec3<double>, 3> p{
            flat.positions[triangle[0]], flat.positions[triangle[1]], flat.positions[triangle[2]]};
        const Vec3<float> normal =
            vec_cast<float>(transform_.place_normal(unit_or_zero(area_vector(p[0], p[1], p[2]))));
        for (std::size_t i = 0; i < 3; ++i) triangle[i] = vertex_of(p[i], normal);
        mesh_.triangles.push_back(triangle);
    }
}

std::uint32_t MeshBuilder::vertex(const MeshCorner& corner, const Vec3<double>& triangle_normal)
{
    const auto place = [&](const Vec3<double>& normal) {
        return vec_cast<float>(transform_.place_normal(normal));
    };
    const Vec3<double>& position = positions[corner.position];
    const bool is_flat = has_normals_ && (corner.normal == MeshCorner::no_normal ||
                                          normals[corner.normal] == Vec3<double>(0));
    if (is_flat) return vertex_of(position, place(triangle_normal));
    if (known_.size() < positions.size()) known_.resize(positions.size());
    Known& known = known_[corner.position];
    if (known.normal != corner.normal)
        known = {corner.normal, vertex_of(position, has_normals_ ? place(normals[corner.normal])
                                                                 : Vec3<float>(0))};
    return known.vertex;
}

/// The slot of a vertex, or the free one where it belongs.
std::size_t MeshBuilder::slot_of(const Vec3<double>& position, const Vec3<float>& normal) const
{
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash_of(position, normal) & mask;; slot = (slot + 1) & mask) {
        const std::uint32_t v = slots_[slot];
        if (v == free_slot ||
            (mesh_.positions[v] == position && (!has_normals_ || mesh_.normals[v] == normal)))
            return slot;
    }
}

void MeshBuilder::add_slots()
{
    // As a rule the file's positions are all there before the first face, and become a vertex each.
    const std::size_t expected = std::max(positions.size(), mesh_.positions.size());
    slots_.assign(std::bit_ceil(2 * std::max<std::size_t>(512, expected + 1)), free_slot);
    for (std::size_t v = 0; v < mesh_.positions.size(); ++v)
        slots_[slot_of(mesh_.positions[v], has_normals_ ? mesh_.normals[v] : Vec3<float>(0))] =
            static_cast<std::uint32_t>(v);
}

std::uint32_t MeshBuilder::vertex_of(const Vec3<double>& position, const Vec3<float>& normal)
{
    if (2 * (mesh_.positions.size() + 1) > slots_.size()) add_slots();
    std::uint32_t& slot = slots_[slot_of(position, normal)];
    if (slot == free_slot) {
        slot = static_cast<std::uint32_t>(mesh_.positions.size());
        mesh_.positions.push_back(position);
        if (has_normals_) mesh_.normals.push_back(normal);
    }
    return slot;
}

Mesh MeshBuilder::take()
{
    for (Vec3<double>& position : mesh_.positions) position = transform_.place(position);
    return std::move(mesh_);
}

}  // namespace mis
