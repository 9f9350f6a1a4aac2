#include "mis/trace/embree.h"

#include "mis/trace/intersect.h"
#include "mis/trace/surface_points.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#if MIS_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#define MIS_OCCLUDED(N) rtcOccluded##N(valid, tree, &rays, nullptr)
#else
#include <embree3/rtcore.h>
#define MIS_OCCLUDED(N)                \
    RTCIntersectContext context;       \
    rtcInitIntersectContext(&context); \
    rtcOccluded##N(valid, tree, &context, &rays)
#endif

namespace mis {

namespace {

/// A sphere of the scene, in the tracer's frame.
struct PlacedSphere {
    Vec3<double> center;
    double radius;
    std::size_t surface;
};

const PlacedSphere& placed(const void* spheres, unsigned primitive)
{
    return (*static_cast<const std::vector<PlacedSphere>*>(spheres))[primitive];
}

void sphere_bounds(const RTCBoundsFunctionArguments* args)
{
    const PlacedSphere& s = placed(args->geometryUserPtr, args->primID);
    const double reach = s.radius + float_offset(s.radius + largest_coordinate(s.center));
    const Vec3<float> low = vec_cast<float>(s.center - reach),
                      high = vec_cast<float>(s.center + reach);
    *args->bounds_o = {low.x, low.y, low.z, 0, high.x, high.y, high.z, 0};
}

/// Where ray i of a packet meets a sphere within its interval, or infinity.
float sphere_distance(RTCRayN* ray, unsigned count, unsigned i, const PlacedSphere& s)
{
    const Vec3<double> origin{RTCRayN_org_x(ray, count, i), RTCRayN_org_y(ray, count, i),
                              RTCRayN_org_z(ray, count, i)};
    const Vec3<double> direction{RTCRayN_dir_x(ray, count, i), RTCRayN_dir_y(ray, count, i),
                                 RTCRayN_dir_z(ray, count, i)};
    const auto distance = static_cast<float>(hit_sphere(origin, direction, s.center, s.radius));
    const bool within =
        distance > RTCRayN_tnear(ray, count, i) && distance < RTCRayN_tfar(ray, count, i);
    return within ? distance : std::numeric_limits<float>::infinity();
}

void sphere_occluded(const RTCOccludedFunctionNArguments* args)
{
    const PlacedSphere& s = placed(args->geometryUserPtr, args->primID);
    for (unsigned i = 0; i < args->N; ++i)
        if (args->valid[i] != 0 &&
            sphere_distance(args->ray, args->N, i, s) < std::numeric_limits<float>::infinity())
            RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
}

void sphere_intersect(const RTCIntersectFunctionNArguments* args)
{
    const PlacedSphere& s = placed(args->geometryUserPtr, args->primID);
    RTCRayN* ray = RTCRayHitN_RayN(args->rayhit, args->N);
    RTCHitN* hit = RTCRayHitN_HitN(args->rayhit, args->N);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const float distance = sphere_distance(ray, args->N, i, s);
        if (!(distance < std::numeric_limits<float>::infinity())) continue;
        RTCRayN_tfar(ray, args->N, i) = distance;
        RTCHitN_primID(hit, args->N, i) = args->primID;
        RTCHitN_geomID(hit, args->N, i) = args->geomID;
        RTCHitN_instID(hit, args->N, i, 0) = RTC_INVALID_GEOMETRY_ID;
    }
}

RTCRay ray_of(const Vec3<float>& origin, const Vec3<float>& direction, float far)
{
    RTCRay ray{};
    ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
    ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
    ray.tfar = far;
    ray.mask = ~0U;
    return ray;
}

void occluded(const int* valid, RTCScene tree, RTCRay4& rays) { MIS_OCCLUDED(4); }
void occluded(const int* valid, RTCScene tree, RTCRay8& rays) { MIS_OCCLUDED(8); }
void occluded(const int* valid, RTCScene tree, RTCRay16& rays) { MIS_OCCLUDED(16); }

/// Asks for the rays in packets of N: their samples are neighbours, whose rays go much the same
/// way, and even where they do not a packet is quicker than rays one by one.
template <class Packet, std::size_t N>
void answer_in_packets(RTCScene tree, float scale, std::span<const ShadowRay> rays,
                       std::span<std::uint8_t> hidden)
{
    alignas(64) std::array<int, N> valid;  // NOLINT: filled below
    Packet packet;                         // NOLINT
    for (std::size_t first = 0; first < rays.size(); first += N) {
        const std::size_t count = std::min(N, rays.size() - first);
        for (std::size_t i = 0; i < N; ++i) {
            const ShadowRay& ray = rays[first + std::min(i, count - 1)];
            valid[i] = i < count ? -1 : 0;
            packet.org_x[i] = ray.origin.x * scale;
            packet.org_y[i] = ray.origin.y * scale;
            packet.org_z[i] = ray.origin.z * scale;
            packet.dir_x[i] = ray.direction.x;
            packet.dir_y[i] = ray.direction.y;
            packet.dir_z[i] = ray.direction.z;
            packet.tnear[i] = packet.time[i] = 0;
            packet.tfar[i] = ray.distance * scale;
            packet.mask[i] = ~0U;
            packet.id[i] = packet.flags[i] = 0;
        }
        occluded(valid.data(), tree, packet);
        for (std::size_t i = 0; i < count; ++i) hidden[first + i] = packet.tfar[i] < 0 ? 1 : 0;
    }
}

struct ReleaseGeometry {
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
/// What we hold of a geometry: given back also where filling it ends early.
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, ReleaseGeometry>;

/// New storage of a geometry's buffer, to be filled.
template <class N>
N* buffer_of(const Geometry& geometry, RTCBufferType type, RTCFormat format, std::size_t per_item,
             std::size_t items)
{
    void* data =
        rtcSetNewGeometryBuffer(geometry.get(), type, 0, format, per_item * sizeof(N), items);
    if (data == nullptr)
        throw std::runtime_error("Embree has no memory for the surfaces of the scene");
    return static_cast<N*>(data);
}

/// A power of two that makes the surfaces of a very large or very small scene about as large as 1:
/// Embree multiplies lengths by one another in float. Else 1.
double scale_of(const Scene& scene, const Vec3<double>& origin)
{
    double largest = 0;
    const auto reach = [&](const Vec3<double>& p) {
        largest = std::max(largest, largest_coordinate(p - origin));
    };
    for (const Surface& surface : scene.surfaces) {
        if (const auto* quad = std::get_if<Quad>(&surface.shape))
            for (const double u : {0.0, 1.0})
                for (const double v : {0.0, 1.0})
                    reach(quad->corner + quad->edges[0] * u + quad->edges[1] * v);
        else if (const auto* sphere = std::get_if<SphereSurface>(&surface.shape))
            reach(sphere->center + sphere->radius), reach(sphere->center - sphere->radius);
        else
            for (const Vec3<double>& p : std::get<Mesh>(surface.shape).positions) reach(p);
    }
    if (!(largest > 0) || (largest > 0x1p-10 && largest < 0x1p20)) return 1;
    constexpr int most = 120;  // a float's
    return std::exp2(std::clamp(-std::ilogb(largest), -most, most));
}

}  // namespace

std::string embree_error(int code)
{
    switch (code) {
        case RTC_ERROR_NONE: return "no error";
        case RTC_ERROR_UNKNOWN: return "an error that it does not know";
        case RTC_ERROR_INVALID_ARGUMENT: return "an argument that it does not take";
        case RTC_ERROR_INVALID_OPERATION: return "an operation that it does not allow";
        case RTC_ERROR_OUT_OF_MEMORY: return "out of memory";
        case RTC_ERROR_UNSUPPORTED_CPU: return "this processor is not supported";
        case RTC_ERROR_CANCELLED: return "it was cancelled";
        default: return "error " + std::to_string(code);
    }
}

/// Embree's device and scene, and which surface a geometry is.
struct EmbreeTracer::Trees {
    Trees(const Scene& s, const StopToken& stop)
        : scene(s), origin(frame_origin_of(s)), scale(scale_of(s, origin))
    {
        device = rtcNewDevice(nullptr);
        if (device == nullptr)
            throw std::runtime_error("Embree does not start: " +
                                     embree_error(rtcGetDeviceError(nullptr)));
        if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0)
            widest_packet = 16;
        else if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0)
            widest_packet = 8;
        tree = rtcNewScene(device);
        rtcSetSceneFlags(tree, RTC_SCENE_FLAG_ROBUST);
        try {
            add_all(stop);
            commit(stop);
        } catch (...) {
            release();
            throw;
        }
    }
    ~Trees() { release(); }
    Trees(const Trees&) = delete;
    Trees& operator=(const Trees&) = delete;

    void release() const
    {
        rtcReleaseScene(tree);
        rtcReleaseDevice(device);
    }

    /// Builds the tree. Embree asks now and then whether it is to go on.
    void commit(const StopToken& stop) const
    {
        StopToken asked = stop;
        rtcSetSceneProgressMonitorFunction(
            tree, [](void* token, double) { return !static_cast<StopToken*>(token)->is_up(); },
            &asked);
        rtcCommitScene(tree);
        rtcSetSceneProgressMonitorFunction(tree, nullptr, nullptr);
        const RTCError error = rtcGetDeviceError(device);
        if (error == RTC_ERROR_CANCELLED) throw Stopped();
        if (error != RTC_ERROR_NONE)
            throw std::runtime_error(
                "Embree could not build a tree over the surfaces of the scene: " +
                embree_error(error));
    }

    void add_all(const StopToken& stop)
    {
        std::vector<std::size_t> quads;
        for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
            stop.check();
            const auto& shape = scene.surfaces[s].shape;
            if (std::holds_alternative<Quad>(shape)) quads.push_back(s);
            else if (const auto* sphere = std::get_if<SphereSurface>(&shape))
                spheres.push_back({(sphere->center - origin) * scale, sphere->radius * scale, s});
            else add_mesh(std::get<Mesh>(shape), s, stop);
        }
        if (!quads.empty()) add_quads(std::move(quads));
        if (!spheres.empty()) add_spheres();
    }

    void put(float* vertices, std::size_t i, const Vec3<double>& p) const
    {
        const Vec3<float> v = vec_cast<float>((p - origin) * scale);
        vertices[3 * i] = v.x, vertices[3 * i + 1] = v.y, vertices[3 * i + 2] = v.z;
    }

    void add_mesh(const Mesh& mesh, std::size_t surface, const StopToken& stop)
    {
        StopEvery check(stop, 1 << 16);
        const Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
        auto* vertices = buffer_of<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3,
                                          mesh.positions.size());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            check(), put(vertices, i, mesh.positions[i]);
        auto* indices = buffer_of<unsigned>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 3,
                                            mesh.triangles.size());
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            check();
            for (std::size_t k = 0; k < 3; ++k) indices[3 * i + k] = mesh.triangles[i][k];
        }
        attach(geometry, {surface});
    }

    void add_quads(std::vector<std::size_t> surfaces)
    {
        const Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD));
        auto* vertices = buffer_of<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3,
                                          4 * surfaces.size());
        auto* indices = buffer_of<unsigned>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT4, 4,
                                            surfaces.size());
        for (std::size_t q = 0; q < surfaces.size(); ++q) {
            const Quad& quad = std::get<Quad>(scene.surfaces[surfaces[q]].shape);
            put(vertices, 4 * q, quad.corner);
            put(vertices, 4 * q + 1, quad.corner + quad.edges[0]);
            put(vertices, 4 * q + 2, quad.corner + quad.edges[0] + quad.edges[1]);
            put(vertices, 4 * q + 3, quad.corner + quad.edges[1]);
            for (std::size_t k = 0; k < 4; ++k)
                indices[4 * q + k] = static_cast<unsigned>(4 * q + k);
        }
        attach(geometry, std::move(surfaces));
    }

    void add_spheres()
    {
        const Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
        rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(spheres.size()));
        rtcSetGeometryUserData(geometry.get(), &spheres);
        rtcSetGeometryBoundsFunction(
            geometry.get(), [](const RTCBoundsFunctionArguments* a) { sphere_bounds(a); }, nullptr);
        rtcSetGeometryIntersectFunction(geometry.get(), sphere_intersect);
        rtcSetGeometryOccludedFunction(geometry.get(), sphere_occluded);
        std::vector<std::size_t> surfaces;
        for (const PlacedSphere& s : spheres) surfaces.push_back(s.surface);
        attach(geometry, std::move(surfaces));
    }

    /// surfaces: one, of which all primitives are triangles; or one per primitive.
    void attach(const Geometry& geometry, std::vector<std::size_t> surfaces)
    {
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometryByID(tree, geometry.get(), static_cast<unsigned>(surfaces_of.size()));
        surfaces_of.push_back(std::move(surfaces));
    }

    SurfaceLocation location(unsigned geometry, unsigned primitive) const
    {
        const std::vector<std::size_t>& surfaces = surfaces_of[geometry];
        const bool is_mesh = std::holds_alternative<Mesh>(scene.surfaces[surfaces[0]].shape);
        return is_mesh ? SurfaceLocation{surfaces[0], primitive}
                       : SurfaceLocation{surfaces[primitive], 0};
    }

    const Scene& scene;
    Vec3<double> origin;
    double scale;  ///< of Embree's lengths, over the scene's
    RTCDevice device = nullptr;
    int widest_packet = 4;  ///< of those that the machine has vectors for: 16, 8 or 4
    RTCScene tree = nullptr;
    std::vector<PlacedSphere> spheres;
    std::vector<std::vector<std::size_t>> surfaces_of;  ///< [geometry]
};

