#include "mis/io/obj.h"

#include "mis/io/obj_words.h"
#include "mis/io/text_file.h"
#include "mis/scene/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <span>

namespace mis {
namespace {

/// Statements that say how geometry is named, shaded or shown, and those that belong to a curve or
/// surface, which is refused by itself.
constexpr std::array<std::string_view, 29> without_polygons{
    "g",     "o",        "s",     "mg",     "usemtl", "mtllib",    "usemap",     "maplib",
    "bevel", "c_interp", "lod",   "cstype", "deg",    "d_interp",  "shadow_obj", "bmat",
    "step",  "parm",     "trim",  "hole",   "scrv",   "trace_obj", "sp",         "end",
    "con",   "ctech",    "stech", "csh",    "res"};

constexpr std::array<std::string_view, 8> unread_geometry{"curv", "curv2", "surf", "bsp",
                                                          "bzp",  "cdc",   "cdp",  "call"};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& words, std::string_view word)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// A corner of a face, each index counted from 0, and where it stands.
struct ObjCorner {
    std::uint32_t position = absent, texture = absent, normal = absent;
    std::uint32_t line = 0, column = 0;
    static constexpr std::uint32_t absent = MeshCorner::no_normal;
};

class ObjReader {
public:
    ObjReader(ByteSource& source, const std::filesystem::path& file, MeshBuilder& mesh)
        : words_(source, file), mesh_(mesh)
    {
    }

    void read()
    {
        bool may_be_names = false;  // of the statement before
        for (std::string_view keyword; words_.next_statement(keyword);) {
            if (keyword == "v") add_position(keyword);
            else if (keyword == "f" || keyword == "fo") add_face(keyword);
            else if (keyword == "vn") add_normal(keyword);
            else if (keyword == "vt") add_texture(keyword);
            else if (keyword == "vp") read_numbers(keyword, 1, 3);
            else if (keyword == "l" || keyword == "p") read_corners(keyword);
            else if (contains(without_polygons, keyword) || may_be_names) {
                may_be_names = words_.skip_names();
                continue;
            } else fail_on(keyword);
            may_be_names = false;
        }
        add_later_faces();
    }

private:
    [[noreturn]] void fail_on(std::string_view keyword) const
    {
        if (contains(unread_geometry, keyword))
            words_.fail_at(keyword,
                           in_quotes(keyword) + ", which is a curve, a surface or another file",
                           "a mesh is read from v, vn and f statements",
                           "Export it as polygons, in one file.");
        words_.fail_at(keyword, in_quotes(keyword),
                       "an OBJ statement begins with v, vt, vn, f, l, p, g, o, s, usemtl, mtllib "
                       "or another keyword of the format",
                       "Mend the line, or remove it.");
    }

    /// The numbers that end the statement.
    std::size_t read_numbers(std::string_view keyword, std::size_t least, std::size_t most)
    {
        const std::string name(keyword);
        const std::size_t line = words_.line(), column = words_.column(keyword);
        std::size_t count = 0;
        for (double number; words_.next_number(number); ++count)
            if (count < numbers_.size()) numbers_[count] = number;
        if (count < least || count > most)
            words_.fail_at(line, column,
                           {"", in_quotes(name) + " with " + many(count, "number"),
                            least == most ? fmt::format("{} has {} numbers", in_quotes(name), least)
                                          : fmt::format("{} has {} to {} numbers", in_quotes(name),
                                                        least, most),
                            "Mend the line."});
        return count;
    }

    /// Three coordinates, then a weight, a colour, or both.
    void add_position(std::string_view keyword)
    {
        const std::size_t line = words_.line(), column = words_.column(keyword);
        const std::size_t count = read_numbers(keyword, 3, 7);
        if (count == 5)
            words_.fail_at(
                line, column,
                {"", "\"v\" with 5 numbers",
                 "\"v\" has 3 coordinates, then a weight, a colour, or both", "Mend the line."});
        if (count == 4 && numbers_[3] != 1)
            words_.fail_at(line, column,
                           {"", fmt::format("\"v\" with the weight {}", numbers_[3]),
                            "the weight of a polygon's vertex is 1",
                            "Divide the coordinates by it, or remove it."});
        mesh_.positions.push_back({numbers_[0], numbers_[1], numbers_[2]});
    }

    void add_normal(std::string_view keyword)
    {
        read_numbers(keyword, 3, 3);
        mesh_.normals.push_back({numbers_[0], numbers_[1], numbers_[2]});
    }

    void add_texture(std::string_view keyword)
    {
        read_numbers(keyword, 1, 3);
        ++texture_count_;
    }

    /// The corners that end the statement, to corners_.
    void read_corners(std::string_view keyword)
    {
        (void)keyword;
        corners_.clear();
        for (std::string_view word; words_.next_word(word);) corners_.push_back(read_corner(word));
    }

