#include "mis/io/image_exr.h"

#include "mis/io/atomic_file.h"
#include "mis/io/image_exr_module.h"

#include <dlfcn.h>

namespace {

/// Set once the module is open.
bool module_is_open = false;

}  // namespace

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
/// Asked by the leak sanitizer, where there is one. The module's libraries start threads when they
/// are loaded (log4cplus) and end them with the program; the sanitizer of Clang 14 can crash on a
/// thread that is beginning or ending. So it looks for leaks where no module was opened.
extern "C" int __lsan_is_turned_off();  // NOLINT: the sanitizer's name
extern "C" int __lsan_is_turned_off() { return module_is_open; }
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

/// The module, which stays loaded; null where it is not found.
void* open_module()
{
    void* module = dlopen(MIS_IMAGE_MODULE, RTLD_NOW | RTLD_LOCAL);
    if (!module) module = dlopen(module_beside_program().c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!module) module = dlopen(MIS_MODULE_DIR "/" MIS_IMAGE_MODULE, RTLD_NOW | RTLD_LOCAL);
    module_is_open = module != nullptr;
    return module;
}

/// A function of the module; null where there is none: dlerror() says why.
template <class F> F* function_of_module(const char* name)
{
    static void* const module = open_module();
    return module ? reinterpret_cast<F*>(dlsym(module, name)) : nullptr;
}

}  // namespace

ExrMetadata::ExrMetadata(const std::string& version, const std::string& command, std::uint64_t seed)
    : all_{{"Software", "mis " + version}}
{
    add("command", command).add("seed", std::to_string(seed));
}

ExrMetadata& ExrMetadata::add(const std::string& key, const std::string& value)
{
    all_["mis:" + key] = value;
    return *this;
}

void write_exr(const std::filesystem::path& file, const LayeredImage& image,
               const ExrMetadata& metadata)
{
    AtomicFile whole(file.string());
    const auto write_layers = function_of_module<WriteExrLayers>("mis_write_exr_layers");
    if (!write_layers) fail(file, dlerror());
    std::string reason;
    write_layers(whole.temporary_path(), image, metadata.all(), reason);
    if (!reason.empty()) fail(file, reason);
    whole.commit();
}

void write_exr(const std::filesystem::path& file, const Image& image, const ExrMetadata& metadata)
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
