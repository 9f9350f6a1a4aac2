// Any text at all, as a scene: it is read, or refused with a message.
#include "mis/io/scene_error.h"
#include "mis/io/scene_json.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        mis::parse_scene({reinterpret_cast<const char*>(data), size}, "/nowhere/scene.json");
    } catch (const mis::SceneError&) {
    }
    return 0;
}
