// Stage `generate`: the camera's rays against the camera's formulas in double, and where in pixel and lens they start.
#include "fit.hpp"
#include "kernel_test.hpp"
#include "numbers.hpp"
#include "owned.hpp"
#include "random_reference.hpp"

namespace orrery::kernel_tests {
namespace {

/// A frame that is not the axes, with a pixel that is not square.
struct View {
    glm::dvec3 position{1, -2, 3};
    glm::dvec3 z = glm::normalize(glm::dvec3(2, -1, 4));
    glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), z));
    glm::dvec3 y = glm::cross(z, x);
    double cell_width = 0.03, cell_height = -0.02;
    double lens_radius = 0, focal_distance = 1;

    kernels::CameraTable<float> table() const {
        kernels::CameraTable<float> t{};
        put3(&t.px, &t.py, &t.pz, 0, position);
        put3(&t.xx, &t.xy, &t.xz, 0, x);
        put3(&t.yx, &t.yy, &t.yz, 0, y);
        put3(&t.zx, &t.zy, &t.zz, 0, z);
        t.cell_width = narrow(cell_width), t.cell_height = narrow(cell_height);
        t.lens_radius = narrow(lens_radius), t.focal_distance = narrow(focal_distance);
        return t;
    }
};

constexpr std::uint32_t seed = 77;

class GenerateTest : public KernelTest {
protected:
    void run(const View& view, const Slots& slots, std::uint32_t count, const Rays& rays) const {
        const auto stage = view.lens_radius > 0 ? stages.generate_lens : stages.generate_pinhole;
        stage(view.table(), *slots, count, seed, *rays);
    }
    static Slots slots_of(std::uint32_t count) {
        Slots slots(kernels::round_up(count) + kernels::widest);
        Numbers random(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            slots->pixel[i] = random.below(1u << 20), slots->sample[i] = i % 9;
            slots->plane_x[i] = narrow(random.between(-1, 1)), slots->plane_y[i] = narrow(random.between(-1, 1));
        }
        return slots;
    }
    void expect_agrees(const View& view, std::uint32_t count, const std::vector<std::string_view>& absent = {}) {
        const Slots slots = slots_of(count);
        Slots out = slots;
        Rays rays(kernels::round_up(count) + kernels::widest, absent);
        const Rays before = rays;
        run(view, out, count, rays);
        const std::ptrdiff_t end = kernels::round_up(count);
        EXPECT_TRUE(rays.untouched_but(before, 0, end));
        EXPECT_TRUE(out.untouched_but(slots, 0, end));
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto u = random_reference(seed, 0, slots->pixel[i], slots->sample[i], 0);
            const double px = slots->plane_x[i] + u[0] * view.cell_width;
            const double py = slots->plane_y[i] + u[1] * view.cell_height;
            const glm::dvec3 through = px * view.x + py * view.y + view.z;
            const glm::dvec3 o = origin_of(*rays, i), d = direction_of(*rays, i);
            if (view.lens_radius == 0) {
                ASSERT_EQ(o, glm::dvec3(glm::vec3(view.position)));
                ASSERT_LT(glm::length(d - glm::normalize(through)), 4e-7);
            } else {
                const glm::dvec3 lens = o - view.position;
                ASSERT_LT(std::abs(glm::dot(lens, view.z)), 1e-6) << "the lens is flat";
                ASSERT_LE(glm::length(lens), view.lens_radius * (1 + 1e-5));
                // Wherever it starts, the ray passes the point in focus.
                const glm::dvec3 focus = view.position + view.focal_distance * through;
                ASSERT_LT(glm::length(d - glm::normalize(focus - o)), 2e-6);
            }
            ASSERT_NEAR(glm::length(d), 1, 3e-7);
            ASSERT_EQ(throughput_of(*rays, i), glm::dvec3(1));
            ASSERT_TRUE(rays->pdf == nullptr || rays->pdf[i] == std::numeric_limits<float>::infinity());
            ASSERT_TRUE(rays->roulette_scale == nullptr || rays->roulette_scale[i] == 1.0f);
            ASSERT_EQ(rays->departed[i], kernels::no_sphere);
            ASSERT_EQ(rays->slot[i], i);
            ASSERT_EQ(rays->pixel[i], slots->pixel[i]);
            ASSERT_EQ(rays->sample[i], slots->sample[i]);
            for (std::uint32_t c = 0; c < 4; ++c) ASSERT_EQ(out->radiance[4 * i + c], 0.0f);
        }
        if (!exact()) return;
        Slots same_slots = slots;
        Rays same = before;
        (view.lens_radius > 0 ? scalar.generate_lens : scalar.generate_pinhole)(view.table(), *same_slots, count, seed,
                                                                                *same);
        EXPECT_TRUE(rays.same_as(same, 0, count));
    }
};

