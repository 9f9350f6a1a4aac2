// Any text at all, as a report: it is read, or refused with a message. What is read is written
// again and compared with itself and with a copy whose strategies have changed places.
#include "mis/io/changes_json.h"
#include "mis/io/changes_text.h"
#include "mis/io/report_json.h"
#include "mis/io/report_read.h"
#include "mis/io/scene_error.h"
#include "tests/support/changes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace {

/// Every strategy under the next one's name.
mis::Report turned(mis::Report report)
{
    for (mis::SceneReport& scene : report.scenes)
        for (std::size_t i = 0; i + 1 < scene.strategies.size(); ++i)
            std::swap(scene.strategies[i].strategy, scene.strategies[i + 1].strategy);
    std::reverse(report.scenes.begin(), report.scenes.end());
    return report;
}

void compare(const mis::Report& before, const mis::Report& after)
{
    const mis::Changes changes = mis::remarked_changes(before, after, {.worse_by = 0.05});
    if (changes.changed > changes.comparisons) std::abort();
    mis::changes_text(changes);
    mis::changes_json(changes, {});
    mis::changes_csv(changes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        const mis::Report report =
            mis::parse_report({reinterpret_cast<const char*>(data), size}, "/nowhere/report.json");
        mis::report_json(report);
        compare(report, report);
        compare(report, turned(report));
    } catch (const mis::SceneError&) {
    }
    return 0;
}
