// The memory of one thread's wave: every queue, allocated once, in one block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "kernels/queues.hpp"
#include "plan/plan.hpp"

namespace orrery {

/// Queues for waves of up to `count` (pixel, sample) pairs, with the fields the plan needs. Owned by one thread.
template <class Real>
class WaveStorage {
public:
    /// Throws std::bad_alloc.
    WaveStorage(const Needs& needs, std::uint32_t depth, std::uint32_t count);

    /// Bytes the constructor would allocate.
    static std::size_t bytes(const Needs& needs, std::uint32_t depth, std::uint32_t count);

    std::uint32_t slot_count;
    kernels::SlotTable<Real> slots{};
    kernels::RayQueue<Real> rays{};
    kernels::HitQueue<Real> hits{};
    kernels::RayQueue<Real> sorted_rays{};  ///< null fields without Needs::sort, as is the next
    kernels::HitQueue<Real> sorted_hits{};
    kernels::LobeQueue<Real> lobes{};
    kernels::ShadowQueue<Real> shadows{};
    kernels::RayQueue<Real>
        aside{};  ///< vertices whose light is not known in closed form; what `connect` reads of them
    kernels::PickQueue<Real> picks{};  ///< null fields without caustics; the slots' chains without Needs::caustics
    kernels::BranchStack<Real> branches{};
    kernels::WordOf<Real>* live = nullptr;  ///< scratch of the stage `resume`, all zero

private:
    struct Free {
        void operator()(std::byte* block) const;
    };
    /// Points every needed field into `base` and returns the bytes used; with a null base only counts.
    std::size_t carve(std::byte* base, const Needs& needs, std::uint32_t depth);
    explicit WaveStorage(std::uint32_t count) : slot_count(count) {}

    std::unique_ptr<std::byte, Free> block_;
};

extern template class WaveStorage<float>;
extern template class WaveStorage<double>;

/// Bytes of all queues of one thread for waves of `count`, in the plan's precision.
std::size_t queue_bytes(const Plan& plan, std::uint32_t count);

}  // namespace orrery
