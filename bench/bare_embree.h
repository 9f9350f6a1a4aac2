#pragma once

#include "mis/scene/scene.h"
#include "mis/trace/visibility.h"

#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace mis::bench {

/// A scene's surfaces in Embree as its own examples would put them: triangles, quads, and spheres
/// of Embree's own kind. No code of the engine takes part.
class BareEmbree {
public:
    explicit BareEmbree(const Scene& scene);
    ~BareEmbree();
    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;

    /// Occlusion calls by name: "single", "packet4", "packet8", "packet16", "stream".
    static std::vector<std::string_view> calls();

    /// Asks for all rays by one kind of call; how many are hidden. The rays are copied into the
    /// form that the call takes, which is part of any use of it.
    std::size_t hidden(std::string_view call, std::span<const ShadowRay> rays) const;

private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace mis::bench
