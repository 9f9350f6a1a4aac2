#include "mis/io/mesh.h"

#include "mis/io/scene_error.h"
#include "mis/io/scene_json.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace mis {
namespace {

constexpr const char* one_triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string ply_start =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\n";
const std::string ply_face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

/// The highest corner along an axis.
double highest(const Mesh& mesh, int axis)
{
    double most = -1e300;
    for (const Vec3<double>& p : mesh.positions) most = std::max(most, p[axis]);
    return most;
}

TEST(Mesh, ReadsObjAndPlyAlike)
{
    const TemporaryFolder folder;
    const Mesh obj = read_mesh(folder.write("a.obj", one_triangle));
    const Mesh ply =
        read_mesh(folder.write("a.PLY", ply_start + ply_face + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
    for (const Mesh& mesh : {obj, ply}) {
        ASSERT_EQ(mesh.positions.size(), 3u);
        EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}));
        EXPECT_TRUE(mesh.normals.empty());
        EXPECT_EQ(mesh.positions[1], (Vec3<double>{1, 0, 0}));
    }
}

TEST(Mesh, CutsPolygonsIntoTrianglesAndMergesEqualVertices)
{
    const TemporaryFolder folder;
    const Mesh mesh = read_mesh(folder.write(
        "a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0.5 0\nf 1 2 3 4\nf 2 5 3\n"));
    EXPECT_EQ(mesh.triangles.size(), 3u);
    EXPECT_EQ(mesh.positions.size(), 5u);
}

