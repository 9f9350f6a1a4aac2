// Any text at all, as a table of lights: it is read, or refused with a message.
#include "mis/io/scene_error.h"
#include "mis/io/table_csv.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        mis::Lights lights;
        mis::append_light_table(std::string_view(reinterpret_cast<const char*>(data), size),
                                "/nowhere/lights.csv", lights);
    } catch (const mis::SceneError&) {
    }
    return 0;
}
