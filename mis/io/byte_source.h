#pragma once

#include "mis/math/stop_token.h"

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace mis {

/// The bytes of a file, or of a text at hand, from first to last; of a file it holds some MiB at a
/// time. What line(), peek() and bytes() return is valid until the next call. All throw SceneError
/// where the file cannot be read, and Stopped within a MiB.
class ByteSource {
public:
    explicit ByteSource(const std::filesystem::path& file, const StopToken& stop = {});
    explicit ByteSource(std::string_view text);

    /// The next line, without its end; false after the last one. A text that ends in `end` has no
    /// empty line after it.
    bool line(std::string_view& line, char end = '\n');
    /// The next `count` bytes, or those that are left; does not take them.
    std::string_view peek(std::size_t count);
    /// The next `count` bytes, or those that are left.
    std::string_view bytes(std::size_t count);

    std::size_t size() const { return size_; }            ///< of the whole file
    std::size_t left() const { return size_ - offset_; }  ///< not yet taken, as far as is known
    std::size_t offset() const { return offset_; }        ///< of the next byte

private:
    bool read_more();
    void take(std::size_t count);

    std::filesystem::path file_;
    StopToken stop_;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_;
    std::vector<char> buffer_;
    std::string_view rest_;  ///< in the buffer, or of the text: not yet taken
    std::size_t size_, offset_ = 0;
};

}  // namespace mis
