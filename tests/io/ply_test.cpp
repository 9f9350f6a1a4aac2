#include "mis/io/mesh.h"
#include "mis/io/scene_error.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

namespace mis {
namespace {

const std::vector<std::string> formats{"ascii", "binary_little_endian", "binary_big_endian"};
const std::vector<std::string> number_types{"char", "uchar", "short", "ushort",
                                            "int",  "uint",  "float", "double"};

/// Writes the numbers of a body, row by row.
class PlyBody {
public:
    explicit PlyBody(std::string format) : format_(std::move(format)) {}

    PlyBody& add(const std::string& type, double x)
    {
        if (format_ == "ascii") {
            std::ostringstream number;
            number.precision(17);
            number << x << ' ';
            text_ += number.str();
        } else if (type == "char" || type == "int8") put(static_cast<std::int8_t>(x));
        else if (type == "uchar" || type == "uint8")
            put(static_cast<std::uint8_t>(static_cast<int>(x)));
        else if (type == "short" || type == "int16") put(static_cast<std::int16_t>(x));
        else if (type == "ushort" || type == "uint16") put(static_cast<std::uint16_t>(x));
        else if (type == "int" || type == "int32") put(static_cast<std::int32_t>(x));
        else if (type == "uint" || type == "uint32") put(static_cast<std::uint32_t>(x));
        else if (type == "float" || type == "float32") put(static_cast<float>(x));
        else put(x);
        return *this;
    }
    PlyBody& add(const std::string& type, const std::vector<double>& numbers)
    {
        for (const double x : numbers) add(type, x);
        return *this;
    }
    PlyBody& add_list(const std::string& count_type, const std::string& type,
                      const std::vector<double>& numbers)
    {
        return add(count_type, static_cast<double>(numbers.size())).add(type, numbers);
    }
    PlyBody& end_row()
    {
        if (format_ == "ascii") text_.back() = '\n';
        return *this;
    }
    const std::string& text() const { return text_; }

private:
    template <class T> void put(T x)
    {
        char bytes[sizeof x];
        std::memcpy(bytes, &x, sizeof x);
        const bool is_big = format_ == "binary_big_endian";
        if (is_big != (std::endian::native == std::endian::big))
            std::reverse(bytes, bytes + sizeof x);
        text_.append(bytes, sizeof x);
    }

    std::string format_, text_;
};

std::string start_of(const std::string& format) { return "ply\nformat " + format + " 1.0\n"; }

const std::string vertices_4 =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string faces_2 = "element face 2\nproperty list uchar int vertex_indices\n";
const std::vector<std::vector<double>> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
const std::vector<std::vector<double>> triangles{{0, 1, 2}, {1, 3, 2}};

void add_vertices(PlyBody& body, const std::string& type = "float")
{
    for (const auto& corner : corners) body.add(type, corner).end_row();
}
void add_faces(PlyBody& body, const std::string& count = "uchar", const std::string& type = "int")
{
    for (const auto& face : triangles) body.add_list(count, type, face).end_row();
}

Mesh ply(const std::string& text) { return parse_mesh(text, "a.ply"); }

/// A square of two triangles that look to +z.
testing::AssertionResult is_square(const std::string& text)
{
    try {
        const Mesh mesh = ply(text);
        double area = 0;
        for (const auto& [a, b, c] : mesh.triangles)
            area +=
                cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a])
                    .z /
                2;
        if (mesh.triangles.size() == 2 && mesh.positions.size() == 4 && area == 1)
            return testing::AssertionSuccess();
        return testing::AssertionFailure() << mesh.triangles.size() << " triangles of "
                                           << mesh.positions.size() << " vertices, area " << area;
    } catch (const SceneError& error) {
        return testing::AssertionFailure() << error.what();
    }
}

std::string refusal(const std::string& text)
{
    try {
        return std::to_string(ply(text).triangles.size()) + " triangles";
    } catch (const SceneError& error) {
        return error.problem.pointer + ": " + error.problem.found;
    }
}

std::string square(const std::string& format, const std::string& before_end = "end_header\n")
{
    PlyBody body(format);
    add_vertices(body);
    add_faces(body);
    return start_of(format) + vertices_4 + faces_2 + before_end + body.text();
}

