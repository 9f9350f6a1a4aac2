#include "mis/io/mesh.h"
#include "mis/io/scene_error.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mis {
namespace {

/// A unit square in two triangles, but for what stands between vertices and faces.
const std::string square_vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";
const std::string square_faces = "f 1 2 3\nf 2 4 3\n";

Mesh obj(const std::string& text) { return parse_mesh(text, "a.obj"); }

double area(const Mesh& mesh)
{
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        sum += length(cross(mesh.positions[b] - mesh.positions[a],
                            mesh.positions[c] - mesh.positions[a])) /
               2;
    return sum;
}

bool is_square(const Mesh& mesh)
{
    return mesh.triangles.size() == 2 && mesh.positions.size() == 4 && area(mesh) == 1;
}

/// "PLACE: found FOUND", or what else came of it.
std::string refusal(const std::string& text)
{
    try {
        return std::to_string(obj(text).triangles.size()) + " triangles";
    } catch (const SceneError& error) {
        return error.problem.pointer + ": " + error.problem.found;
    }
}

TEST(Obj, ABackslashSwallowsNoLineAfterACommentOrNames)
{
    for (const std::string ends_so :
         {"# from C:\\models\\", "#\\", "usemtl C:\\mat\\", "usemtl red \\", "mtllib C:\\a.mtl\\",
          "g left\\", "o box \\", "s off\\", "usemap C:\\", "l 1 2 # C:\\", "   # C:\\  ",
          "mg 1 2 \\", "usemtl\\"})
        for (const std::string line_end : {"\n", "\r\n", "\r"}) {
            EXPECT_TRUE(is_square(obj(square_vertices + ends_so + line_end + square_faces)))
                << ends_so;
            EXPECT_TRUE(is_square(obj(ends_so + line_end + square_vertices + square_faces)))
                << ends_so;
        }
}

TEST(Obj, ABackslashContinuesAStatement)
{
    EXPECT_TRUE(is_square(
        obj("v 0 \\\n0 0\nv 1\\\n\\\n 0 0\nv 0 1 0\nv 1 1 \\  \n 0\nf 1 \\\r\n2 \\\n 3\nf\\\n2 4 "
            "3\\\n")));
    EXPECT_TRUE(is_square(obj(square_vertices + "g a b \\\n c d\\\n e\n" + square_faces)));
    EXPECT_EQ(refusal("v 0 0 \\\nv 1 0 0\n"), "line 2, column 1: \"v\"");
    EXPECT_EQ(refusal("v 0 0 \\ 0\n"), "line 1, column 7: \"\\\\\"");
    EXPECT_EQ(refusal(square_vertices + "f 1 \\\n  2 \\\n   x\n"), "line 7, column 4: \"x\"");
}

TEST(Obj, ReadsEverySpellingOfANumber)
{
    for (const std::string one :
         {"1", "1.", "1.0", "+1", "01", "1e0", "1E+0", ".1e1", "10e-1", "+.1e+1", "1.000000000000"})
        EXPECT_TRUE(is_square(
            obj("v 0 0 0\nv " + one + " 0 0\nv 0 1 0\nv 1 " + one + " 0\n" + square_faces)))
            << one;
    EXPECT_EQ(obj("v 0 0 .5\nv 1 0 -.5\nv 0 1 5.\nf 1 2 3\n").positions[1].z, -0.5);
}

TEST(Obj, RefusesWhatIsNoNumberAtItsPlace)
{
    for (const std::string word :
         {"-1.#IND00", "1.#QNAN", "1.#INF",   "1x",     "0.1D+01", "1d0",    "nan", "inf",
          "-inf",      "NaN",     "infinity", "nan(1)", "1e400",   "1e-400", "1,5", "0x1p3",
          "0x10",      "1e",      "1e+",      ".",      "-",       "+",      "+-1", "--1",
          "1.2.3",     "1_000",   "\xD9\xA1", "1/2",    "one"}) {
        const std::string quoted = "\"" + word + "\"";
        for (const std::string keyword : {"v", "vn"}) {
            EXPECT_EQ(refusal(keyword + " 0 0 " + word + "\n"),
                      "line 1, column " + std::to_string(6 + keyword.size()) + ": " + quoted);
            EXPECT_EQ(refusal("\n  " + keyword + " " + word + " 0 0\n"),
                      "line 2, column " + std::to_string(4 + keyword.size()) + ": " + quoted);
        }
        EXPECT_EQ(refusal("vt 0 " + word + "\n"), "line 1, column 6: " + quoted);
        EXPECT_EQ(refusal("v 0 0 0 1 1 " + word + "\n"), "line 1, column 13: " + quoted);
    }
    const std::string with_zero("v 0 0 0\0 1\n", 11);
    EXPECT_EQ(refusal(with_zero), "line 1, column 7: \"0\\u0000\"");
}

TEST(Obj, ReadsALineHoweverItIsSetOut)
{
    const std::string plain = square_vertices + square_faces;
    for (const auto& [found, put] :
         std::vector<std::pair<std::string, std::string>>{{"v", "\xEF\xBB\xBFv"},
                                                          {"v", "\xEF\xBB\xBF# a comment\nv"},
                                                          {"v", "  v"},
                                                          {"f", "\tf"},
                                                          {" ", "   "},
                                                          {" ", "\t"},
                                                          {" ", " \f\v "},
                                                          {"\n", "\r\n"},
                                                          {"\n", "\r"},
                                                          {"\n", "\n\n \n"},
                                                          {"\n", "   \n"},
                                                          {"\n", " # a comment\n"},
                                                          {"\n", "# a comment\n"},
                                                          {"\n", " # C:\\\n"}}) {
        std::string text = plain;
        const bool is_once = put.starts_with("\xEF");
        for (std::size_t at = 0; (at = text.find(found, at)) != text.npos; at += put.size()) {
            text.replace(at, found.size(), put);
            if (is_once) break;
        }
        EXPECT_TRUE(is_square(obj(text))) << text;
    }
    EXPECT_TRUE(is_square(obj(plain.substr(0, plain.size() - 1))));
}

TEST(Obj, ReadsVerticesWithWeightsAndColours)
{
    const Mesh mesh = obj("v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 0.5 0.5 0.5\nf 1 2 3\n");
    EXPECT_EQ(area(mesh), 0.5);
    EXPECT_EQ(refusal("v 1 2\n"), "line 1, column 1: \"v\" with 2 numbers");
    EXPECT_EQ(refusal("v 1 2 3 4 5\n"), "line 1, column 1: \"v\" with 5 numbers");
    EXPECT_EQ(refusal(" v 1 2 3 4 5 6 7 8\n"), "line 1, column 2: \"v\" with 8 numbers");
    EXPECT_EQ(refusal("v 2 2 2 2\n"), "line 1, column 1: \"v\" with the weight 2");
    EXPECT_EQ(refusal("vn 1 2\n"), "line 1, column 1: \"vn\" with 2 numbers");
    EXPECT_EQ(refusal("vt 1 2 3 4\n"), "line 1, column 1: \"vt\" with 4 numbers");
}

TEST(Obj, ReadsEveryFormOfACorner)
{
    const std::string rest = "vt 0 0\nvn 0 0 1\n";
    for (const std::string face :
         {"f 1/1 2/1 3/1\nf 2/1 4/1 3/1\n", "f 1//1 2//1 3//1\nf 2//1 4//1 3//1\n",
          "f 1/1/1 2/1/1 3/1/1\nf 2/1/1 4/1/1 3/1/1\n", "f 1/ 2/ 3/\nf 2// 4// 3//\n",
          "f -4 -3 -2\nf -3 -1 -2\n", "f -4/-1/-1 2/1/-1 -2//-1\nf 2//1 4 3\n", "fo 1 2 4 3\n",
          "f +1 +2 +4 +3\n"})
        EXPECT_TRUE(is_square(obj(square_vertices + rest + face)) ||
                    obj(square_vertices + rest + face).positions.size() == 6)
            << face;
    for (const std::string corner :
         {"x", "1.0", "1/x", "1/1/x", "1/1/1/1", "1x", "/1", "//1", "-", "1//x", "1e0", "+-1"})
        EXPECT_EQ(refusal(square_vertices + rest + "f 1 2 " + corner + " 3\n"),
                  "line 7, column 7: \"" + corner + "\"");
}

TEST(Obj, RefusesIndicesOutOfRangeAtTheirPlace)
{
    const std::string rest = "vt 0 0\nvn 0 0 1\n";
    for (const std::string corner :
         {"0", "5", "-5", "1/2", "1/0", "1/-2", "1//2", "1//0", "1//-2", "1/1/2", "99999999999",
          "4294967296", "4294967297", "-4294967296", "9223372036854775808", "-9223372036854775808",
          "99999999999999999999"}) {
        const std::string found = refusal(square_vertices + rest + "f 1 2 " + corner + "\n");
        EXPECT_EQ(found.substr(0, 17), "line 7, column 7:") << found;
        EXPECT_NE(found.find("out of range"), std::string::npos) << found;
    }
}

TEST(Obj, CountsBackFromWhereItStandsAndForwardToTheEnd)
{
    EXPECT_TRUE(is_square(obj(square_faces + square_vertices)));
    const Mesh mesh = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 1 1 0\nf -3 -1 -2\n");
    EXPECT_TRUE(is_square(mesh));
    EXPECT_EQ(refusal("f -1 1 2\n" + square_vertices),
              "line 1, column 3: \"-1\", an index out of range");
    EXPECT_EQ(refusal("v 0 0 0\nf 1 2 \\\n 3\nv 1 0 0\n"),
              "line 3, column 2: the index 3, which is out of range");
}

TEST(Obj, RefusesFacesOfTooFewCornersAndThoseThatCross)
{
    EXPECT_EQ(refusal(square_vertices + "f\n"), "line 5, column 1: a face with 0 corners");
    EXPECT_EQ(refusal(square_vertices + "f 1 2\n"), "line 5, column 1: a face with 2 corners");
    EXPECT_EQ(refusal(square_vertices + "f 1 2 3 4\n"),
              "line 5, column 3: a face that crosses itself");
}

TEST(Obj, RefusesWhatItDoesNotRead)
{
    for (const std::string statement : {"curv 0 1 1 2", "curv2 1 2", "surf 0 1 0 1 1 2",
                                        "call a.obj", "bsp 1", "bzp 1", "cdc 1", "cdp 1"})
        EXPECT_EQ(refusal(square_vertices + square_faces + statement + "\n").substr(0, 16),
                  "line 7, column 1")
            << statement;
    EXPECT_EQ(refusal("F 1 2 3\n"), "line 1, column 1: \"F\"");
    EXPECT_EQ(refusal("v 0 0 0\nvv 1 0 0\n"), "line 2, column 1: \"vv\"");
    EXPECT_EQ(refusal("\xFF\xFEv\0 \0"), "line 1, column 1: UTF-16 text");
    EXPECT_EQ(refusal("\xFE\xFFv"), "line 1, column 1: UTF-16 text");
}

TEST(Obj, LeavesOutWhatHoldsNoPolygons)
{
    EXPECT_TRUE(is_square(obj(
        "mtllib a.mtl\no box\ng a b\ns 1\nvp 0.5\nvp 1 2 3\nvt 0\nvt 0 1 0\n" + square_vertices +
        "usemtl red\nl 1 2 3\nl 1/1 2/1\np 1 2\nlod 3\nbevel on\nc_interp off\ncstype bezier\n"
        "deg 3\nparm u 0 1\nend\nshadow_obj a.obj\n" +
        square_faces)));
    EXPECT_EQ(refusal(square_vertices + "l 1 x\n"), "line 5, column 5: \"x\"");
}

/// Lines, comments and continued statements that lie across the blocks in which a file is read.
TEST(Obj, ReadsAFileOfManyBlocks)
{
    const TemporaryFolder folder;
    std::string text = square_vertices;
    constexpr int count = 60'000;
    for (int i = 0; i < count; ++i) {
        text += "v " + std::to_string(i) + " 0 \\\n 1\n# " + std::string(i % 97, '-') + "\\\n";
        text += "f 1 \\\n 2 " + std::to_string(i + 5) + "\n";
    }
    ASSERT_GT(text.size(), std::size_t{4} << 20);
    const Mesh from_file = read_mesh(folder.write("a.obj", text)), mesh = obj(text);
    EXPECT_EQ(mesh.triangles.size(), std::size_t(count));
    EXPECT_EQ(from_file.triangles, mesh.triangles);
    EXPECT_EQ(from_file.positions, mesh.positions);
    try {
        read_mesh(folder.write("b.obj", text + "f 1 2 x\n"));
        FAIL() << "was accepted";
    } catch (const SceneError& error) {
        EXPECT_EQ(error.problem.pointer,
                  "line " + std::to_string(4 + 5 * count + 1) + ", column 7");
    }
}

TEST(Obj, ReadsNormalsThatComeLate)
{
    const Mesh mesh = obj(square_vertices +
                          "f 1 2 3\nvn 0.6 0 0.8\nf 2//1 4//1 3//1\nvn 0 0 0\nf 1//2 3//2 2//2\n");
    ASSERT_EQ(mesh.triangles.size(), 3u);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    const auto normal = [&](std::size_t i) { return mesh.normals[mesh.triangles[i][0]]; };
    EXPECT_EQ(normal(0), (Vec3<float>{0, 0, 1}));
    EXPECT_EQ(normal(1), (Vec3<float>{0.6f, 0, 0.8f}));
    EXPECT_EQ(normal(2), (Vec3<float>{0, 0, -1}));
}

}  // namespace
}  // namespace mis
