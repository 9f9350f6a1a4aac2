#include "mis/io/image_exr.h"

#include "mis/io/atomic_file.h"

#include <OpenImageIO/imageio.h>

namespace mis {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason)
{
    throw WriteError(file.string() + ": cannot be written: " + reason);
}

}  // namespace

void write_exr(const std::filesystem::path& file, const Image& image,
               const std::map<std::string, std::string>& metadata)
{
    AtomicFile whole(file.string());
    const auto output = OIIO::ImageOutput::create("openexr");
    if (!output) fail(file, OIIO::geterror());
    OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::FLOAT);
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    for (const auto& [key, value] : metadata) spec.attribute(key, value);
    if (!output->open(whole.temporary_path(), spec)) fail(file, output->geterror());
    static_assert(sizeof(Vec3<float>) == 3 * sizeof(float));
    if (!output->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data()))
        fail(file, output->geterror());
    if (!output->close()) fail(file, output->geterror());
    whole.commit();
}

}  // namespace mis
