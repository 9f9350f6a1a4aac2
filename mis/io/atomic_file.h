#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace mis {

/// A file that could not be written. what() is the finished message: which file, and why.
struct WriteError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A file that appears whole or not at all. What is written goes to a temporary file in the same
/// folder, under a name of its own with the same extension; commit() brings it to the disk and
/// renames it. Without commit() it is removed, and what stood under `path` before stays. A path
/// that is no ordinary file (/dev/null, a pipe) is written to directly; a symbolic link is
/// followed. All members but the destructor throw WriteError.
class AtomicFile {
public:
    explicit AtomicFile(const std::string& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    AtomicFile(AtomicFile&&) = delete;
    AtomicFile& operator=(AtomicFile&&) = delete;

    /// For libraries that open files by name: an empty file that stands already.
    const std::string& temporary_path() const { return temporary_; }

    /// Adds to the end.
    void write(std::string_view text);

    void commit();

private:
    [[noreturn]] void fail(int error) const;
    bool is_direct() const { return temporary_ == target_; }

    std::string path_;    ///< as given
    std::string target_;  ///< with symbolic links followed
    std::string temporary_;
    int file_ = -1;
};

/// Writes all of `text` to the file `path`, whole or not at all; "-" is standard output. Throws
/// WriteError.
void write_text(const std::string& path, std::string_view text);

}  // namespace mis
