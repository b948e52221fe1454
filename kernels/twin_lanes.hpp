// Two vectors as one: lanes twice as wide as the machine's registers.
//
// A stage such as `scatter` is one long chain of dependent operations, about as long as what the processor keeps in
// flight: the next vector of rays starts when the last one is nearly done, and the arithmetic units wait. With two
// vectors side by side every operation comes twice, independently. Nothing else changes, not a bit of the results.
#pragma once

#include "kernels/compress.hpp"
#include "kernels/reversed_bits.hpp"

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

// --- operators ----------------------------------------------------------------------------------------------------

template <class B>
ORRERY_INLINE Twin<B> operator+(const Twin<B>& a, const Twin<B>& b) {
    return {a.low + b.low, a.high + b.high};
}
template <class B>
ORRERY_INLINE Twin<B> operator-(const Twin<B>& a, const Twin<B>& b) {
    return {a.low - b.low, a.high - b.high};
}
template <class B>
ORRERY_INLINE Twin<B> operator*(const Twin<B>& a, const Twin<B>& b) {
    return {a.low * b.low, a.high * b.high};
}
template <class B>
ORRERY_INLINE Twin<B> operator/(const Twin<B>& a, const Twin<B>& b) {
    return {a.low / b.low, a.high / b.high};
}
template <class B>
ORRERY_INLINE Twin<B> operator&(const Twin<B>& a, const Twin<B>& b) {
    return {a.low & b.low, a.high & b.high};
}
template <class B>
ORRERY_INLINE Twin<B> operator|(const Twin<B>& a, const Twin<B>& b) {
    return {a.low | b.low, a.high | b.high};
}
template <class B>
ORRERY_INLINE Twin<B> operator^(const Twin<B>& a, const Twin<B>& b) {
    return {a.low ^ b.low, a.high ^ b.high};
}
template <class B>
ORRERY_INLINE Twin<B> operator>>(const Twin<B>& a, int places) {
    return {a.low >> places, a.high >> places};
}
template <class B>
ORRERY_INLINE Twin<B> operator<<(const Twin<B>& a, int places) {
    return {a.low << places, a.high << places};
}
template <class B>
ORRERY_INLINE auto operator<(const Twin<B>& a, const Twin<B>& b) {
    return Twin<decltype(a.low < b.low)>{a.low < b.low, a.high < b.high};
}
template <class B>
ORRERY_INLINE auto operator<=(const Twin<B>& a, const Twin<B>& b) {
    return Twin<decltype(a.low <= b.low)>{a.low <= b.low, a.high <= b.high};
}
template <class B>
ORRERY_INLINE auto operator>(const Twin<B>& a, const Twin<B>& b) {
    return b < a;
}
template <class B>
ORRERY_INLINE auto operator>=(const Twin<B>& a, const Twin<B>& b) {
    return b <= a;
}
template <class B>
ORRERY_INLINE auto operator==(const Twin<B>& a, const Twin<B>& b) {
    return Twin<decltype(a.low == b.low)>{a.low == b.low, a.high == b.high};
}

// --- masks --------------------------------------------------------------------------------------------------------

template <class M>
ORRERY_INLINE Twin<M> operator&&(const Twin<M>& a, const Twin<M>& b) {
    return {a.low && b.low, a.high && b.high};
}
template <class M>
ORRERY_INLINE Twin<M> operator||(const Twin<M>& a, const Twin<M>& b) {
    return {a.low || b.low, a.high || b.high};
}
template <class M>
ORRERY_INLINE Twin<M> operator!(const Twin<M>& a) {
    return {!a.low, !a.high};
}
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
template <class U>
ORRERY_INLINE auto words_equal(const Twin<U>& a, const Twin<U>& b) {
    return Twin<decltype(words_equal(a.low, b.low))>{words_equal(a.low, b.low), words_equal(a.high, b.high)};
}
template <class M, class B>
ORRERY_INLINE Twin<B> choose(const Twin<M>& m, const Twin<B>& a, const Twin<B>& b) {
    return {choose(m.low, a.low, b.low), choose(m.high, a.high, b.high)};
}

// --- arithmetic ---------------------------------------------------------------------------------------------------

template <class B>
ORRERY_INLINE Twin<B> mul_add(const Twin<B>& a, const Twin<B>& b, const Twin<B>& c) {
    return {mul_add(a.low, b.low, c.low), mul_add(a.high, b.high, c.high)};
}
template <class B>
ORRERY_INLINE Twin<B> mul_sub(const Twin<B>& a, const Twin<B>& b, const Twin<B>& c) {
    return {mul_sub(a.low, b.low, c.low), mul_sub(a.high, b.high, c.high)};
}
template <class B>
ORRERY_INLINE Twin<B> neg_mul_add(const Twin<B>& a, const Twin<B>& b, const Twin<B>& c) {
    return {neg_mul_add(a.low, b.low, c.low), neg_mul_add(a.high, b.high, c.high)};
}
template <class B>
ORRERY_INLINE Twin<B> root(const Twin<B>& a) {
    return {root(a.low), root(a.high)};
}
template <class B>
ORRERY_INLINE Twin<B> min(const Twin<B>& a, const Twin<B>& b) {
    return {min(a.low, b.low), min(a.high, b.high)};
}
template <class B>
ORRERY_INLINE Twin<B> max(const Twin<B>& a, const Twin<B>& b) {
    return {max(a.low, b.low), max(a.high, b.high)};
}
template <class B>
ORRERY_INLINE typename B::value_type least(const Twin<B>& a) {
    return least(min(a.low, a.high));
}
template <class B>
ORRERY_INLINE Twin<B> magnitude(const Twin<B>& a) {
    return {magnitude(a.low), magnitude(a.high)};
}
template <class U>
ORRERY_INLINE Twin<U> multiply_words(const Twin<U>& a, const Twin<U>& b) {
    return {multiply_words(a.low, b.low), multiply_words(a.high, b.high)};
}
template <class U>
ORRERY_INLINE Twin<U> reversed_bits(const Twin<U>& a) {
    return {reversed_bits(a.low), reversed_bits(a.high)};
}
template <class U>
ORRERY_INLINE auto unit_interval(const Twin<U>& a) {
    return Twin<decltype(unit_interval(a.low))>{unit_interval(a.low), unit_interval(a.high)};
}
template <class B>
ORRERY_INLINE auto truncate_to_word(const Twin<B>& a) {
    return Twin<decltype(truncate_to_word(a.low))>{truncate_to_word(a.low), truncate_to_word(a.high)};
}
template <class U>
ORRERY_INLINE auto to_number(const Twin<U>& a) {
    return Twin<decltype(to_number(a.low))>{to_number(a.low), to_number(a.high)};
}
template <class B, class U>
ORRERY_INLINE Twin<B> flip_sign(const Twin<B>& a, const Twin<U>& sign) {
    return {flip_sign(a.low, sign.low), flip_sign(a.high, sign.high)};
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
