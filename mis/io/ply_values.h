#pragma once

#include "mis/io/byte_source.h"
#include "mis/io/ply_header.h"
#include "mis/scene/validate.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace mis {

/// What both kinds of a body know of the row that is read.
class PlyRows {
public:
    explicit PlyRows(const std::filesystem::path& file) : file_(file) {}

    void begin(const PlyElement& element) { element_ = &element, row_ = 0; }
    std::size_t row() const { return row_; }

    [[noreturn]] void fail(std::string place, std::string found, std::string allowed) const;
    [[noreturn]] void fail_early_end() const;
    /// "face 7"; counted from 0, as indices are.
    std::string row_text() const;

protected:
    const std::filesystem::path& file_;
    const PlyElement* element_ = nullptr;
    std::size_t row_ = 0;
};

/// The numbers of a binary body, one after the other.
class BinaryPlyValues : public PlyRows {
public:
    BinaryPlyValues(ByteSource& source, const PlyHeader& header, const std::filesystem::path& file);

    double number(PlyType type);
    void skip(PlyType type, std::size_t count);
    void end_row() { ++row_; }
    void require_end();
    /// Throws SceneError at the number read last.
    [[noreturn]] void fail_at_last(std::string found, std::string allowed) const;

private:
    ByteSource& source_;
    bool swapped_;
    std::size_t last_ = 0;  ///< byte of the number read last
};

/// The numbers of a body in text. A row may go on in the next line; it ends where its line ends.
class TextPlyValues : public PlyRows {
public:
    TextPlyValues(ByteSource& source, const PlyHeader& header, const std::filesystem::path& file);

    double number(PlyType type);
    void skip(PlyType type, std::size_t count);
    void end_row();
    void require_end();
    [[noreturn]] void fail_at_last(std::string found, std::string allowed) const;

private:
    bool next_word();
    bool next_word_of_line();

    ByteSource& source_;
    char line_end_;
    std::size_t line_;
    std::string_view rest_, word_;
    const char* line_begin_ = nullptr;
};

}  // namespace mis
