// The memory of one thread's wave: every queue, allocated once, in one block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "kernels/queues.hpp"
#include "plan/plan.hpp"

namespace orrery {

/// Queues for waves of up to `count` (pixel, sample) pairs, with the fields the plan needs. Owned by one thread.
class WaveStorage {
public:
    /// Throws std::bad_alloc.
    WaveStorage(const Needs& needs, std::uint32_t depth, std::uint32_t count);

    /// Bytes the constructor would allocate.
    static std::size_t bytes(const Needs& needs, std::uint32_t depth, std::uint32_t count);

    std::uint32_t slot_count;
    kernels::SlotTable<float> slots{};
    kernels::RayQueue<float> rays{};
    kernels::HitQueue<float> hits{};
    kernels::RayQueue<float> sorted_rays{};  ///< null fields without Needs::sort, as is the next
    kernels::HitQueue<float> sorted_hits{};
    kernels::LobeQueue<float> lobes{};
    kernels::ShadowQueue<float> shadows{};
    kernels::BranchStack<float> branches{};
    std::uint32_t* live = nullptr;  ///< scratch of the stage `resume`, all zero

private:
    struct Free {
        void operator()(std::byte* block) const;
    };
    /// Points every needed field into `base` and returns the bytes used; with a null base only counts.
    std::size_t carve(std::byte* base, const Needs& needs, std::uint32_t depth);
    explicit WaveStorage(std::uint32_t count) : slot_count(count) {}

    std::unique_ptr<std::byte, Free> block_;
};

}  // namespace orrery