TEST(Ply, ReadsEveryMixOfTypesAndFormats)
{
    for (const std::string& format : formats)
        for (const std::string& number : number_types)
            for (const std::string& count : number_types)
                for (const std::string& index : number_types) {
                    PlyBody body(format);
                    add_vertices(body, number);
                    add_faces(body, count, index);
                    const std::string header = start_of(format) + "element vertex 4\nproperty " +
                                               number + " x\nproperty " + number + " y\nproperty " +
                                               number + " z\nelement face 2\nproperty list " +
                                               count + " " + index + " vertex_index\nend_header\n";
                    ASSERT_TRUE(is_square(header + body.text()))
                        << format << " " << number << " " << count << " " << index;
                }
}

TEST(Ply, ReadsTheNewNamesOfTypes)
{
    const std::string body = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n";
    for (const std::string type : {"int8", "int16", "int32", "uint8", "uint16", "uint32"})
        EXPECT_TRUE(
            is_square("ply\nformat ascii 1.0\nelement vertex 4\nproperty float32 "
                      "x\nproperty float64 y\nproperty " +
                      type + " z\nelement face 2\nproperty list " + type + " " + type +
                      " vertex_indices\nend_header\n" + body));
}

/// A camera before the vertices, and other elements before, between and after what is read.
TEST(Ply, LeavesOutOtherElementsWhereverTheyStand)
{
    const std::string camera =
        "element camera 2\nproperty float view_px\nproperty list uchar double lens\nproperty uchar "
        "id\n";
    for (const std::string& format : formats)
        for (int place = 0; place < 4; ++place) {
            std::string header = start_of(format);
            PlyBody body(format);
            const auto add_camera = [&](int at) {
                if (at != place) return;
                header += camera;
                body.add("float", 7).add_list("uchar", "double", {}).add("uchar", 1).end_row();
                body.add("float", std::numeric_limits<double>::quiet_NaN())
                    .add_list("uchar", "double", {1e99, 2})
                    .add("uchar", 9)
                    .end_row();
            };
            add_camera(0);
            header += vertices_4;
            add_vertices(body);
            add_camera(1);
            header += faces_2;
            add_faces(body);
            add_camera(2);
            header += "element edge 1\nproperty int vertex1\nproperty int vertex2\n";
            body.add("int", {0, 1}).end_row();
            add_camera(3);
            header += "element empty 0\nproperty int a\n";
            EXPECT_TRUE(is_square(header + "end_header\n" + body.text())) << format << place;
        }
}

TEST(Ply, LeavesOutOtherPropertiesOfEveryTypeWhereverTheyStand)
{
    for (const std::string& format : formats)
        for (const std::string& type : number_types)
            for (const bool is_list : {false, true}) {
                std::string header = start_of(format);
                PlyBody body(format);
                const std::string words = (is_list ? "list ushort " : "") + type;
                const auto add_other = [&](double x) {
                    if (!is_list) body.add(type, x);
                    else body.add_list("ushort", type, std::vector<double>(std::size_t(x), x));
                };
                header += "element vertex 4\nproperty " + words +
                          " a\nproperty float z\nproperty " + words +
                          " b\nproperty double x\nproperty float y\nproperty " + words + " c\n";
                for (const auto& corner : corners) {
                    add_other(3);
                    body.add("float", corner[2]);
                    add_other(0);
                    body.add("double", corner[0]).add("float", corner[1]);
                    add_other(120);
                    body.end_row();
                }
                header += "element face 2\nproperty " + words +
                          " a\nproperty list uchar int vertex_indices\nproperty " + words +
                          " vertex\n";
                for (const auto& face : triangles) {
                    add_other(2);
                    body.add_list("uchar", "int", face);
                    add_other(5);
                    body.end_row();
                }
                EXPECT_TRUE(is_square(header + "end_header\n" + body.text())) << format << words;
            }
}

TEST(Ply, ReadsBodiesThatBeginWithAnyByte)
{
    for (const std::string line_end : {"\n", "\r\n", "\r"})
        for (const std::string format : {"binary_little_endian", "binary_big_endian"})
            for (int byte = 0; byte < 256; ++byte) {
                if (line_end == "\r" && byte == '\n') continue;  // one cannot tell it from CRLF
                std::string header = start_of(format) + "element first 2\nproperty uchar a\n" +
                                     vertices_4 + faces_2 + "end_header\n";
                for (std::size_t at = 0; (at = header.find('\n', at)) != header.npos;
                     at += line_end.size())
                    header.replace(at, 1, line_end);
                PlyBody body(format);
                body.add("uchar", {double(byte), double(byte)});
                add_vertices(body);
                add_faces(body);
                ASSERT_TRUE(is_square(header + body.text())) << format << " " << byte;
            }
}

