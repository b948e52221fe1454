#include "wavefront/agreement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace orrery::test {
namespace {

bool has_area_lights(const Scene& scene) {
    return std::ranges::any_of(scene.primitives, [](const Primitive& p) { return p.emission.has_value(); });
}

// DEPTH: the mean distance I, of which 1 - I/(1+I) is no unbiased estimate.
void undo_post_process(Image& image) {
    for (Rgb& p : image.pixels) p = {1 / p.r - 1, 1 / p.g - 1, 1 / p.b - 1};
}

}  // namespace

std::vector<Variant> path_variants(const Scene& scene) {
    using enum Transport;
    using enum LightSampling;
    const auto with = [](Transport transport, LightSampling sampling, bool roulette, Estimator estimator) {
        return [=](RenderSettings& s) {
            s.transport = transport;
            s.light_sampling = sampling;
            s.roulette = roulette;
            s.estimator = estimator;
        };
    };
    const auto stratified = Estimator::stratified, uniform = Estimator::uniform;
    std::vector<Variant> variants = {{"mis, cone", with(mis, cone, true, stratified)},
                                     {"no roulette", with(mis, cone, false, stratified)},
                                     {"uniform", with(mis, cone, true, uniform)},
                                     {"sobol", with(mis, cone, true, Estimator::sobol)}};
    if (isa_supported(Isa::sse2)) variants.push_back({"SSE2", with(mis, cone, true, stratified), Isa::sse2});
    if (has_area_lights(scene)) {
        // Without them point lights' are missing.
        if (scene.point_lights.empty())
            variants.push_back({"no caustics", [](RenderSettings& s) { s.caustics = false; }});
        variants.push_back({"mis, area", with(mis, area, true, uniform)});
        variants.push_back({"nee, cone", with(nee, cone, true, stratified)});
        variants.push_back({"nee, area, no roulette", with(nee, area, false, stratified)});
        variants.push_back({"naive", with(naive, cone, true, stratified)});
        variants.push_back({"mis, exact", with(mis, exact, true, stratified)});
        variants.push_back({"nee, exact", with(nee, exact, true, uniform)});
    }
    return variants;
}

std::vector<Variant> other_variants(const Scene& scene) {
    const auto with = [](LightSampling sampling, Estimator estimator) {
        return [=](RenderSettings& s) {
            s.light_sampling = sampling;
            s.estimator = estimator;
        };
    };
    std::vector<Variant> variants = {
        {"cone, stratified", with(LightSampling::cone, Estimator::stratified)},
        {"cone, uniform", with(LightSampling::cone, Estimator::uniform)},
        {"cone, sobol", with(LightSampling::cone, Estimator::sobol)},
    };
    if (isa_supported(Isa::sse2))
        variants.push_back({"SSE2", with(LightSampling::cone, Estimator::stratified), Isa::sse2});
    if (has_area_lights(scene) && scene.settings.integrator == Integrator::whitted) {
        variants.push_back({"area, stratified", with(LightSampling::area, Estimator::stratified)});
        variants.push_back({"exact, stratified", with(LightSampling::exact, Estimator::stratified)});
    }
    return variants;
}

std::vector<Variant> finite_at_contact(std::vector<Variant> variants) {
    std::erase_if(variants, [](const Variant& v) { return v.name.starts_with("nee, area"); });
    return variants;
}

statistics::BlockImage blocks_of(const Scene& scene, const Variant& variant, const Budget& budget) {
    Scene varied = scene;
    variant.apply(varied.settings);
    varied.settings.samples = budget.samples;
    std::vector<Image> images;
    for (std::uint32_t seed = 0; seed < budget.seeds; ++seed) {
        varied.settings.seed = 1000 + seed;
        RenderResult result = render(varied, {.isa = variant.isa});
        EXPECT_EQ(result.stats.dropped_samples, 0u) << variant.name;
        if (varied.settings.integrator == Integrator::depth) undo_post_process(result.image);
        images.push_back(std::move(result.image));
    }
    return statistics::blocks_over_seeds(images, budget.block_size);
}

void record(const statistics::Comparison& comparison) {
    static const testing::TestInfo* test = nullptr;
    static double greatest = 0;
    const testing::TestInfo* const current = testing::UnitTest::GetInstance()->current_test_info();
    if (current != test) greatest = 0;
    test = current;
    greatest = std::max(greatest, std::abs(comparison.worst.z));
    for (const auto& global : comparison.global) greatest = std::max(greatest, std::abs(global.z));
    testing::Test::RecordProperty("greatest_z", std::to_string(greatest));
    testing::Test::RecordProperty("threshold", std::to_string(comparison.threshold));
}

void expect_agreement_of(const std::vector<Variant>& variants, const Scene& scene, const Budget& budget) {
    const auto truth = reference::render(scene, {.samples = budget.reference_samples,
                                                 .block_size = budget.block_size,
                                                 .next_event = budget.next_event,
                                                 .caustics = scene.settings.caustics,
                                                 .post_process = false});
    const auto judge = [](const statistics::BlockImage& candidate, const statistics::BlockImage& expected,
                          const std::string& what) {
        const auto comparison = statistics::compare(candidate, expected, one_of_the_family);
        EXPECT_TRUE(comparison.agrees) << what << ": " << comparison.message;
        record(comparison);
    };
    statistics::BlockImage first;
    for (const Variant& variant : variants) {
        const auto blocks = blocks_of(scene, variant, budget);
        judge(blocks, truth, variant.name + " against the reference");
        if (first.blocks.empty()) {
            first = blocks;
        } else {
            judge(blocks, first, variant.name + " against " + variants[0].name);
        }
    }
}

void expect_agreement(const Scene& scene, const Budget& budget) {
    const bool paths = scene.settings.integrator == Integrator::path_tracing;
    expect_agreement_of(paths ? path_variants(scene) : other_variants(scene), scene, budget);
}

}  // namespace orrery::test
