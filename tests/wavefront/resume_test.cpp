// Renders that are stopped and go on from what they saved: the bytes of one that never was.
#include <gtest/gtest.h>

#include <atomic>
#include <random>

#include "film/film_bytes.hpp"
#include "wavefront/ledger.hpp"
#include "wavefront/scenes.hpp"

namespace orrery::test {
namespace {

constexpr std::uint32_t side = 40;
constexpr std::uint64_t most_pixels = side * side;

std::unique_ptr<Ledger> ledger_of(const FilmBytes& bytes) {
    WholeFilm whole = film_of(bytes, most_pixels);
    return std::make_unique<Ledger>(std::move(whole.film), std::move(whole.state));
}

struct Part {
    std::optional<RenderResult> result;  ///< none where it was stopped
    FilmBytes saved;                     ///< at the end, however that came
    FilmBytes last;                      ///< the one saved before that; empty if there was none
};

/// Goes on with `film`, which may be empty, until so many waves have asked whether to go on.
Part run(const Plan& plan, RenderOptions options, const FilmBytes& film, int questions, Shard shard = {}) {
    const auto ledger = film.empty() ? begin_film(plan, options.goal, shard) : ledger_of(film);
    Part part;
    std::atomic<int> left = questions;
    options.interrupted = [&] { return --left < 0; };
    options.keep.every = 1e-3;
    options.keep.save = [&](const Ledger& now) {
        part.last = std::move(part.saved);
        part.saved.clear();
        now.write({}, [&](std::span<const std::byte> more) {
            part.saved.insert(part.saved.end(), more.begin(), more.end());
        });
    };
    try {
        part.result = render(plan, options, *ledger);
    } catch (const Interrupted&) {
    }
    return part;
}

struct Case {
    const char* name;
    Scene scene;
    Goal goal = {};
};

std::vector<Case> cases() {
    std::vector<Case> list;
    const auto add = [&](const char* name, const auto& change, const Goal& goal = {}) {
        Case& added = list.emplace_back(Case{name, noisy(3, side), goal});
        added.scene.settings.samples = 64;
        change(added.scene.settings);
    };
    add("stratified", [](RenderSettings&) {});
    add("one sample", [](RenderSettings& s) { s.samples = 1; });
    add("uniform, double",
        [](RenderSettings& s) { s.estimator = Estimator::uniform, s.precision = Precision::binary64; });
    add("sobol", [](RenderSettings& s) { s.estimator = Estimator::sobol; });
    add("WRT", [](RenderSettings& s) { s.integrator = Integrator::whitted; });
    add("DEPTH", [](RenderSettings& s) { s.integrator = Integrator::depth; });
    add("error", [](RenderSettings&) {}, {.error = 0.05});
    add("error, evenly", [](RenderSettings&) {}, {.error = 0.05, .adaptive = false});
    add("error, sobol", [](RenderSettings& s) { s.estimator = Estimator::sobol; }, {.error = 0.05});
    add("error, double", [](RenderSettings& s) { s.precision = Precision::binary64; }, {.error = 0.08});
    add("a ceiling", [](RenderSettings&) {}, {.error = 0.001, .samples = 100});
    add("error, DEPTH", [](RenderSettings& s) { s.integrator = Integrator::depth; }, {.error = 0.002});
    return list;
}

void expect_same(const RenderResult& a, const RenderResult& b) {
    EXPECT_EQ(a.image.pixels, b.image.pixels);
    EXPECT_EQ(a.standard_error.pixels, b.standard_error.pixels);
    EXPECT_EQ(a.stats.samples_per_pixel, b.stats.samples_per_pixel);
    EXPECT_EQ(a.stats.least_samples, b.stats.least_samples);
    EXPECT_EQ(a.stats.most_samples, b.stats.most_samples);
    EXPECT_EQ(a.stats.error.relative.value, b.stats.error.relative.value);
    EXPECT_EQ(a.stats.stopped_by, b.stats.stopped_by);
    EXPECT_EQ(a.stats.passes, b.stats.passes);
}

// Ten stops and more, at moments of which some are in the first wave and some between passes; after each it goes on
// from what was saved at the stop, or from what was saved some time before, as after a kill.
TEST(Resumed, IsTheRenderThatWasNeverStopped) {
    std::mt19937 random(11);
    for (const Case& asked : cases()) {
        SCOPED_TRACE(asked.name);
        const Plan plan(asked.scene);
        RenderOptions options;
        options.goal = asked.goal;
        options.standard_error = true;
        options.threads = 1;
        const RenderResult expected = orrery::render(plan, options);
        FilmBytes film;
        int stops = 0;
        for (int questions = 1;; questions += questions / 4 + 1) {
            options.threads = 1 + static_cast<unsigned>(random() % 3);
            options.wave_size = random() % 2 == 0 ? 0 : 100;
            const Part part = run(plan, options, film, questions);
            if (part.result) {
                expect_same(*part.result, expected);
                film = part.saved;
                break;
            }
            ++stops;
            film = random() % 2 == 0 && !part.last.empty() ? part.last : part.saved;
        }
        EXPECT_GE(stops, 1);
        RecordProperty(std::string(asked.name) + "_stops", stops);
        const Part finished = run(plan, options, film, 1 << 30);
        ASSERT_TRUE(finished.result);
        expect_same(*finished.result, expected);
        EXPECT_EQ(finished.result->stats.closest_rays, 0u) << "nothing was left to do";
    }
}

TEST(Resumed, WithATimeEndsInAnImage) {
    Scene scene = noisy(3, side);
    const Plan plan(scene);
    RenderOptions options;
    options.goal = {.seconds = 0.3};
    FilmBytes film;
    int runs = 0;
    for (int questions = 20; runs < 100; ++runs, questions += 20) {
        Part part = run(plan, options, film, questions);
        film = part.saved;
        if (!part.result) continue;
        EXPECT_EQ(part.result->stats.stopped_by, StopReason::time);
        EXPECT_GE(part.result->stats.least_samples, 2u);
        const Part again = run(plan, options, film, 1 << 30);
        ASSERT_TRUE(again.result);
        EXPECT_EQ(again.result->image.pixels, part.result->image.pixels) << "its time is over";
        options.goal.seconds = 0.6;
        const Part more = run(plan, options, film, 1 << 30);
        ASSERT_TRUE(more.result);
        EXPECT_GT(more.result->stats.samples_per_pixel, part.result->stats.samples_per_pixel);
        return;
    }
    ADD_FAILURE() << "never done";
}

// Whatever order they are read in, on whatever they were rendered.
TEST(Shards, TogetherAreTheImage) {
    for (const Case& asked : cases()) {
        if (asked.goal.asked()) continue;
        SCOPED_TRACE(asked.name);
        const Plan plan(asked.scene);
        RenderOptions options;
        options.standard_error = true;
        const RenderResult expected = orrery::render(plan, options);
        for (const std::uint32_t of : {2u, 3u, 11u}) {
            Film film(side, side, contrasting_of(plan.settings()));
            std::vector<FilmRegion> regions;
            for (std::uint32_t k = of; k >= 1; --k) {
                options.threads = k % 3 + 1;
                if (k % 2 == 1 && isa_supported(Isa::avx2)) options.isa = Isa::avx2;
                const Part part = run(plan, options, {}, 1 << 30, {k, of});
                ASSERT_TRUE(part.result);
                EXPECT_TRUE(part.result->image.pixels.empty());
                FilmReader reader(source_of(part.saved));
                regions.resize(reader.tiling().size());
                reader.read(film, regions);
            }
            FilmState state = begin_film(plan, {})->state();
            state.regions = regions;
            Ledger whole(std::move(film), state);
            const RenderResult result = orrery::render(plan, options, whole);
            expect_same(result, expected);
            EXPECT_EQ(result.stats.closest_rays, 0u);
        }
    }
}

}  // namespace
}  // namespace orrery::test