TEST(Ply, ReadsAHeaderHoweverItIsSetOut)
{
    for (const std::string& format : formats) {
        EXPECT_TRUE(is_square(
            square(format, "comment element face 9\ncomment\nobj_info a b\nend_header\n")));
        EXPECT_TRUE(is_square(square(format, "end_header \n")));
        std::string text = square(format);
        text.replace(0, 4, "ply \ncomment first\n");
        EXPECT_TRUE(is_square(text));
    }
    std::string text = square("ascii");
    EXPECT_TRUE(is_square(text.substr(0, text.size() - 1)));
    EXPECT_TRUE(is_square(text + "\n \n"));
    for (const std::string line_end : {"\r\n", "\r"}) {
        std::string other = text;
        for (std::size_t at = 0; (at = other.find('\n', at)) != other.npos; at += line_end.size())
            other.replace(at, 1, line_end);
        EXPECT_TRUE(is_square(other));
    }
}

TEST(Ply, ReadsRowsOfTextHoweverTheyAreSetOut)
{
    const std::string header = start_of("ascii") + vertices_4 + faces_2 + "end_header\n";
    EXPECT_TRUE(
        is_square(header + "\n 0 0\t0 \n1. 0\n0\n\n+0 1e0 -0\n.1e1 1 0.0\n3 0\n1\n2\n3 1 3 2"));
    EXPECT_EQ(refusal(header + "0 0 0 1\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n"),
              "line 10, column 7: \"1\" after the end of vertex 0 (counted from 0)");
    EXPECT_EQ(refusal(header + "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2 3\n3 1 3 2\n"),
              "line 14, column 9: \"3\" after the end of face 0 (counted from 0)");
    for (const std::string word : {"1x", "-1.#IND00", "0.1D+01", "1,5", "nan", "inf", "1e400"})
        EXPECT_EQ(refusal(header + "0 0 0\n1 " + word + " 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n"),
                  "line 11, column 3: \"" + word + "\"");
    EXPECT_EQ(refusal(header + "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1.5 2\n3 1 3 2\n"),
              "line 14, column 5: \"1.5\"");
    EXPECT_EQ(refusal(header + "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n\n 3 1 3 2\n"),
              "line 17, column 2: \"3\" after the last row");
}

TEST(Ply, TakesFacesBeforeVertices)
{
    for (const std::string& format : formats) {
        PlyBody body(format);
        add_faces(body);
        add_vertices(body);
        EXPECT_TRUE(
            is_square(start_of(format) + faces_2 + vertices_4 + "end_header\n" + body.text()));
    }
}

/// Triangle strips of every index type, ended by −1 or not, in rows and in one.
TEST(Ply, ReadsTriangleStrips)
{
    const std::vector<std::vector<std::vector<double>>> strips{
        {{0, 1, 2, 3}},
        {{0, 1, 2, 3, -1}},
        {{-1, 0, 1, 2, -1, 1, 3, 2}},
        {{0, 1, 2}, {1, 3, 2, -1}},
        {{}, {0, 1, -1}, {-1, 0, 1, 2, 3, -1, -1, 3}},
        {{0, 0, 1, 2, 3, 3}},  // with a corner twice, to turn the strip over: 3 empty ones
        {{2, 0, 1, -1, 1, 3, 2, -1}},
        {{3, 2, 1, 0}}};
    for (const std::string& format : formats)
        for (const std::string& type : number_types)
            for (std::size_t i = 0; i < strips.size(); ++i) {
                PlyBody body(format);
                add_vertices(body);
                for (const auto& strip : strips[i]) {
                    std::vector<double> numbers = strip;
                    if (type[0] == 'u' && format != "ascii")
                        for (double& x : numbers)
                            if (x < 0)
                                x += type == "uchar"    ? 256.0
                                     : type == "ushort" ? 65536.0
                                                        : 4294967296.0;
                    body.add_list("int", type, numbers).end_row();
                }
                const std::string text = start_of(format) + vertices_4 + "element tristrips " +
                                         std::to_string(strips[i].size()) + "\nproperty list int " +
                                         type + " vertex_indices\nend_header\n" + body.text();
                if (i == 5) {
                    // 0 0 1 | 0 1 2 turned | 1 2 3 | 2 3 3 turned
                    const Mesh mesh = ply(text);
                    ASSERT_EQ(mesh.triangles.size(), 2u) << format << type;
                    EXPECT_LT(cross(mesh.positions[mesh.triangles[0][1]] -
                                        mesh.positions[mesh.triangles[0][0]],
                                    mesh.positions[mesh.triangles[0][2]] -
                                        mesh.positions[mesh.triangles[0][0]])
                                  .z,
                              0);
                } else {
                    EXPECT_TRUE(is_square(text)) << format << " " << type << " " << i;
                }
            }
}

