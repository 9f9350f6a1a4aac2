#include "mis/io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <system_error>

namespace mis {
namespace {

namespace fs = std::filesystem;

/// Where `path` leads if it is a symbolic link to something that exists.
std::string followed(const std::string& path)
{
    std::error_code error;
    const fs::path target = fs::canonical(path, error);
    return error ? path : target.string();
}

bool is_special(const std::string& path)
{
    struct stat status {};
    return stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

fs::path folder_of(const std::string& path)
{
    const fs::path folder = fs::path(path).parent_path();
    return folder.empty() ? "." : folder;
}

/// Short, whatever the length of the name that it stands for; hidden; no other process or call has
/// it.
std::string temporary_beside(const std::string& path)
{
    static std::atomic<unsigned> files{0};
    const std::string extension = fs::path(path).extension().string();
    return (folder_of(path) / fmt::format(".mis-{}-{}{}", getpid(), files++, extension)).string();
}

/// Writes all of it; 0, or what went wrong.
int write_all(int file, std::string_view text)
{
    while (!text.empty()) {
        const ssize_t written = ::write(file, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

/// A renamed file is on the disk when its folder is. Not every file system can do that: then the
/// renaming must do.
void bring_to_disk(const fs::path& folder)
{
    const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return;
    fsync(file);
    close(file);
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(followed(path))
{
    if (path.empty()) throw WriteError("cannot write a file without a name");
    const bool direct = is_special(target_);
    temporary_ = direct ? target_ : temporary_beside(target_);
    // The mode of a file that may not be written to says so, though a renaming would not ask it.
    if (!direct && access(target_.c_str(), F_OK) == 0 && access(target_.c_str(), W_OK) != 0)
        fail(errno);
    file_ = open(temporary_.c_str(), O_WRONLY | O_CLOEXEC | (direct ? 0 : O_CREAT | O_EXCL), 0666);
    if (file_ < 0) fail(errno);
}

AtomicFile::~AtomicFile()
{
    if (file_ < 0) return;
    close(file_);
    if (!is_direct()) unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view text)
{
    if (const int error = write_all(file_, text)) fail(error);
}

void AtomicFile::commit()
{
    // What special files cannot do is no error there; a full disk may show here first.
    if (fsync(file_) != 0 && errno != EINVAL && errno != EROFS && errno != ENOTSUP) fail(errno);
    if (!is_direct()) {
        if (rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
        bring_to_disk(folder_of(target_));
    }
    close(file_);
    file_ = -1;
}

void AtomicFile::fail(int error) const
{
    std::string why = std::generic_category().message(error);
    if (error == ENOENT) why += fmt::format(" (is there a folder {}?)", folder_of(path_).string());
    throw WriteError(fmt::format("{}: cannot be written: {}", path_, why));
}

void write_text(const std::string& path, std::string_view text)
{
    if (path == "-") {
        if (const int error = write_all(STDOUT_FILENO, text))
            throw WriteError(fmt::format("standard output: cannot be written: {}",
                                         std::generic_category().message(error)));
        return;
    }
    AtomicFile file(path);
    file.write(text);
    file.commit();
}

}  // namespace mis
