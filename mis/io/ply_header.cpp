#include "mis/io/ply_header.h"

#include "mis/io/scene_error.h"
#include "mis/io/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <utility>

namespace mis {
namespace {

using Words = std::vector<std::string>;

constexpr std::array<std::pair<std::string_view, PlyType>, 16> type_names{
    {{"char", PlyType::int8},
     {"uchar", PlyType::uint8},
     {"short", PlyType::int16},
     {"ushort", PlyType::uint16},
     {"int", PlyType::int32},
     {"uint", PlyType::uint32},
     {"float", PlyType::float32},
     {"double", PlyType::float64},
     {"int8", PlyType::int8},
     {"uint8", PlyType::uint8},
     {"int16", PlyType::int16},
     {"uint16", PlyType::uint16},
     {"int32", PlyType::int32},
     {"uint32", PlyType::uint32},
     {"float32", PlyType::float32},
     {"float64", PlyType::float64}}};

constexpr std::array<std::pair<std::string_view, PlyFormat>, 3> format_names{
    {{"ascii", PlyFormat::ascii},
     {"binary_little_endian", PlyFormat::binary_little_endian},
     {"binary_big_endian", PlyFormat::binary_big_endian}}};

template <class Names> auto find_named(const Names& names, std::string_view word)
{
    const auto found = std::find_if(names.begin(), names.end(),
                                    [&](const auto& name) { return name.first == word; });
    return found == names.end() ? std::nullopt : std::optional(found->second);
}

std::optional<PlyProperty> property_of(const Words& words)
{
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (words.size() != 3 && !is_list) return {};
    const auto type = find_named(type_names, words[words.size() - 2]);
    if (!type) return {};
    PlyProperty property{words.back(), *type, {}};
    if (is_list && !(property.count_type = find_named(type_names, words[2]))) return {};
    return property;
}

/// "element NAME COUNT"; each one takes a byte at least.
std::optional<PlyElement> element_of(const Words& words, std::size_t file_size)
{
    if (words.size() != 3) return {};
    PlyElement element{words[1], 0, {}};
    const char* const text_end = words[2].data() + words[2].size();
    const auto [end, error] = std::from_chars(words[2].data(), text_end, element.count);
    if (error != std::errc{} || end != text_end || element.count > file_size) return {};
    return element;
}

template <class Items> bool has_name(const Items& items, std::string_view name)
{
    return std::any_of(items.begin(), items.end(),
                       [&](const auto& item) { return item.name == name; });
}

/// Reads a header line by line.
class HeaderReader {
public:
    explicit HeaderReader(std::size_t file_size) : file_size_(file_size) {}

    /// False for a line that cannot stand where it stands.
    bool add(const Words& words)
    {
        if (words.empty()) return false;
        if (words[0] == "comment" || words[0] == "obj_info") return true;
        if (words[0] == "format") return add_format(words);
        if (!has_format_) return false;
        if (words[0] == "element") return add_element(words);
        return words[0] == "property" && add_property(words);
    }

    bool has_format() const { return has_format_; }
    PlyHeader& header() { return header_; }

private:
    bool add_format(const Words& words)
    {
        if (std::exchange(has_format_, true) || words.size() != 3 || words[2] != "1.0")
            return false;
        const auto format = find_named(format_names, words[1]);
        if (format) header_.format = *format;
        return format.has_value();
    }

    bool add_element(const Words& words)
    {
        const auto element = element_of(words, file_size_);
        if (!element || has_name(header_.elements, element->name)) return false;
        header_.elements.push_back(*element);
        return true;
    }

    bool add_property(const Words& words)
    {
        const auto property = property_of(words);
        if (!property || header_.elements.empty()) return false;
        std::vector<PlyProperty>& properties = header_.elements.back().properties;
        if (has_name(properties, property->name)) return false;
        properties.push_back(*property);
        return true;
    }

    std::size_t file_size_;
    PlyHeader header_;
    bool has_format_ = false;
};

Words words_of(std::string_view line)
{
    std::istringstream text{std::string(line)};
    Words words;
    for (std::string word; text >> word;) words.push_back(word);
    return words;
}

}  // namespace

std::size_t bytes_of(PlyType type)
{
    constexpr std::array<std::size_t, 8> bytes{1, 1, 2, 2, 4, 4, 4, 8};
    return bytes[static_cast<std::size_t>(type)];
}

PlyHeader read_ply_header(ByteSource& source, const std::filesystem::path& file)
{
    constexpr std::size_t most_lines = 10'000;
    HeaderReader reader(source.size());
    PlyHeader& header = reader.header();
    const std::string_view start = source.peek(5);
    if (start.substr(0, 4) == "ply\r" && start != "ply\r\n") header.line_end = '\r';
    std::string_view line;
    while (header.lines < most_lines && source.line(line, header.line_end)) {
        const Words words = words_of(line);
        const bool is_first = header.lines++ == 0;
        if (!is_first && reader.has_format() && words == Words{"end_header"}) return header;
        if (is_first ? words != Words{"ply"} : !reader.add(words))
            throw SceneError(
                file.string(),
                Problem{"",
                        fmt::format("{} in line {} of its header", in_quotes(line), header.lines),
                        "a PLY header has the lines ply, format, comment, element and property; "
                        "each name stands once, and a count fits the file",
                        "Mend the file."});
    }
    throw SceneError(file.string(),
                     Problem{"", "a PLY header without an end",
                             "a PLY header ends in the line \"end_header\"", "Mend the file."});
}

}  // namespace mis
