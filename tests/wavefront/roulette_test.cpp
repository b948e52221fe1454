// Russian roulette: no expectation changes, however little a path carries and whatever glass does to its radiance.
#include <gtest/gtest.h>

#include <cmath>

#include "wavefront/agreement.hpp"

namespace orrery::test {
namespace {

// Dark things: paths survive one time in ten, three times in a row.
TEST(Roulette, KeepsTheMeanOfDarkPaths) {
    Scene scene = still_life(mirror(0.3), 6);
    for (Material& material : scene.materials) material.rho *= 0.2;
    scene.background = {1, 2, 3};
    add_lamp(scene, {1.7, 3.2, -1.5}, 1, {4, 3, 5}, diffuse(dvec3{0.1}));
    expect_agreement(scene);
}

// Coloured things: what one channel has lost must not be played for by another.
TEST(Roulette, KeepsTheMeanOfColouredPaths) {
    Scene scene = still_life(tinted(mirror(0), {0.02, 0.9, 0.1}), 6);
    scene.materials[0].rho = {0.9, 0.05, 0.1};
    scene.materials[2].rho = {0.05, 0.1, 0.9};
    scene.background = {1, 2, 3};
    expect_agreement(scene);
}

// Inside glass radiance is scaled by 1/eta^2, a fifth or five times: throughput that is no loss and no gain.
TEST(Roulette, KeepsTheMeanInsideGlassOfAnyIndex) {
    for (const double eta : {2.4, 0.45}) {
        Scene scene = still_life(tinted(glass(0, eta), {0.9, 0.8, 0.7}, {0.5, 0.7, 0.9}), 8);
        add_sphere(scene, {-0.5, 1, 0}, 0.6, diffuse({0.8, 0.5, 0.3}));  // seen through the glass, and lit through it
        add_sphere(scene, {-2, 0.6, -0.8}, 0.6, tinted(glass(0, eta, 0.2), dvec3{0.8}, {0.9, 0.7, 0.5}));
        scene.background = {0.5, 0.7, 1};
        expect_agreement(scene);
    }
}

// What loses nothing is never killed, nor weighed: the images are the same bytes. Through glass this needs the radiance
// scaling left out of the probability.
TEST(Roulette, LeavesPathsThatLoseNothingAlone) {
    for (const Material& material :
         {diffuse(dvec3{1}), mirror(1), glossy(1, 0.4), glass(1, 1.5), glass(1, 0.6), glass(1, 2.4, 0.3)}) {
        Scene scene = still_life(material, 12);
        scene.materials[0].rho = scene.materials[2].rho = dvec3{1};
        scene.background = {0.5, 0.7, 1};
        scene.settings.samples = 16;
        for (const Isa isa : supported_isas()) {
            scene.settings.roulette = true;
            const RenderResult with = render(scene, {.isa = isa});
            scene.settings.roulette = false;
            const RenderResult without = render(scene, {.isa = isa});
            EXPECT_EQ(with.image.pixels, without.image.pixels)
                << isa_name(isa) << ", kind " << static_cast<int>(material.kind) << ", eta " << material.eta;
            EXPECT_EQ(with.stats.closest_rays, without.stats.closest_rays);
        }
    }
}

// Whatever number of scattering events goes free: in the dark, where every game counts, behind glass, where what is
// carried and what is scaled were apart for several of them.
TEST(Roulette, KeepsTheMeanWhereverItStarts) {
    Scene scene = still_life(tinted(glass(0, 1.5), {0.9, 0.8, 0.7}, {0.5, 0.7, 0.9}), 6);
    for (Material& material : scene.materials) material.rho *= 0.4;
    add_sphere(scene, {-0.5, 1, 0}, 0.6, diffuse({0.4, 0.3, 0.1}));
    scene.background = {1, 2, 3};
    add_lamp(scene, {1.7, 3.2, -1.5}, 1, {4, 3, 5}, diffuse(dvec3{0.1}));
    std::vector<Variant> variants;
    for (const std::uint32_t from : {0u, 1u, 2u, 4u})
        variants.push_back({std::to_string(from) + " free", [=](RenderSettings& s) { s.roulette_from = from; }});
    expect_agreement_of(variants, scene);
}

TEST(Roulette, ThatStartsBehindTheLastEventIsNone) {
    Scene scene = everything();
    for (const std::uint32_t depth : {1u, 3u, 8u}) {
        scene.settings.depth = depth;
        scene.settings.roulette = false;
        const Image without = image_of(scene);
        scene.settings.roulette = true;
        for (const std::uint32_t from : {depth, depth + 1, 0xFFFFFFFFu}) {
            scene.settings.roulette_from = from;
            EXPECT_EQ(image_of(scene).pixels, without.pixels) << depth << ", " << from;
        }
        scene.settings.roulette_from = depth - 1;
        EXPECT_NE(image_of(scene).pixels, without.pixels) << depth;
    }
}

// It is there to save work.
TEST(Roulette, EndsPathsThatCarryLittle) {
    Scene scene = picture({0, 0, 0}, {0, 0, 1}, 90, 50);
    add_lamp(scene, {0, 0, 0}, 1, dvec3{1}, diffuse(dvec3{0.25}));
    scene.settings.transport = Transport::naive;
    scene.settings.samples = 256;
    const double paths = 256 * 256;
    for (const std::uint32_t from : {0u, 1u, 3u}) {
        scene.settings.roulette_from = from;
        // Of the segments behind the free ones the first is reached with all that was lost till then, and by those who
        // get there and at every further event again with 1/4: 1 / (1 - 1/4) segments on average.
        const double wanted = from + 1 + std::pow(0.25, from + 1) * 4 / 3;
        EXPECT_NEAR(static_cast<double>(render(scene).stats.closest_rays) / paths, wanted, 0.02) << from;
    }
    scene.settings.roulette = false;
    EXPECT_EQ(render(scene).stats.closest_rays, 51 * 256 * 256u);
}

}  // namespace
}  // namespace orrery::test
