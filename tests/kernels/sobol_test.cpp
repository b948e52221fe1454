// Sobol's sequences: the points the papers define, on every instruction set, evenly spread and yet random.
#include <cmath>

#include "fit.hpp"
#include "kernel_test.hpp"
#include "kernels/queues.hpp"
#include "numbers.hpp"
#include "owned.hpp"
#include "probe/lane_probe.hpp"
#include "sobol_reference.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::Dimension;
using kernels::RandomKey;

template <class Real>
using Blocks = std::array<std::vector<Real>, 4>;

/// Blocks of `count` items, of which `counter` gives pixel, sample and vertex.
template <class Real, class Counter>
Blocks<Real> draw(Isa isa, const RandomKey& key, std::uint32_t count, Counter counter) {
    const std::uint32_t padded = kernels::round_up(count);
    std::vector<kernels::WordOf<Real>> pixel(padded), sample(padded), vertex(padded);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::array<std::uint32_t, 3> at = counter(i);
        pixel[i] = at[0], sample[i] = reversed_reference(at[1]), vertex[i] = at[2];
    }
    Blocks<Real> out;
    Real* to[4];
    for (std::size_t c = 0; c < 4; ++c) out[c].resize(padded), to[c] = out[c].data();
    lane_probe<Real>(isa).sobol_block(key, pixel.data(), sample.data(), vertex.data(), to, count);
    return out;
}

// Sobol's first points, as any table has them.
TEST(SobolReference, BeginsAsTheSequenceDoes) {
    const double known[8][2] = {{0, 0},         {0.5, 0.5},     {0.25, 0.75},   {0.75, 0.25},
                                {0.125, 0.625}, {0.625, 0.125}, {0.375, 0.375}, {0.875, 0.875}};
    for (std::uint32_t i = 0; i < 8; ++i) {
        const auto point = sobol_reference(i);
        EXPECT_EQ(point[0] * 0x1p-32, known[i][0]) << i;
        EXPECT_EQ(point[1] * 0x1p-32, known[i][1]) << i;
    }
}

class SobolTest : public KernelTest {};

TEST_P(SobolTest, BlocksEqualTheReferenceToTheBit) {
    const auto counter = [](std::uint32_t i) {
        return std::array<std::uint32_t, 3>{i * 977, i % 3 == 0 ? 0xFFFFFFFFu - i : i * i, i / 9};
    };
    constexpr std::uint32_t n = 1024;
    for (const auto& [key, block] :
         {std::pair{RandomKey{7, Dimension::camera, 0}, 0u}, {RandomKey{0xFFFFFFFFu, Dimension::light, 7}, 10u}}) {
        const auto floats = draw<float>(GetParam(), key, n, counter);
        const auto doubles = draw<double>(GetParam(), key, n, counter);
        for (std::uint32_t i = 0; i < n; ++i) {
            const auto at = counter(i);
            const auto words = sobol_block_reference(key.seed, block, at[0], at[1], at[2]);
            for (std::size_t c = 0; c < 4; ++c) {
                ASSERT_EQ(double{floats[c][i]}, (words[c] / 256) * 0x1p-24) << "item " << i << ", word " << c;
                ASSERT_EQ(doubles[c][i], words[c] * 0x1p-32) << "item " << i << ", word " << c;
            }
        }
    }
}

using Points = Owned<kernels::SobolQueue<float>>;

/// Item i of a block's first words, as the stages draw them.
void expect_drawn(const Points& points, std::uint32_t i, const std::array<std::uint32_t, 4>& words, int dimensions) {
    const float* const columns[4] = {points->x, points->y, points->z, points->w};
    for (std::size_t c = 0; c < static_cast<std::size_t>(dimensions); ++c)
        ASSERT_EQ(double{columns[c][i]}, (words[c] / 256) * 0x1p-24) << "ray " << i << ", word " << c;
}

TEST_P(SobolTest, CameraRaysTakeTheirSlotsPoints) {
    constexpr std::uint32_t count = 75, capacity = 96;
    Rays rays(capacity);
    Slots slots(capacity);
    Points points(capacity);
    kernels::SlotTable<float> table = *slots;
    table.sobol = *points;
    for (std::uint32_t i = 0; i < count; ++i) slots->pixel[i] = i / 6, slots->sample[i] = i % 6;
    for (std::uint32_t i = 0; i < count; ++i) slots->plane_x[i] = slots->plane_y[i] = 0;
    kernels::CameraTable<float> camera{};
    camera.xx = camera.yy = camera.zz = 1, camera.cell_width = camera.cell_height = 1, camera.focal_distance = 1;
    stages.generate_lens(camera, table, count, 9, *rays);
    for (std::uint32_t i = 0; i < count; ++i) {
        expect_drawn(points, i, sobol_block_reference(9, 0, i / 6, i % 6, 0), 4);
        ASSERT_EQ(rays->sample[i], reversed_reference(i % 6));
    }
    // A camera at the centre that looks along z: the ray passes the plane at distance 1 at its first two numbers.
    stages.generate_pinhole(camera, table, count, 9, *rays);
    for (std::uint32_t i = 0; i < count; ++i) {
        EXPECT_NEAR(rays->dx[i] / rays->dz[i], points->x[i], 1e-6);
        EXPECT_NEAR(rays->dy[i] / rays->dz[i], points->y[i], 1e-6);
    }
}

