#include "mutation.hpp"

#include <algorithm>
#include <array>
#include <random>

namespace orrery::test {
namespace {

/// Not uniform_int_distribution, whose numbers the standard leaves to the library.
std::size_t below(std::mt19937& random, std::size_t bound) { return bound == 0 ? 0 : random() % bound; }

void set_word(Bytes& file, std::size_t at, std::uint32_t value, bool big_endian) {
    for (std::size_t i = 0; i < 4 && at + i < file.size(); ++i)
        file[at + i] = static_cast<std::byte>(value >> 8 * (big_endian ? 3 - i : i));
}

void damage(Bytes& file, std::mt19937& random) {
    constexpr std::array<std::uint32_t, 10> extremes{0,          1,          255,        65535,      0x7fffffff,
                                                     0x80000000, 0xffffffff, 0x00010000, 0x01000000, 0x40000000};
    const std::size_t at = below(random, file.size());
    const auto offset = file.begin() + static_cast<std::ptrdiff_t>(at);
    const std::size_t length = std::min(file.size() - at, 1 + below(random, 16));
    const auto end = offset + static_cast<std::ptrdiff_t>(length);
    switch (below(random, 8)) {
        case 0:
        case 1:
            file[at] ^= static_cast<std::byte>(1u << below(random, 8));
            break;
        case 2:
            file[at] = static_cast<std::byte>(random());
            break;
        case 3:
            set_word(file, at, extremes[below(random, extremes.size())], true);
            break;
        case 4:
            set_word(file, at, extremes[below(random, extremes.size())], false);
            break;
        case 5:
            file.erase(offset, end);
            break;
        case 6: {
            const Bytes piece(offset, end);
            file.insert(offset, piece.begin(), piece.end());
            break;
        }
        default:
            file[at] = std::byte('9');  // more digits where a number is text
            break;
    }
}

std::uint32_t crc32(ByteView bytes) {
    std::uint32_t crc = 0xffffffff;
    for (const std::byte byte : bytes) {
        crc ^= std::to_integer<std::uint32_t>(byte);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return ~crc;
}

}  // namespace

Bytes mutated(ByteView file, std::uint32_t seed) {
    std::mt19937 random(seed);
    Bytes result(file.begin(), file.end());
    for (std::size_t count = 1 + below(random, 4); count-- > 0 && !result.empty();) damage(result, random);
    if (below(random, 16) == 0) result.resize(below(random, result.size()));
    return result;
}

void repair_png_checksums(Bytes& file) {
    constexpr std::size_t signature = 8, length_and_type = 8, checksum = 4;
    for (std::size_t at = signature; at + length_and_type + checksum <= file.size();) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) length = length << 8 | std::to_integer<std::size_t>(file[at + i]);
        if (length > file.size() - at - length_and_type - checksum) return;
        set_word(file, at + length_and_type + length, crc32(ByteView(file).subspan(at + 4, 4 + length)), true);
        at += length_and_type + length + checksum;
    }
}

}  // namespace orrery::test
