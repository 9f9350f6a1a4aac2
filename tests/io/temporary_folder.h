#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace mis {

/// An empty folder for the files of one test; removed at its end.
class TemporaryFolder {
public:
    TemporaryFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "mis-test-XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        path_ = name;
    }
    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

    /// The path of a new file with this content.
    std::filesystem::path write(std::string_view name, std::string_view content) const
    {
        std::ofstream stream(path_ / name, std::ios::binary);
        stream << content;
        EXPECT_TRUE(stream.good());
        return path_ / name;
    }

private:
    std::filesystem::path path_;
};

}  // namespace mis
