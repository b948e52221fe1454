#include "wavefront/wave_storage.hpp"

#include <cstring>
#include <new>

namespace orrery {

namespace {

constexpr std::size_t cache_line = 64;

/// Hands out one field after another. Fields of equal power-of-two length would all start in the same cache set and
/// evict each other, a stage walking a dozen of them at once; the stagger keeps them apart.
struct Carver {
    std::byte* base;
    std::size_t used = 0;

    template <class T>
    void field(T*& to, std::size_t count) {
        to = base != nullptr ? reinterpret_cast<T*>(base + used) : nullptr;
        used += (count * sizeof(T) + cache_line - 1) / cache_line * cache_line + 3 * cache_line;
    }
    template <class Queue>
    void queue(Queue& to, std::size_t count) {
        Queue::each_field([&](const char*, auto member) { field(to.*member, count); });
    }
};

}  // namespace

template <class Real>
void WaveStorage<Real>::Free::operator()(std::byte* block) const {
    ::operator delete (block, std::align_val_t{cache_line});
}

template <class Real>
std::size_t WaveStorage<Real>::carve(std::byte* base, const Needs& needs, std::uint32_t depth) {
    Carver carver{base};
    const std::uint32_t padded = kernels::round_up(slot_count);
    const std::uint32_t capacity = kernels::ray_capacity(slot_count);
    const bool shades = needs.integrator != Integrator::depth;

    const auto every = [](auto) { return true; };
    const auto ray_fields = [&](kernels::RayQueue<Real>& queue, std::size_t count, const auto& wanted) {
        kernels::RayQueue<Real>::each_field([&](const char*, auto member) {
            using Queue = kernels::RayQueue<Real>;
            if (!wanted(member)) return;
            if constexpr (std::is_same_v<decltype(member), Real * Queue::*>) {
                if (member == &Queue::pdf && !needs.scattering_pdf) return;
                if (member == &Queue::roulette_scale && !needs.roulette_scale) return;
            } else if (member == &Queue::vertex && needs.integrator != Integrator::whitted) {
                return;
            }
            carver.field(queue.*member, count);
        });
    };

    carver.field(slots.pixel, padded);
    carver.field(slots.sample, padded);
    carver.field(slots.plane_x, padded);
    carver.field(slots.plane_y, padded);
    carver.field(slots.radiance, std::size_t{4} * padded);
    if (needs.sobol) {
        const bool four = needs.lens || needs.one_light || needs.caustics;
        const auto drawing_three = kernels::scattering_where([](const auto& traits) { return traits.dimensions > 2; });
        carver.field(slots.sobol.x, capacity);
        carver.field(slots.sobol.y, capacity);
        if (four || (needs.scattering & drawing_three) != 0) carver.field(slots.sobol.z, capacity);
        if (four) carver.field(slots.sobol.w, capacity);
    }
    ray_fields(rays, capacity, every);
    carver.queue(hits, capacity);
    if (needs.sort) {
        ray_fields(sorted_rays, capacity, every);
        carver.queue(sorted_hits, capacity);
    }
    if (needs.lobes) carver.queue(lobes, capacity);
    if (shades && (needs.connect_point | needs.connect_area) != 0) {
        const bool targets = (needs.one_light && needs.connect_area != 0) || needs.point_caustics;
        kernels::ShadowQueue<Real>::each_field([&](const char*, auto member) {
            using Queue = kernels::ShadowQueue<Real>;
            if constexpr (std::is_same_v<decltype(member), typename Queue::Word * Queue::*>) {
                if (member == &Queue::target && !targets) return;
            }
            carver.field(shadows.*member, capacity);
        });
    }
    if (needs.exact) {
        using Queue = kernels::RayQueue<Real>;
        ray_fields(aside, capacity, [](auto member) {
            if constexpr (std::is_same_v<decltype(member), Real * Queue::*>) {
                return member != &Queue::dx && member != &Queue::dy && member != &Queue::dz && member != &Queue::pdf &&
                       member != &Queue::roulette_scale;
            }
            return true;
        });
    }
    if (needs.caustics) carver.queue(slots.chains, padded);
    if (needs.caustics || needs.point_caustics) carver.queue(picks, capacity);
    if (needs.branches) {
        branches.slots = slot_count;
        carver.field(branches.height, padded);
        ray_fields(branches.rays, std::size_t{slot_count} * depth, every);
        branches.rays.pixel = branches.rays.sample = nullptr;  // the slot knows them
        carver.field(live, padded);
    }
    return carver.used;
}

template <class Real>
std::size_t WaveStorage<Real>::bytes(const Needs& needs, std::uint32_t depth, std::uint32_t count) {
    WaveStorage counted(count);
    return counted.carve(nullptr, needs, depth);
}

template <class Real>
WaveStorage<Real>::WaveStorage(const Needs& needs, std::uint32_t depth, std::uint32_t count) : WaveStorage(count) {
    const std::size_t size = bytes(needs, depth, count);
    block_.reset(static_cast<std::byte*>(::operator new (size, std::align_val_t{cache_line})));
    // Zero, so that lanes nobody wrote hold valid ids and slots; first touch is by the thread that owns the wave.
    std::memset(block_.get(), 0, size);
    carve(block_.get(), needs, depth);
}

std::size_t queue_bytes(const Plan& plan, std::uint32_t count) {
    const auto bytes =
        plan.settings().precision == Precision::binary64 ? WaveStorage<double>::bytes : WaveStorage<float>::bytes;
    return bytes(plan.needs(), plan.settings().depth, count);
}

template class WaveStorage<float>;
template class WaveStorage<double>;

}  // namespace orrery
