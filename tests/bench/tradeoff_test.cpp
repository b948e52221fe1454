#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "bench/tradeoff/summary.hpp"
#include "scene/read.hpp"
#include "scene/settings.hpp"

namespace orrery::tradeoff {
namespace {

/// The mean product of two renders' errors is above zero beyond chance.
bool biased(const CellSummary& cell) { return cell.floor.value > 5 * cell.floor.error; }
/// The error falls slower than that of independent samples.
bool flattens(const CellSummary& cell) { return cell.slope.value + 1 > 5 * cell.slope.error; }

TEST(Slope, OfAPowerLawIsItsExponent) {
    std::vector<double> x;
    std::vector<Figure> y;
    for (const double n : {4.0, 16.0, 100.0}) {
        x.push_back(std::log(n));
        y.push_back({std::log(3 / std::pow(n, 1.5)), 0.1});
    }
    EXPECT_NEAR(slope_of(x, y).value, -1.5, 1e-12);
    // Equal errors e: e / sqrt(sum of (x - mean)^2), within what keeps weights finite.
    EXPECT_NEAR(slope_of(x, y).error, 0.1 / std::sqrt(5.23188), 1e-4);
    EXPECT_TRUE(std::isinf(slope_of({1, 1}, {{1, 1}, {2, 1}}).error));
}

TEST(Variants, BeginWithTheDefaultsAndHaveNamesOfTheirOwn) {
    const std::vector<Variant> variants = all_variants();
    EXPECT_EQ(variants.front().name(), "defaults");
    std::vector<std::string> names;
    for (const Variant& variant : variants) names.push_back(variant.name());
    EXPECT_THAT(names, ::testing::Contains("--transport naive --light-sampling area --estimator stratified"));
    EXPECT_THAT(names,
                ::testing::IsSupersetOf({"--light-choice uniform", "--light-choice power", "--roulette-from 4"}));
    EXPECT_THAT(names, ::testing::Contains("--precision double"));
    std::ranges::sort(names);
    EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
}

TEST(Variants, TryEverySettingThatChangesNoExpectation) {
    const std::vector<Variant> variants = all_variants();
    for (const Setting& setting : all_settings()) {
        const std::string option = "--" + std::string(setting.option);
        EXPECT_EQ(std::ranges::any_of(variants, [&](const Variant& variant) { return variant.chooses(option); }),
                  setting.same_expectation)
            << option;
        for (std::uint32_t word = 0; setting.same_expectation && word < setting.words.size(); ++word) {
            const Variant alone{{{.option = option, .word = text_of(setting, {word})}}};
            const SettingValue usual = setting.member.get(RenderSettings{});
            EXPECT_EQ(std::ranges::count(variants, alone.name(), &Variant::name), word == usual[0] ? 0 : 1)
                << alone.name();
        }
    }
}

TEST(Variants, DoWhatTheirNamesSay) {
    for (const Variant& variant : all_variants()) {
        const RenderSettings settings = variant.setup({}).settings;
        for (const Setting& setting : all_settings()) {
            std::string expected = text_of(setting, RenderSettings{});
            for (const Choice& choice : variant.choices)
                if (choice.option == "--" + std::string(setting.option)) expected = choice.word;
            EXPECT_EQ(text_of(setting, settings), expected) << variant.name();
        }
    }
}

/// A ball on the ground under a lamp, 16 x 16 pixels.
class Tradeoff : public ::testing::Test {
protected:
    static constexpr std::uint32_t rounds = 8;

    static void SetUpTestSuite() {
        const std::filesystem::path root = ORRERY_ROOT;
        ReadResult read = read_scene(root / "scenes/tests/diffuse_area.json");
        ASSERT_TRUE(read.scene);
        subject = new Subject{"ball", std::move(*read.scene), {}, {}};
        subject->usual = usual_settings(subject->scene.settings, 256);
        subject->reference = make_reference(subject->scene, subject->usual, std::uint32_t{24});
    }
    static void TearDownTestSuite() { delete subject; }

    static CellSummary measured(const Variant& variant, std::uint32_t depth) {
        Cell cell{0, variant, variant.setup(subject->usual), levels_up_to(8)};
        cell.setup.settings.depth = depth;
        for (std::uint32_t round = 0; round < rounds; ++round) measure_round(*subject, cell, round);
        return summarise(cell, subject->reference);
    }

    static Variant variant(const std::string& name) { return *std::ranges::find(all_variants_, name, &Variant::name); }

    static inline Subject* subject = nullptr;
    static inline const std::vector<Variant> all_variants_ = all_variants();
};

TEST_F(Tradeoff, IndependentSamplesHaveSlopeMinusOneAndNoBias) {
    const CellSummary uniform = measured(variant("--estimator uniform"), subject->usual.depth);
    ASSERT_EQ(uniform.levels.size(), 4u);
    EXPECT_EQ(uniform.levels.front().samples, 1);
    EXPECT_EQ(uniform.levels.back().samples, 64);
    EXPECT_NEAR(uniform.slope.value, -1, 0.08);
    EXPECT_FALSE(biased(uniform)) << uniform.floor.value << " +- " << uniform.floor.error;
    EXPECT_FALSE(flattens(uniform));
    for (const LevelSummary& level : uniform.levels) {
        EXPECT_EQ(level.renders, rounds);
        EXPECT_GT(level.mrse.value, 0);
        EXPECT_GT(level.seconds.value, 0);
    }
}

TEST_F(Tradeoff, StratifiedSamplesAreUnbiased) {
    const CellSummary usual = measured({}, subject->usual.depth);
    EXPECT_LT(usual.slope.value, -0.92);
    EXPECT_FALSE(biased(usual)) << usual.floor.value << " +- " << usual.floor.error;
}

TEST_F(Tradeoff, PathsCutShortAreReportedAsBias) {
    const CellSummary cut = measured({}, 1);
    EXPECT_TRUE(biased(cut)) << cut.floor.value << " +- " << cut.floor.error;
    EXPECT_TRUE(flattens(cut)) << cut.slope.value << " +- " << cut.slope.error;
}

TEST_F(Tradeoff, TheReferenceKnowsItsError) {
    // Others of other seeds and fewer samples differ by their errors. Few pixels carry these, so that a single ratio
    // scatters by 0.13, and the mean of six by 0.05.
    double ratios = 0;
    for (std::uint32_t strata = 3; strata <= 8; ++strata) {
        const Reference coarse = make_reference(subject->scene, subject->usual, strata);
        double sum = 0;
        for (std::size_t i = 0; i < coarse.image.pixels.size(); ++i) {
            for (float Rgb::*channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
                const double t = subject->reference.image.pixels[i].*channel;
                sum += std::pow(coarse.image.pixels[i].*channel - t, 2) / (t * t + 0.01) / 3;
            }
        }
        ratios += coarse.mrse / (sum / static_cast<double>(coarse.image.pixels.size()));
    }
    EXPECT_NEAR(ratios / 6, 1, 0.3);
}

}  // namespace
}  // namespace orrery::tradeoff
