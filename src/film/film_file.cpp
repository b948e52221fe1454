#include "film/film_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "film/little_endian.hpp"

namespace orrery {
namespace {

constexpr std::string_view magic("orrery\x1a\n", 8);
constexpr std::uint32_t layout_version = 1;
constexpr std::uint32_t largest_dimension = 1u << 16, largest_side = 64;
constexpr std::uint64_t longest_subject = 1u << 20, longest_head = 1u << 12;
constexpr std::size_t kind_and_length = 12;
constexpr std::size_t region_bytes = 40;  ///< of a "tile" section, before its pixels

std::size_t pixel_bytes(Contrasting contrasting) { return contrasting == Contrasting::one ? 104 : 80; }

/// The most bytes that a "tile" section has.
std::uint64_t longest_tile(const Tile& tile, Contrasting contrasting) {
    return region_bytes + pixel_bytes(contrasting) * (std::uint64_t{tile.pixels()} + 1);
}

[[noreturn]] void damaged(std::string_view what) { throw std::runtime_error(fmt::format("damaged: {}", what)); }

void require(bool good, std::string_view what) {
    if (!good) damaged(what);
}

std::uint32_t checksum(std::uint32_t before, std::span<const std::byte> bytes) {
    if (bytes.empty()) return before;  // of no address zlib would begin anew
    return static_cast<std::uint32_t>(
        ::crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

void write_section(std::string_view kind, const LittleEndianWriter& content, const FilmSink& sink) {
    LittleEndianWriter head;
    head.text(kind);
    head.u64(content.bytes().size());
    LittleEndianWriter tail;
    tail.u32(checksum(checksum(0, head.bytes()), content.bytes()));
    sink(head.bytes());
    sink(content.bytes());
    sink(tail.bytes());
}

/// Every pixel's bytes, one pixel after the other, are `count` records of `size`: those of one place side by side.
void write_planes(const std::vector<std::byte>& records, std::size_t size, LittleEndianWriter& out) {
    const std::size_t count = records.size() / size;
    std::vector<std::byte> plane(count);
    for (std::size_t place = 0; place < size; ++place) {
        for (std::size_t i = 0; i < count; ++i) plane[i] = records[i * size + place];
        const bool same = std::ranges::all_of(plane, [&](std::byte b) { return b == plane[0]; });
        out.u8(same ? 0 : 1);
        out.append(std::span(plane).first(same ? 1 : count));
    }
}

std::vector<std::byte> read_planes(LittleEndianReader& in, std::size_t size, std::size_t count) {
    std::vector<std::byte> records(size * count);
    for (std::size_t place = 0; place < size; ++place) {
        const std::uint32_t form = in.u8();
        require(form <= 1, "a plane of unknown form");
        const auto plane = in.take(form == 0 ? 1 : count);
        require(!plane.empty() || count == 0, "a tile ends early");
        for (std::size_t i = 0; i < count; ++i) records[i * size + place] = plane[form == 0 ? 0 : i];
    }
    return records;
}

void write_pixel(const Film::Content& pixel, Contrasting contrasting, LittleEndianWriter& out) {
    const auto triple = [&](const Rgb64& v) { out.f64(v.r), out.f64(v.g), out.f64(v.b); };
    const Spread& spread = pixel.spread;
    triple(pixel.sum);
    out.u64(pixel.samples);
    triple(spread.squares);
    for (const float skew : {spread.skews.r, spread.skews.g, spread.skews.b}) out.f32(skew);
    for (const std::uint32_t count : {spread.members, spread.contrasts, spread.steps}) out.u32(count);
    if (contrasting == Contrasting::one) triple(pixel.difference);
}

Film::Content read_pixel(LittleEndianReader& in, Contrasting contrasting) {
    Film::Content pixel;
    const auto triple = [&](Rgb64& v) { v.r = in.f64(), v.g = in.f64(), v.b = in.f64(); };
    Spread& spread = pixel.spread;
    triple(pixel.sum);
    pixel.samples = in.u64();
    triple(spread.squares);
    for (float* skew : {&spread.skews.r, &spread.skews.g, &spread.skews.b}) *skew = in.f32();
    for (std::uint32_t* count : {&spread.members, &spread.contrasts, &spread.steps}) *count = in.u32();
    if (contrasting == Contrasting::one) triple(pixel.difference);
    return pixel;
}

bool finite(const Rgb64& v) { return std::isfinite(v.r) && std::isfinite(v.g) && std::isfinite(v.b); }

/// Whether a pixel of so many samples can be like this: one sample is in four contrasts at most.
bool sensible(const Film::Content& pixel, std::uint32_t taken) {
    const Spread& spread = pixel.spread;
    return finite(pixel.sum) && finite(pixel.difference) && pixel.samples <= taken && spread.contrasts <= taken &&
           spread.members <= std::uint64_t{4} * taken && spread.steps <= spread.contrasts;
}

bool is_share(double x) { return x >= 0 && x <= 1; }

}  // namespace

void write_film(const FilmSubject& subject, const Film& film, const FilmState& state, const FilmRegions& regions,
                const FilmSink& sink) {
    LittleEndianWriter begin, what, head, end;
    begin.text(magic);
    begin.u32(layout_version);
    sink(begin.bytes());

    what.u32(static_cast<std::uint32_t>(subject.size()));
    for (const auto& [key, value] : subject)
        for (const std::string& text : {key, value}) what.u32(static_cast<std::uint32_t>(text.size())), what.text(text);
    if (what.bytes().size() > longest_subject) throw std::runtime_error("the names in it are too long for a film file");
    write_section("what", what, sink);

    head.u32(film.width());
    head.u32(film.height());
    head.u8(film.contrasting() == Contrasting::one ? 1 : 0);
    head.u8(state.halves ? 1 : 0);
    head.u8(state.pilot ? 1 : 0);
    head.u8(state.finished ? 1 : 0);
    head.u32(state.side);
    head.u32(state.shard.number);
    head.u32(state.shard.of);
    head.u32(state.passes);
    for (const double x : {state.seconds, state.share_before, state.share_after}) head.f64(x);
    write_section("head", head, sink);

    const Tiling tiles = state.tiling(film.width(), film.height());
    Film patch(0, 0, film.contrasting());
    std::uint64_t written = 0;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (!state.shard.has(i)) continue;
        const FilmRegion region = regions(i, patch);
        LittleEndianWriter content;
        content.u64(i);
        for (const std::uint32_t x : {region.taken, region.strata, region.visits, 0u}) content.u32(x);
        content.u64(region.dropped);
        content.f64(region.scatter);
        if (region.taken > 0) {
            LittleEndianWriter records;
            each_pixel(tiles[i], 0, [&](std::size_t, std::size_t place) {
                write_pixel(patch.content(place), film.contrasting(), records);
            });
            write_planes(records.bytes(), pixel_bytes(film.contrasting()), content);
        }
        write_section("tile", content, sink);
        ++written;
    }
    end.u64(written);
    write_section("end.", end, sink);
}

struct FilmReader::Section {
    std::string kind;
    std::vector<std::byte> content;