TEST(Mesh, DropsTrianglesWithoutAnArea)
{
    const TemporaryFolder folder;
    const Mesh mesh = read_mesh(folder.write(
        "a.obj",
        "v 0 0 0\nv 0.1 0.1 0.1\nv 0.2 0.2 0.2\nv 0 1 0\nf 1 2 3\nf 1 1 4\nf 1 2 4\nl 1 2\n"));
    EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(Mesh, DropsTrianglesThatDecimalNumbersPutOnALine)
{
    const Mesh mesh = parse_mesh(
        "v 0.1 0.2 0.3\nv 0.3 0.6 0.9\nv 0.7 1.4 2.1\nv 0 1 0\nf 1 2 3\nf 1 2 4\n", "a.obj");
    EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(Mesh, KeepsCoordinatesInFull)
{
    const Mesh mesh =
        parse_mesh("v 1234567.1 0 0\nv 1234568.2 0 0\nv 1234567.1 1 0\nf 1 2 3\n", "a.obj");
    EXPECT_EQ(highest(mesh, 0), 1234568.2);
}

TEST(Mesh, PlacesVerticesInDoubleFarFromTheOrigin)
{
    const TemporaryFolder folder;
    const Transform transform(Vec3<double>(2), {0, 0, 0}, {1e6, 0, 0});
    const Mesh mesh = read_mesh(
        folder.write("a.obj", "v 0 0 0\nv 0.0001220703125 0 0\nv 0 1 0\nf 1 2 3\n"), transform);
    EXPECT_EQ(highest(mesh, 0), 1e6 + 2 * 0.0001220703125);  // a float at 1e6 has steps of 0.0625
}

TEST(Mesh, ScalesThenTurnsAboutXThenYThenZThenMoves)
{
    const Transform transform({1, 2, 3}, {90, 90, 90}, {10, 20, 30});
    // (1, 1, 1) → scale (1, 2, 3) → about x (1, −3, 2) → about y (2, −3, −1) → about z (3, 2, −1) →
    // move
    EXPECT_EQ(transform.place({1, 1, 1}), (Vec3<double>{13, 22, 29}));
}

TEST(Mesh, TurnsByExactQuarters)
{
    for (const double degrees : {90.0, -270.0, 450.0})
        EXPECT_EQ(Transform(Vec3<double>(1), {0, 0, degrees}, Vec3<double>(0)).place({1, 0, 0}),
                  (Vec3<double>{0, 1, 0}));
    EXPECT_EQ(Transform(Vec3<double>(1), {0, 180, 0}, Vec3<double>(0)).place({1, 0, 0}),
              (Vec3<double>{-1, 0, 0}));
    const Vec3<double> turned =
        Transform(Vec3<double>(1), {0, 0, 120}, Vec3<double>(0)).place({1, 0, 0});
    EXPECT_NEAR(turned.x, -0.5, 1e-15);
    EXPECT_NEAR(turned.y, std::sqrt(0.75), 1e-15);
}

TEST(Mesh, KeepsNormalsUprightUnderUnequalScales)
{
    const Transform transform({1, 5, 0.2}, {10, 20, 30}, {1, 2, 3});
    const Vec3<double> a{1, 0, -1}, b{0, 1, -1}, normal = unit_or_zero(cross(a, b));
    const Vec3<double> origin = transform.place(Vec3<double>(0));
    const Vec3<double> placed =
        unit_or_zero(cross(transform.place(a) - origin, transform.place(b) - origin));
    EXPECT_NEAR(dot(transform.place_normal(normal), placed), 1, 1e-14);
}

TEST(Mesh, KeepsNormalsOutwardsUnderAMirror)
{
    const Transform mirror({-1, 1, 1}, {0, 0, 0}, {0, 0, 0});
    EXPECT_EQ(mirror.place_normal({1, 0, 0}), (Vec3<double>{-1, 0, 0}));
    EXPECT_EQ(mirror.place_normal({0, 1, 0}), (Vec3<double>{0, 1, 0}));
}

TEST(Mesh, ReadsSmoothNormalsAndNormalisesThem)
{
    const TemporaryFolder folder;
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 3 0 4\nf 1//1 2//1 3//1\n";
    const Mesh mesh =
        read_mesh(folder.write("a.obj", text), Transform(Vec3<double>(1), {0, 0, 90}, {7, 7, 7}));
    ASSERT_EQ(mesh.normals.size(), 3u);
    EXPECT_FLOAT_EQ(mesh.normals[0].y, 0.6f);
    EXPECT_FLOAT_EQ(mesh.normals[0].z, 0.8f);
}

TEST(Mesh, GivesAVertexWithoutANormalThatOfItsTriangle)
{
    const TemporaryFolder folder;
    const Mesh mesh = read_mesh(folder.write("a.obj",
                                             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0.6 0 0.8\no "
                                             "smooth\nf 1//1 2//1 3//1\no flat\nf 1 3 4\n"));
    ASSERT_EQ(mesh.triangles.size(), 2u);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (const std::uint32_t corner : mesh.triangles[0])
        EXPECT_FLOAT_EQ(mesh.normals[corner].z, 0.8f);
    for (const std::uint32_t corner : mesh.triangles[1])
        EXPECT_EQ(mesh.normals[corner], (Vec3<float>{1, 0, 0}));
}

TEST(Mesh, IsReadWithoutAWordOnTheTerminal)
{
    const TemporaryFolder folder;
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    read_mesh(
        folder.write("a.obj", std::string("mtllib missing.mtl\nusemtl none\n") + one_triangle));
    EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
}

struct BadMesh {
    const char* name;
    std::string file, content, place, found;
};

void PrintTo(const BadMesh& mesh, std::ostream* out) { *out << mesh.name; }

class EveryBadMesh : public testing::TestWithParam<BadMesh> {};

TEST_P(EveryBadMesh, IsRefusedWithThePlaceAndTheReason)
{
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.write(GetParam().file, GetParam().content);
    try {
        read_mesh(file);
        FAIL() << "was accepted";
    } catch (const SceneError& error) {
        EXPECT_EQ(error.problem.pointer, GetParam().place);
        EXPECT_NE(error.problem.found.find(GetParam().found), std::string::npos)
            << error.problem.found;
        EXPECT_EQ(std::string(error.what()).rfind(file.string() + ": ", 0), 0u) << error.what();
    }
}

const std::string three_vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

const BadMesh bad_meshes[] = {
    {"OtherFormat", "a.stl", one_triangle, "", "a file name that ends in \".stl\""},
    {"NoExtension", "a", one_triangle, "", "a file name that ends in \"\""},
    {"EmptyObj", "a.obj", "", "", "an empty file"},
    {"NoObj", "a.obj", "this is no mesh at all, but a sentence\n", "line 1, column 1", "\"this\""},
    {"ObjWithoutFaces", "a.obj", three_vertices, "", "without triangles"},
    {"ObjOfLines", "a.obj", three_vertices + "l 1 2 3\n", "", "without triangles"},
    {"ObjWithoutArea", "a.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n", "",
     "without triangles that have an area"},
    {"ObjIndexOutOfRange", "a.obj", three_vertices + "f 1 2 9\n", "line 4, column 7",
     "out of range"},
    {"EmptyPly", "a.ply", "", "", "an empty file"},
    {"NoPly", "a.ply", one_triangle, "", "\"v 0 0 0\" in line 1"},
    {"PlyHeaderCut", "a.ply", ply_start, "", "header without an end"},
    {"PlyHeaderGarbled", "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty floyt x\n" + ply_face, "",
     "\"property floyt x\" in line 4"},
    {"PlyCountImpossible", "a.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\n" + ply_face,
     "", "element vertex 4000000000"},
    {"PlyCut", "a.ply", ply_start + ply_face + "0 0 0\n1 0 0\n0 1 0\n", "",
     "ends early: 18 of at least 19 bytes"},
    {"PlyCutRow", "a.ply", ply_start + ply_face + "0.0 0.0 0.0\n1 0 0\n0 1 0\n3 0 1\n", "",
     "ends early: 0 of 1 row of \"face\" are there"},
    {"PlyCutBinary", "a.ply",
     "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float "
     "y\nproperty float z\n" +
         ply_face + std::string(36, '\0'),
     "", "ends early: 36 of at least 37 bytes"},
    {"PlyFaceOfTwoCorners", "a.ply", ply_start + ply_face + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n",
     "line 13, column 1", "a face with 2 corners"},
    {"PlyFaceOfOneCorner", "a.ply", ply_start + ply_face + "0 0 0\n1 0 0\n0 1 0\n1 0\n",
     "line 13, column 1", "a face with 1 corner"},
    {"PlyBinaryFaceWithoutCorners", "a.ply",
     "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float "
     "y\nproperty float z\n" +
         ply_face + std::string(37, '\0'),
     "face 0 (counted from 0), byte 205", "a face with 0 corners"},
    {"PlyByteTooMany", "a.ply",
     "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float "
     "y\nproperty float z\n" +
         ply_face + std::string(36, '\0') + "\3" + std::string(12, '\0') + "x",
     "byte 218", "1 byte after the last row"},
    {"ObjFaceOfOneCorner", "a.obj", three_vertices + "f 1\n", "line 4, column 1",
     "a face with 1 corner"},
    {"ObjVertexOfOneNumber", "a.obj", "v 0\n", "line 1, column 1", "\"v\" with 1 number"},
    {"PlyIndexOutOfRange", "a.ply", ply_start + ply_face + "0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n",
     "line 13, column 7", "out of range"},
    {"PlyIndexNegative", "a.ply", ply_start + ply_face + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n",
     "line 13, column 7", "out of range"},
    {"PlyNoNumber", "a.ply", ply_start + ply_face + "0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n",
     "line 11, column 3", "\"x\""},
    {"PlyPoints", "a.ply", ply_start + "end_header\n0 0 0\n1 0 0\n0 1 0\n", "", "without faces"},
};
INSTANTIATE_TEST_SUITE_P(Mesh, EveryBadMesh, testing::ValuesIn(bad_meshes),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Mesh, NamesItsOwnFileWhereItHasAPlace)
{
    const TemporaryFolder folder;
    const std::filesystem::path mesh = folder.write("a.obj", three_vertices + "f 1 2 x\n");
    const std::string scene =
        R"({"format": "mis-scene/1", "materials": {"w": {"type": "lambert", "albedo": 0.5}},
            "surfaces": [{"type": "mesh", "file": "a.obj", "material": "w"}],
            "probes": [], "lights": []})";
    try {
        parse_scene(scene, folder / "scene.json");
        FAIL() << "was accepted";
    } catch (const SceneError& error) {
        EXPECT_EQ(std::string(error.what()).rfind(mesh.string() + ": line 4, column 7: found", 0),
                  0u)
            << error.what();
    }
}

TEST(Mesh, StopsWhenToldTo)
{
    const TemporaryFolder folder;
    std::string text = three_vertices;
    for (int i = 0; i < 1'000'000; ++i) text += "f 1 2 3\n";
    const std::filesystem::path file = folder.write("a.obj", text);
    int asked = 0;
    const std::function<bool()> on_third = [&] { return ++asked == 3; };
    EXPECT_THROW(read_mesh(file, {}, StopToken(&on_third)), Stopped);
}

TEST(Mesh, ThatIsMissingIsRefused)
{
    const TemporaryFolder folder;
    EXPECT_THROW(read_mesh(folder / "missing.obj"), SceneError);
    EXPECT_THROW(read_mesh(folder / "missing.ply"), SceneError);
}

}  // namespace
}  // namespace mis
