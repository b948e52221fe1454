// Renders that keep a film: killed, stopped, continued, divided, developed; and films that do not fit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "kernels/isa.hpp"
#include "program.hpp"
#include "world.hpp"

namespace orrery::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Words = std::vector<std::string>;

Words operator+(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

const Words small = {"render", scene_file("assignment_08.json"), "--size", "64x48"};
/// Some tenths of a second on one core.
const Words work = small + Words{"--spp", "400"};

class Film : public ::testing::Test {
protected:
    Outcome run(const Words& words, Surroundings surroundings = {}) const {
        surroundings.folder = folder.path();
        return orrery(words, surroundings);
    }
    /// Runs what must work.
    void done(const Words& words) const {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    }
    /// The message of what must be refused as bad usage.
    std::string refused(const Words& words) const {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exit_code, 2) << outcome.error;
        EXPECT_EQ(outcome.output, "");
        return outcome.error;
    }
    std::string content(const char* name) const { return load(folder / name); }

    const TemporaryFolder folder;
};

struct Asked {
    const char* name;
    Words options;
};

class KilledFilm : public Film, public ::testing::WithParamInterface<Asked> {};

// At random moments, the first of which may be before anything was saved. By hand with a hundred of them: set
// ORRERY_KILLS.
TEST_P(KilledFilm, GoesOnToTheSameBytes) {
    const Words words = work + GetParam().options;
    const auto begun = std::chrono::steady_clock::now();
    done(words + Words{"-o", "whole.exr"});
    const double whole_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();

    const char* const asked = std::getenv("ORRERY_KILLS");
    const int kills = asked != nullptr ? std::atoi(asked) : 3;
    std::mt19937 random(5);
    const Words kept = words + Words{"-o", "parts.exr", "--film", "x.film", "--film-every", "5ms"};
    for (int i = 0; i < kills; ++i) {
        {
            Program program(kept, {.folder = folder.path()});
            std::this_thread::sleep_for(
                std::chrono::duration<double>(whole_time * static_cast<double>(random() % 1000) / 1500));
            program.send(i % 4 == 3 ? SIGTERM : SIGKILL);
            program.wait();
        }
        if (i % 8 == 7) {
            done(kept);
            EXPECT_EQ(content("parts.exr"), content("whole.exr")) << i;
            fs::remove(folder / "x.film");
        }
    }
    done(kept);
    EXPECT_EQ(content("parts.exr"), content("whole.exr"));
    EXPECT_THAT(folder.names(), ElementsAre("parts.exr", "whole.exr", "x.film")) << "no temporaries";
}

INSTANTIATE_TEST_SUITE_P(All, KilledFilm,
                         ::testing::Values(Asked{"stratified", {"--estimator", "stratified"}},
                                           Asked{"sobol", {"--estimator", "sobol", "--precision", "double"}},
                                           Asked{"error", {"--error", "5%"}}),
                         [](const auto& one) { return std::string(one.param.name); });

// What is on the film when a signal has ended the render is all that was done.
TEST_F(Film, IsSavedAtASignal) {
    const Words words = {"render", scene_file("assignment_08.json"), "--size", "400x300", "--spp", "2500", "-o",
                         "x.png"};
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        Program program(words + Words{"--film", "x.film"}, {.folder = folder.path()});
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        program.send(signal);
        const Outcome outcome = program.wait();
        EXPECT_EQ(outcome.exit_code, 128 + signal);
        EXPECT_THAT(outcome.error,
                    HasSubstr("orrery: interrupted: the film x.film has what was done; the same command goes on\n"));
        EXPECT_THAT(folder.names(), ElementsAre("x.film"));
    }
    const std::string unfinished = refused({"develop", "x.film", "-o", "x.png"});
    EXPECT_THAT(unfinished, AllOf(HasSubstr("x.film: is not finished: "), HasSubstr(" % of the samples")));
    done({"develop", "x.film", "-o", "x.png", "--unfinished"});
}

