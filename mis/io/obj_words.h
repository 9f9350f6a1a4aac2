#pragma once

#include "mis/io/byte_source.h"
#include "mis/scene/validate.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace mis {

/// The statements of an OBJ file, word by word. A comment ends its line, wherever it begins. A `\`
/// at a line's end continues the statement, but not a comment, nor the names of `usemtl` and the
/// like: Windows paths end in it.
class ObjWords {
public:
    ObjWords(ByteSource& source, const std::filesystem::path& file);

    /// Goes to the next statement, and gives its first word; false at the end of the file.
    bool next_statement(std::string_view& keyword);
    /// The next word of the statement; valid until the next call. False at its end.
    bool next_word(std::string_view& word);
    /// The next word as a number; false at the statement's end.
    bool next_number(double& number);

    /// Takes what follows a keyword for names. True for a line that ends in `\`: the next line may
    /// hold more names, or be a statement.
    bool skip_names();

    std::size_t line() const { return line_; }
    std::size_t column(std::string_view word) const
    {
        return static_cast<std::size_t>(word.data() - line_begin_) + 1;
    }

    /// Throws SceneError at `word`, which is the last one.
    [[noreturn]] void fail_at(std::string_view word, std::string found, std::string allowed,
                              std::string remedy) const;
    [[noreturn]] void fail_at(std::size_t line, std::size_t column, Problem problem) const;

private:
    bool next_line();

    ByteSource& source_;
    const std::filesystem::path& file_;
    std::string_view block_;  ///< of the source's line, what is not yet read: old Macs end with CR
    bool has_block_ = false, is_continued_ = false;
    std::string_view rest_;  ///< of the line, without its comment
    const char* line_begin_ = nullptr;
    std::size_t line_ = 0;
};

}  // namespace mis
