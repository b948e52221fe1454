// Compression: every mask, what it writes and what it must leave alone.
#include <algorithm>
#include <bit>

#include "kernel_test.hpp"
#include "probe/lane_probe.hpp"

namespace orrery::kernel_tests {
namespace {

class CompressTest : public KernelTest {
protected:
    const LaneProbe<float>& probe = lane_probe<float>(GetParam());
    const LaneProbe<double>& doubles = lane_probe<double>(GetParam());
};

template <class T, class Compress>
void expect_every_mask_compresses(std::uint32_t lanes, Compress&& compress) {
    constexpr std::size_t before = 16;
    const T untouched = 1000;
    for (std::uint32_t mask = 0; mask < 1u << lanes; ++mask) {
        T from[16], to[64];
        for (std::uint32_t lane = 0; lane < 16; ++lane) from[lane] = static_cast<T>(lane + 1);
        std::fill(std::begin(to), std::end(to), untouched);
        compress(from, mask, to + before);
        std::size_t at = before;
        for (std::uint32_t lane = 0; lane < lanes; ++lane)
            if ((mask >> lane & 1u) != 0) {
                ASSERT_EQ(to[at], static_cast<T>(lane + 1)) << "mask " << mask;
                ++at;
            }
        ASSERT_EQ(at - before, static_cast<std::size_t>(std::popcount(mask)));
        // Behind the last chosen lane anything may stand, up to a vector from the start; elsewhere nothing changes.
        for (std::size_t i = 0; i < before; ++i) ASSERT_EQ(to[i], untouched) << "mask " << mask;
        for (std::size_t i = before + lanes; i < 64; ++i) ASSERT_EQ(to[i], untouched) << "mask " << mask;
    }
}

TEST_P(CompressTest, NumbersUnderEveryMask) {
    expect_every_mask_compresses<float>(probe.lanes, probe.compress_numbers);
    expect_every_mask_compresses<double>(doubles.lanes, doubles.compress_numbers);
}
TEST_P(CompressTest, WordsUnderEveryMask) {
    expect_every_mask_compresses<std::uint32_t>(probe.lanes, probe.compress_words);
    expect_every_mask_compresses<std::uint64_t>(doubles.lanes, doubles.compress_words);
}

INSTANTIATE_TEST_SUITE_P(Isas, CompressTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
