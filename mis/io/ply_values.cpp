#include "mis/io/ply_values.h"

#include "mis/io/number_text.h"
#include "mis/io/scene_error.h"
#include "mis/io/text_file.h"
#include "mis/io/text_words.h"
#include "mis/scene/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace mis {
namespace {

/// The number of type T that the bytes are, in the order of this machine.
template <class T> double number_of(const char* bytes)
{
    T number;
    std::memcpy(&number, bytes, sizeof number);
    return static_cast<double>(number);
}

double number_of(PlyType type, const char* bytes)
{
    switch (type) {
        case PlyType::int8: return number_of<std::int8_t>(bytes);
        case PlyType::uint8: return number_of<std::uint8_t>(bytes);
        case PlyType::int16: return number_of<std::int16_t>(bytes);
        case PlyType::uint16: return number_of<std::uint16_t>(bytes);
        case PlyType::int32: return number_of<std::int32_t>(bytes);
        case PlyType::uint32: return number_of<std::uint32_t>(bytes);
        case PlyType::float32: return number_of<float>(bytes);
        default: return number_of<double>(bytes);
    }
}

}  // namespace

void PlyRows::fail(std::string place, std::string found, std::string allowed) const
{
    throw SceneError(file_.string(), Problem{std::move(place), std::move(found), std::move(allowed),
                                             "Mend the file."});
}

void PlyRows::fail_early_end() const
{
    fail("",
         fmt::format("a PLY file that ends early: {} of {} of {} {} there", row_,
                     many(element_->count, "row"), in_quotes(element_->name),
                     row_ == 1 ? "is" : "are"),
         "a body is as long as its header says");
}

std::string PlyRows::row_text() const
{
    return fmt::format("{} {} (counted from 0)", element_->name, row_);
}

BinaryPlyValues::BinaryPlyValues(ByteSource& source, const PlyHeader& header,
                                 const std::filesystem::path& file)
    : PlyRows(file), source_(source), swapped_((header.format == PlyFormat::binary_big_endian) !=
                                               (std::endian::native == std::endian::big))
{
}

double BinaryPlyValues::number(PlyType type)
{
    const std::size_t size = bytes_of(type);
    last_ = source_.offset();
    const std::string_view bytes = source_.bytes(size);
    if (bytes.size() < size) fail_early_end();
    if (!swapped_) return number_of(type, bytes.data());
    char reversed[8];
    std::reverse_copy(bytes.begin(), bytes.end(), reversed);
    return number_of(type, reversed);
}

void BinaryPlyValues::skip(PlyType type, std::size_t count)
{
    constexpr std::size_t most = std::size_t{1} << 20;
    if (count > source_.left() / bytes_of(type)) fail_early_end();
    for (std::size_t left = count * bytes_of(type); left > 0;) {
        const std::size_t skipped = source_.bytes(std::min(left, most)).size();
        if (skipped == 0) fail_early_end();
        left -= skipped;
    }
}

void BinaryPlyValues::require_end()
{
    const std::size_t begin = source_.offset();
    for (std::string_view rest; !(rest = source_.bytes(1)).empty();)
        if (!is_blank(rest[0]))
            fail(fmt::format("byte {}", begin),
                 many(source_.size() - begin, "byte") + " after the last row",
                 "a body is as long as its header says");
}

void BinaryPlyValues::fail_at_last(std::string found, std::string allowed) const
{
    fail(fmt::format("{}, byte {}", row_text(), last_), std::move(found), std::move(allowed));
}

TextPlyValues::TextPlyValues(ByteSource& source, const PlyHeader& header,
                             const std::filesystem::path& file)
    : PlyRows(file), source_(source), line_end_(header.line_end), line_(header.lines)
{
}

bool TextPlyValues::next_word_of_line()
{
    word_ = take_word(rest_);
    return !word_.empty();
}

bool TextPlyValues::next_word()
{
    while (!next_word_of_line()) {
        if (!source_.line(rest_, line_end_)) return false;
        line_begin_ = rest_.data();
        ++line_;
    }
    return true;
}

double TextPlyValues::number(PlyType type)
{
    if (!next_word()) fail_early_end();
    double number = 0;
    if (const auto problem = read_number_text(word_, number))
        fail_at_last(in_quotes(word_), problem->allowed);
    if (type < PlyType::float32 && std::floor(number) != number)
        fail_at_last(in_quotes(word_), "a whole number belongs here, by the property's type");
    return number;
}

/// Numbers that are not used may be NaN or infinite.
void TextPlyValues::skip(PlyType, std::size_t count)
{
    for (; count > 0; --count) {
        if (!next_word()) fail_early_end();
        double number = 0;
        const char* const begin = word_.data() + (word_[0] == '+');
        const char* const end = word_.data() + word_.size();
        if (std::from_chars(begin, end, number).ptr != end)
            fail_at_last(in_quotes(word_), "a number belongs here");
    }
}

void TextPlyValues::end_row()
{
    if (next_word_of_line())
        fail_at_last(fmt::format("{} after the end of {}", in_quotes(word_), row_text()),
                     "a row has the values that its header lists, and ends its line");
    ++row_;
}

void TextPlyValues::require_end()
{
    if (next_word())
        fail_at_last(in_quotes(word_) + " after the last row",
                     "a body is as long as its header says");
}

void TextPlyValues::fail_at_last(std::string found, std::string allowed) const
{
    fail(fmt::format("line {}, column {}", line_, word_.data() - line_begin_ + 1), std::move(found),
         std::move(allowed));
}

}  // namespace mis
