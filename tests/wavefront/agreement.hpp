// Renderings that must have the same expectation: several settings of one scene, and the reference renderer.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "statistics/compare.hpp"
#include "wavefront/scenes.hpp"

namespace orrery::test {

/// Settings under which a scene's image may not change in expectation.
struct Variant {
    std::string name;
    std::function<void(RenderSettings&)> apply;
    Isa isa = best_isa();
};

/// Every transport with either way to sample lights, with and without roulette, all estimators, and the one
/// instruction set that rounds differently. Settings that do nothing in `scene` (light sampling without area lights)
/// are left out.
std::vector<Variant> path_variants(const Scene& scene);
/// Light sampling, estimators and SSE2; what else there is has no meaning for Whitted ray tracing and DEPTH.
std::vector<Variant> other_variants(const Scene& scene);

struct Budget {
    std::uint32_t samples = 256;  ///< per pixel of one image
    std::uint32_t seeds = 4;      ///< images per variant
    std::uint32_t reference_samples = 1500;
    /// Pixels per side of a block: 64 pixels times 3 gives every block far more degrees of freedom than it needs.
    std::uint32_t block_size = 8;
    /// The reference finds area lights by sampling them: needed for lights so small that paths hardly run into them.
    bool next_event = false;
};

/// What all comparisons of this folder together may raise of false alarms, and how many there are at most. With the
/// fixed seeds the dice were thrown once; the figure says how surprised to be when a change of the code throws others.
inline constexpr double family_alpha = 1e-3;
inline constexpr double family_comparisons = 1000;
inline constexpr statistics::ComparisonOptions one_of_the_family{.alpha = family_alpha / family_comparisons};

/// Block means of a variant over its seeds.
statistics::BlockImage blocks_of(const Scene& scene, const Variant& variant, const Budget& budget);

/// Notes the greatest |z| and its threshold with the test's result (`--gtest_output=xml` shows them).
void record(const statistics::Comparison& comparison);

/// Every variant against the reference (computed once), and against the first variant, which being measured with more
/// precision than the reference tells smaller differences apart.
void expect_agreement_of(const std::vector<Variant>& variants, const Scene& scene, const Budget& budget = {});
/// Without the variants whose variance is infinite where a light touches a diffuse surface: next event
/// estimation over the light's area, the cosine over squared distance of which has no square integral there.
std::vector<Variant> finite_at_contact(std::vector<Variant> variants);
/// With path_variants or other_variants, as the scene's integrator asks.
void expect_agreement(const Scene& scene, const Budget& budget = {});

}  // namespace orrery::test
