// Two vectors as one: lanes twice as wide as the machine's registers.
//
// A stage such as `scatter` is one long chain of dependent operations, about as long as what the processor keeps in
// flight: the next vector of rays starts when the last one is nearly done, and the arithmetic units wait. With two
// vectors side by side every operation comes twice, independently. Nothing else changes, not a bit of the results.
#pragma once

#include "kernels/lanes/compress.hpp"

namespace orrery::kernels {

/// Lanes of `low`, then those of `high`.
template <class B>
struct Twin {
    using value_type = typename B::value_type;
    using Half = B;
    static constexpr std::size_t size = 2 * B::size;

    B low, high;

    Twin() = default;
    ORRERY_INLINE Twin(const B& a, const B& b) : low(a), high(b) {}
    ORRERY_INLINE explicit Twin(value_type x) : low(x), high(x) {}
    ORRERY_INLINE static Twin load_unaligned(const value_type* from) {
        return {B::load_unaligned(from), B::load_unaligned(from + B::size)};
    }
    ORRERY_INLINE void store_unaligned(value_type* to) const {
        low.store_unaligned(to);
        high.store_unaligned(to + B::size);
    }
};

template <class V>
struct TwinLanes {
    using Half = V;
    using Real = typename V::Real;
    using Word = typename V::Word;
    using F = Twin<typename V::F>;
    using U = Twin<typename V::U>;
    using M = Twin<typename V::M>;
    static constexpr std::uint32_t count = 2 * V::count;
};

// Every operation on one vector is one on two.

template <class B>
ORRERY_INLINE const B& low_of(const Twin<B>& x) {
    return x.low;
}
template <class B>
ORRERY_INLINE const B& high_of(const Twin<B>& x) {
    return x.high;
}
/// op of the low halves, then op of the high ones.
template <class Op, class... T>
ORRERY_INLINE auto lifted(const Op& op, const T&... x) {
    return Twin<decltype(op(low_of(x)...))>{op(low_of(x)...), op(high_of(x)...)};
}

#define ORRERY_LIFT_INFIX(op)                                                                    \
    template <class B>                                                                           \
    ORRERY_INLINE auto operator op(const Twin<B>& a, const Twin<B>& b) {                         \
        return lifted([](const B& x, const B& y) ORRERY_INLINE_LAMBDA { return x op y; }, a, b); \
    }
ORRERY_LIFT_INFIX(+)
ORRERY_LIFT_INFIX(-)
ORRERY_LIFT_INFIX(*)
ORRERY_LIFT_INFIX(/)
ORRERY_LIFT_INFIX(&)
ORRERY_LIFT_INFIX(|)
ORRERY_LIFT_INFIX(^)
ORRERY_LIFT_INFIX(<)
ORRERY_LIFT_INFIX(<=)
ORRERY_LIFT_INFIX(>)
ORRERY_LIFT_INFIX(>=)
ORRERY_LIFT_INFIX(==)
ORRERY_LIFT_INFIX(&&)
ORRERY_LIFT_INFIX(||)
#undef ORRERY_LIFT_INFIX

#define ORRERY_LIFT(name, parameters, ...)                                                            \
    template <class B>                                                                                \
    ORRERY_INLINE auto name parameters {                                                              \
        return lifted([](const auto&... x) ORRERY_INLINE_LAMBDA { return name(x...); }, __VA_ARGS__); \
    }
#define ORRERY_LIFT_1(name) ORRERY_LIFT(name, (const Twin<B>& a), a)
#define ORRERY_LIFT_2(name) ORRERY_LIFT(name, (const Twin<B>& a, const Twin<B>& b), a, b)
#define ORRERY_LIFT_3(name) ORRERY_LIFT(name, (const Twin<B>& a, const Twin<B>& b, const Twin<B>& c), a, b, c)
ORRERY_LIFT_1(root)
ORRERY_LIFT_1(magnitude)
ORRERY_LIFT_1(reversed_bits)
ORRERY_LIFT_1(unit_interval)
ORRERY_LIFT_1(truncate_to_word)
ORRERY_LIFT_1(to_number)
ORRERY_LIFT_2(min)
ORRERY_LIFT_2(max)
ORRERY_LIFT_2(words_equal)
ORRERY_LIFT_2(multiply_words)
ORRERY_LIFT_3(mul_add)
ORRERY_LIFT_3(mul_sub)
ORRERY_LIFT_3(neg_mul_add)
#undef ORRERY_LIFT_3
#undef ORRERY_LIFT_2
#undef ORRERY_LIFT_1
#undef ORRERY_LIFT

template <class B>
ORRERY_INLINE Twin<B> operator>>(const Twin<B>& a, int places) {
    return {a.low >> places, a.high >> places};
}
template <class B>
ORRERY_INLINE Twin<B> operator<<(const Twin<B>& a, int places) {
    return {a.low << places, a.high << places};
}
template <class M>
ORRERY_INLINE Twin<M> operator!(const Twin<M>& a) {
    return {!a.low, !a.high};
}
template <class M, class B>
ORRERY_INLINE Twin<B> choose(const Twin<M>& m, const Twin<B>& a, const Twin<B>& b) {
    return {choose(m.low, a.low, b.low), choose(m.high, a.high, b.high)};
}
template <class B, class U>
ORRERY_INLINE Twin<B> flip_sign(const Twin<B>& a, const Twin<U>& sign) {
    return {flip_sign(a.low, sign.low), flip_sign(a.high, sign.high)};
}

// What makes one of many.

template <class M>
ORRERY_INLINE bool any(const Twin<M>& m) {
    return any(m.low || m.high);
}
template <class M>
ORRERY_INLINE bool all(const Twin<M>& m) {
    return all(m.low && m.high);
}
template <class M>
ORRERY_INLINE std::uint32_t bits(const Twin<M>& m) {
    return bits(m.low) | bits(m.high) << M::size;
}
template <class B>
ORRERY_INLINE typename B::value_type least(const Twin<B>& a) {
    return least(min(a.low, a.high));
}

// --- memory -------------------------------------------------------------------------------------------------------

template <class T, class Element, class U>
ORRERY_INLINE T gather(const Element* table, const Twin<U>& index) {
    return {gather<typename T::Half>(table, index.low), gather<typename T::Half>(table, index.high)};
}
template <class T, class Element, class U>
ORRERY_INLINE T lookup(const Element* table, const Twin<U>& index, std::uint32_t size) {
    return {lookup<typename T::Half>(table, index.low, size), lookup<typename T::Half>(table, index.high, size)};
}
template <class V, class B>
ORRERY_INLINE void compress_store(typename B::value_type* to, const Twin<B>& value, std::uint32_t chosen) {
    const std::uint32_t low = chosen & ((1u << B::size) - 1);
    compress_store<typename V::Half>(to, value.low, low);
    compress_store<typename V::Half>(to + std::popcount(low), value.high, chosen >> B::size);
}

}  // namespace orrery::kernels
