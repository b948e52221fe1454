// What a wave's queues held at one moment, so that a stage can be run on it again and again.
#pragma once

#include <cstdint>
#include <vector>

#include "wavefront/pipeline.hpp"

namespace orrery::bench {

/// Calls visit(name, array, words) for every array that is present among `parts`, `slots` and `records` long.
template <class Storage, class Visit>
void each_array(Storage& storage, std::uint32_t parts, std::uint32_t slots, std::uint32_t records, const Visit& visit) {
    const auto queue = [&](auto& of, std::uint32_t count) {
        std::remove_cvref_t<decltype(of)>::each_field([&](const char* name, auto member) {
            if (of.*member != nullptr) visit(name, of.*member, std::size_t{count});
        });
    };
    if (parts & slot_part) {
        visit("pixel", storage.slots.pixel, std::size_t{slots});
        visit("sample", storage.slots.sample, std::size_t{slots});
        visit("plane_x", storage.slots.plane_x, std::size_t{slots});
        visit("plane_y", storage.slots.plane_y, std::size_t{slots});
    }
    if (parts & radiance_part) visit("radiance", storage.slots.radiance, std::size_t{4} * slots);
    if (parts & ray_part) queue(storage.rays, records);
    if (parts & hit_part) queue(storage.hits, records);
    if (parts & lobe_part) queue(storage.lobes, records);
    if (parts & shadow_part) queue(storage.shadows, records);
    if (parts & aside_part) queue(storage.aside, records);
    if (parts & chain_part) queue(storage.slots.chains, slots);
    if (parts & pick_part) queue(storage.picks, records);
    if (parts & sorted_part) {
        queue(storage.sorted_rays, records);
        queue(storage.sorted_hits, records);
    }
}

class Snapshot {
public:
    /// Copies the first `slots` slots and `records` records of `parts`, rounded up to whole vectors.
    Snapshot(const WaveStorage<float>& from, std::uint32_t parts, std::uint32_t slots, std::uint32_t records);

    /// Puts everything back where it was. `to` has the layout of the storage the snapshot was taken of.
    void restore(WaveStorage<float>& to) const;

private:
    std::uint32_t parts_, slots_, records_;
    std::vector<std::uint32_t> words_;
};

}  // namespace orrery::bench
