#include "mis/io/image_exr_module.h"

#include <OpenImageIO/imageio.h>

void mis_write_exr_pixels(const std::string& path, const mis::Image& image,
                          const std::map<std::string, std::string>& metadata, std::string& reason)
{
    const auto output = OIIO::ImageOutput::create("openexr");
    if (!output) {
        reason = OIIO::geterror();
        return;
    }
    OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::FLOAT);
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    for (const auto& [key, value] : metadata) spec.attribute(key, value);
    static_assert(sizeof(mis::Vec3<float>) == 3 * sizeof(float));
    if (!output->open(path, spec) ||
        !output->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data()) || !output->close())
        reason = output->geterror();
}
