// Film files: whole, cut, changed and made up.
#include "film/film_file.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "film/film_bytes.hpp"
#include "image/mutation.hpp"
#include "support/heap_watch.hpp"

namespace orrery::test {
namespace {

constexpr std::uint64_t most_pixels = 1 << 12;

/// Of 5 x 3 pixels in tiles of 4, with everything different everywhere.
WholeFilm some_film(Contrasting contrasting, bool halves, Shard shard = {}) {
    WholeFilm whole{
        {{"seed", "7"}, {"scene", std::string("a\0b", 3)}}, {.side = 4, .halves = halves}, Film(5, 3, contrasting)};
    whole.state.shard = shard;
    whole.state.passes = 3;
    whole.state.pilot = false;
    whole.state.seconds = 12.5;
    whole.state.share_before = 0.25;
    whole.state.share_after = 0.5;
    const Tiling tiling = whole.state.tiling(5, 3);
    whole.state.regions.resize(tiling.size());
    double x = 0;
    for (std::size_t i = 0; i < tiling.size(); ++i) {
        if (!shard.has(i)) continue;
        FilmRegion& region = whole.state.regions[i];
        region = {.taken = i == 1 ? 0u : 9u, .strata = 3, .visits = i == 0 ? 0u : 2u, .dropped = i, .scatter = 1.5};
        if (region.taken == 0) continue;
        each_pixel(tiling[i], 5, [&](std::size_t pixel, std::size_t) {
            x += 0.7;
            whole.film.set_content(pixel, {.sum = {x, x * x, -x},
                                           .samples = 9 - pixel % 2,
                                           .spread = {.squares = {x, 1e300, 0},
                                                      .skews = {1, -2, 3e38f},
                                                      .members = 8,
                                                      .contrasts = 4,
                                                      .steps = 3},
                                           .difference = contrasting == Contrasting::one ? Rgb64{x, 0, -x} : Rgb64{}});
        });
    }
    return whole;
}

void expect_same(const Rgb64& a, const Rgb64& b) {
    EXPECT_EQ(a.r, b.r);
    EXPECT_EQ(a.g, b.g);
    EXPECT_EQ(a.b, b.b);
}

class FilmFile : public ::testing::TestWithParam<std::tuple<Contrasting, bool>> {
protected:
    WholeFilm film(Shard shard = {}) const {
        return some_film(std::get<0>(GetParam()), std::get<1>(GetParam()), shard);
    }
};

TEST_P(FilmFile, ComesBackAsItWas) {
    for (const Shard shard : {Shard{}, Shard{1, 2}, Shard{2, 2}}) {
        const WholeFilm before = film(shard);
        const FilmBytes bytes = bytes_of(before);
        EXPECT_LE(FilmReader(source_of(bytes)).least_size(), bytes.size());
        const WholeFilm after = film_of(bytes, most_pixels, 7);
        EXPECT_EQ(after.subject, before.subject);
        EXPECT_EQ(after.state.shard.number, shard.number);
        EXPECT_EQ(after.state.shard.of, shard.of);
        EXPECT_EQ(after.state.halves, before.state.halves);
        EXPECT_EQ(after.state.side, 4u);
        EXPECT_EQ(after.state.passes, 3u);
        EXPECT_FALSE(after.state.pilot);
        EXPECT_FALSE(after.state.finished);
        EXPECT_EQ(after.state.seconds, 12.5);
        EXPECT_EQ(after.state.share_before, 0.25);
        EXPECT_EQ(after.state.share_after, 0.5);
        ASSERT_EQ(after.state.regions.size(), before.state.regions.size());
        for (std::size_t i = 0; i < after.state.regions.size(); ++i) {
            const FilmRegion &a = after.state.regions[i], &b = before.state.regions[i];
            EXPECT_EQ(std::tie(a.taken, a.strata, a.visits, a.dropped, a.scatter),
                      std::tie(b.taken, b.strata, b.visits, b.dropped, b.scatter))
                << i;
        }
        for (std::size_t i = 0; i < before.film.pixels(); ++i) {
            SCOPED_TRACE(i);
            const Film::Content a = after.film.content(i), b = before.film.content(i);
            expect_same(a.sum, b.sum);
            EXPECT_EQ(a.samples, b.samples);
            expect_same(a.spread.squares, b.spread.squares);
            EXPECT_EQ(a.spread.skews, b.spread.skews);
            EXPECT_EQ(std::tie(a.spread.members, a.spread.contrasts, a.spread.steps),
                      std::tie(b.spread.members, b.spread.contrasts, b.spread.steps));
            expect_same(a.difference, b.difference);
        }
    }
}

/// The message, "" where it was read.
std::string refusal(const FilmBytes& bytes) {
    restart_heap_watch();
    std::string message;
    try {
        film_of(bytes, most_pixels);
    } catch (const std::exception& fault) {
        message = fault.what();
        EXPECT_NE(message, "");
        EXPECT_EQ(dynamic_cast<const std::bad_alloc*>(&fault), nullptr);
    }
    EXPECT_LE(heap_use().largest, std::size_t{1} << 21);
    return message;
}

TEST_P(FilmFile, IsRefusedWhereverItIsCut) {
    const FilmBytes file = bytes_of(film());
    for (std::size_t length = 0; length < file.size(); ++length)
        EXPECT_NE(refusal({file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length)}), "") << length;
    EXPECT_EQ(refusal(file), "");
}

TEST_P(FilmFile, IsRefusedWhicheverBitIsFlipped) {
    FilmBytes file = bytes_of(film());
    for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
        const auto mask = static_cast<std::byte>(1u << bit % 8);
        file[bit / 8] ^= mask;
        EXPECT_NE(refusal(file), "") << bit;
        file[bit / 8] ^= mask;
    }
}

