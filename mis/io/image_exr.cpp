#include "mis/io/image_exr.h"

#include "mis/io/atomic_file.h"
#include "mis/io/image_exr_module.h"

#include <dlfcn.h>

#include <cstdlib>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#include <sanitizer/lsan_interface.h>
#define MIS_LOOKS_FOR_LEAKS 1
#endif
#endif

namespace mis {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason)
{
    throw WriteError(file.string() + ": cannot be written: " + reason);
}

/// The module in the folder beside the running program's, as a build has it. (The program's run
/// path would do, but for sanitizers, under which it is theirs that counts.)
std::string module_beside_program()
{
    std::error_code ignored;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
    return program.parent_path().parent_path() / "lib" / MIS_IMAGE_MODULE;
}

/// Under the sanitizer, leaks are looked for before the module's libraries end the threads that
/// they started when loaded (log4cplus): Clang 14's leak sanitizer can crash on a thread that is
/// ending.
void look_for_leaks_before_threads_end()
{
#ifdef MIS_LOOKS_FOR_LEAKS
    std::atexit(__lsan_do_leak_check);
#endif
}

/// The module, which stays loaded; null where it is not found.
void* open_module()
{
    void* module = dlopen(MIS_IMAGE_MODULE, RTLD_NOW | RTLD_LOCAL);
    if (!module) module = dlopen(module_beside_program().c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!module) module = dlopen(MIS_MODULE_DIR "/" MIS_IMAGE_MODULE, RTLD_NOW | RTLD_LOCAL);
    look_for_leaks_before_threads_end();
    return module;
}

/// A function of the module; null where there is none: dlerror() says why.
template <class F> F* function_of_module(const char* name)
{
    static void* const module = open_module();
    return module ? reinterpret_cast<F*>(dlsym(module, name)) : nullptr;
}

}  // namespace

void write_exr(const std::filesystem::path& file, const LayeredImage& image,
               const std::map<std::string, std::string>& metadata)
{
    AtomicFile whole(file.string());
    const auto write_layers = function_of_module<WriteExrLayers>("mis_write_exr_layers");
    if (!write_layers) fail(file, dlerror());
    std::string reason;
    write_layers(whole.temporary_path(), image, metadata, reason);
    if (!reason.empty()) fail(file, reason);
    whole.commit();
}

void write_exr(const std::filesystem::path& file, const Image& image,
               const std::map<std::string, std::string>& metadata)
{
    const auto fill_row = [&image](int y, std::span<float> row) {
        const auto width = static_cast<std::size_t>(image.width);
        for (std::size_t x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                row[3 * x + static_cast<std::size_t>(c)] =
                    image.pixels[static_cast<std::size_t>(y) * width + x][c];
    };
    write_exr(file, LayeredImage{image.width, image.height, {"R", "G", "B"}, fill_row}, metadata);
}

std::string png_bytes(int width, int height, std::span<const std::uint8_t> grey)
{
    const auto encode = function_of_module<EncodePng>("mis_encode_png");
    if (!encode) fail("a picture", dlerror());
    std::string bytes, reason;
    encode(width, height, grey, bytes, reason);
    if (!reason.empty()) fail("a picture", reason);
    return bytes;
}

}  // namespace mis