    LittleEndianReader reader() const { return LittleEndianReader(content); }
};

void FilmReader::take(std::span<std::byte> bytes) {
    while (!bytes.empty()) {
        const std::size_t count = source_(bytes);
        if (count == 0) damaged("the file ends early");
        bytes = bytes.subspan(count);
    }
}

/// The next section of a kind that is known here.
FilmReader::Section FilmReader::next() {
    for (;;) {
        std::array<std::byte, kind_and_length> head;
        take(head);
        LittleEndianReader reader(head);
        Section section;
        section.kind = std::string(reader.text(4));
        const std::uint64_t length = reader.u64();
        const bool is_tile = section.kind == "tile";
        const bool known = is_tile || section.kind == "what" || section.kind == "head" || section.kind == "end.";
        const std::uint64_t most =
            is_tile ? longest_tile({0, 0, std::min(state_.side, width_), std::min(state_.side, height_)}, contrasting_)
            : section.kind == "what" ? longest_subject
                                     : longest_head;
        require(!known || length <= most, "a section is longer than it can be");

        std::uint32_t sum = checksum(0, head);
        // What is not known is only gone over; memory is taken for what has come.
        for (std::uint64_t done = 0; done < length;) {
            const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(length - done, std::uint64_t{1} << 20));
            const std::size_t kept = known ? section.content.size() : 0;
            section.content.resize(kept + count);
            const auto part = std::span(section.content).subspan(kept);
            take(part);
            sum = checksum(sum, part);
            done += count;
        }
        std::array<std::byte, 4> tail;
        take(tail);
        require(LittleEndianReader(tail).u32() == sum, "a checksum does not fit what it is of");
        if (known) return section;
    }
}

FilmReader::Section FilmReader::expect(const char* kind) {
    Section section = next();
    require(section.kind == kind, "its sections are out of order");
    return section;
}

FilmReader::FilmReader(FilmSource source) : source_(std::move(source)) {
    std::array<std::byte, magic.size() + 4> begin;
    std::size_t count = 0;
    while (count < begin.size()) {
        const std::size_t more = source_(std::span(begin).subspan(count));
        if (more == 0) break;
        count += more;
    }
    LittleEndianReader beginning(std::span<const std::byte>(begin).first(count));
    if (beginning.text(magic.size()) != magic) throw std::runtime_error("not a film file");
    require(count == begin.size(), "the file ends early");
    if (const std::uint32_t version = beginning.u32(); version != layout_version)
        throw std::runtime_error(
            fmt::format("found version {} of the film file's layout, expected {}", version, layout_version));

    const Section what = expect("what");
    LittleEndianReader texts = what.reader();
    const std::uint32_t entries = texts.u32();
    for (std::uint32_t i = 0; i < entries && texts.good(); ++i) {
        std::string key(texts.text(texts.u32()));
        std::string value(texts.text(texts.u32()));
        subject_.emplace_back(std::move(key), std::move(value));
    }
    require(texts.good() && texts.left() == 0, "what it is of cannot be read");

    read_head();
}

void FilmReader::read_head() {
    const Section section = expect("head");
    LittleEndianReader head = section.reader();
    bool sensible = true;
    const auto within = [&](std::uint32_t x, std::uint32_t least, std::uint32_t most) {
        sensible = sensible && x >= least && x <= most;
        return x;
    };
    width_ = within(head.u32(), 1, largest_dimension);
    height_ = within(head.u32(), 1, largest_dimension);
    contrasting_ = within(head.u8(), 0, 1) == 1 ? Contrasting::one : Contrasting::many;
    state_.halves = within(head.u8(), 0, 1) == 1;
    state_.pilot = within(head.u8(), 0, 1) == 1;
    state_.finished = within(head.u8(), 0, 1) == 1;
    state_.side = within(head.u32(), 2, largest_side);
    state_.shard.number = head.u32();
    state_.shard.of = head.u32();
    within(state_.shard.number, 1, state_.shard.of);
    state_.passes = head.u32();
    state_.seconds = head.f64();
    state_.share_before = head.f64();
    state_.share_after = head.f64();
    require(head.good() && sensible && state_.side % 2 == 0 && state_.seconds >= 0 && std::isfinite(state_.seconds) &&
                is_share(state_.share_before) && is_share(state_.share_after),
            "its head makes no sense");
}

std::uint64_t FilmReader::least_size() const {
    const std::uint64_t tiles = tiling().size(), number = state_.shard.number, of = state_.shard.of;
    return (tiles < number ? 0 : (tiles - number) / of + 1) * (kind_and_length + region_bytes + 4);
}

FilmRegion FilmReader::read_region(const Section& section, std::size_t region, Film& film) const {
    LittleEndianReader in = section.reader();
    require(in.u64() == region, "its tiles are out of order");
    FilmRegion got;
    got.taken = in.u32();
    got.strata = in.u32();
    got.visits = in.u32();
    in.take(4);
    got.dropped = in.u64();
    got.scatter = in.f64();
    const Tile tile = tiling()[region];
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    require(in.good() && got.strata >= 1 && got.strata <= 1u << 16 && got.asked() <= most - got.taken &&
                got.scatter >= 0 && std::isfinite(got.scatter),
            "a tile makes no sense");
    if (got.taken > 0) {
        const auto records = read_planes(in, pixel_bytes(contrasting_), tile.pixels());
        LittleEndianReader pixels(records);
        each_pixel(tile, width_, [&](std::size_t pixel, std::size_t) {
            const Film::Content content = read_pixel(pixels, contrasting_);
            require(sensible(content, got.taken), "a pixel makes no sense");
            film.set_content(pixel, content);
        });
    }
    require(in.left() == 0, "a tile is too long");
    return got;
}

void FilmReader::read(Film& film, std::vector<FilmRegion>& regions) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < regions.size(); ++i) {
        if (!state_.shard.has(i)) continue;
        regions[i] = read_region(expect("tile"), i, film);
        ++count;
    }
    const Section end = expect("end.");
    require(end.content.size() == 8 && end.reader().u64() == count, "its number of tiles is wrong");
    std::byte more;
    require(source_({&more, 1}) == 0, "something follows its end");
}

}  // namespace orrery
