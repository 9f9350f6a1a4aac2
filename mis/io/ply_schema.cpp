#include "mis/io/ply_schema.h"

#include "mis/io/mesh_builder.h"
#include "mis/io/scene_error.h"
#include "mis/io/text_file.h"
#include "mis/scene/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace mis {
namespace {

[[noreturn]] void fail_on_header(const std::filesystem::path& file, std::string found,
                                 std::string allowed)
{
    throw SceneError(file.string(),
                     Problem{"", std::move(found), std::move(allowed), "Mend the file."});
}

constexpr std::array<std::string_view, 6> vertex_numbers{"x", "y", "z", "nx", "ny", "nz"};

bool holds_triangles(const PlyElement& element)
{
    return element.name == "face" || element.name == "tristrips";
}

bool is_index_list(const PlyProperty& property)
{
    return property.name == "vertex_indices" || property.name == "vertex_index";
}

/// How many of the properties x, y, z, or nx, ny, nz, an element has.
std::ptrdiff_t count_of(const PlyElement& element, int first_role)
{
    return std::count_if(element.properties.begin(), element.properties.end(), [&](const auto& p) {
        const int role = role_of(element, p);
        return role >= first_role && role < first_role + 3;
    });
}

void require_properties(const PlyElement& element, const std::filesystem::path& file)
{
    const std::string name = in_quotes(element.name);
    std::ptrdiff_t lists = 0;
    for (const PlyProperty& property : element.properties) {
        const int role = role_of(element, property);
        lists += role == ply_role::list ? 1 : 0;
        if (role != ply_role::ignored &&
            (role == ply_role::list) != property.count_type.has_value())
            fail_on_header(file,
                           fmt::format("the property {} of {} as a {}", in_quotes(property.name),
                                       name, property.count_type ? "list" : "number"),
                           "x, y, z, nx, ny, nz are numbers, vertex_indices is a list");
    }
    if (holds_triangles(element) && lists != 1 && element.count > 0)
        fail_on_header(file, fmt::format("{} with {} lists of vertices", name, lists),
                       "a face or strip has one list, vertex_indices or vertex_index");
    if (element.name != "vertex") return;
    if (element.count >= MeshCorner::no_normal)
        fail_on_header(file, many(element.count, "vertex"),
                       fmt::format("a mesh has less than {} vertices", MeshCorner::no_normal));
    if (count_of(element, 0) != 3)
        fail_on_header(file, name + " without x, y or z", "a vertex has x, y and z");
    if (count_of(element, 3) % 3 != 0)
        fail_on_header(file, name + " with a part of a normal",
                       "a normal is nx, ny and nz, all three or none");
}

void require_elements(const PlyHeader& header, const std::filesystem::path& file)
{
    const auto has = [&](const auto& rule) {
        return std::any_of(header.elements.begin(), header.elements.end(), rule);
    };
    if (!has([](const PlyElement& e) { return e.name == "vertex"; }) || !has(holds_triangles))
        fail_on_header(file, "a header without vertices, or without faces",
                       "a mesh has the elements vertex, and face or tristrips");
}

/// Bytes that a row takes at least, with empty lists: a face with too few corners is read, and
/// refused as such. In text a digit and a blank or line end for each number.
std::size_t least_bytes(const PlyElement& element, bool is_text)
{
    std::size_t bytes = 0;
    for (const PlyProperty& p : element.properties)
        bytes += is_text ? 2 : bytes_of(p.count_type.value_or(p.type));
    return bytes;
}

/// The header's counts say how much is kept, so they are held against the file first.
void require_long_enough(const PlyHeader& header, std::size_t there,
                         const std::filesystem::path& file)
{
    const bool is_text = header.format == PlyFormat::ascii;
    std::size_t least = 0;
    for (const PlyElement& element : header.elements)
        least += element.count * least_bytes(element, is_text);
    least -= is_text && least > 0 ? 1 : 0;  // the last line may do without its end
    if (there < least)
        fail_on_header(file,
                       fmt::format("a PLY file that ends early: {} of at least {} after its header",
                                   there, many(least, "byte")),
                       "a body is as long as its header says");
}

}  // namespace

int role_of(const PlyElement& element, const PlyProperty& property)
{
    if (holds_triangles(element))
        return is_index_list(property) ? ply_role::list : ply_role::ignored;
    if (element.name != "vertex") return ply_role::ignored;
    const auto found = std::find(vertex_numbers.begin(), vertex_numbers.end(), property.name);
    return found == vertex_numbers.end() ? ply_role::ignored
                                         : static_cast<int>(found - vertex_numbers.begin());
}

bool has_vertex_normals(const PlyElement& vertex) { return count_of(vertex, 3) == 3; }

void require_mesh_header(const PlyHeader& header, std::size_t there,
                         const std::filesystem::path& file)
{
    for (const PlyElement& element : header.elements) require_properties(element, file);
    require_elements(header, file);
    require_long_enough(header, there, file);
}

}  // namespace mis
