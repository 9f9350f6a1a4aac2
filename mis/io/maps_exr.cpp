#include "mis/io/maps_exr.h"

#include "mis/io/image_exr.h"

#include <fmt/format.h>

#include <algorithm>

namespace mis {
namespace {

/// A strategy's name as a layer: what OpenEXR takes for a level of its own is a dot.
std::string layer_of(const Strategy& strategy)
{
    std::string name = name_of(strategy);
    std::replace(name.begin(), name.end(), '/', '.');
    return name;
}

/// Where the channels of a row stand, and what stands in them.
class Layers {
public:
    Layers(const SceneReport& scene, const Maps& maps) : scene_(scene), maps_(maps) {}

    std::vector<std::string> names() const
    {
        std::vector<std::string> names;
        add_colour(names, "reference");
        for (const StrategyMap& s : maps_.strategies) {
            const std::string layer = layer_of(strategy(s));
            add_colour(names, layer + ".mean");
            names.push_back(layer + ".variance.Y");
            if (!s.bad.empty()) names.push_back(layer + ".invalid.ID");
        }
        for (const char* layer : {"winner.ID", "winner.policy", "winner_by_efficiency.ID",
                                  "winner_by_efficiency.policy", "kind.ID"})
            names.emplace_back(layer);
        return names;
    }

    void fill(int y, std::span<float> row) const
    {
        std::size_t at = 0;
        const std::size_t width = static_cast<std::size_t>(maps_.width),
                          first = static_cast<std::size_t>(y) * width;
        for (std::size_t p = first; p < first + width; ++p) {
            put(row, at, maps_.reference[p]);
            for (const StrategyMap& s : maps_.strategies) {
                put(row, at, s.mean[p]);
                row[at++] = s.variance[p];
                if (!s.bad.empty()) row[at++] = is_bad(s, p) ? 1.0F : 0.0F;
            }
            for (const WinnerMap* map : {&maps_.by_variance, &maps_.by_efficiency}) {
                row[at++] = static_cast<float>(map->strategy[p]);
                row[at++] = static_cast<float>(map->policy[p]);
            }
            row[at++] = static_cast<float>(maps_.kind[p]);
        }
    }

private:
    const Strategy& strategy(const StrategyMap& s) const
    {
        return scene_.strategies[static_cast<std::size_t>(s.strategy)].strategy;
    }
    static void add_colour(std::vector<std::string>& names, const std::string& layer)
    {
        for (const char* channel : {".R", ".G", ".B"}) names.push_back(layer + channel);
    }
    static void put(std::span<float> row, std::size_t& at, const Vec3<float>& colour)
    {
        for (int c = 0; c < 3; ++c) row[at++] = colour[c];
    }
    static bool is_bad(const StrategyMap& s, std::size_t pixel)
    {
        return std::binary_search(s.bad.begin(), s.bad.end(), pixel);
    }

    const SceneReport& scene_;
    const Maps& maps_;
};

/// "0 uniform, 1 power".
std::string numbered(const std::vector<std::string>& names)
{
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += fmt::format("{}{} {}", i == 0 ? "" : ", ", i, names[i]);
    return text;
}

}  // namespace

void write_maps_exr(const Report& report, std::size_t scene, const Maps& maps,
                    const std::string& path)
{
    const SceneReport& of = report.scenes[scene];
    const Layers layers(of, maps);
    std::vector<std::string> strategies;
    for (const StrategyReport& s : of.strategies) strategies.push_back(name_of(s.strategy));
    const auto fill_row = [&](int y, std::span<float> row) { layers.fill(y, row); };
    write_exr(path, LayeredImage{maps.width, maps.height, layers.names(), fill_row},
              ExrMetadata(report.version, report.command, report.seed)
                  .add("scene", of.name)
                  .add("strategies", numbered(strategies))
                  .add("policies", numbered(maps.policies)));
}

}  // namespace mis
