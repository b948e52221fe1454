// The forced instruction set is the one that runs.
#include <set>

#include "kernel_test.hpp"
#include "owned.hpp"
#include "world.hpp"

namespace orrery::kernel_tests {
namespace {

std::uint32_t lanes_of(Isa isa) {
    constexpr std::uint32_t lanes[] = {1, 4, 8, 16};
    return lanes[static_cast<std::size_t>(isa)];
}

/// The addresses in a table, in order.
template <class Real>
std::vector<const void*> stages_in(const kernels::Stages<Real>& s) {
    std::vector<const void*> all;
    const auto add = [&](auto pointer) { all.push_back(reinterpret_cast<const void*>(pointer)); };
    add(s.generate_pinhole), add(s.generate_lens), add(s.intersect), add(s.intersect_coherent), add(s.intersect_tree),
        add(s.emission), add(s.sort_by_scattering);
    for (const auto scatter : s.scatter) add(scatter);
    for (const auto connect : s.connect) add(connect);
    add(s.shadow), add(s.shadow_coherent), add(s.shadow_tree), add(s.roulette), add(s.expire), add(s.branch),
        add(s.resume);
    add(s.intersects), add(s.is_occluded);
    return all;
}

class DispatchTest : public KernelTest {};

TEST_P(DispatchTest, TableSaysWhatWasAskedFor) {
    EXPECT_EQ(stages.isa, GetParam());
    EXPECT_EQ(stages.lanes, lanes_of(GetParam()));
    const auto& in_double = kernels::stages_for<double>(GetParam());
    EXPECT_EQ(in_double.isa, GetParam());
    EXPECT_EQ(in_double.lanes, std::max(1u, lanes_of(GetParam()) / 2));
}

TEST_P(DispatchTest, EveryStageIsThereAndIsNoOtherInstructionSets) {
    std::set<const void*> others;
    for (const Isa other : supported_isas())
        if (other != GetParam())
            for (const void* stage : stages_in(kernels::stages_for(other))) others.insert(stage);
    for (const Isa any : supported_isas())
        for (const void* stage : stages_in(kernels::stages_for<double>(any))) EXPECT_TRUE(others.insert(stage).second);
    for (const void* stage : stages_in(stages)) {
        EXPECT_NE(stage, nullptr);
        EXPECT_FALSE(others.contains(stage));
    }
}

// A table can say anything. What runs shows in memory: a kernel stores whole vectors, so for one segment this one
// overwrites as many entries as it has lanes.
TEST_P(DispatchTest, OneSegmentOverwritesOneVector) {
    const World world({{glm::dvec3(0, 0, 5), 1}});
    Rays rays(kernels::widest);
    for (std::uint32_t i = 0; i < kernels::widest; ++i) {
        rays->ox[i] = rays->oy[i] = rays->oz[i] = rays->dx[i] = rays->dy[i] = rays->tr[i] = 0;
        rays->dz[i] = 1;
        rays->tg[i] = 9;
    }
    Hits hits(kernels::widest);
    const kernels::SegmentColumns<float> segments{rays->ox, rays->oy, rays->oz, rays->dx,
                                                  rays->dy, rays->dz, rays->tr, rays->tg};
    stages.is_occluded(world.spheres, segments, 1, hits->id);
    EXPECT_EQ(hits->id[0], 1u);
    std::uint32_t written = 0;
    while (written < kernels::widest && hits->id[written] != canary) ++written;
    EXPECT_EQ(written, lanes_of(GetParam()));
    for (std::uint32_t i = written; i < kernels::widest; ++i) EXPECT_EQ(hits->id[i], canary);
}

INSTANTIATE_TEST_SUITE_P(Isas, DispatchTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

TEST(Isa, NamesAndBack) {
    const std::set<std::string_view> names{"scalar", "sse2", "avx2", "avx512"};
    for (const Isa isa : all_isas) {
        EXPECT_TRUE(names.contains(isa_name(isa)));
        EXPECT_EQ(isa_from_name(isa_name(isa)), isa);
    }
    for (const std::string_view wrong : {"", "AVX2", "avx", "avx-512", "auto", "neon", "sse2 "})
        EXPECT_EQ(isa_from_name(wrong), std::nullopt) << wrong;
}

TEST(Isa, TheBestIsTheLastSupportedOne) {
    EXPECT_TRUE(isa_supported(Isa::scalar));
    EXPECT_EQ(best_isa(), supported_isas().back());
#if defined(__x86_64__)
    EXPECT_TRUE(isa_supported(Isa::sse2)) << "every x86-64 has it";
#endif
}

}  // namespace
}  // namespace orrery::kernel_tests
