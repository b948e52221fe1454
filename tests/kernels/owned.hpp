// A queue or table of the kernels with memory of its own, poisoned and guarded.
//
// Every word starts as the canary: as a number it is a NaN, as an id or slot it lies outside every table, so a kernel
// that lets it into a result, or looks it up, shows. Guards before and behind each field tell of writes out of bounds.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "kernels/queues.hpp"

namespace orrery::kernel_tests {

inline constexpr std::uint32_t canary = 0xFFB5EED5u;

template <class Queue>
class Owned {
public:
    static constexpr std::ptrdiff_t guard = 64;  ///< words before and behind each field

    /// `absent` names the fields to be null pointers.
    explicit Owned(std::size_t capacity, const std::vector<std::string_view>& absent = {})
        : capacity_(static_cast<std::ptrdiff_t>(capacity)) {
        Queue::each_field([&](std::string_view name, auto) {
            bool present = true;
            for (const std::string_view other : absent) present = present && name != other;
            fields_.push_back({name, {}});
            if (!present) return;
            const auto words = static_cast<std::size_t>(2 * guard + capacity_ * width(name));
            fields_.back().lines.resize((words + 15) / 16);
            for (std::size_t i = 0; i < 16 * fields_.back().lines.size(); ++i)
                std::memcpy(fields_.back().byte(i), &canary, 4);
        });
        point();
    }
    Owned(const Owned& other) : fields_(other.fields_), capacity_(other.capacity_) { point(); }
    Owned& operator=(const Owned&) = delete;

    const Queue& operator*() const { return queue_; }
    const Queue* operator->() const { return &queue_; }
    std::ptrdiff_t capacity() const { return capacity_; }

    /// Items [begin, end) hold the same bytes in both, in every field. Reaches into the guards: -guard to capacity() +
    /// guard.
    ::testing::AssertionResult same_as(const Owned& other, std::ptrdiff_t begin, std::ptrdiff_t end) const {
        for (std::size_t f = 0; f < fields_.size(); ++f) {
            if (fields_[f].lines.empty()) continue;
            const std::ptrdiff_t w = width(fields_[f].name);
            for (std::ptrdiff_t i = std::max(begin * w, -guard); i < std::min(end * w, capacity_ * w + guard); ++i)
                if (word(f, i) != other.word(f, i))
                    return ::testing::AssertionFailure() << fields_[f].name << "[" << i << "] is " << std::hex
                                                         << word(f, i) << ", not " << other.word(f, i);
        }
        return ::testing::AssertionSuccess();
    }
    /// Nothing but items [begin, end) differs from `before`.
    ::testing::AssertionResult untouched_but(const Owned& before, std::ptrdiff_t begin, std::ptrdiff_t end) const {
        auto front = same_as(before, -guard, begin);
        return front ? same_as(before, end, capacity_ + guard) : front;
    }

private:
    /// The kernels' own storage begins every field on a cache line; so does this.
    struct alignas(64) Line {
        std::byte bytes[64];
    };
    struct Field {
        std::string_view name;
        std::vector<Line> lines;
        std::byte* byte(std::size_t word) { return lines[word / 16].bytes + word % 16 * 4; }
        const std::byte* byte(std::size_t word) const { return lines[word / 16].bytes + word % 16 * 4; }
    };

    /// Words per item.
    static std::ptrdiff_t width(std::string_view field) { return field == "radiance" ? 4 : 1; }

    void point() {
        std::size_t f = 0;
        Queue::each_field([&](std::string_view, auto member) {
            using Pointer = std::remove_reference_t<decltype(queue_.*member)>;
            Field& field = fields_[f++];
            queue_.*member = field.lines.empty() ? nullptr : reinterpret_cast<Pointer>(field.byte(guard));
        });
    }
    std::uint32_t word(std::size_t field, std::ptrdiff_t i) const {
        std::uint32_t value = 0;
        std::memcpy(&value, fields_[field].byte(static_cast<std::size_t>(guard + i)), 4);
        return value;
    }

    std::vector<Field> fields_;
    std::ptrdiff_t capacity_;
    Queue queue_{};
};

/// Without the column of vertices, as path tracing has them, unless it is asked for.
struct Rays : Owned<kernels::RayQueue<float>> {
    struct InTrees {};
    explicit Rays(std::size_t capacity, std::vector<std::string_view> absent = {})
        : Owned(capacity, and_vertex(std::move(absent))) {}
    Rays(std::size_t capacity, InTrees, const std::vector<std::string_view>& absent = {}) : Owned(capacity, absent) {}

private:
    static std::vector<std::string_view> and_vertex(std::vector<std::string_view> absent) {
        absent.push_back("vertex");
        return absent;
    }
};
using Hits = Owned<kernels::HitQueue<float>>;
using Lobes = Owned<kernels::LobeQueue<float>>;
using Slots = Owned<kernels::SlotTable<float>>;

/// Without the column of targets, as in most plans, unless it is asked for.
struct Shadows : Owned<kernels::ShadowQueue<float>> {
    struct WithTargets {};
    explicit Shadows(std::size_t capacity) : Owned(capacity, {"target"}) {}
    Shadows(std::size_t capacity, WithTargets) : Owned(capacity) {}
};

inline kernels::RayQueue<float> from(const Rays& rays, std::uint32_t first) {
    kernels::RayQueue<float> part = *rays;
    kernels::RayQueue<float>::each_field([&](const char*, auto field) {
        if (part.*field != nullptr) part.*field += first;
    });
    return part;
}

}  // namespace orrery::kernel_tests