TEST_F(Film, BecomesTheImagesOfTheRender) {
    const Words image = {"-o", "a.png", "-o", "a.ppm", "-o", "a.exr", "-o", "a.pfm", "--error-image", "e.exr"};
    for (const Words& options : {Words{}, Words{"--error", "10%"}, Words{"--integrator", "depth"},
                                 Words{"--estimator", "sobol", "--tonemap", "linear"}}) {
        done(work + options + image + Words{"--film", "x.film"});
        std::vector<std::string> rendered;
        for (const char* name : {"a.png", "a.ppm", "a.exr", "a.pfm", "e.exr"}) {
            rendered.push_back(content(name));
            fs::remove(folder / name);
        }
        done(Words{"develop", "x.film"} + image);
        std::size_t i = 0;
        for (const char* name : {"a.png", "a.ppm", "a.exr", "a.pfm", "e.exr"})
            EXPECT_EQ(content(name), rendered[i++]) << name << ::testing::PrintToString(options);
        fs::remove(folder / "x.film");
    }
}

TEST_F(Film, IsDevelopedWithAnotherLook) {
    done(small + Words{"--spp", "4", "-o", "b.png", "--film", "x.film"});
    for (const Words& look :
         {Words{"--tonemap", "none"}, Words{"--tonemap", "srgb", "--exposure", "-1.5"}, Words{"--exposure", "2"}}) {
        done(small + Words{"--spp", "4", "-o", "a.png", "-o", "a.exr"} + look);
        EXPECT_NE(content("a.png"), content("b.png"));
        done(Words{"develop", "x.film", "-o", "c.png", "-o", "c.exr"} + look);
        EXPECT_EQ(content("c.png"), content("a.png"));
        EXPECT_EQ(content("c.exr"), content("a.exr"));
    }
    done(small + Words{"--spp", "4", "-o", "b.png", "--film", "x.film", "--exposure", "2"});
    done({"develop", "x.film", "-o", "c.png"});
    EXPECT_EQ(content("c.png"), content("a.png")) << "what the render said is the default";
    for (const char* bad : {"x", "101", "-101", "nan", "1e2", "--1", "1 "})
        EXPECT_THAT(refused({"develop", "x.film", "-o", "c.png", "--exposure=" + std::string(bad)}),
                    HasSubstr("expected a number from -100 to 100"))
            << bad;
}

TEST_F(Film, OfShardsIsThatOfTheWhole) {
    done(work + Words{"-o", "whole.exr"});
    const bool wide = isa_supported(Isa::avx512);
    for (const char* k : {"1", "2", "3"})
        done(work + Words{"--shard", std::string(k) + "/3", "--film", std::string(k) + ".film", "--threads", k, "--isa",
                          wide ? (*k == '2' ? "avx2" : "avx512") : "auto"});
    done({"develop", "2.film", "3.film", "1.film", "-o", "parts.exr"});
    EXPECT_EQ(content("parts.exr"), content("whole.exr"));

    EXPECT_THAT(refused({"develop", "1.film", "3.film", "-o", "x.png"}),
                HasSubstr("1 of the image's 3 parts are missing: 2/3"));
    EXPECT_THAT(refused({"develop", "1.film", "2.film", "3.film", "1.film", "-o", "x.png"}),
                HasSubstr("1.film: is the same part of the image, 1/3, as 1.film"));
    done(work + Words{"--shard", "2/3", "--film", "other.film", "--seed", "9"});
    EXPECT_THAT(refused({"develop", "1.film", "other.film", "3.film", "-o", "x.png"}),
                AllOf(HasSubstr("other.film: is no part of the image that 1.film is of"),
                      HasSubstr("seed: found \"9\", expected \"0\"")));
    done(work + Words{"--shard", "2/4", "--film", "quarter.film"});
    EXPECT_THAT(refused({"develop", "1.film", "quarter.film", "3.film", "-o", "x.png"}),
                HasSubstr("parts: found one of 4, expected one of 3"));
    EXPECT_THAT(refused({"develop", "1.film", "-o", "x.png"}), HasSubstr("missing: 2/3, 3/3"));
    EXPECT_FALSE(fs::exists(folder / "x.png"));
}