TEST_P(FilmFile, DoesNoHarmWhereItWasMadeUp) {
    const FilmBytes file = bytes_of(film());
    int read = 0;
    for (std::uint32_t seed = 0; seed < 4000; ++seed) {
        SCOPED_TRACE(seed);
        FilmBytes changed = mutated(file, seed);
        repair_checksums(changed);
        read += refusal(changed).empty() ? 1 : 0;
    }
    EXPECT_GT(read, 0) << "else the checksums are wrong and nothing is tried";
}

INSTANTIATE_TEST_SUITE_P(All, FilmFile,
                         ::testing::Combine(::testing::Values(Contrasting::many, Contrasting::one), ::testing::Bool()));

FilmBytes with(const FilmBytes& file, std::size_t at, const FilmBytes& more) {
    FilmBytes bytes = file;
    bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), more.begin(), more.end());
    return bytes;
}

FilmBytes section(const char* kind, std::uint64_t length, std::size_t really) {
    FilmBytes bytes(12 + really + 4);
    std::memcpy(bytes.data(), kind, 4);
    std::memcpy(bytes.data() + 4, &length, 8);
    return bytes;
}

TEST(FilmFileRoom, SkipsSectionsItDoesNotKnow) {
    FilmBytes file = with(bytes_of(some_film(Contrasting::many, false)), 12, section("more", 3 << 20, 3 << 20));
    EXPECT_NE(refusal(file), "") << "of a wrong checksum";
    repair_checksums(file);
    EXPECT_EQ(refusal(file), "");
    file = with(file, 12, section("none", 0, 0));
    repair_checksums(file);
    EXPECT_EQ(refusal(file), "");
}

TEST(FilmFileRoom, RefusesWhatCannotBe) {
    const FilmBytes file = bytes_of(some_film(Contrasting::many, false));
    EXPECT_EQ(refusal({}), "not a film file");
    EXPECT_EQ(refusal(FilmBytes(100)), "not a film file");
    EXPECT_EQ(refusal(with(file, file.size(), FilmBytes(1))), "damaged: something follows its end");
    EXPECT_EQ(refusal(with(file, 12, section("more", ~std::uint64_t{0}, 100))), "damaged: the file ends early");
    EXPECT_EQ(refusal(with(file, 12, section("tile", std::uint64_t{1} << 40, 100))),
              "damaged: a section is longer than it can be");
    FilmBytes another = file;
    another[8] = std::byte{2};
    EXPECT_EQ(refusal(another), "found version 2 of the film file's layout, expected 1");
}

// A file of a kilobyte does not get the memory of millions of pixels.
TEST(FilmFileSize, IsInProportionToTheImage) {
    FilmBytes file = bytes_of(some_film(Contrasting::many, false));
    const std::string kind = "head";
    const auto head = std::search(file.begin(), file.end(), reinterpret_cast<const std::byte*>(kind.data()),
                                  reinterpret_cast<const std::byte*>(kind.data() + kind.size()));
    const auto set = [&](std::ptrdiff_t at, std::uint32_t value) { std::memcpy(&*(head + 12 + at), &value, 4); };
    set(0, 12000);
    set(4, 12000);
    set(12, 64);
    repair_checksums(file);
    EXPECT_EQ(FilmReader(source_of(file)).least_size(), 188u * 188 * 56);
    set(12, 128);
    repair_checksums(file);
    EXPECT_EQ(refusal(file), "damaged: its head makes no sense");
}

// So that a film of few samples is small, and one of none takes a line a tile.
TEST(FilmFileSize, IsThatOfWhatIsKnown) {
    WholeFilm whole{{}, {}, Film(64, 64)};
    whole.state.regions.resize(16);
    EXPECT_LT(bytes_of(whole).size(), 64u * 16 + 200);
    std::mt19937 random(1);
    for (FilmRegion& region : whole.state.regions) region.taken = 4;
    for (std::size_t i = 0; i < whole.film.pixels(); ++i)
        for (int s = 0; s < 4; ++s) {
            const auto value = [&] { return static_cast<float>(random()) * 0x1p-32f; };
            whole.film.add(i, value(), value(), value());
        }
    EXPECT_LT(bytes_of(whole).size(), 64u * 64 * 20) << "three sums of some 30 bits and little more";
}

}  // namespace
}  // namespace orrery::test
