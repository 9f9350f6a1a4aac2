#include "mis/io/atomic_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace mis {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public testing::Test {
protected:
    AtomicFileTest()
        : folder_(fs::path(testing::TempDir()) / ("mis_atomic_" + std::to_string(getpid())))
    {
        fs::create_directories(folder_);
    }
    ~AtomicFileTest() override { fs::remove_all(folder_); }

    std::string at(const std::string& name) const { return (folder_ / name).string(); }
    std::size_t files() const
    {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
    }

    static std::string content(const std::string& path)
    {
        std::ostringstream text;
        text << std::ifstream(path).rdbuf();
        return text.str();
    }

    fs::path folder_;
};

std::string message_of(const std::string& path)
{
    try {
        write_text(path, "text");
    } catch (const WriteError& error) {
        return error.what();
    }
    return "";
}

TEST_F(AtomicFileTest, WritesAndLeavesNothingElse)
{
    write_text(at("a.json"), "one");
    write_text(at("a.json"), "two");
    EXPECT_EQ(content(at("a.json")), "two");
    EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, KeepsWhatStoodThereUntilTheCommit)
{
    write_text(at("a.exr"), "old");
    {
        AtomicFile file(at("a.exr"));
        file.write("new");
        EXPECT_EQ(content(at("a.exr")), "old");
        EXPECT_EQ(fs::path(file.temporary_path()).extension(), ".exr");
        EXPECT_EQ(content(file.temporary_path()), "new");
    }  // as if something had thrown
    EXPECT_EQ(content(at("a.exr")), "old");
    EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, TakesWhatALibraryWroteUnderTheTemporaryName)
{
    AtomicFile file(at("a.exr"));
    std::ofstream(file.temporary_path()) << "by name";
    file.commit();
    EXPECT_EQ(content(at("a.exr")), "by name");
    EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, FollowsASymbolicLink)
{
    write_text(at("real"), "old");
    fs::create_symlink(at("real"), at("link"));
    write_text(at("link"), "new");
    EXPECT_TRUE(fs::is_symlink(at("link")));
    EXPECT_EQ(content(at("real")), "new");
}

TEST_F(AtomicFileTest, WritesToADeviceWithoutReplacingIt)
{
    EXPECT_EQ(message_of("/dev/null"), "");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(AtomicFileTest, SaysThatTheDiskIsFull)
{
    EXPECT_EQ(message_of("/dev/full"), "/dev/full: cannot be written: No space left on device");
}

TEST_F(AtomicFileTest, SaysWhatIsWrongWithAPath)
{
    EXPECT_EQ(message_of(at("none/a.json")),
              at("none/a.json") +
                  ": cannot be written: No such file or directory (is there a folder " +
                  at("none") + "?)");
    EXPECT_EQ(message_of(folder_.string()),
              folder_.string() + ": cannot be written: Is a directory");
    EXPECT_EQ(message_of(""), "cannot write a file without a name");
    EXPECT_EQ(files(), 0u);
}

TEST_F(AtomicFileTest, ObeysTheUmask)
{
    const mode_t before = umask(027);
    write_text(at("a"), "x");
    umask(before);
    EXPECT_EQ(fs::status(at("a")).permissions(), fs::perms(0640));
}

}  // namespace
}  // namespace mis
