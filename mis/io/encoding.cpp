#include "mis/io/encoding.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace mis {
namespace {

using namespace std::string_view_literals;

struct Signature {
    std::string_view bytes, name;
};

/// Byte order marks and what archives begin with; of two that fit, the longer stands first.
constexpr std::array<Signature, 8> signatures{{
    {"\xFF\xFE\0\0"sv, "UTF-32 text (little-endian)"},
    {"\0\0\xFE\xFF"sv, "UTF-32 text (big-endian)"},
    {"\xFF\xFE"sv, "UTF-16 text (little-endian)"},
    {"\xFE\xFF"sv, "UTF-16 text (big-endian)"},
    {"\x1F\x8B"sv, "a gzip file"},
    {"PK\x03\x04"sv, "a zip file, as spreadsheets are"},
    {"\x28\xB5\x2F\xFD"sv, "a Zstandard file"},
    {"\xFD\x37zXZ"sv, "an xz file"},
}};

/// Without a mark: where the zero bytes of plain letters stand.
struct ZeroPattern {
    std::string_view name;
    std::size_t width, letter;  ///< bytes of a character, and which of them is not zero
};
constexpr std::array<ZeroPattern, 4> zero_patterns{{
    {"UTF-32 text (little-endian)", 4, 0},
    {"UTF-32 text (big-endian)", 4, 3},
    {"UTF-16 text (little-endian)", 2, 0},
    {"UTF-16 text (big-endian)", 2, 1},
}};

bool fits(std::string_view text, const ZeroPattern& pattern)
{
    constexpr std::size_t looked_at = 16;
    const std::size_t count = std::min(text.size(), looked_at) / pattern.width * pattern.width;
    for (std::size_t i = 0; i < count; ++i)
        if ((text[i] != '\0') != (i % pattern.width == pattern.letter)) return false;
    return count > 0;
}

struct NamedCharacter {
    char32_t code;
    std::string_view name;
};
constexpr std::array<NamedCharacter, 23> named_characters{{
    {0x85, "a next-line character"},
    {0xA0, "a no-break space"},
    {0xAD, "a soft hyphen"},
    {0x2007, "a figure space"},
    {0x2009, "a thin space"},
    {0x200B, "a zero-width space"},
    {0x200C, "a zero-width non-joiner"},
    {0x200D, "a zero-width joiner"},
    {0x200E, "a left-to-right mark"},
    {0x2013, "an en dash"},
    {0x2014, "an em dash"},
    {0x2018, "a typographic quote"},
    {0x2019, "a typographic quote"},
    {0x201C, "a typographic quote"},
    {0x201D, "a typographic quote"},
    {0x201E, "a typographic quote"},
    {0x2028, "a line separator"},
    {0x2029, "a paragraph separator"},
    {0x202F, "a narrow no-break space"},
    {0x2060, "a word joiner"},
    {0x2212, "a minus sign that is no hyphen"},
    {0x3000, "an ideographic space"},
    {0xFEFF, "a byte order mark"},
}};

char32_t code_of(std::string_view character)
{
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
    if (character.size() == 1) return byte(0);
    char32_t code = byte(0) & (0xFFU >> (character.size() + 1));
    for (std::size_t i = 1; i < character.size(); ++i) code = code << 6 | (byte(i) & 0x3FU);
    return code;
}

/// Are the next eight bytes ASCII, and none of them zero?
bool are_plain(const char* bytes)
{
    std::uint64_t eight = 0;
    std::memcpy(&eight, bytes, sizeof eight);
    constexpr std::uint64_t ones = 0x0101010101010101, tops = 0x8080808080808080;
    return ((eight | (eight - ones)) & tops) == 0;
}

}  // namespace

std::string_view other_encoding(std::string_view text)
{
    for (const Signature& signature : signatures)
        if (text.starts_with(signature.bytes)) return signature.name;
    for (const ZeroPattern& pattern : zero_patterns)
        if (fits(text, pattern)) return pattern.name;
    return {};
}

std::size_t utf8_length(std::string_view rest)
{
    const auto byte = [&](std::size_t i) {
        return i < rest.size() ? static_cast<unsigned char>(rest[i]) : 0u;
    };
    const auto follows = [&](std::size_t i, unsigned low = 0x80, unsigned high = 0xBF) {
        return byte(i) >= low && byte(i) <= high;
    };
    const unsigned first = byte(0);
    if (first < 0x80) return 1;
    if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
    if (first >= 0xE0 && first <= 0xEF) {
        const unsigned low = first == 0xE0 ? 0xA0 : 0x80, high = first == 0xED ? 0x9F : 0xBF;
        return follows(1, low, high) && follows(2) ? 3 : 0;
    }
    if (first >= 0xF0 && first <= 0xF4) {
        const unsigned low = first == 0xF0 ? 0x90 : 0x80, high = first == 0xF4 ? 0x8F : 0xBF;
        return follows(1, low, high) && follows(2) && follows(3) ? 4 : 0;
    }
    return 0;
}

std::size_t first_not_utf8(std::string_view text, const StopToken& stop)
{
    StopEvery check(stop, 1 << 17);
    std::size_t i = 0;
    while (i < text.size()) {
        check();
        if (i + 8 <= text.size() && are_plain(text.data() + i)) {
            i += 8;
            continue;
        }
        const std::size_t length = text[i] == '\0' ? 0 : utf8_length(text.substr(i, 4));
        if (length == 0) return i;
        i += length;
    }
    return i;
}

std::string described_character(std::string_view rest)
{
    const char32_t code = code_of(rest.substr(0, std::max<std::size_t>(utf8_length(rest), 1)));
    const auto* const named = std::find_if(named_characters.begin(), named_characters.end(),
                                           [&](const auto& c) { return c.code == code; });
    const std::string number = fmt::format("U+{:04X}", static_cast<std::uint32_t>(code));
    return named == named_characters.end() ? number : number + ", " + std::string(named->name);
}

}  // namespace mis
