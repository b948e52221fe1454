#include "bench/snapshot.hpp"

#include <cstring>

namespace orrery::bench {

Snapshot::Snapshot(const WaveStorage<float>& from, std::uint32_t parts, std::uint32_t slots, std::uint32_t records)
    : parts_(parts), slots_(kernels::round_up(slots)), records_(kernels::round_up(records)) {
    std::size_t size = 0;
    each_array(from, parts_, slots_, records_, [&](const char*, const auto*, std::size_t words) { size += words; });
    words_.resize(size);
    std::uint32_t* to = words_.data();
    each_array(from, parts_, slots_, records_, [&](const char*, const auto* array, std::size_t words) {
        static_assert(sizeof *array == sizeof *to);
        std::memcpy(to, array, words * sizeof *to);
        to += words;
    });
}

void Snapshot::restore(WaveStorage<float>& to) const {
    const std::uint32_t* from = words_.data();
    each_array(to, parts_, slots_, records_, [&](const char*, auto* array, std::size_t words) {
        std::memcpy(array, from, words * sizeof *from);
        from += words;
    });
}

}  // namespace orrery::bench
