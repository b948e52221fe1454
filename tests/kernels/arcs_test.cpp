// Angles and segments from sine and cosine, in every instruction set and both number formats.
#include "kernels/arcs.hpp"

#include <cmath>

#include "kernel_test.hpp"
#include "numbers.hpp"
#include "probe/lane_probe.hpp"

namespace orrery::kernel_tests {
namespace {

template <class Real>
struct Angles {
    static constexpr std::uint32_t count = 1u << 14;
    std::vector<Real> sine = std::vector<Real>(count), cosine = sine;
    std::vector<long double> angle = std::vector<long double>(count);
    Angles() {
        Numbers random(1);
        for (std::uint32_t i = 0; i < count; ++i) {
            // Half of them all over, a quarter near either end, down to 2^-30.
            const double small = std::exp2(-30 * random.uniform());
            const double a = std::numbers::pi * (i % 4 < 2 ? random.uniform() : i % 4 == 2 ? small : 1 - small);
            sine[i] = static_cast<Real>(std::sin(a)), cosine[i] = static_cast<Real>(std::cos(a));
        }
        sine[0] = 0, cosine[0] = 1, sine[1] = 0, cosine[1] = -1, sine[2] = 1, cosine[2] = 0;
        for (std::uint32_t i = 0; i < count; ++i)
            angle[i] = std::atan2(static_cast<long double>(sine[i]), static_cast<long double>(cosine[i]));
    }
};

/// a - sin a cos a without the cancellation near 0.
long double segment_of(long double a) {
    if (a > 0.01L) return a - std::sin(a) * std::cos(a);
    const long double x = 4 * a * a;  // (2a - sin 2a) / 2 as a series
    return a * x / 6 * (1 - x / 20 * (1 - x / 42 * (1 - x / 72)));
}

template <class Real>
void expect_accurate(Isa isa, long double ulp) {
    const Angles<Real> angles;
    const auto& probe = lane_probe<Real>(isa);
    std::vector<Real> segment(angles.count), angle(angles.count);
    probe.segment(angles.sine.data(), angles.cosine.data(), segment.data(), angles.count);
    probe.angle(angles.sine.data(), angles.cosine.data(), angle.data(), angles.count);
    long double worst_segment = 0, worst_angle = 0;
    for (std::uint32_t i = 0; i < angles.count; ++i) {
        const long double a = angles.angle[i];
        // Sine and cosine are rounded each by itself: near a right angle the segment hangs on both.
        const long double scale =
            std::sin(a) < std::sqrt(0.5L) && std::cos(a) > 0 ? 0 : std::numbers::pi_v<long double>;
        const auto error = [&](Real found, long double wanted) {
            const long double unit = std::max(scale, wanted);
            return unit > 0 ? std::abs(found - wanted) / (unit * ulp) : std::abs(found);
        };
        worst_segment = std::max(worst_segment, error(segment[i], segment_of(a)));
        worst_angle = std::max(worst_angle, error(angle[i], a));
    }
    EXPECT_LE(worst_segment, 5);
    EXPECT_LE(worst_angle, 3);
    if (isa == Isa::sse2) return;
    std::vector<Real> same(angles.count);
    lane_probe<Real>(Isa::scalar).segment(angles.sine.data(), angles.cosine.data(), same.data(), angles.count);
    EXPECT_EQ(segment, same);
    lane_probe<Real>(Isa::scalar).angle(angles.sine.data(), angles.cosine.data(), same.data(), angles.count);
    EXPECT_EQ(angle, same);
}

class Arcs : public ::testing::TestWithParam<Isa> {};

TEST_P(Arcs, AnglesAndSegmentsInFloat) { expect_accurate<float>(GetParam(), 0x1p-23L); }
TEST_P(Arcs, AnglesAndSegmentsInDouble) { expect_accurate<double>(GetParam(), 0x1p-52L); }

INSTANTIATE_TEST_SUITE_P(Isas, Arcs, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
