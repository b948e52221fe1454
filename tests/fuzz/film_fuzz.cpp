// Any bytes as a film file, their checksums put right: read or refused with a message, and what is read is written as a
// file that is read as the same.
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "film/film_bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace orrery::test;
    const auto input = std::as_bytes(std::span(data, size));
    FilmBytes bytes(input.begin(), input.end());
    repair_checksums(bytes);
    constexpr std::uint64_t most_pixels = 1 << 16;
    WholeFilm whole;
    try {
        whole = film_of(bytes, most_pixels);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& refusal) {
        if (std::strlen(refusal.what()) == 0) std::abort();
        return 0;
    }
    const FilmBytes once = bytes_of(whole);
    if (bytes_of(film_of(once, most_pixels)) != once) std::abort();
    return 0;
}
