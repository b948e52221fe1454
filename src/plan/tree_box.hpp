// Axis-aligned boxes in registers, for the tree's builder.
#pragma once

#include <cstddef>
#include <cstring>
#include <limits>

#include "plan/tree.hpp"

namespace orrery {

using Four __attribute__((vector_size(16))) = float;  // as both g++ and clang++ read it

inline Four smaller(Four a, Four b) { return a < b ? a : b; }
inline Four larger(Four a, Four b) { return a > b ? a : b; }

struct Box {
    Four low = Four{} + std::numeric_limits<float>::infinity();
    Four high = Four{} - std::numeric_limits<float>::infinity();

    void add(Four from, Four to) {
        low = smaller(low, from);
        high = larger(high, to);
    }
    void add(const Box& other) { add(other.low, other.high); }
    /// Half the surface, in double: squares of what a float holds do not overflow there.
    double area() const {
        const double x = double{high[0]} - low[0], y = double{high[1]} - low[1], z = double{high[2]} - low[2];
        return x * y + y * z + z * x;
    }
};

/// Centre and radius in one load.
inline Four four_of(const BuildSphere& s) {
    Four v;
    static_assert(offsetof(BuildSphere, radius) == 3 * sizeof(float));
    std::memcpy(&v, &s, sizeof v);
    return v;
}
inline Four radius_of(Four sphere) { return __builtin_shufflevector(sphere, sphere, 3, 3, 3, 3); }

}  // namespace orrery