TEST(Ply, ReadsNormals)
{
    for (const std::string& format : formats) {
        PlyBody body(format);
        for (const auto& corner : corners)
            body.add("float", 3).add("float", corner).add("float", {4, 0}).end_row();
        add_faces(body);
        const Mesh mesh =
            ply(start_of(format) +
                "element vertex 4\nproperty float nx\nproperty float x\nproperty float "
                "y\nproperty float z\nproperty float nz\nproperty float ny\n" +
                faces_2 + "end_header\n" + body.text());
        ASSERT_EQ(mesh.normals.size(), 4u);
        EXPECT_EQ(mesh.normals[0], (Vec3<float>{0.6f, 0, 0.8f}));
    }
}

TEST(Ply, CutsConcaveFaces)
{
    const Mesh mesh = ply(start_of("ascii") + vertices_4 +
                          "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                          "0 0 0\n2 0 0\n0.5 0.5 0\n0 2 0\n4 0 1 2 3\n");
    ASSERT_EQ(mesh.triangles.size(), 2u);
    for (const auto& [a, b, c] : mesh.triangles)
        EXPECT_EQ(
            cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]),
            (Vec3<double>{0, 0, 1}));
}

/// A file that ends early anywhere, in its header or its body, is refused.
TEST(Ply, IsRefusedWhereverItIsCut)
{
    for (const std::string& format : formats) {
        const std::string text = square(format);
        for (std::size_t size = 0; size + 2 <= text.size(); ++size) {
            const std::string found = refusal(text.substr(0, size));
            ASSERT_TRUE(found.find("early") != found.npos || found.find("header") != found.npos)
                << format << " at " << size << ": " << found;
        }
        EXPECT_NE(refusal(text + "3"), "2 triangles");
    }
    EXPECT_EQ(refusal(square("binary_big_endian") + "abc"), "byte 240: 3 bytes after the last row");
}

TEST(Ply, RefusesNumbersThatCannotBe)
{
    const double infinite = std::numeric_limits<double>::infinity();
    for (const std::string format : {"binary_little_endian", "binary_big_endian"}) {
        const std::string header = start_of(format) + vertices_4 + faces_2 + "end_header\n";
        for (const double x : {infinite, -infinite, std::nan("")}) {
            PlyBody body(format);
            body.add("float", {0, 0, 0, 1, x, 0, 0, 1, 0, 1, 1, 0});
            add_faces(body);
            const std::string found = refusal(header + body.text());
            EXPECT_EQ(found.rfind("vertex 1 (counted from 0), byte ", 0), 0u) << found;
            EXPECT_NE(found.find(" as \"y\""), std::string::npos) << found;
        }
        for (const double index : {4.0, -1.0, 2147483647.0, -2147483648.0}) {
            PlyBody body(format);
            add_vertices(body);
            body.add_list("uchar", "int", {0, 1, 2}).add_list("uchar", "int", {0, 1, index});
            const std::string found = refusal(header + body.text());
            EXPECT_EQ(found.rfind("face 1 (counted from 0), byte ", 0), 0u) << found;
            EXPECT_NE(found.find("out of range"), std::string::npos) << found;
        }
        for (const std::string type : {"char", "int", "float", "double"}) {
            PlyBody body(format);
            add_vertices(body);
            body.add(type, {-1, 0, 1, 2, 3, 0, 1, 2});
            EXPECT_NE(refusal(start_of(format) + vertices_4 + "element face 2\nproperty list " +
                              type + " " + type + " vertex_indices\nend_header\n" + body.text())
                          .find("a list of -1 numbers"),
                      std::string::npos);
        }
    }
    const std::string header = start_of("ascii") + vertices_4 + faces_2 + "end_header\n";
    EXPECT_EQ(refusal(header + "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 0 1\n3 1 3 222\n"),
              "line 14, column 1: a face with 2 corners");
    EXPECT_EQ(refusal(header + "0 0 0\n1 0 0\n0 1 0\n1 1 0\n4 0 1 2 3\n3 1 3 2\n"),
              "face 0, counted from 0: a face that crosses itself");
}