// Twelve tiles, so that the thirteenth shard has none.
TEST_F(Film, OfAShardWithoutTilesIsOneOfThem) {
    done(small + Words{"--spp", "8", "-o", "whole.exr"});
    Words develop = {"develop", "-o", "parts.exr"};
    for (int k = 1; k <= 13; ++k) {
        const std::string number = std::to_string(k);
        const Outcome outcome = run(small + Words{"--spp", "8", "--shard", number + "/13", "--film", number + ".film"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
        EXPECT_EQ(outcome.output, number + ".film\n");
        EXPECT_EQ(outcome.error.find("error"), std::string::npos) << "of a shard none is known: " << outcome.error;
        develop.push_back(number + ".film");
    }
    done(develop);
    EXPECT_EQ(content("parts.exr"), content("whole.exr"));
}

/// Of a PFM file: the pixels of some columns and rows, which are counted from the top.
std::string window_of(const std::string& pfm, std::size_t width, std::size_t height, std::size_t x0, std::size_t y0,
                      std::size_t x1, std::size_t y1) {
    const std::size_t pixel = 12, begin = pfm.size() - width * height * pixel;
    std::string pixels;
    for (std::size_t y = y1; y-- > y0;)
        pixels += pfm.substr(begin + ((height - 1 - y) * width + x0) * pixel, (x1 - x0) * pixel);
    return pixels;
}

TEST_F(Film, OfAWindowIsThatOfTheWhole) {
    for (const Words& options :
         {Words{"--estimator", "stratified", "--spp", "9"}, Words{"--estimator", "sobol", "--spp", "4"},
          Words{"--integrator", "depth", "--spp", "1"}, Words{"--precision", "double", "--spp", "1"}}) {
        done(small + options + Words{"-o", "whole.pfm"});
        for (const auto& [crop, x0, y0, x1, y1] : {std::tuple{"0,0,64,48", 0u, 0u, 64u, 48u},
                                                   {"5,7,40,31", 5u, 7u, 40u, 31u},
                                                   {"63,47,64,48", 63u, 47u, 64u, 48u}}) {
            const std::string expected = window_of(content("whole.pfm"), 64, 48, x0, y0, x1, y1);
            const Words window = small + options + Words{"--crop", crop};
            done(window + Words{"-o", "part.pfm", "--film", "x.film"});
            EXPECT_EQ(window_of(content("part.pfm"), x1 - x0, y1 - y0, 0, 0, x1 - x0, y1 - y0), expected) << crop;
            fs::remove(folder / "x.film");
            done(window + Words{"--shard", "1/2", "--film", "1.film"});
            done(window + Words{"--shard", "2/2", "--film", "2.film"});
            done({"develop", "1.film", "2.film", "-o", "both.pfm"});
            EXPECT_EQ(content("both.pfm"), content("part.pfm"));
            for (const char* film : {"1.film", "2.film"}) fs::remove(folder / film);
        }
    }
    const Words cropped = small + Words{"-o", "x.pfm", "--film", "x.film", "--spp", "1"};
    done(cropped + Words{"--crop", "0,0,8,8"});
    EXPECT_THAT(refused(cropped), HasSubstr("crop: found \"0,0,8,8\", expected \"off\""));
    EXPECT_THAT(refused(cropped + Words{"--crop", "0,0,65,48"}),
                HasSubstr("expected a window of the image of 64 x 48"));
    EXPECT_THAT(refused(small + Words{"--error", "1%", "--crop", "0,0,8,8", "-o", "x.pfm"}),
                HasSubstr("--crop: found --error beside it"));
    for (const char* bad :
         {"0,0,0,8", "8,0,4,8", "1,2,3", "1,2,3,4,5", "a,0,8,8", "-1,0,8,8", ",,,", "0,0,8,8,", "0 ,0,8,8"})
        EXPECT_THAT(refused(cropped + Words{"--crop=" + std::string(bad)}), HasSubstr("--crop: found")) << bad;
}

TEST_F(Film, OfAnotherRenderIsRefusedInWords) {
    done(work + Words{"-o", "a.png", "--film", "x.film"});
    const std::string before = content("x.film");
    const auto refusal = [&](const Words& options) {
        return refused(work + options + Words{"-o", "a.png", "--film", "x.film"});
    };
    EXPECT_THAT(refusal({"--seed", "3"}),
                HasSubstr("x.film: is the film of another render: seed: found \"0\", expected \"3\""));
    EXPECT_THAT(refusal({"--depth", "2", "--transport", "nee"}),
                AllOf(HasSubstr("depth: found"), HasSubstr("; transport: found \"mis\"")));
    EXPECT_THAT(refusal({"--precision", "double"}), HasSubstr("precision: found \"float\", expected \"double\""));
    EXPECT_THAT(refusal({"--isa", "sse2"}), HasSubstr("arithmetic: found \"of scalar, avx2 and avx512\""));
    EXPECT_THAT(
        refused({"render", scene_file("assignment_08.json"), "--size", "64x40", "-o", "a.png", "--film", "x.film"}),
        HasSubstr("size: found \"64x48\""));
    EXPECT_THAT(refused(small + Words{"--spp", "100", "-o", "a.png", "--film", "x.film"}),
                HasSubstr("cannot become fewer"));
    EXPECT_THAT(refusal({"--shard", "1/2"}), HasSubstr("found an image to write"));
    EXPECT_THAT(refused(work + Words{"--film", "x.film", "--shard", "1/2"}),
                HasSubstr("shard: found 1/1, expected 1/2"));
    EXPECT_THAT(refused(work + Words{"--film", "y.film", "--shard", "1/2", "--error", "1%"}),
                HasSubstr("--shard: found --error beside it"));
    EXPECT_THAT(refused(work + Words{"--shard", "1/2"}), HasSubstr("--shard: found no --film"));
    EXPECT_THAT(refused(work + Words{"--film-every", "9s", "-o", "a.png"}), HasSubstr("--film-every: found no --film"));
    for (const char* bad : {"0/2", "3/2", "1", "1/", "/2", "1/0", "-1/2", "1/2x", "1/4294967296"})
        EXPECT_THAT(refused(work + Words{"--film", "y.film", "--shard", bad}), HasSubstr("expected K/N")) << bad;
    EXPECT_EQ(content("x.film"), before);
}

// The film is of what a scene means: not of how it is spelt, what it is called and what in it is not used.
TEST_F(Film, KnowsItsScene) {
    auto world = small_world();
    store(folder / "a.json", to_bytes(world.dump()));
    done({"render", "a.json", "-o", "a.pfm", "--film", "x.film"});
    auto spelt = world;
    spelt["materials"][0]["id"] = "another";
    for (auto& primitive : spelt["scene"]["primitives"]) primitive["material"] = "another";
    spelt["shapes"].push_back({{"id", "unused"}, {"type", "sphere"}, {"centre", {0, 0, 0}}, {"radius", 3}});
    store(folder / "b.json", to_bytes(spelt.dump(4)));
    done({"render", "b.json", "-o", "b.pfm", "--film", "x.film"});
    EXPECT_EQ(content("a.pfm"), content("b.pfm"));

    const auto refusal = [&](const auto& change) {
        auto other = world;
        change(other);
        store(folder / "c.json", to_bytes(other.dump()));
        return refused({"render", "c.json", "-o", "c.pfm", "--film", "x.film"});
    };
    EXPECT_THAT(refusal([](auto& w) { w["cameras"][0]["fov"] = 46; }),
                HasSubstr("the camera of the scene is not the same"));
    EXPECT_THAT(refusal([](auto& w) { w["shapes"][0]["radius"] = 1.5; }),
                HasSubstr("the spheres of the scene are not the same"));
    EXPECT_THAT(refusal([](auto& w) { w["materials"][0]["rho"][1] = 0.75; }),
                HasSubstr("the spheres of the scene are not"));
    EXPECT_THAT(refusal([](auto& w) { w["lights"][0]["power"][2] = 21; }),
                HasSubstr("the spheres of the scene are not"));
    EXPECT_THAT(refusal([](auto& w) {
                    w["scene"]["background"] = {0, 0, 1};
                }),
                HasSubstr("the background of the scene is not"));
}

TEST_F(Film, GoesOnWithMoreSamples) {
    for (const char* estimator : {"uniform", "sobol"}) {
        const Words few = {"render", scene_file("tests/glossy.json"), "--size", "32x32", "--estimator", estimator};
        done(few + Words{"--spp", "100", "-o", "a.exr"});
        for (const char* spp : {"30", "64", "100"}) done(few + Words{"--spp", spp, "-o", "b.exr", "--film", "x.film"});
        EXPECT_EQ(content("a.exr"), content("b.exr")) << estimator;
        EXPECT_THAT(refused(few + Words{"--spp", "64", "-o", "b.exr", "--film", "x.film"}), HasSubstr("fewer"));
        // An image of which more is wanted than a number of samples: its error, and then a smaller one.
        done(few + Words{"--error", "3%", "-o", "b.exr", "--film", "x.film"});
        done(few + Words{"--error", "2%", "-o", "b.exr", "--film", "x.film"});
        const Outcome more = run(few + Words{"--error", "1%", "-o", "c.exr", "--film", "x.film"});
        EXPECT_THAT(more.error, HasSubstr("stopped at the 1 % asked"));
        EXPECT_THAT(refused(few + Words{"--spp", "9999", "-o", "b.exr", "--film", "x.film"}),
                    HasSubstr("was begun with --error or --time, expected one of these"));
        EXPECT_THAT(refused(few + Words{"--error", "0.5%", "--adaptive", "off", "-o", "b.exr", "--film", "x.film"}),
                    HasSubstr("adaptive: found \"on\", expected \"off\""));
        fs::remove(folder / "x.film");
    }
    const Words grid = {"render",      scene_file("tests/glossy.json"),
                        "--size",      "32x32",
                        "--estimator", "stratified",
                        "-o",          "a.exr",
                        "--film",      "x.film"};
    done(grid + Words{"--spp", "64"});
    done(grid + Words{"--spp", "70"});
    EXPECT_THAT(refused(grid + Words{"--spp", "100"}),
                AllOf(HasSubstr("going on would lose them"), HasSubstr("--error and --time go on from any film")));
    done(grid + Words{"--error", "2%"});
}

TEST_F(Film, ThatIsDamagedIsRefused) {
    const Words words_of_render = small + Words{"-o", "a.exr", "--film", "x.film", "--spp", "4"};
    done(words_of_render);
    const std::string image = content("a.exr"), film = content("x.film");
    std::mt19937 random(3);
    for (int i = 0; i < 12; ++i) {
        std::string bad = film;
        const std::size_t at = random() % bad.size();
        if (i % 3 == 0) {
            bad.resize(at);
        } else {
            bad[at] = static_cast<char>(bad[at] ^ 1 << random() % 8);
        }
        store(folder / "x.film", to_bytes(bad));
        for (const Words& words : {words_of_render, Words{"develop", "x.film", "-o", "a.exr"}}) {
            const Outcome outcome = run(words);
            EXPECT_EQ(outcome.exit_code, 1) << at;
            EXPECT_THAT(outcome.error, HasSubstr("x.film: ")) << at;
            EXPECT_EQ(content("a.exr"), image) << at;
            EXPECT_EQ(content("x.film"), bad) << at;
        }
    }
}

// Where there is no room for a film the one before stays, the render goes on, and its end says so.
TEST_F(Film, ThatCannotBeWrittenLeavesTheOlder) {
    const Words words = small + Words{"--estimator", "uniform", "--film", "x.film", "-o", "a.ppm"};
    done(words + Words{"--spp", "1"});
    const std::string older = content("x.film");
    const Outcome outcome = run(words + Words{"--spp", "400"}, {.largest_file = 20'000});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.error,
                HasSubstr("orrery: warning: the film is not saved: x.film: cannot write: File too large"));
    EXPECT_EQ(content("x.film"), older);
    EXPECT_THAT(folder.names(), ElementsAre("a.ppm", "x.film"));
}

/// The film that a message names.
fs::path named_in(const std::string& error) {
    const std::size_t end = error.find(" has what was rendered: orrery develop ");
    const std::size_t begin = error.rfind('\n', end);
    return end == std::string::npos ? "" : error.substr(begin == std::string::npos ? 0 : begin + 1, end - begin - 1);
}

TEST_F(Film, IsKeptWhereTheImageCannotBe) {
    done(work + Words{"-o", "whole.exr"});
    for (const bool folder_too : {false, true}) {
        fs::create_directory(folder / "out");
        Program program(work + Words{"-o", "out/x.exr"}, {.folder = folder.path()});
        std::this_thread::sleep_for(std::chrono::milliseconds(60));
        if (folder_too) {
            fs::rename(folder / "out", folder / "gone");
        } else {
            fs::create_directory(folder / "out/x.exr");
        }
        const Outcome outcome = program.wait();
        EXPECT_EQ(outcome.exit_code, 1);
        const fs::path film = named_in(outcome.error);
        ASSERT_FALSE(film.empty()) << outcome.error;
        if (folder_too) {
            EXPECT_EQ(film.parent_path(), fs::temp_directory_path());
            done({"develop", film.string(), "-o", "x.exr"});
            fs::remove(film);
        } else {
            EXPECT_EQ(film, "out/x.film");
            done({"develop", film.string(), "-o", "x.exr"});
            fs::remove_all(folder / "out");
        }
        EXPECT_EQ(content("x.exr"), content("whole.exr"));
    }
}

}  // namespace
}  // namespace orrery::test
