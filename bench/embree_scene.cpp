#include "bench/embree_scene.hpp"

#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace orrery::bench {

namespace {

struct Roots {
    double near, far;  ///< NaN where the line misses
};

/// Where a ray's line meets a sphere of the table, in double.
template <class Queue>
Roots roots(const kernels::SphereTable<float>& spheres, std::uint32_t id, const Queue& rays, std::size_t i) {
    const double f[3] = {double{rays.ox[i]} - spheres.cx[id], double{rays.oy[i]} - spheres.cy[id],
                         double{rays.oz[i]} - spheres.cz[id]};
    const double d[3] = {rays.dx[i], rays.dy[i], rays.dz[i]};
    const double r = spheres.radius[id];
    const double dd = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const double b = -(f[0] * d[0] + f[1] * d[1] + f[2] * d[2]) / dd;
    const double c = (f[0] * f[0] + f[1] * f[1] + f[2] * f[2] - r * r) / dd;
    const double s = std::sqrt(b * b - c);
    return {b - s, b + s};
}

/// In radii: how far behind its start a ray may meet the sphere it left by the rounding of Embree's roots. A third of
/// it lets 16 shadow rays in 10000 of scene 8 run into their own wall, thrice of it hides hits close to the start.
constexpr double own_margin = 3e-5;

template <class Queue>
PeerRay peer_ray(const kernels::SphereTable<float>& spheres, const Queue& rays, std::size_t i) {
    PeerRay ray{rays.ox[i], rays.oy[i], rays.oz[i], 0, rays.dx[i], rays.dy[i], rays.dz[i], INFINITY};
    const std::uint32_t left = rays.departed[i] & kernels::no_sphere;
    if (left == kernels::no_sphere) return ray;
    const Roots own = roots(spheres, left, rays, i);
    // Inward the far root is a hit to be found; outward it is the rounding of the origin, and none.
    const bool inward = (rays.departed[i] & kernels::inside_bit) != 0;
    const double far = own.far > 0 ? own.far : 0;
    ray.tnear = static_cast<float>(inward ? far / 2 : far * 1.01 + own_margin * spheres.radius[left]);
    return ray;
}

bool count_bytes(void* sum, ssize_t bytes, bool) {
    *static_cast<std::int64_t*>(sum) += bytes;
    return true;
}

}  // namespace

std::vector<PeerRay> peer_rays(const kernels::SphereTable<float>& spheres, const kernels::RayQueue<float>& rays,
                               std::uint32_t count) {
    std::vector<PeerRay> list;
    for (std::size_t i = 0; i < count; ++i) list.push_back(peer_ray(spheres, rays, i));
    return list;
}

std::vector<PeerRay> peer_rays(const kernels::SphereTable<float>& spheres, const kernels::ShadowQueue<float>& queue,
                               std::uint32_t count, std::uint32_t target) {
    std::vector<PeerRay> list;
    for (std::size_t i = 0; i < count; ++i) {
        PeerRay ray = peer_ray(spheres, queue, i);
        ray.tfar = 1 / queue.inverse_t_max[i];
        if (target != kernels::no_sphere) {
            const Roots light = roots(spheres, target, queue, i);
            const double end = light.near > 0 ? light.near : light.far;
            if (end > 0) ray.tfar = static_cast<float>(std::min<double>(ray.tfar, end) * 0.9999);
        }
        list.push_back(ray);
    }
    return list;
}

FlushDenormals::FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040u); }
FlushDenormals::~FlushDenormals() { _mm_setcsr(before_); }

EmbreeScene::EmbreeScene(const kernels::SphereTable<float>& spheres, const char* config, RTCBuildQuality quality,
                         TimedBy clock)
    : device_(rtcNewDevice(config)) {
    if (device_ == nullptr) throw std::runtime_error(std::string("Embree refuses the configuration ") + config);
    rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &bytes_);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), spheres.count));
    for (std::size_t k = 0; k < spheres.count; ++k) {
        vertices[4 * k] = spheres.cx[k];
        vertices[4 * k + 1] = spheres.cy[k];
        vertices[4 * k + 2] = spheres.cz[k];
        vertices[4 * k + 3] = spheres.radius[k];
    }
    rtcSetGeometryBuildQuality(geometry, quality);
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, quality);
    const Stopwatch watch(clock);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    build_seconds_ = watch.seconds();
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

}  // namespace orrery::bench