TEST(Ply, RefusesHeadersThatAreNone)
{
    const std::string rest =
        vertices_4 + faces_2 + "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n";
    const std::string start = "ply\nformat ascii 1.0\n";
    ASSERT_TRUE(is_square(start + rest));
    const auto without = [&](const std::string& line) {
        std::string text = start + rest;
        text.erase(text.find(line), line.size());
        return refusal(text);
    };
    const auto with = [&](const std::string& line, const std::string& other) {
        std::string text = start + rest;
        text.replace(text.find(line), line.size(), other);
        return refusal(text);
    };
    EXPECT_NE(without("format ascii 1.0\n").find("line 2"), std::string::npos);
    EXPECT_NE(with("format ascii 1.0", "format ascii 1.1").find("line 2"), std::string::npos);
    EXPECT_NE(with("format ascii", "format text").find("line 2"), std::string::npos);
    EXPECT_NE(with("element vertex 4", "format ascii 1.0\nelement vertex 4").find("line 3"),
              std::string::npos);
    EXPECT_NE(with("element vertex 4", "property int a\nelement vertex 4").find("line 3"),
              std::string::npos);
    EXPECT_NE(with("element face", "element vertex").find("line 7"), std::string::npos);
    EXPECT_NE(with("property float y", "property float x").find("line 5"), std::string::npos);
    EXPECT_NE(with("element face 2", "element face -2").find("line 7"), std::string::npos);
    EXPECT_NE(with("element face 2", "element face 2x").find("line 7"), std::string::npos);
    EXPECT_NE(with("element face 2", "elements face 2").find("line 7"), std::string::npos);
    EXPECT_NE(with("list uchar int", "list uchar long").find("line 8"), std::string::npos);
    EXPECT_EQ(without("property float y\n"), ": \"vertex\" without x, y or z");
    EXPECT_EQ(with("property float y", "property float w"), ": \"vertex\" without x, y or z");
    EXPECT_EQ(with("property float z", "property float z\nproperty float nx"),
              ": \"vertex\" with a part of a normal");
    EXPECT_EQ(with("property float y", "property list uchar float y"),
              ": the property \"y\" of \"vertex\" as a list");
    EXPECT_EQ(with("list uchar int", "int"),
              ": the property \"vertex_indices\" of \"face\" as a number");
    EXPECT_EQ(with("vertex_indices", "indices"), ": \"face\" with 0 lists of vertices");
    EXPECT_EQ(with("vertex_indices", "vertex_indices\nproperty list uchar int vertex_index"),
              ": \"face\" with 2 lists of vertices");
    EXPECT_EQ(with("element vertex", "element vertices"),
              ": a header without vertices, or without faces");
}

/// Nothing is kept room for on the word of a header alone.
TEST(Ply, RefusesCountsThatTheFileCannotHold)
{
    for (const std::string& format : formats) {
        const std::string text = start_of(format) +
                                 "element vertex 1000000\nproperty float "
                                 "x\nproperty float y\nproperty float z\n" +
                                 faces_2 + "end_header\n" + std::string(1'500'000, ' ');
        EXPECT_NE(refusal(text).find("ends early"), std::string::npos);
        PlyBody body(format);
        body.add("uint", 4294967295.0);
        EXPECT_NE(refusal(start_of(format) + "element other 1\nproperty list uint double a\n" +
                          vertices_4 +
                          "element face 0\nproperty list uchar int vertex_indices\n"
                          "end_header\n" +
                          body.text() + std::string(60, format == "ascii" ? ' ' : '\0'))
                      .find("ends early"),
                  std::string::npos);
    }
}

TEST(Ply, ReadsAFileOfManyBlocks)
{
    const TemporaryFolder folder;
    constexpr int count = 200'000;
    for (const std::string& format : formats) {
        PlyBody body(format);
        for (int i = 0; i < count; ++i)
            body.add("float", {double(i), double(i % 2), double(i % 7)}).add("uchar", 3).end_row();
        for (int i = 0; i + 2 < count; ++i)
            body.add_list("uchar", "int", {double(i), i + 1.0, i + 2.0}).end_row();
        const std::string text = start_of(format) + "element vertex " + std::to_string(count) +
                                 "\nproperty float x\nproperty float y\nproperty float z\nproperty "
                                 "uchar a\nelement face " +
                                 std::to_string(count - 2) +
                                 "\nproperty list uchar int vertex_indices\nend_header\n" +
                                 body.text();
        ASSERT_GT(text.size(), std::size_t{4} << 20);
        const Mesh from_file = read_mesh(folder.write("a.ply", text)), mesh = ply(text);
        EXPECT_EQ(mesh.triangles.size(), std::size_t(count - 2));
        EXPECT_EQ(from_file.triangles, mesh.triangles);
        EXPECT_EQ(from_file.positions, mesh.positions);
        EXPECT_EQ(mesh.positions.back(), (Vec3<double>{count - 1, 1, (count - 1) % 7}));
    }
}

}  // namespace
}  // namespace mis
