#include "mis/io/byte_source.h"

#include "mis/io/scene_error.h"

#include <algorithm>
#include <cstring>

namespace mis {
namespace {

constexpr std::size_t block = std::size_t{1} << 20;

[[noreturn]] void fail_to_read(const std::filesystem::path& file)
{
    throw SceneError(file.string(), Problem{"", "a file that cannot be read to its end",
                                            "a mesh is a readable file",
                                            "Check the file's permissions, and the disk."});
}

}  // namespace

ByteSource::ByteSource(const std::filesystem::path& file, const StopToken& stop)
    : file_(file), stop_(stop), stream_(std::fopen(file.c_str(), "rb"), &std::fclose), size_(0)
{
    std::error_code error;
    size_ = static_cast<std::size_t>(std::filesystem::file_size(file, error));
    if (!stream_ || error) fail_to_read(file);
    std::setvbuf(stream_.get(), nullptr, _IONBF, 0);
}

ByteSource::ByteSource(std::string_view text)
    : stream_(nullptr, &std::fclose), rest_(text), size_(text.size())
{
}

bool ByteSource::read_more()
{
    stop_.check();
    if (!stream_) return false;
    const std::size_t kept = rest_.size();
    if (kept > 0) std::memmove(buffer_.data(), rest_.data(), kept);
    if (buffer_.size() < kept + block) buffer_.resize(std::max(kept + block, 2 * buffer_.size()));
    const std::size_t read =
        std::fread(buffer_.data() + kept, 1, buffer_.size() - kept, stream_.get());
    if (std::ferror(stream_.get())) fail_to_read(file_);
    rest_ = {buffer_.data(), kept + read};
    size_ = std::max(size_, offset_ + rest_.size());  // a file that grows
    if (read == 0) size_ = offset_ + rest_.size();    // or shrinks
    return read > 0;
}

void ByteSource::take(std::size_t count)
{
    rest_.remove_prefix(count);
    offset_ += count;
}

bool ByteSource::line(std::string_view& line, char end)
{
    std::size_t searched = 0, length = rest_.find(end);
    while (length == rest_.npos) {
        searched = rest_.size();
        if (!read_more()) break;
        length = rest_.find(end, searched);
    }
    if (length == rest_.npos && rest_.empty()) return false;
    line = rest_.substr(0, length);
    take(std::min(line.size() + 1, rest_.size()));
    return true;
}

std::string_view ByteSource::peek(std::size_t count)
{
    while (rest_.size() < count && read_more()) {
    }
    return rest_.substr(0, count);
}

std::string_view ByteSource::bytes(std::size_t count)
{
    const std::string_view taken = peek(count);
    take(taken.size());
    return taken;
}

}  // namespace mis
