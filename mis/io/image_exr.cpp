#include "mis/io/image_exr.h"

#include "mis/io/atomic_file.h"
#include "mis/io/image_exr_module.h"

#include <dlfcn.h>

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

/// The module's only function; the module stays loaded. Null where it is not found: dlerror() says
/// why.
WriteExrPixels* open_module()
{
    void* module = dlopen(MIS_IMAGE_MODULE, RTLD_NOW | RTLD_LOCAL);
    if (!module) module = dlopen(module_beside_program().c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!module) module = dlopen(MIS_MODULE_DIR "/" MIS_IMAGE_MODULE, RTLD_NOW | RTLD_LOCAL);
    return module ? reinterpret_cast<WriteExrPixels*>(dlsym(module, "mis_write_exr_pixels"))
                  : nullptr;
}

}  // namespace

void write_exr(const std::filesystem::path& file, const Image& image,
               const std::map<std::string, std::string>& metadata)
{
    AtomicFile whole(file.string());
    static WriteExrPixels* const write_pixels = open_module();
    if (!write_pixels) fail(file, dlerror());
    std::string reason;
    write_pixels(whole.temporary_path(), image, metadata, reason);
    if (!reason.empty()) fail(file, reason);
    whole.commit();
}

}  // namespace mis
