// Shadow rays against an Embree scene that a host made.
#include "mis/trace/embree.h"

#include <gtest/gtest.h>

#if MIS_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <iterator>
#include <vector>

namespace mis {
namespace {

/// One triangle: (0,0,1), (1,0,1), (0,1,1).
struct HostScene {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);

    HostScene()
    {
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* const corners = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3));
        auto* const triangle = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), 1));
        const float places[] = {0, 0, 1, 1, 0, 1, 0, 1, 1};
        std::copy(std::begin(places), std::end(places), corners);
        for (unsigned i = 0; i < 3; ++i) triangle[i] = i;
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene);
    }
    ~HostScene() { rtcReleaseScene(scene), rtcReleaseDevice(device); }
    HostScene(const HostScene&) = delete;
    HostScene& operator=(const HostScene&) = delete;
};

TEST(OccludedIn, SeesTheHostsTriangleBeforeTheDistanceAndNoFurther)
{
    const HostScene host;
    std::vector<ShadowRay> rays;
    std::vector<std::uint8_t> expected;
    for (int i = 0; i < 21; ++i)  // more than two packets, the last in part
        for (const float distance : {0.5F, 2.0F}) {
            const float x = 0.05F + 0.07F * static_cast<float>(i);
            rays.push_back({{x, 0.1F, 0}, {0, 0, 1}, distance});
            expected.push_back(distance > 1 && x + 0.1F < 1 ? 1 : 0);
        }
    std::vector<std::uint8_t> hidden(rays.size(), 7);
    occluded_in(host.scene, rays, hidden);
    EXPECT_EQ(hidden, expected);
    EXPECT_EQ(std::count(expected.begin(), expected.end(), 1), 13);
}

}  // namespace
}  // namespace mis
