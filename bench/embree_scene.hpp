// The same spheres in Embree, and the same rays in the layouts its queries want.
//
// Without Embree in the build the type exists, and no object of it.
#pragma once

#if ORRERY_EMBREE
#include <embree3/rtcore.h>
#endif

#include <cstdint>
#include <vector>

#include "bench/timing.hpp"
#include "kernels/queues.hpp"

namespace orrery::bench {

#if !ORRERY_EMBREE
class EmbreeScene {};
constexpr const char* embree_version() { return "none"; }
#else

constexpr const char* embree_version() { return RTC_VERSION_STRING; }

/// A ray as Embree takes it. Embree knows no "sphere just left": that root is kept out by tnear.
struct PeerRay {
    float ox, oy, oz, tnear, dx, dy, dz, tfar;
};

/// The rays of a queue.
std::vector<PeerRay> peer_rays(const kernels::SphereTable<float>& spheres, const kernels::RayQueue<float>& rays,
                               std::uint32_t count);
/// The segments of a shadow queue; they end just before the sphere `target`.
std::vector<PeerRay> peer_rays(const kernels::SphereTable<float>& spheres, const kernels::ShadowQueue<float>& queue,
                               std::uint32_t count, std::uint32_t target);

/// Flush-to-zero and denormals-are-zero, as Embree's manual asks of threads that query it; for the object's life.
class FlushDenormals {
public:
    FlushDenormals();
    ~FlushDenormals();
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
    unsigned before_;
};

/// The configuration queries are fastest with: asked for heavy AVX-512 Embree finds closest hits up to a tenth faster
/// and occlusion up to a third slower than left alone. isa=avx2 is slower throughout, hugepages=1 changes nothing.
constexpr const char* embree_config(bool occlusion) {
    // No threads=1: a query runs on its caller's thread anyway, and the device would keep all of TBB to one.
    return occlusion ? "" : "frequency_level=simd512";
}

/// Spheres, committed. primID is the place in the table.
class EmbreeScene {
public:
    /// `config` as in rtcNewDevice; `clock` times the building.
    EmbreeScene(const kernels::SphereTable<float>& spheres, const char* config, RTCBuildQuality quality,
                TimedBy clock = TimedBy::wall);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    RTCScene scene() const { return scene_; }
    double build_seconds() const { return build_seconds_; }
    /// What Embree has allocated, the spheres themselves (16 bytes each) included.
    std::int64_t bytes() const { return bytes_; }

private:
    RTCDevice device_;
    RTCScene scene_;
    double build_seconds_ = 0;
    std::int64_t bytes_ = 0;
};

template <int width>
struct Packet;
template <>
struct Packet<1> {
    using Hits = RTCRayHit;
    using Rays = RTCRay;
    static void intersect(const int*, RTCScene s, RTCIntersectContext* c, Hits* h) { rtcIntersect1(s, c, h); }
    static void occluded(const int*, RTCScene s, RTCIntersectContext* c, Rays* r) { rtcOccluded1(s, c, r); }
};
template <>
struct Packet<4> {
    using Hits = RTCRayHit4;
    using Rays = RTCRay4;
    static constexpr auto intersect = rtcIntersect4;
    static constexpr auto occluded = rtcOccluded4;
};
template <>
struct Packet<8> {
    using Hits = RTCRayHit8;
    using Rays = RTCRay8;
    static constexpr auto intersect = rtcIntersect8;
    static constexpr auto occluded = rtcOccluded8;
};
template <>
struct Packet<16> {
    using Hits = RTCRayHit16;
    using Rays = RTCRay16;
    static constexpr auto intersect = rtcIntersect16;
    static constexpr auto occluded = rtcOccluded16;
};

/// A field of a packet's lane: an array of the packet, or the number itself.
template <class T, std::size_t n>
T& lane_of(T (&field)[n], std::size_t lane) {
    return field[lane];
}
template <class T>
T& lane_of(T& field, std::size_t) {
    return field;
}

template <class Rays>
void set_ray(Rays& packet, std::size_t lane, const PeerRay& ray) {
    lane_of(packet.org_x, lane) = ray.ox;
    lane_of(packet.org_y, lane) = ray.oy;
    lane_of(packet.org_z, lane) = ray.oz;
    lane_of(packet.tnear, lane) = ray.tnear;
    lane_of(packet.dir_x, lane) = ray.dx;
    lane_of(packet.dir_y, lane) = ray.dy;
    lane_of(packet.dir_z, lane) = ray.dz;
    lane_of(packet.tfar, lane) = ray.tfar;
    lane_of(packet.mask, lane) = ~0u;
}

/// Rays in packets of `width`, the last one filled up with copies of its first ray.
template <int width>
std::vector<typename Packet<width>::Rays> occlusion_packets(const std::vector<PeerRay>& rays) {
    std::vector<typename Packet<width>::Rays> packets((rays.size() + width - 1) / width);
    for (std::size_t i = 0; i < packets.size() * width; ++i)
        set_ray(packets[i / width], i % width, rays[i < rays.size() ? i : i / width * width]);
    return packets;
}
template <int width>
std::vector<typename Packet<width>::Hits> hit_packets(const std::vector<PeerRay>& rays) {
    std::vector<typename Packet<width>::Hits> packets((rays.size() + width - 1) / width);
    for (std::size_t i = 0; i < packets.size() * width; ++i) {
        set_ray(packets[i / width].ray, i % width, rays[i < rays.size() ? i : i / width * width]);
        lane_of(packets[i / width].hit.geomID, i % width) = RTC_INVALID_GEOMETRY_ID;
    }
    return packets;
}

#endif

}  // namespace orrery::bench
