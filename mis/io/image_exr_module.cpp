#include "mis/io/image_exr_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <vector>

namespace {

constexpr int rows_at_a_time = 64;

/// All rows, some at a time; false where writing failed.
bool write_rows(OIIO::ImageOutput& output, const mis::LayeredImage& image)
{
    const std::size_t row = static_cast<std::size_t>(image.width) * image.channels.size();
    std::vector<float> rows(row * static_cast<std::size_t>(std::min(rows_at_a_time, image.height)));
    for (int first = 0; first < image.height; first += rows_at_a_time) {
        const int end = std::min(image.height, first + rows_at_a_time);
        for (int y = first; y < end; ++y)
            image.fill_row(y,
                           std::span(rows).subspan(static_cast<std::size_t>(y - first) * row, row));
        if (!output.write_scanlines(first, end, 0, OIIO::TypeDesc::FLOAT, rows.data()))
            return false;
    }
    return true;
}

}  // namespace

void mis_write_exr_layers(const std::string& path, const mis::LayeredImage& image,
                          const std::map<std::string, std::string>& metadata, std::string& reason)
{
    const auto output = OIIO::ImageOutput::create("openexr");
    if (!output) {
        reason = OIIO::geterror();
        return;
    }
    OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()),
                         OIIO::TypeDesc::FLOAT);
    spec.channelnames = image.channels;
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    for (const auto& [key, value] : metadata) spec.attribute(key, value);
    if (!output->open(path, spec) || !write_rows(*output, image) || !output->close())
        reason = output->geterror();
}

void mis_encode_png(int width, int height, std::span<const std::uint8_t> grey, std::string& bytes,
                    std::string& reason)
{
    const auto output = OIIO::ImageOutput::create("png");
    if (!output) {
        reason = OIIO::geterror();
        return;
    }
    std::vector<unsigned char> buffer;
    OIIO::Filesystem::IOVecOutput file(buffer);
    OIIO::ImageSpec spec(width, height, 1, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "Linear");  // numbers, not a colour
    output->set_ioproxy(&file);
    if (!output->open("picture.png", spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, grey.data()) || !output->close())
        reason = output->geterror();
    else bytes.assign(buffer.begin(), buffer.end());
}
