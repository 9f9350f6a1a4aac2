#include "bench/bare_embree.h"

#include "mis/trace/surface_points.h"

#include <array>
#include <stdexcept>
#include <string>

#if MIS_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#define MIS_BENCH_CONTEXT
#define MIS_BENCH_PACKET(N) rtcOccluded##N(valid.data(), tree, &rays)
#define MIS_BENCH_SINGLE rtcOccluded1(tree, &rays)
#else
#include <embree3/rtcore.h>
#define MIS_BENCH_CONTEXT        \
    RTCIntersectContext context; \
    rtcInitIntersectContext(&context)
#define MIS_BENCH_PACKET(N) rtcOccluded##N(valid.data(), tree, &context, &rays)
#define MIS_BENCH_SINGLE rtcOccluded1(tree, &context, &rays)
#endif

namespace mis::bench {

struct BareEmbree::Tree {
    explicit Tree(const Scene& scene)
        : origin(frame_origin_of(scene)), device(rtcNewDevice(nullptr)), tree(rtcNewScene(device))
    {
        rtcSetSceneFlags(tree, RTC_SCENE_FLAG_ROBUST);
        for (const Surface& surface : scene.surfaces)
            std::visit([&](const auto& s) { add(s); }, surface.shape);
        rtcCommitScene(tree);
        if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
            throw std::runtime_error("Embree could not build its tree");
    }
    ~Tree() { rtcReleaseScene(tree), rtcReleaseDevice(device); }
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;

    template <class N>
    static N* buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t each,
                     std::size_t count)
    {
        return static_cast<N*>(
            rtcSetNewGeometryBuffer(geometry, type, 0, format, each * sizeof(N), count));
    }
    void put(float* at, const Vec3<double>& p) const
    {
        const Vec3<float> v = vec_cast<float>(p - origin);
        at[0] = v.x, at[1] = v.y, at[2] = v.z;
    }
    void attach(RTCGeometry geometry) const
    {
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(tree, geometry);
        rtcReleaseGeometry(geometry);
    }
    void add(const Mesh& mesh) const
    {
        RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* p =
            buffer<float>(g, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3, mesh.positions.size());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) put(p + 3 * i, mesh.positions[i]);
        auto* t =
            buffer<unsigned>(g, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 3, mesh.triangles.size());
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) t[3 * i + k] = mesh.triangles[i][k];
        attach(g);
    }
    void add(const Quad& quad) const
    {
        RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
        auto* p = buffer<float>(g, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3, 4);
        put(p, quad.corner), put(p + 3, quad.corner + quad.edges[0]);
        put(p + 6, quad.corner + quad.edges[0] + quad.edges[1]);
        put(p + 9, quad.corner + quad.edges[1]);
        auto* t = buffer<unsigned>(g, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT4, 4, 1);
        for (unsigned k = 0; k < 4; ++k) t[k] = k;
        attach(g);
    }
    void add(const SphereSurface& sphere) const
    {
        RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
        auto* p = buffer<float>(g, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, 4, 1);
        put(p, sphere.center), p[3] = static_cast<float>(sphere.radius);
        attach(g);
    }

    Vec3<double> origin;
    RTCDevice device;
    RTCScene tree;
};

BareEmbree::BareEmbree(const Scene& scene) : tree_(std::make_unique<Tree>(scene)) {}
BareEmbree::~BareEmbree() = default;

namespace {

RTCRay ray_of(const ShadowRay& ray)
{
    RTCRay r{};
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tfar = ray.distance, r.mask = ~0U;
    return r;
}

std::size_t one_by_one(RTCScene tree, std::span<const ShadowRay> all)
{
    MIS_BENCH_CONTEXT;
    std::size_t hidden = 0;
    for (const ShadowRay& ray : all) {
        RTCRay rays = ray_of(ray);
        MIS_BENCH_SINGLE;
        hidden += rays.tfar < 0;
    }
    return hidden;
}

template <std::size_t N, class Packet, class Ask>
std::size_t in_packets(std::span<const ShadowRay> all, const Ask& ask)
{
    alignas(64) std::array<int, N> valid;  // NOLINT: filled below
    Packet rays;                           // NOLINT
    std::size_t hidden = 0;
    for (std::size_t first = 0; first < all.size(); first += N) {
        const std::size_t count = std::min(N, all.size() - first);
        for (std::size_t i = 0; i < N; ++i) {
            const ShadowRay& ray = all[first + std::min(i, count - 1)];
            valid[i] = i < count ? -1 : 0;
            rays.org_x[i] = ray.origin.x, rays.org_y[i] = ray.origin.y;
            rays.org_z[i] = ray.origin.z, rays.dir_x[i] = ray.direction.x;
            rays.dir_y[i] = ray.direction.y, rays.dir_z[i] = ray.direction.z;
            rays.tnear[i] = rays.time[i] = 0, rays.tfar[i] = ray.distance, rays.mask[i] = ~0U;
            rays.id[i] = rays.flags[i] = 0;
        }
        ask(valid, rays);
        for (std::size_t i = 0; i < count; ++i) hidden += rays.tfar[i] < 0;
    }
    return hidden;
}

#if MIS_EMBREE_MAJOR < 4
std::size_t in_streams(RTCScene tree, std::span<const ShadowRay> all)
{
    MIS_BENCH_CONTEXT;
    constexpr std::size_t most = 256;  // rays at a time: a batch of the engine
    std::array<RTCRay, most> rays;     // NOLINT: filled below
    std::size_t hidden = 0;
    for (std::size_t first = 0; first < all.size(); first += most) {
        const std::size_t count = std::min(most, all.size() - first);
        for (std::size_t i = 0; i < count; ++i) rays[i] = ray_of(all[first + i]);
        rtcOccluded1M(tree, &context, rays.data(), static_cast<unsigned>(count), sizeof(RTCRay));
        for (std::size_t i = 0; i < count; ++i) hidden += rays[i].tfar < 0;
    }
    return hidden;
}
#endif

}  // namespace

std::vector<std::string_view> BareEmbree::calls()
{
#if MIS_EMBREE_MAJOR < 4
    return {"single", "packet4", "packet8", "packet16", "packet16-coherent", "stream"};
#else
    return {"single", "packet4", "packet8", "packet16"};
#endif
}

std::size_t BareEmbree::hidden(std::string_view call, std::span<const ShadowRay> all) const
{
    const RTCScene tree = tree_->tree;
    MIS_BENCH_CONTEXT;
    if (call == "packet4")
        return in_packets<4, RTCRay4>(all,
                                      [&](auto& valid, RTCRay4& rays) { MIS_BENCH_PACKET(4); });
    if (call == "packet8")
        return in_packets<8, RTCRay8>(all,
                                      [&](auto& valid, RTCRay8& rays) { MIS_BENCH_PACKET(8); });
    if (call == "packet16")
        return in_packets<16, RTCRay16>(all,
                                        [&](auto& valid, RTCRay16& rays) { MIS_BENCH_PACKET(16); });
#if MIS_EMBREE_MAJOR < 4
    if (call == "packet16-coherent") {
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        return in_packets<16, RTCRay16>(all,
                                        [&](auto& valid, RTCRay16& rays) { MIS_BENCH_PACKET(16); });
    }
    if (call == "stream") return in_streams(tree, all);
#endif
    return one_by_one(tree, all);
}

}  // namespace mis::bench
