// Writes the scenes of tests/cases into a folder, one file each: seeds of the scene reader's
// fuzzer.
#include "tests/cases/cases.h"
#include "tests/support/scene_text.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

int main(int count, char** arguments)
{
    if (count != 2) {
        std::fputs("usage: scene_seeds FOLDER\n", stderr);
        return 2;
    }
    for (const mis::Case& c : mis::all_cases()) {
        const std::filesystem::path file = std::filesystem::path(arguments[1]) / (c.name + ".json");
        if (!(std::ofstream(file) << mis::scene_text(c.scene)).flush()) {
            std::fprintf(stderr, "%s: cannot be written\n", file.c_str());
            return 1;
        }
    }
    return 0;
}
