// Any bytes at all, as an OBJ and as a PLY file: they are read, or refused with a message. What is
// read has triangles of its own vertices.
#include "mis/io/mesh.h"
#include "mis/io/scene_error.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

void read(std::string_view bytes, const char* file)
{
    try {
        const mis::Mesh mesh = mis::parse_mesh(bytes, file);
        if (mesh.triangles.empty()) std::abort();
        if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) std::abort();
        for (const auto& triangle : mesh.triangles)
            for (const std::uint32_t vertex : triangle)
                if (vertex >= mesh.positions.size()) std::abort();
    } catch (const mis::SceneError&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    read(bytes, "/nowhere/mesh.obj");
    read(bytes, "/nowhere/mesh.ply");
    return 0;
}
