# mis_embed(TARGET FILE…): puts the bytes of files into a target, from which page_asset("name") of mis/io/page_assets.h gives
# them. The assembler reads them (.incbin), so that it costs nothing to compile.
function(mis_embed target)
  set(symbols "")
  set(cases "")
  set(number 0)
  foreach(file IN LISTS ARGN)
    cmake_path(GET file FILENAME name)
    string(APPEND symbols "MIS_ASSET(mis_asset_${number}, \"${file}\")\n")
    string(APPEND cases "    if (name == \"${name}\") return text(mis_asset_${number}, mis_asset_${number}_end);\n")
    math(EXPR number "${number} + 1")
  endforeach()
  set(source "${PROJECT_BINARY_DIR}/generated/${target}_assets.cpp")
  file(CONFIGURE OUTPUT "${source}" @ONLY CONTENT
[[// Made by cmake/embed.cmake.
#include "mis/io/page_assets.h"

#include <cstddef>

#define MIS_ASSET(symbol, file)                                                          \
    asm(".pushsection .rodata\n.global " #symbol "\n.global " #symbol "_end\n" #symbol   \
        ":\n.incbin \"" file "\"\n" #symbol "_end:\n.byte 0\n.popsection\n");            \
    extern "C" const char symbol[], symbol##_end[];

@symbols@
namespace {
std::string_view text(const char* begin, const char* end)
{
    return {begin, static_cast<std::size_t>(end - begin)};
}
}  // namespace

std::string_view mis::page_asset(std::string_view name)
{
@cases@    return {};
}
]])
  set_source_files_properties("${source}" PROPERTIES OBJECT_DEPENDS "${ARGN}" SKIP_PRECOMPILE_HEADERS ON
    SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(${target} PRIVATE "${source}")
endfunction()
