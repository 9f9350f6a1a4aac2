#include "mis/io/mesh.h"

#include "mis/io/ply_header.h"
#include "mis/io/scene_error.h"
#include "mis/io/text_file.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <bit>
#include <span>
#include <system_error>
#include <unordered_map>

namespace mis {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, std::string found, std::string allowed,
                       std::string remedy)
{
    throw SceneError(file.string(),
                     Problem{"", std::move(found), std::move(allowed), std::move(remedy)});
}

Vec3<double> to_vec(const aiVector3D& v) { return {v.x, v.y, v.z}; }

/// A vertex as the file has it.
struct Corner {
    aiVector3D position, normal;
    bool operator==(const Corner&) const = default;
};

struct CornerHash {
    std::size_t operator()(const Corner& c) const
    {
        std::uint64_t hash = 0;
        for (const float x :
             {c.position.x, c.position.y, c.position.z, c.normal.x, c.normal.y, c.normal.z}) {
            hash = (hash ^ std::bit_cast<std::uint32_t>(x + 0.0f)) *
                   0x9E3779B97F4A7C15u;  // −0 + 0 is 0: equal, so one hash
            hash ^= hash >> 32;
        }
        return hash;
    }
};

/// Normal times twice the area. Differences of floats, and products of these, leave no rounding
/// that could hide a zero.
Vec3<double> area_vector(const std::array<Vec3<double>, 3>& p)
{
    return cross(p[1] - p[0], p[2] - p[0]);
}

/// Collects triangles; vertices that are equal to the last bit become one.
class MeshBuilder {
public:
    MeshBuilder(const Transform& transform, bool has_normals)
        : transform_(transform), has_normals_(has_normals)
    {
    }

    void add(const aiMesh& part, const aiFace& face)
    {
        std::array<Vec3<double>, 3> positions;
        for (unsigned i = 0; i < 3; ++i) positions[i] = to_vec(part.mVertices[face.mIndices[i]]);
        const Vec3<double> area = area_vector(positions);
        if (area == Vec3<double>(0)) return;
        std::array<std::uint32_t, 3> triangle;
        for (unsigned i = 0; i < 3; ++i)
            triangle[i] = vertex(part, face.mIndices[i], unit_or_zero(area));
        mesh_.triangles.push_back(triangle);
    }

    Mesh take() { return std::move(mesh_); }

private:
    std::uint32_t vertex(const aiMesh& part, unsigned index, const Vec3<double>& triangle_normal)
    {
        Corner corner{part.mVertices[index], {}};
        if (has_normals_) {
            if (part.HasNormals()) corner.normal = part.mNormals[index];
            if (corner.normal == aiVector3D(0)) {
                const Vec3<float> n = vec_cast<float>(triangle_normal);
                corner.normal = {n.x, n.y, n.z};
            }
        }
        const auto [known, is_new] =
            vertices_.try_emplace(corner, static_cast<std::uint32_t>(mesh_.positions.size()));
        if (is_new) {
            mesh_.positions.push_back(transform_.place(to_vec(corner.position)));
            if (has_normals_)
                mesh_.normals.push_back(
                    vec_cast<float>(transform_.place_normal(to_vec(corner.normal))));
        }
        return known->second;
    }

    const Transform& transform_;
    bool has_normals_;
    Mesh mesh_;
    std::unordered_map<Corner, std::uint32_t, CornerHash> vertices_;
};

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

/// The file as Assimp has it, in triangles. Two defects of Assimp 5.2 are met on the way: it lets
/// indices pass that are out of range, unless told to validate, and cutting faces without vertices
/// into triangles fails an assertion.
const aiScene* read_scene_of(const std::filesystem::path& file, Assimp::Importer& importer)
{
    const char* const allowed = "a mesh is a well-formed OBJ or PLY file";
    const aiScene* const scene = importer.ReadFile(file.string(), aiProcess_ValidateDataStructure);
    if (!scene)
        fail(file, "no readable mesh (" + std::string(importer.GetErrorString()) + ")", allowed,
             "Mend the file.");
    for (const aiMesh* const part : std::span(scene->mMeshes, scene->mNumMeshes))
        for (const aiFace& face : std::span(part->mFaces, part->mNumFaces))
            if (face.mNumIndices == 0)
                fail(file, "a face without vertices", allowed,
                     "Mend the file: it may have been cut short.");
    return importer.ApplyPostProcessing(aiProcess_Triangulate);
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& file, const Transform& transform)
{
    require_known_extension(file);
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        fail(file, "no such file", "a mesh is a file that exists", "Check the path.");
    if (has_extension(file, ".ply")) require_ply_header(file);
    Assimp::Importer importer;  // logs nowhere unless a program sets a logger
    const aiScene* const scene = read_scene_of(file, importer);
    const std::span<aiMesh*> parts(scene->mMeshes, scene->mNumMeshes);
    const bool has_normals = std::any_of(parts.begin(), parts.end(),
                                         [](const aiMesh* part) { return part->HasNormals(); });
    MeshBuilder builder(transform, has_normals);
    for (const aiMesh* const part : parts)
        for (const aiFace& face : std::span(part->mFaces, part->mNumFaces))
            if (face.mNumIndices == 3) builder.add(*part, face);
    Mesh mesh = builder.take();
    if (mesh.triangles.empty())
        fail(file, "a mesh without triangles that have an area", "a mesh has at least one triangle",
             "Mend the file, or remove the surface.");
    return mesh;
}

}  // namespace mis
