#include "mis/io/ply.h"

#include "mis/io/ply_header.h"
#include "mis/io/ply_values.h"
#include "mis/io/scene_error.h"
#include "mis/io/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

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

/// What a property of an element is read as: a number of a vertex, the list of a face, or nothing.
enum Role : int { ignored = -1, list = 6 };
int role_of(const PlyElement& element, const PlyProperty& property)
{
    if (holds_triangles(element)) return is_index_list(property) ? Role::list : Role::ignored;
    if (element.name != "vertex") return Role::ignored;
    const auto found = std::find(vertex_numbers.begin(), vertex_numbers.end(), property.name);
    return found == vertex_numbers.end() ? Role::ignored
                                         : static_cast<int>(found - vertex_numbers.begin());
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
        lists += role == Role::list ? 1 : 0;
        if (role != Role::ignored && (role == Role::list) != property.count_type.has_value())
            fail_on_header(file,
                           fmt::format("the property {} of {} as a {}", in_quotes(property.name),
                                       name, property.count_type ? "list" : "number"),
                           "x, y, z, nx, ny, nz are numbers, vertex_indices is a list");
    }
    if (holds_triangles(element) && lists != 1)
        fail_on_header(file, fmt::format("{} with {} lists of vertices", name, lists),
                       "a face or strip has one list, vertex_indices or vertex_index");
    if (element.name != "vertex") return;
    if (element.count >= MeshCorner::no_normal)
        fail_on_header(file, fmt::format("{} vertices", element.count),
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

/// Bytes that a row takes at least; in text a digit and a blank or line end for each number.
std::size_t least_bytes(const PlyElement& element, bool is_text)
{
    constexpr std::size_t least_corners = 3;
    std::size_t bytes = 0;
    for (const PlyProperty& p : element.properties) {
        const auto bytes_as = [&](PlyType type) { return is_text ? 2 : bytes_of(type); };
        bytes += bytes_as(p.count_type.value_or(p.type));
        if (element.name == "face" && is_index_list(p)) bytes += least_corners * bytes_as(p.type);
    }
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
                       fmt::format("a PLY file that ends early: {} of at least {} bytes after its "
                                   "header",
                                   there, least),
                       "a body is as long as its header says");
}

