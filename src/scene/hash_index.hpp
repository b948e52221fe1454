// Finds the items of somebody else's array by their hash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace orrery {

/// An open-addressing table of 8 bytes a slot: what it indexes, and how two of those compare, its user knows. Hashes
/// have to be keyed_hash()es, whose every bit counts.
class HashIndex {
public:
    /// The item of this hash that `is_equal(item)`; where there is none, `next`, which is then entered.
    template <class IsEqual>
    std::uint32_t find_or_insert(std::uint64_t hash, std::uint32_t next, const IsEqual& is_equal) {
        if (slots_.size() * 3 <= count_ * 4) grow();
        const std::size_t last = slots_.size() - 1;
        const auto tag = static_cast<std::uint32_t>(hash);
        std::size_t at = tag & last;
        for (; slots_[at].item != none; at = (at + 1) & last)
            if (slots_[at].tag == tag && is_equal(slots_[at].item)) return slots_[at].item;
        slots_[at] = {tag, next};
        ++count_;
        return next;
    }

private:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    struct Slot {
        std::uint32_t tag = 0;  ///< low bits of the hash
        std::uint32_t item = none;
    };

    void grow() {
        std::vector<Slot> larger(slots_.empty() ? 64 : slots_.size() * 2);
        const std::size_t last = larger.size() - 1;
        for (const Slot& slot : slots_) {
            if (slot.item == none) continue;
            std::size_t at = slot.tag & last;
            while (larger[at].item != none) at = (at + 1) & last;
            larger[at] = slot;
        }
        slots_ = std::move(larger);
    }

    std::vector<Slot> slots_;  ///< a power of two of them, at most three quarters taken
    std::size_t count_ = 0;
};

}  // namespace orrery