    /// v, v/vt, v//vn or v/vt/vn; an empty end is as good as none.
    ObjCorner read_corner(std::string_view word) const
    {
        ObjCorner corner;
        corner.line = static_cast<std::uint32_t>(words_.line());
        corner.column = static_cast<std::uint32_t>(words_.column(word));
        const char *at = word.data(), *const end = at + word.size();
        corner.position = read_index(word, at, end, mesh_.positions.size());
        if (at != end && *at == '/') {
            if (++at != end && *at != '/')
                corner.texture = read_index(word, at, end, texture_count_);
            if (at != end && *at == '/' && ++at != end)
                corner.normal = read_index(word, at, end, mesh_.normals.size());
        }
        if (at != end) fail_on_corner(word);
        return corner;
    }

    /// Of `count` so far: n from 1 is the n-th, −n the n-th last.
    std::uint32_t read_index(std::string_view word, const char*& at, const char* end,
                             std::size_t count) const
    {
        std::int64_t index = 0;
        const bool has_plus = end - at > 1 && at[0] == '+' && at[1] != '-';
        const auto [rest, error] = std::from_chars(at + has_plus, end, index);
        if (error == std::errc::invalid_argument) fail_on_corner(word);
        if (index < 0) index += static_cast<std::int64_t>(count) + 1;
        if (error != std::errc{} || index <= 0 || index >= ObjCorner::absent)
            words_.fail_at(word, in_quotes(word) + ", an index out of range",
                           "indices count from 1, or back from -1, the last one so far",
                           "Mend the file.");
        at = rest;
        return static_cast<std::uint32_t>(index - 1);
    }

    [[noreturn]] void fail_on_corner(std::string_view word) const
    {
        words_.fail_at(word, in_quotes(word),
                       "a corner is v, v/vt, v//vn or v/vt/vn, of whole numbers", "Mend the line.");
    }

    void add_face(std::string_view keyword)
    {
        const std::size_t line = words_.line(), column = words_.column(keyword);
        read_corners(keyword);
        if (corners_.size() < 3)
            words_.fail_at(
                line, column,
                {"", "a face with " + many(corners_.size(), "corner"),
                 "a face has at least 3 corners", "Mend the file: it may have been cut short."});
        const auto is_known = [&](const ObjCorner& corner) { return !missing_of(corner); };
        if (std::all_of(corners_.begin(), corners_.end(), is_known)) add_polygon(corners_);
        else {
            later_.insert(later_.end(), corners_.begin(), corners_.end());
            later_ends_.push_back(later_.size());
        }
    }

    /// What a corner needs and the file does not have so far: "vertices"; else nothing.
    const char* missing_of(const ObjCorner& corner) const
    {
        const auto lacks = [](std::uint32_t index, std::size_t count) {
            return index != ObjCorner::absent && index >= count;
        };
        return corner.position >= mesh_.positions.size()    ? "vertices"
               : lacks(corner.texture, texture_count_)      ? "texture coordinates"
               : lacks(corner.normal, mesh_.normals.size()) ? "normals"
                                                            : nullptr;
    }

    void add_polygon(std::span<const ObjCorner> corners)
    {
        polygon_.clear();
        for (const ObjCorner& corner : corners)
            polygon_.push_back({corner.position, corner.normal});
        try {
            mesh_.add_polygon(polygon_);
        } catch (const PolygonError& error) {
            words_.fail_at(corners[0].line, corners[0].column, error.problem);
        }
    }

    /// Faces may stand before their vertices.
    void add_later_faces()
    {
        std::size_t begin = 0;
        for (const std::size_t end : later_ends_) {
            const std::span<const ObjCorner> face(later_.data() + begin, end - begin);
            for (const ObjCorner& corner : face) require_known(corner);
            add_polygon(face);
            begin = end;
        }
    }

    void require_known(const ObjCorner& corner) const
    {
        const std::string_view missing = missing_of(corner) ? missing_of(corner) : "";
        if (missing.empty()) return;
        const bool is_position = missing == "vertices", is_normal = missing == "normals";
        const std::uint32_t index = is_position ? corner.position
                                    : is_normal ? corner.normal
                                                : corner.texture;
        const std::size_t count = is_position ? mesh_.positions.size()
                                  : is_normal ? mesh_.normals.size()
                                              : texture_count_;
        words_.fail_at(corner.line, corner.column,
                       {"", fmt::format("the index {}, which is out of range", index + 1),
                        fmt::format("the file has {} {}", count, missing),
                        "Mend the file: it may have been cut short."});
    }

    ObjWords words_;
    MeshBuilder& mesh_;
    std::size_t texture_count_ = 0;
    std::array<double, 7> numbers_{};
    std::vector<ObjCorner> corners_;       ///< of the statement at hand
    std::vector<MeshCorner> polygon_;      ///< the same, for the builder
    std::vector<ObjCorner> later_;         ///< of faces that use what comes after them
    std::vector<std::size_t> later_ends_;  ///< where each of those faces ends in later_
};

}  // namespace

void read_obj(ByteSource& source, const std::filesystem::path& file, MeshBuilder& mesh)
{
    ObjReader(source, file, mesh).read();
}

}  // namespace mis
