#include "mis/io/ply_header.h"

#include "mis/io/scene_error.h"
#include "mis/io/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

namespace mis {
namespace {

using Words = std::vector<std::string>;

/// 0 for what is no type of number.
std::uintmax_t bytes_of_type(const std::string& word)
{
    static constexpr std::array<std::pair<std::string_view, std::uintmax_t>, 16> types{
        {{"char", 1},
         {"uchar", 1},
         {"short", 2},
         {"ushort", 2},
         {"int", 4},
         {"uint", 4},
         {"float", 4},
         {"double", 8},
         {"int8", 1},
         {"uint8", 1},
         {"int16", 2},
         {"uint16", 2},
         {"int32", 4},
         {"uint32", 4},
         {"float32", 4},
         {"float64", 8}}};
    const auto found = std::find_if(types.begin(), types.end(),
                                    [&](const auto& type) { return type.first == word; });
    return found == types.end() ? 0 : found->second;
}
bool is_number_type(const std::string& word) { return bytes_of_type(word) > 0; }

bool is_format(const Words& words)
{
    return words.size() == 3 && words[2] == "1.0" &&
           (words[1] == "ascii" || words[1] == "binary_little_endian" ||
            words[1] == "binary_big_endian");
}

bool is_property(const Words& words)
{
    if (words.size() == 3) return is_number_type(words[1]);
    return words.size() == 5 && words[1] == "list" && is_number_type(words[2]) &&
           is_number_type(words[3]);
}

/// Whether "element NAME COUNT" can be true: each one takes a byte at least.
bool is_element(const Words& words, std::uintmax_t file_size)
{
    if (words.size() != 3) return false;
    std::uintmax_t count = 0;
    const std::string& text = words[2];
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    return error == std::errc{} && end == text.data() + text.size() && count <= file_size;
}

/// What the body must hold at least, by the header's good lines.
struct Body {
    bool is_text = true;
    std::uintmax_t elements = 0, bytes = 0;  ///< one element is a line of text
    std::uintmax_t of_element = 0;           ///< how many of the element whose properties follow
    bool is_face = false;

    void add(const Words& words)
    {
        if (words[0] == "format") is_text = words[1] == "ascii";
        if (words[0] == "element") {
            of_element = std::stoull(words[2]);
            is_face = words[1] == "face";
            elements += of_element;
        }
        if (words[0] != "property") return;
        constexpr std::uintmax_t least_corners = 3;
        bytes += of_element * (words[1] != "list"
                                   ? bytes_of_type(words[1])
                                   : bytes_of_type(words[2]) +
                                         (is_face ? least_corners * bytes_of_type(words[3]) : 0));
    }
};

/// What is missing of a body that starts where the stream is; empty if nothing is.
std::string missing_of(const Body& body, std::ifstream& stream, std::uintmax_t file_size)
{
    if (!body.is_text) {
        const std::uintmax_t there = file_size - static_cast<std::uintmax_t>(stream.tellg());
        return there >= body.bytes ? "" : fmt::format("{} of at least {} bytes", there, body.bytes);
    }
    std::uintmax_t lines = 0;
    for (std::string line; lines < body.elements && std::getline(stream, line);)
        lines += line.find_first_not_of(" \t\r") != std::string::npos ? 1 : 0;
    return lines == body.elements ? "" : fmt::format("{} of {} lines", lines, body.elements);
}

bool is_header_line(const Words& words, std::uintmax_t file_size)
{
    if (words.empty()) return false;
    if (words[0] == "comment" || words[0] == "obj_info") return true;
    if (words[0] == "format") return is_format(words);
    if (words[0] == "element") return is_element(words, file_size);
    return words[0] == "property" && is_property(words);
}

}  // namespace

void require_ply_header(const std::filesystem::path& file)
{
    constexpr int most_lines = 10'000;
    const std::uintmax_t file_size = std::filesystem::file_size(file);
    std::ifstream stream(file, std::ios::binary);
    std::string line;
    Body body;
    for (int number = 1; number <= most_lines && std::getline(stream, line); ++number) {
        std::istringstream text(line);
        Words words;
        for (std::string word; text >> word;) words.push_back(word);
        if (number > 1 && words == Words{"end_header"}) {
            const std::string missing = missing_of(body, stream, file_size);
            if (missing.empty()) return;
            throw SceneError(
                file.string(),
                Problem{"", "a PLY file that ends early: " + missing + " after its header",
                        "all elements that the header counts follow it", "Write the file anew."});
        }
        const bool is_good = number == 1 ? words == Words{"ply"} : is_header_line(words, file_size);
        if (!is_good)
            throw SceneError(
                file.string(),
                Problem{"", fmt::format("{} in line {} of its header", in_quotes(line), number),
                        "a PLY header has ply, format, comment, element and property lines",
                        "Mend the file."});
        if (number > 1) body.add(words);
    }
    throw SceneError(file.string(),
                     Problem{"", "a PLY header without an end",
                             "a PLY header ends in the line \"end_header\"", "Mend the file."});
}

}  // namespace mis
