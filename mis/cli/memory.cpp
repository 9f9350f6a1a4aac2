#include "mis/cli/memory.h"

#include "mis/cli/options.h"
#include "mis/scene/text.h"
#include "mis/study/maps.h"

#include <fmt/format.h>
#include <unistd.h>

namespace mis::cli {

void check_memory(const Scene& scene, std::size_t strategies, bool with_maps)
{
    std::size_t points = scene.probes.size();
    if (scene.camera)
        points += static_cast<std::size_t>(scene.camera->resolution[0]) *
                  static_cast<std::size_t>(scene.camera->resolution[1]);
    const double needed = static_cast<double>(study_bytes(points, strategies) +
                                              (with_maps ? maps_bytes(points, strategies) : 0));
    const double there =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    if (needed > 0.8 * there)
        throw UsageError(
            fmt::format("{}: {} by {} take about {:.1f} GB, and this machine has "
                        "{:.1f} GB\n    Lower --resolution, or compare fewer strategies.",
                        scene.file, many(points, "shading point"), many(strategies, "strategy"),
                        needed / 1e9, there / 1e9));
}

}  // namespace mis::cli
