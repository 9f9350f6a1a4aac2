#include "mis/io/page_pictures.h"

#include "mis/io/base64.h"
#include "mis/io/image_exr.h"
#include "mis/io/json_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace mis {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr double most_stops = 60;  ///< between the largest value and what is kept apart from 0
constexpr std::size_t most_listed_lights = 5000;

/// The page's pixels, each a block of the maps' pixels.
struct Blocks {
    Blocks(const Maps& maps, int scale)
        : of(maps), side(scale), width(maps.width / scale), height(maps.height / scale)
    {
    }
    std::size_t count() const
    {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    std::size_t first_pixel(std::size_t block) const
    {
        const auto w = static_cast<std::size_t>(width), s = static_cast<std::size_t>(side);
        return block / w * s * static_cast<std::size_t>(of.width) + block % w * s;
    }
    /// Calls f(pixel) for all pixels of a block.
    template <class F> void each_pixel(std::size_t block, const F& f) const
    {
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                f(first_pixel(block) +
                  static_cast<std::size_t>(y) * static_cast<std::size_t>(of.width) +
                  static_cast<std::size_t>(x));
    }

    const Maps& of;
    int side, width, height;
};

double luminance_of(const Vec3<float>& colour) { return luminance(vec_cast<double>(colour)); }

/// Mean over a block of f(pixel): no number where one of them is none, so that it shows.
template <class F> double mean_over(const Blocks& blocks, std::size_t block, const F& f)
{
    double sum = 0;
    blocks.each_pixel(block, [&](std::size_t pixel) { sum += f(pixel); });
    return sum / (blocks.side * blocks.side);
}

/// Mean over a block of f(pixel), where that is known (a number); NaN where it is nowhere.
template <class F> double mean_of_known(const Blocks& blocks, std::size_t block, const F& f)
{
    double sum = 0, count = 0;
    blocks.each_pixel(block, [&](std::size_t pixel) {
        if (const double value = f(pixel); std::isfinite(value)) sum += value, ++count;
    });
    return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

/// Planes of bytes on their way to a picture.
class Planes {
public:
    explicit Planes(const Blocks& blocks) : width_(blocks.width), height_(blocks.height) {}
    Planes(int width, int height) : width_(width), height_(height) {}

    std::size_t size() const
    {
        return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    }
    Bytes& add() { return planes_.emplace_back(size()); }

    /// Numbers as steps of their logarithm, in two planes; what the page needs to read them.
    OrderedJson add_logs(const std::vector<double>& values, double step)
    {
        double most = 0;
        for (const double v : values)
            if (std::isfinite(v)) most = std::max(most, v);
        const double highest = most > 0 ? std::log2(most) : 0;
        double least = highest;
        for (const double v : values)
            if (v > 0 && std::isfinite(v)) least = std::min(least, std::log2(v));
        const double low = std::max(least, highest - most_stops);
        Bytes high_bytes(size()), low_bytes(size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            const unsigned k = logarithmic(values[i], low, step);
            high_bytes[i] = static_cast<std::uint8_t>(k >> 8);
            low_bytes[i] = static_cast<std::uint8_t>(k & 255U);
        }
        planes_.push_back(std::move(high_bytes));
        planes_.push_back(std::move(low_bytes));
        return {{"low", low}, {"step", step}};
    }

    /// Adds the picture to the page's and returns its description.
    OrderedJson finish(PagePictures& page, const std::string& id, std::size_t columns = 1) const
    {
        const std::size_t rows = (planes_.size() + columns - 1) / columns;
        const std::size_t w = static_cast<std::size_t>(width_),
                          h = static_cast<std::size_t>(height_);
        Bytes all(columns * rows * size());
        for (std::size_t k = 0; k < planes_.size(); ++k)
            for (std::size_t y = 0; y < h; ++y)
                std::copy_n(planes_[k].begin() + static_cast<std::ptrdiff_t>(y * w), w,
                            all.begin() + static_cast<std::ptrdiff_t>(
                                              ((k / columns * h + y) * columns + k % columns) * w));
        page.pictures.emplace_back(
            id, base64(png_bytes(static_cast<int>(columns * w), static_cast<int>(rows * h), all)));
        return {{"id", id}, {"planes", planes_.size()}, {"columns", columns}};
    }

private:
    static unsigned logarithmic(double value, double low, double step)
    {
        if (!std::isfinite(value)) return 65535;
        if (!(value > 0)) return 0;
        return static_cast<unsigned>(
            std::clamp(std::lround((std::log2(value) - low) / step) + 1L, 1L, 65534L));
    }

    int width_, height_;
    std::vector<Bytes> planes_;
};

std::uint8_t byte_of(double share)
{
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

/// Luminance, and the shares that red and blue have in the sum of the channels.
OrderedJson reference(const Blocks& blocks, PagePictures& page, const std::string& prefix)
{
    std::vector<double> y(blocks.count());
    Bytes red(blocks.count()), blue(blocks.count());
    for (std::size_t b = 0; b < blocks.count(); ++b) {
        Vec3<double> sum(0);
        blocks.each_pixel(b,
                          [&](std::size_t p) { sum += vec_cast<double>(blocks.of.reference[p]); });
        const double all = sum.x + sum.y + sum.z;
        y[b] = luminance(sum) / (blocks.side * blocks.side);
        const bool has_colour = all > 0 && std::isfinite(all);
        red[b] = byte_of(has_colour ? sum.x / all : 1.0 / 3);
        blue[b] = byte_of(has_colour ? sum.z / all : 1.0 / 3);
    }
    Planes planes(blocks);
    const OrderedJson mean = planes.add_logs(y, mean_step);
    planes.add() = std::move(red);
    planes.add() = std::move(blue);
    OrderedJson json = planes.finish(page, prefix + "reference");
    json["mean"] = mean;
    return json;
}

OrderedJson strategy(const Blocks& blocks, const StrategyMap& map, PagePictures& page,
                     const std::string& prefix)
{
    std::vector<double> mean(blocks.count()), variance(blocks.count());
    for (std::size_t b = 0; b < blocks.count(); ++b) {
        mean[b] = mean_over(blocks, b, [&](std::size_t p) { return luminance_of(map.mean[p]); });
        variance[b] =
            mean_of_known(blocks, b, [&](std::size_t p) { return double(map.variance[p]); });
    }
    Planes planes(blocks);
    const OrderedJson means = planes.add_logs(mean, mean_step),
                      variances = planes.add_logs(variance, variance_step);
    if (!map.bad.empty()) {
        Bytes& bad = planes.add();
        for (std::size_t b = 0; b < blocks.count(); ++b)
            blocks.each_pixel(b, [&](std::size_t p) {
                if (std::binary_search(map.bad.begin(), map.bad.end(), p)) bad[b] = 1;
            });
    }
    OrderedJson json = planes.finish(page, prefix + std::to_string(map.strategy));
    json["strategy"] = map.strategy;
    json["mean"] = means;
    json["variance"] = variances;
    return json;
}

/// What a pixel is, and in two planes each one more than its winners' numbers: by variance, by
/// efficiency; of each the strategy, then the policy.
OrderedJson kinds_and_winners(const Blocks& blocks, PagePictures& page, const std::string& prefix)
{
    Planes planes(blocks);
    Bytes& kind = planes.add();
    for (std::size_t b = 0; b < blocks.count(); ++b)
        kind[b] = static_cast<std::uint8_t>(blocks.of.kind[blocks.first_pixel(b)]);
    for (const WinnerMap* map : {&blocks.of.by_variance, &blocks.of.by_efficiency})
        for (const std::vector<int>* winners : {&map->strategy, &map->policy})
            for (const unsigned shift : {8U, 0U}) {
                Bytes& plane = planes.add();
                for (std::size_t b = 0; b < blocks.count(); ++b)
                    plane[b] = static_cast<std::uint8_t>(
                        static_cast<unsigned>((*winners)[blocks.first_pixel(b)] + 1) >> shift &
                        255U);
            }
    return planes.finish(page, prefix + "winners");
}

/// The light map, no finer than the page's pixels: four planes for each of its lights, number
/// (one more, three bytes) and share.
OrderedJson lights(const Blocks& blocks, PagePictures& page, const std::string& prefix)
{
    const LightMap& map = blocks.of.lights;
    const int stride = std::max(map.stride, blocks.side);
    const int width = (blocks.width * blocks.side + stride - 1) / stride,
              height = (blocks.height * blocks.side + stride - 1) / stride;
    Planes planes(width, height);
    std::set<LightIndex> used;
    const auto at = [&](std::size_t i) -> const std::array<LightShare, shown_lights>& {
        const auto w = static_cast<std::size_t>(width);
        const std::size_t x = i % w * static_cast<std::size_t>(stride) /
                              static_cast<std::size_t>(map.stride),
                          y = i / w * static_cast<std::size_t>(stride) /
                              static_cast<std::size_t>(map.stride);
        return map.lights[std::min(y, static_cast<std::size_t>(map.height) - 1) *
                              static_cast<std::size_t>(map.width) +
                          std::min(x, static_cast<std::size_t>(map.width) - 1)];
    };
    for (std::size_t k = 0; k < shown_lights; ++k) {
        for (const unsigned shift : {16U, 8U, 0U}) {
            Bytes& plane = planes.add();
            for (std::size_t i = 0; i < planes.size(); ++i)
                plane[i] = static_cast<std::uint8_t>(
                    static_cast<unsigned>(at(i)[k].light + 1) >> shift & 255U);
        }
        Bytes& share = planes.add();
        for (std::size_t i = 0; i < planes.size(); ++i) {
            share[i] = byte_of(double(at(i)[k].share));
            if (at(i)[k].light >= 0) used.insert(at(i)[k].light);
        }
    }
    OrderedJson json = planes.finish(page, prefix + "lights", 4);
    json["stride"] = stride / static_cast<double>(blocks.side);
    json["width"] = width;
    json["height"] = height;
    json["lights"] = OrderedJson::object();
    for (const LightIndex j : used) {
        if (json["lights"].size() >= most_listed_lights) break;
        const Light& light = blocks.of.scene_lights[static_cast<std::size_t>(j)];
        const Vec3<double> colour = radiance(light);
        json["lights"][std::to_string(j)] = {
            {"center", {light.center.x, light.center.y, light.center.z}},
            {"radius", light.radius},
            {"radiance", {json_figure(colour.x), json_figure(colour.y), json_figure(colour.z)}}};
    }
    return json;
}

OrderedJson wins(const WinnerMap& map)
{
    return {{"strategy", map.strategy_wins}, {"policy", map.policy_wins}};
}

}  // namespace

int page_scale(int width, int height, std::size_t strategies, double most_values)
{
    int scale = 1;
    const auto is_too_large = [&] {
        const double w = width / scale, h = height / scale;
        return w > 2048 || h > 2048 || w * h * static_cast<double>(strategies) > most_values;
    };
    while (is_too_large() && scale < std::min(width, height)) ++scale;
    return scale;
}

PagePictures page_pictures(const Maps& maps, double most_values, const std::string& prefix)
{
    const Blocks blocks(
        maps, page_scale(maps.width, maps.height, maps.strategies.size() + 1, most_values));
    PagePictures page;
    OrderedJson json{{"width", blocks.width},
                     {"height", blocks.height},
                     {"scale", blocks.side},
                     {"winner_square", maps.winner_square},
                     {"false_winners", false_winners}};
    json["policies"] = maps.policies;
    json["wins"] = {{"variance", wins(maps.by_variance)}, {"efficiency", wins(maps.by_efficiency)}};
    json["reference"] = reference(blocks, page, prefix);
    json["winners"] = kinds_and_winners(blocks, page, prefix);
    json["lights"] = lights(blocks, page, prefix);
    json["strategies"] = OrderedJson::array();
    for (const StrategyMap& map : maps.strategies)
        json["strategies"].push_back(strategy(blocks, map, page, prefix));
    page.json = json.dump();
    return page;
}

}  // namespace mis