TEST_P(SobolTest, RaysOfARunTakeThePointsOfTheirVertex) {
    constexpr std::uint32_t begin = 32, count = 75, capacity = 160, bounce = 3;
    for (const bool whitted : {false, true}) {
        Rays rays = whitted ? Rays(capacity, Rays::InTrees{}, {"roulette_scale"}) : Rays(capacity, {"roulette_scale"});
        Slots slots(capacity);
        Points points(capacity);
        kernels::SlotTable<float> table = *slots;
        table.sobol = *points;
        std::vector<std::uint32_t> slot_of(capacity);
        for (std::uint32_t i = begin; i < begin + count; ++i) {
            put3(rays->tr, rays->tg, rays->tb, i, glm::dvec3(0.5));
            rays->slot[i] = slot_of[i] = 2 * count - i;
            rays->pixel[i] = i / 6, rays->sample[i] = reversed_reference(i % 6);
            if (whitted) rays->vertex[i] = i + 1;
        }
        kernels::Runs runs;
        runs.run[0] = {begin, count};
        const std::uint32_t survivors = stages.roulette(table, 9, bounce, true, runs, *rays);
        std::uint32_t expected = 0;
        for (std::uint32_t i = begin; i < begin + count; ++i) {
            const auto words = sobol_block_reference(9, 2, i / 6, i % 6, whitted ? i + 1 : bounce);
            expect_drawn(points, i, words, 1);
            if (words[0] >= 0x80000000u) continue;
            EXPECT_EQ(rays->slot[expected++], slot_of[i]);
        }
        EXPECT_EQ(survivors, expected);
    }
}

INSTANTIATE_TEST_SUITE_P(Isas, SobolTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

class SobolQuality : public KernelTest {};

// Of 2^k consecutive points of a sequence that begin at a multiple of 2^k, every box of area 2^-k with sides of powers
// of two holds exactly one: what (0, 2)-sequence means.
TEST_P(SobolQuality, EveryElementaryBoxHoldsOnePoint) {
    for (std::uint32_t trial = 0; trial < 40; ++trial) {
        for (std::uint32_t k = 0; k <= 10; ++k) {
            const std::uint32_t n = 1u << k;
            const auto u = draw<float>(GetParam(), {trial, Dimension::scattering, 0}, n, [&](std::uint32_t i) {
                return std::array<std::uint32_t, 3>{trial * 31, 2 * (i + n * (trial % 3)) + trial % 2, trial % 5};
            });
            for (std::size_t pair = 0; pair < 4; pair += 2) {
                for (std::uint32_t columns = 1; columns <= n; columns *= 2) {
                    std::vector<int> held(n);
                    const std::uint32_t rows = n / columns;
                    for (std::uint32_t i = 0; i < n; ++i) {
                        const auto x = static_cast<std::uint32_t>(u[pair][i] * static_cast<float>(columns));
                        const auto y = static_cast<std::uint32_t>(u[pair + 1][i] * static_cast<float>(rows));
                        ++held[y * columns + x];
                    }
                    ASSERT_EQ(held, std::vector<int>(n, 1)) << n << " points, " << columns << " columns";
                }
            }
        }
    }
}

// Over pixels each sample is a uniform point, and nothing ties it to those it must be independent of: the other pair of
// its block, the other sequence, the next vertex, the next dimension.
TEST_P(SobolQuality, OverPixelsPointsAreUniformAndUnrelated) {
    constexpr std::uint32_t n = 1 << 17;
    const auto image = [&](std::uint32_t sample, std::uint32_t vertex, Dimension dimension) {
        return draw<float>(GetParam(), {3, dimension, 0}, n, [&](std::uint32_t i) {
            return std::array<std::uint32_t, 3>{i, sample, vertex};
        });
    };
    for (const std::uint32_t sample : {0u, 1u, 6u, 1001u}) {
        const auto here = image(sample, 2, Dimension::scattering);
        const auto fits = [&](const Blocks<float>& there, std::size_t a, std::size_t b, const char* what) {
            Histogram square(32, 32);
            for (std::uint32_t i = 0; i < n; ++i) square.add(here[a][i], there[b][i]);
            square.expect_uniform(std::string(what) + ", words " + std::to_string(a) + " and " + std::to_string(b));
        };
        for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t b = a + 1; b < 4; ++b) fits(here, a, b, "one block");
        const std::pair<const char*, Blocks<float>> others[] = {
            {"other sequence", image(sample ^ 1u, 2, Dimension::scattering)},
            {"next vertex", image(sample, 3, Dimension::scattering)},
            {"next dimension", image(sample, 2, Dimension::roulette)}};
        for (const auto& [name, there] : others)
            for (std::size_t a = 0; a < 4; ++a)
                for (std::size_t b = 0; b < 4; ++b) fits(there, a, b, name);
    }
}

// Where in its cell a point lies is as random as the cell: of the camera's points one by one, of others sequence by
// sequence.
TEST_P(SobolQuality, PointsAreScatteredWithinTheirCells) {
    constexpr std::uint32_t n = 1 << 17;
    for (const auto& [dimension, stride] : {std::pair{Dimension::camera, 2u}, {Dimension::scattering, 1u}}) {
        const auto u = draw<float>(GetParam(), {4, dimension, 0}, n, [s = stride](std::uint32_t i) {
            return std::array<std::uint32_t, 3>{i / 16, s * (i % 16), 0};
        });
        Histogram within(32, 32), two(32, 32);
        const auto part = [&](std::size_t word, std::uint32_t i) { return std::fmod(u[word][i] * 16, 1.0f); };
        const std::uint32_t step = dimension == Dimension::camera ? 1 : 16;
        for (std::uint32_t i = 0; i < n; i += step) within.add(part(0, i), part(1, i));
        for (std::uint32_t i = 0; i + 1 < n; i += 2 * step) two.add(part(0, i), part(0, i + 1));
        within.expect_uniform("both coordinates within the cell of sixteenths");
        two.expect_uniform("two points of a pixel within their cells");
    }
}

INSTANTIATE_TEST_SUITE_P(Best, SobolQuality, ::testing::Values(best_isa()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
