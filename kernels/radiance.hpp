// Radiance to the slots it belongs to: three columns of lanes added to rows in memory.
#pragma once

#include "kernels/lanes/twin.hpp"
#include "kernels/queues.hpp"
#include "kernels/vec3.hpp"

namespace orrery::kernels {

namespace detail {

/// (x, y, z, 0) of every lane: that of lane 4 i + j goes to out[j * V::count + 4 i].
template <class V>
ORRERY_INLINE void save_rows(float* out, const Vec3Of<V>& v) {
#if defined(__AVX512F__)
    if constexpr (V::count == 16) {
        const __m512 zero = _mm512_setzero_ps();
        const __m512d xy_low = _mm512_castps_pd(_mm512_unpacklo_ps(v.x, v.y));
        const __m512d xy_high = _mm512_castps_pd(_mm512_unpackhi_ps(v.x, v.y));
        const __m512d z_low = _mm512_castps_pd(_mm512_unpacklo_ps(v.z, zero));
        const __m512d z_high = _mm512_castps_pd(_mm512_unpackhi_ps(v.z, zero));
        _mm512_store_ps(out, _mm512_castpd_ps(_mm512_unpacklo_pd(xy_low, z_low)));
        _mm512_store_ps(out + 16, _mm512_castpd_ps(_mm512_unpackhi_pd(xy_low, z_low)));
        _mm512_store_ps(out + 32, _mm512_castpd_ps(_mm512_unpacklo_pd(xy_high, z_high)));
        _mm512_store_ps(out + 48, _mm512_castpd_ps(_mm512_unpackhi_pd(xy_high, z_high)));
        return;
    }
#endif
#if defined(__AVX2__)
    if constexpr (V::count == 8) {
        const __m256 zero = _mm256_setzero_ps();
        const __m256d xy_low = _mm256_castps_pd(_mm256_unpacklo_ps(v.x, v.y));
        const __m256d xy_high = _mm256_castps_pd(_mm256_unpackhi_ps(v.x, v.y));
        const __m256d z_low = _mm256_castps_pd(_mm256_unpacklo_ps(v.z, zero));
        const __m256d z_high = _mm256_castps_pd(_mm256_unpackhi_ps(v.z, zero));
        _mm256_store_ps(out, _mm256_castpd_ps(_mm256_unpacklo_pd(xy_low, z_low)));
        _mm256_store_ps(out + 8, _mm256_castpd_ps(_mm256_unpackhi_pd(xy_low, z_low)));
        _mm256_store_ps(out + 16, _mm256_castpd_ps(_mm256_unpacklo_pd(xy_high, z_high)));
        _mm256_store_ps(out + 24, _mm256_castpd_ps(_mm256_unpackhi_pd(xy_high, z_high)));
        return;
    }
#endif
#if defined(__SSE2__)
    if constexpr (V::count == 4) {
        __m128 row[4] = {v.x, v.y, v.z, _mm_setzero_ps()};
        _MM_TRANSPOSE4_PS(row[0], row[1], row[2], row[3]);
        for (int j = 0; j < 4; ++j) _mm_store_ps(out + 4 * j, row[j]);
    }
#endif
}

}  // namespace detail

/// rows[4 row .. 4 row + 2] += value, for every lane in lane order. A lane that has nothing to add brings zeros and any
/// valid row. (Gathering, adding and scattering a column at a time takes the processor longer than these single rows,
/// and needs the rows of a vector to differ.)
template <class V>
ORRERY_INLINE void add_to_rows(RealOf<V>* rows, const Words<V>& row, const Vec3Of<V>& value) {
    if constexpr (V::count == 1) {
        rows[4 * row] += value.x;
        rows[4 * row + 1] += value.y;
        rows[4 * row + 2] += value.z;
    } else if constexpr (requires { typename V::Half; }) {
        using Half = typename V::Half;
        using Rgb = Vec3<typename Half::F>;
        add_to_rows<Half>(rows, row.low, Rgb{value.x.low, value.y.low, value.z.low});
        add_to_rows<Half>(rows, row.high, Rgb{value.x.high, value.y.high, value.z.high});
    } else if constexpr (sizeof(RealOf<V>) == 8) {
        alignas(64) std::uint64_t at[V::count];
        alignas(64) double x[V::count], y[V::count], z[V::count];
        row.store_aligned(at);
        value.x.store_aligned(x), value.y.store_aligned(y), value.z.store_aligned(z);
        for (std::uint32_t lane = 0; lane < V::count; ++lane) {
            double* const sum = rows + std::size_t{4} * at[lane];
            sum[0] += x[lane], sum[1] += y[lane], sum[2] += z[lane];
        }
    } else {
        alignas(64) std::uint32_t at[V::count];
        alignas(64) float terms[4 * V::count];
        row.store_aligned(at);
        detail::save_rows<V>(terms, value);
        using Row = xsimd::batch<RealOf<V>, xsimd::sse2>;
        for (std::uint32_t lane = 0; lane < V::count; ++lane) {
            float* const sum = rows + std::size_t{4} * at[lane];
            const float* const term = terms + lane % 4 * V::count + lane / 4 * 4;
            (Row::load_aligned(sum) + Row::load_aligned(term)).store_aligned(sum);
        }
    }
}

/// Adds the chosen lanes to their slots.
template <class V>
ORRERY_INLINE void add_radiance(const Slots<V>& slots, const Words<V>& slot, const Vec3Of<V>& radiance,
                                const Mask<V>& chosen) {
    using F = Floats<V>;
    using U = Words<V>;
    const Vec3<F> none{F(0), F(0), F(0)};
    add_to_rows<V>(slots.radiance, choose(chosen, slot, U(0u)), choose(chosen, radiance, none));
}

}  // namespace orrery::kernels