TEST_P(GenerateTest, PinholeRaysFollowTheFormula) {
    for (const std::uint32_t count : awkward_counts) expect_agrees({}, count);
    expect_agrees({}, 17, {"pdf", "roulette_scale"});
}

TEST_P(GenerateTest, LensRaysMeetInFocus) {
    View view;
    view.lens_radius = 0.25, view.focal_distance = 5;
    for (const std::uint32_t count : awkward_counts) expect_agrees(view, count);
    expect_agrees(view, 17, {"pdf", "roulette_scale"});
}

class GenerateSampling : public GenerateTest {};

// The slots of a pixel as the wavefront's fill() writes them: e x e cells, one sample each, row by row from the top.
TEST_P(GenerateSampling, StratifiedPositionsFillTheirCells) {
    constexpr std::uint32_t strata = 4, width = 64, height = 48;
    View view;
    view.position = {}, view.x = {1, 0, 0}, view.y = {0, 1, 0}, view.z = {0, 0, 1};
    const double half_width = 0.8, half_height = 0.6;
    view.cell_width = 2 * half_width / width / strata, view.cell_height = -2 * half_height / height / strata;
    const std::uint32_t count = width * height * strata * strata;
    Slots slots(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t pixel = i / (strata * strata), sample = i % (strata * strata);
        slots->pixel[i] = pixel, slots->sample[i] = sample;
        slots->plane_x[i] =
            narrow((2.0 * (pixel % width) / width - 1) * half_width + sample % strata * view.cell_width);
        slots->plane_y[i] =
            narrow((1 - 2.0 * (pixel / width) / height) * half_height + sample / strata * view.cell_height);
    }
    Rays rays(count);
    run(view, slots, count, rays);
    Histogram within_cell(16, 16);
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 d = direction_of(*rays, i);
        const double x = (d.x / d.z + half_width) / (2 * half_width) * width;     // in pixels from the left
        const double y = (half_height - d.y / d.z) / (2 * half_height) * height;  // and from the top
        const std::uint32_t pixel = i / (strata * strata), sample = i % (strata * strata);
        const double cell_x = (x - pixel % width) * strata - sample % strata;
        const double cell_y = (y - pixel / width) * strata - sample / strata;
        ASSERT_NEAR(cell_x, 0.5, 0.5 + 1e-3);
        ASSERT_NEAR(cell_y, 0.5, 0.5 + 1e-3);
        within_cell.add(std::clamp(cell_x, 0.0, 1.0), std::clamp(cell_y, 0.0, 1.0));
    }
    within_cell.expect_uniform("position within the stratum");
}

// Uniform on the disk: the square of the radius and the azimuth are.
TEST_P(GenerateSampling, LensPointsAreUniformOnTheDisk) {
    constexpr std::uint32_t count = 1u << 19;
    View view;
    view.lens_radius = 0.5, view.focal_distance = 3;
    view.position = {};
    Slots slots(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        slots->pixel[i] = i / 16, slots->sample[i] = i % 16;
        slots->plane_x[i] = slots->plane_y[i] = 0;
    }
    Rays rays(count);
    run(view, slots, count, rays);
    Histogram disk(24, 24), plane_and_lens(24, 24);
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 o = origin_of(*rays, i) / view.lens_radius;
        const double x = glm::dot(o, view.x), y = glm::dot(o, view.y);
        const double azimuth = std::atan2(y, x) / (2 * std::numbers::pi) + 0.5;
        disk.add(x * x + y * y, azimuth);
        plane_and_lens.add(azimuth, random_reference(seed, 0, slots->pixel[i], slots->sample[i], 0)[0]);
    }
    disk.expect_uniform("lens");
    plane_and_lens.expect_uniform("lens azimuth against position in the pixel");
}

INSTANTIATE_TEST_SUITE_P(Isas, GenerateTest, ::testing::ValuesIn(supported_isas()), name_of_isa);
INSTANTIATE_TEST_SUITE_P(Isas, GenerateSampling, ::testing::ValuesIn(differing_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
