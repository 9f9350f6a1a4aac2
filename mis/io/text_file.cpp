#include "mis/io/text_file.h"

#include "mis/io/scene_error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <span>
#include <system_error>

namespace mis {
namespace {

[[noreturn]] void fail_on(const std::filesystem::path& file, std::string found, std::string allowed,
                          std::string remedy)
{
    throw SceneError(file.string(),
                     Problem{"", std::move(found), std::move(allowed), std::move(remedy)});
}

[[noreturn]] void fail_too_large(const std::filesystem::path& file, std::string_view kind)
{
    fail_on(file, fmt::format("more than {} bytes", limits::scene_file_bytes),
            fmt::format("a {} has at most {} bytes", kind, limits::scene_file_bytes),
            fmt::format("Split the {}.", kind));
}

/// Bytes of the UTF-8 character at the start of `rest`; 0 if there is none (RFC 3629: no overlong
/// forms, no surrogates).
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

/// The next bytes of a stream; none at its end or on an error. A signal ends the wait for a pipe.
std::size_t read_some(std::FILE* stream, std::span<char> buffer, const StopToken& stop)
{
    for (;;) {
        stop.check();
        errno = 0;
        const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), stream);
        if (count > 0 || std::ferror(stream) == 0 || errno != EINTR) return count;
        std::clearerr(stream);
    }
}

}  // namespace

std::string read_text_file(const std::filesystem::path& file, std::string_view kind,
                           const StopToken& stop)
{
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
        fail_on(file, "a directory", fmt::format("a {} is a file", kind), "Name a file in it.");
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"),
                                                                 &std::fclose);
    if (!stream) {
        stop.check();  // a signal ends the wait for a pipe to be opened at its other end
        const std::error_code reason(errno, std::generic_category());
        if (reason == std::errc::no_such_file_or_directory || reason == std::errc::not_a_directory)
            fail_on(file, "no such file", fmt::format("a {} is a file that exists", kind),
                    "Check the path.");
        fail_on(file, fmt::format("a file that cannot be opened ({})", reason.message()),
                fmt::format("a {} is a readable file", kind), "Check the file's permissions.");
    }
    const std::uintmax_t size =
        std::filesystem::file_size(file, error);  // of a pipe: an error, and nothing to reserve
    std::string text;
    if (!error && size > limits::scene_file_bytes) fail_too_large(file, kind);
    if (!error) text.reserve(size);
    std::array<char, 1 << 16> buffer;
    while (const std::size_t count = read_some(stream.get(), buffer, stop)) {
        text.append(buffer.data(), count);
        if (text.size() > limits::scene_file_bytes) fail_too_large(file, kind);
    }
    if (std::ferror(stream.get()))
        fail_on(file, "a file that cannot be read to its end",
                fmt::format("a {} is a readable file", kind), "Check the disk.");
    if (text.empty())
        fail_on(file, "an empty file", fmt::format("a {} has content", kind),
                "Check that it was written in full.");
    return text;
}

TextPlace place_in(std::string_view text, std::size_t byte)
{
    const std::string_view before = text.substr(0, byte);
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
    return {static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1,
            before.size() - line_start + 1};
}

void require_utf8(std::string_view text, const std::filesystem::path& file, const StopToken& stop)
{
    StopEvery check(stop, 1 << 20);
    for (std::size_t i = 0; i < text.size();) {
        check();
        const std::size_t length = text[i] == '\0' ? 0 : utf8_length(text.substr(i, 4));
        if (length == 0) {
            const auto [line, column] = place_in(text, i);
            throw SceneError(
                file.string(),
                Problem{fmt::format("line {}, column {}", line, column),
                        fmt::format("byte 0x{:02X}", static_cast<unsigned char>(text[i])),
                        "the text is UTF-8, without zero bytes", "Save it as UTF-8."});
        }
        i += length;
    }
}

std::string in_quotes(std::string_view text)
{
    constexpr std::size_t longest = 60;
    std::size_t end = std::min(text.size(), longest);
    while (end < text.size() && end > longest - 4 &&
           (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
        --end;
    const nlohmann::json string(std::string(text.substr(0, end)) +
                                (end < text.size() ? "..." : ""));
    return string.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace mis
