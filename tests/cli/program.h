#pragma once

#include "tests/io/temporary_folder.h"
#include "tests/support/places.h"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace mis {

struct Outcome {
    int exit;
    std::string out, error;
};

inline std::string text_of(const std::string& file)
{
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Runs the program with these words, as a shell splits them.
inline Outcome mis_with(const std::string& words)
{
    const TemporaryFolder folder;
    const std::string out = (folder / "out").string(), error = (folder / "error").string();
    const int status = std::system(
        ("'" + program_file().string() + "' " + words + " >'" + out + "' 2>'" + error + "'")
            .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(error)};
}

inline std::string scene(const std::string& name)
{
    return (source_dir() / "scenes" / (name + ".json")).string();
}

}  // namespace mis
