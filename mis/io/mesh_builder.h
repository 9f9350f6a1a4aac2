#pragma once

#include "mis/io/transform.h"
#include "mis/io/triangulate.h"
#include "mis/math/stop_token.h"
#include "mis/scene/surface.h"
#include "mis/scene/validate.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace mis {

/// What a polygon is refused for; the reader adds the place.
struct PolygonError {
    Problem problem;
};

/// A corner of a polygon, as indices into the file's positions and normals.
struct MeshCorner {
    static constexpr std::uint32_t no_normal = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t position, normal = no_normal;
};

/// Makes a mesh of a file's polygons: cuts them into triangles, drops those without an area, and
/// makes one vertex of all that are equal to the last bit. Only vertices that a triangle uses are
/// kept. Readers append to `positions` and `normals`, as the file has them, before the polygons
/// that use them.
class MeshBuilder {
public:
    std::vector<Vec3<double>> positions, normals;

    MeshBuilder(const Transform& transform, const StopToken& stop)
        : transform_(transform), stop_(stop), check_(stop_, 1 << 14)
    {
    }
    MeshBuilder(const MeshBuilder&) = delete;
    MeshBuilder& operator=(const MeshBuilder&) = delete;

    /// Throws Stopped, and PolygonError for a polygon that crosses itself, and past
    /// limits::triangles.
    void add_polygon(std::span<const MeshCorner> polygon);
    void add_triangle(const std::array<MeshCorner, 3>& corners);

    /// The mesh, placed.
    Mesh take();

private:
    /// The vertices that a position of the file became: the last one only, which is as a rule the
    /// only one.
    struct Known {
        std::uint32_t normal = MeshCorner::no_normal - 1, vertex = 0;
    };

    std::uint32_t vertex(const MeshCorner& corner, const Vec3<double>& triangle_normal);
    std::uint32_t vertex_of(const Vec3<double>& position, const Vec3<float>& normal);
    void use_normals();
    void add_slots();
    std::size_t slot_of(const Vec3<double>& position, const Vec3<float>& normal) const;

    const Transform& transform_;
    StopToken stop_;
    StopEvery check_;
    Mesh mesh_;  ///< its positions are the file's until take()
    bool has_normals_ = false;
    std::vector<Known> known_;          ///< by position of the file
    std::vector<std::uint32_t> slots_;  ///< a hash table of mesh_'s vertices, open addressing
    std::vector<Vec3<double>> polygon_;
    std::vector<PolygonTriangle> triangles_;
};

}  // namespace mis