void occluded_in(RTCSceneTy* scene, std::span<const ShadowRay> rays, std::span<std::uint8_t> hidden)
{
    answer_in_packets<RTCRay8, 8>(scene, 1, rays, hidden);
}

EmbreeTracer::EmbreeTracer(const Scene& scene, const StopToken& stop)
    : trees_(std::make_unique<Trees>(scene, stop))
{
}
EmbreeTracer::~EmbreeTracer() = default;

void EmbreeTracer::occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> hidden) const
{
    const RTCScene tree = trees_->tree;
    const auto scale = static_cast<float>(trees_->scale);
    if (trees_->widest_packet == 16) answer_in_packets<RTCRay16, 16>(tree, scale, rays, hidden);
    else if (trees_->widest_packet == 8) answer_in_packets<RTCRay8, 8>(tree, scale, rays, hidden);
    else answer_in_packets<RTCRay4, 4>(tree, scale, rays, hidden);
}

std::optional<SurfaceHit> EmbreeTracer::first_hit(const Vec3<double>& origin,
                                                  const Vec3<double>& direction) const
{
    RTCRayHit ray{};
    ray.ray = ray_of(vec_cast<float>((origin - trees_->origin) * trees_->scale),
                     vec_cast<float>(direction), std::numeric_limits<float>::infinity());
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if MIS_EMBREE_MAJOR >= 4
    rtcIntersect1(trees_->tree, &ray, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(trees_->tree, &context, &ray);
#endif
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return hit_at(trees_->scene, trees_->location(ray.hit.geomID, ray.hit.primID), origin,
                  direction, trees_->origin);
}

Vec3<double> EmbreeTracer::origin() const { return trees_->origin; }

double EmbreeTracer::offset_at(const Vec3<double>& x) const
{
    return offset_of_point(trees_->scene, x, trees_->origin);
}

void EmbreeTracer::offsets_at(std::span<const Vec3<double>> points, std::span<double> offsets,
                              const ForEach& for_each) const
{
    offsets_of_points(trees_->scene, points, trees_->origin, for_each, offsets);
}

}  // namespace mis