template <class Values> class BodyReader {
public:
    BodyReader(Values values, const PlyHeader& header, MeshBuilder& mesh)
        : values_(std::move(values)), header_(header), mesh_(mesh)
    {
        for (const PlyElement& element : header.elements)
            if (element.name == "vertex") vertex_count_ = element.count;
    }

    void read()
    {
        for (const PlyElement& element : header_.elements) {
            values_.begin(element);
            read_rows(element);
        }
        values_.require_end();
        std::size_t begin = 0;
        for (const auto& [row, end] : later_ends_) {
            add_face(row, {later_.data() + begin, end - begin});
            begin = end;
        }
    }

private:
    void read_rows(const PlyElement& element)
    {
        std::vector<int> roles;
        for (const PlyProperty& p : element.properties) roles.push_back(role_of(element, p));
        const bool is_vertex = element.name == "vertex";
        is_strip_ = element.name == "tristrips";
        const bool has_normals = is_vertex && count_of(element, 3) == 3;
        if (is_vertex) mesh_.positions.reserve(element.count);
        if (has_normals) mesh_.normals.reserve(element.count);
        if (element.properties.empty()) return;
        for (std::size_t row = 0; row < element.count; ++row) {
            for (std::size_t i = 0; i < roles.size(); ++i) read(element.properties[i], roles[i]);
            values_.end_row();
            if (element.name == "face") add_or_keep(row, indices_);
            else if (element.name == "tristrips") add_strip(row);
            if (is_vertex) mesh_.positions.push_back({numbers_[0], numbers_[1], numbers_[2]});
            if (has_normals) mesh_.normals.push_back({numbers_[3], numbers_[4], numbers_[5]});
        }
    }

    void read(const PlyProperty& property, int role)
    {
        if (!property.count_type) {
            if (role == Role::ignored) values_.skip(property.type, 1);
            else numbers_[static_cast<std::size_t>(role)] = coordinate(property);
            return;
        }
        const std::size_t count = list_length(*property.count_type);
        if (role == Role::ignored) {
            values_.skip(property.type, count);
            return;
        }
        if (count < 3 && !is_strip_)
            values_.fail_at_last(fmt::format("a face with {} corners", count),
                                 "a face has at least 3 corners");
        indices_.clear();
        for (std::size_t i = 0; i < count; ++i) indices_.push_back(index(property.type));
    }

    double coordinate(const PlyProperty& property)
    {
        const double number = values_.number(property.type);
        if (!std::isfinite(number))
            values_.fail_at_last(fmt::format("{} as {}", number, in_quotes(property.name)),
                                 "a finite number belongs here");
        return number;
    }

    std::size_t list_length(PlyType type)
    {
        const double length = values_.number(type);
        if (!(length >= 0 && length < 4294967296.0 && std::floor(length) == length))
            values_.fail_at_last(fmt::format("a list of {} numbers", length),
                                 "the length of a list is a whole number from 0");
        return static_cast<std::size_t>(length);
    }

    /// Index of a vertex, or strip_end.
    std::uint32_t index(PlyType type)
    {
        const double index = values_.number(type);
        if (index >= 0 && index < static_cast<double>(vertex_count_) && std::floor(index) == index)
            return static_cast<std::uint32_t>(index);
        if (is_strip_ && (index == -1 || index == unsigned_minus_one(type))) return strip_end;
        values_.fail_at_last(fmt::format("the index {}, which is out of range", index),
                             fmt::format("an index is a whole number; the file has {} vertices, "
                                         "counted from 0",
                                         vertex_count_));
    }

    /// What -1 becomes where the type has no sign.
    static double unsigned_minus_one(PlyType type)
    {
        return type == PlyType::uint8    ? 255.0
               : type == PlyType::uint16 ? 65535.0
               : type == PlyType::uint32 ? 4294967295.0
                                         : -1.0;
    }

    /// Every second triangle of a strip is turned over, so that all have one orientation; −1 starts
    /// a new strip.
    void add_strip(std::size_t row)
    {
        std::size_t begin = 0;
        for (std::size_t i = 0; i < indices_.size(); ++i) {
            if (indices_[i] == strip_end) begin = i + 1;
            if (i < begin + 2) continue;
            std::array<std::uint32_t, 3> face{indices_[i - 2], indices_[i - 1], indices_[i]};
            if ((i - begin) % 2 == 1) std::swap(face[0], face[1]);
            add_or_keep(row, face);
        }
    }

    /// Elements may come in any order, faces before vertices.
    void add_or_keep(std::size_t row, std::span<const std::uint32_t> face)
    {
        if (mesh_.positions.size() == vertex_count_) {
            add_face(row, face);
            return;
        }
        later_.insert(later_.end(), face.begin(), face.end());
        later_ends_.emplace_back(row, later_.size());
    }

    void add_face(std::size_t row, std::span<const std::uint32_t> face)
    {
        corners_.clear();
        for (const std::uint32_t i : face)
            corners_.push_back({i, mesh_.normals.empty() ? MeshCorner::no_normal : i});
        try {
            mesh_.add_polygon(corners_);
        } catch (const PolygonError& error) {
            values_.fail(fmt::format("face {}, counted from 0", row), error.problem.found,
                         error.problem.allowed);
        }
    }

    Values values_;
    const PlyHeader& header_;
    MeshBuilder& mesh_;
    std::size_t vertex_count_ = 0;
    std::array<double, 6> numbers_{};     ///< of the vertex at hand
    std::vector<std::uint32_t> indices_;  ///< of the face or strip at hand
    bool is_strip_ = false;
    std::vector<MeshCorner> corners_;
    std::vector<std::uint32_t> later_;  ///< faces that stand before the vertices
    std::vector<std::pair<std::size_t, std::size_t>> later_ends_;  ///< their rows, and ends in it
    static constexpr std::uint32_t strip_end = MeshCorner::no_normal;
};

}  // namespace

void read_ply(ByteSource& source, const std::filesystem::path& file, MeshBuilder& mesh)
{
    const PlyHeader header = read_ply_header(source, file);
    for (const PlyElement& element : header.elements) require_properties(element, file);
    require_elements(header, file);
    require_long_enough(header, source.left(), file);
    if (header.format == PlyFormat::ascii)
        BodyReader(TextPlyValues(source, header, file), header, mesh).read();
    else BodyReader(BinaryPlyValues(source, header, file), header, mesh).read();
}

}  // namespace mis
