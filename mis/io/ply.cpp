#include "mis/io/ply.h"

#include "mis/io/ply_schema.h"
#include "mis/io/ply_values.h"
#include "mis/io/text_file.h"
#include "mis/scene/text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace mis {
namespace {

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
        const bool has_normals = is_vertex && has_vertex_normals(element);
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
            if (role == ply_role::ignored) values_.skip(property.type, 1);
            else numbers_[static_cast<std::size_t>(role)] = coordinate(property);
            return;
        }
        const std::size_t count = list_length(*property.count_type);
        if (role == ply_role::ignored) {
            values_.skip(property.type, count);
            return;
        }
        if (count < 3 && !is_strip_)
            values_.fail_at_last("a face with " + many(count, "corner"),
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
                             "an index is a whole number; the file has " +
                                 many(vertex_count_, "vertex") + ", counted from 0");
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
    require_mesh_header(header, source.left(), file);
    if (header.format == PlyFormat::ascii)
        BodyReader(TextPlyValues(source, header, file), header, mesh).read();
    else BodyReader(BinaryPlyValues(source, header, file), header, mesh).read();
}

}  // namespace mis
