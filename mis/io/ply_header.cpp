#include "mis/io/ply_header.h"

#include "mis/io/scene_error.h"
#include "mis/io/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <sstream>
#include <vector>

namespace mis {
namespace {

using Words = std::vector<std::string>;

bool is_number_type(const std::string& word)
{
    static constexpr std::array<std::string_view, 16> types{
        "char", "uchar", "short", "ushort", "int",   "uint",   "float",   "double",
        "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};
    return std::find(types.begin(), types.end(), word) != types.end();
}

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
    for (int number = 1; number <= most_lines && std::getline(stream, line); ++number) {
        std::istringstream text(line);
        Words words;
        for (std::string word; text >> word;) words.push_back(word);
        if (number > 1 && words == Words{"end_header"}) return;
        const bool is_good = number == 1 ? words == Words{"ply"} : is_header_line(words, file_size);
        if (!is_good)
            throw SceneError(
                file.string(),
                Problem{"", fmt::format("{} in line {} of its header", in_quotes(line), number),
                        "a PLY header has ply, format, comment, element and property lines",
                        "Mend the file."});
    }
    throw SceneError(file.string(),
                     Problem{"", "a PLY header without an end",
                             "a PLY header ends in the line \"end_header\"", "Mend the file."});
}

}  // namespace mis
