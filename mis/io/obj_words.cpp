#include "mis/io/obj_words.h"

#include "mis/io/number_text.h"
#include "mis/io/scene_error.h"
#include "mis/io/text_file.h"
#include "mis/io/text_words.h"

#include <fmt/format.h>

#include <utility>

namespace mis {
namespace {

/// Where the comment of a line begins. What follows a point is no comment, but one of the ways in
/// which a NaN is written: 1.#IND, 1.#QNAN.
std::size_t comment_in(std::string_view line)
{
    std::size_t at = line.find('#');
    while (at != line.npos && at > 0 && line[at - 1] == '.') at = line.find('#', at + 1);
    return at;
}

}  // namespace

ObjWords::ObjWords(ByteSource& source, const std::filesystem::path& file)
    : source_(source), file_(file)
{
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (source.peek(3) == byte_order_mark) source.bytes(3);
    if (source.peek(2) == "\xFF\xFE" || source.peek(2) == "\xFE\xFF")
        fail_at(1, 1,
                {"", "UTF-16 text", "an OBJ file is text with one byte per letter, or UTF-8",
                 "Save it as UTF-8."});
}

bool ObjWords::next_line()
{
    if (!has_block_) {
        if (!source_.line(block_)) return false;
        if (block_.ends_with('\r')) block_.remove_suffix(1);
    }
    const std::size_t length = block_.find('\r');
    rest_ = block_.substr(0, length);
    has_block_ = length != block_.npos;
    if (has_block_) block_.remove_prefix(length + 1);
    line_begin_ = rest_.data();
    ++line_;

    rest_ = rest_.substr(0, comment_in(rest_));
    while (!rest_.empty() && is_blank(rest_.back())) rest_.remove_suffix(1);
    is_continued_ = rest_.ends_with('\\');
    if (is_continued_) rest_.remove_suffix(1);
    return true;
}

bool ObjWords::next_statement(std::string_view& keyword)
{
    do {
        if (!next_line()) return false;
    } while (!next_word(keyword));
    return true;
}

bool ObjWords::next_word(std::string_view& word)
{
    while ((word = take_word(rest_)).empty()) {
        if (!is_continued_) return false;
        if (!next_line()) return is_continued_ = false;
    }
    return true;
}

bool ObjWords::next_number(double& number)
{
    std::string_view word;
    if (!next_word(word)) return false;
    if (const std::optional<NumberProblem> problem = read_number_text(word, number))
        fail_at(word, in_quotes(word), problem->allowed, problem->remedy);
    return true;
}

bool ObjWords::skip_names()
{
    rest_ = {};
    return std::exchange(is_continued_, false);
}

void ObjWords::fail_at(std::string_view word, std::string found, std::string allowed,
                       std::string remedy) const
{
    fail_at(line_, column(word), {"", std::move(found), std::move(allowed), std::move(remedy)});
}

void ObjWords::fail_at(std::size_t line, std::size_t column, Problem problem) const
{
    problem.pointer = fmt::format("line {}, column {}", line, column);
    throw SceneError(file_.string(), problem);
}

}  // namespace mis
