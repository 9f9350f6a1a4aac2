#include "mis/io/mesh.h"

#include "mis/io/byte_source.h"
#include "mis/io/mesh_builder.h"
#include "mis/io/obj.h"
#include "mis/io/ply.h"
#include "mis/io/scene_error.h"
#include "mis/io/text_file.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace mis {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, std::string found, std::string allowed,
                       std::string remedy)
{
    throw SceneError(file.string(),
                     Problem{"", std::move(found), std::move(allowed), std::move(remedy)});
}

bool has_extension(const std::filesystem::path& file, std::string_view extension)
{
    const auto same_letter = [](char a, char b) {
        return a == b || (a >= 'A' && a <= 'Z' && a - 'A' + 'a' == b);
    };
    return std::ranges::equal(file.extension().string(), extension, same_letter);
}

void require_known_extension(const std::filesystem::path& file)
{
    if (has_extension(file, ".obj") || has_extension(file, ".ply")) return;
    fail(file, "a file name that ends in " + in_quotes(file.extension().string()),
         "a mesh is an OBJ or PLY file, and its name ends in .obj or .ply",
         "Convert it to OBJ or PLY.");
}

Mesh parse_mesh(ByteSource& source, const std::filesystem::path& file, const Transform& transform,
                const StopToken& stop)
{
    require_known_extension(file);
    MeshBuilder builder(transform, stop);
    if (has_extension(file, ".ply")) read_ply(source, file, builder);
    else read_obj(source, file, builder);
    Mesh mesh = builder.take();
    if (mesh.triangles.empty())
        fail(file, "a mesh without triangles that have an area", "a mesh has at least one triangle",
             "Mend the file, or remove the surface.");
    return mesh;
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& file, const Transform& transform, const StopToken& stop)
{
    require_known_extension(file);
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        fail(file, "no such file", "a mesh is a file that exists", "Check the path.");
    ByteSource source(file, stop);
    if (source.size() == 0)
        fail(file, "an empty file", "a mesh has content", "Check that it was written in full.");
    return parse_mesh(source, file, transform, stop);
}

Mesh parse_mesh(std::string_view bytes, const std::filesystem::path& file,
                const Transform& transform)
{
    ByteSource source(bytes);
    return parse_mesh(source, file, transform, {});
}

}  // namespace mis
