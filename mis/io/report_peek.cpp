#include "mis/io/report_peek.h"

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

namespace mis {

bool is_report_file(const std::filesystem::path& file)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return false;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"),
                                                                 &std::fclose);
    if (!stream) return false;
    std::string start(1 << 16, '\0');
    start.resize(std::fread(start.data(), 1, start.size(), stream.get()));
    constexpr std::string_view key = "\"format\"", blank = " \t\r\n";
    std::size_t at = start.find(key);
    if (at == start.npos) return false;
    at = start.find_first_not_of(blank, at + key.size());
    if (at == start.npos || start[at] != ':') return false;
    at = start.find_first_not_of(blank, at + 1);
    return at != start.npos && start.compare(at, 12, "\"mis-report/") == 0;
}

}  // namespace mis
