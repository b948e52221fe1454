#include "scene/keyed_hash.hpp"

#include <bit>
#include <cstring>
#include <random>

namespace orrery {
namespace {

struct State {
    std::uint64_t a, b, c, d;

    void round() {
        a += b, c += d;
        b = std::rotl(b, 13) ^ a, d = std::rotl(d, 16) ^ c;
        a = std::rotl(a, 32);
        c += b, a += d;
        b = std::rotl(b, 17) ^ c, d = std::rotl(d, 21) ^ a;
        c = std::rotl(c, 32);
    }

    void absorb(std::uint64_t word) {
        d ^= word;
        round();
        a ^= word;
    }
};

HashKey random_key() {
    std::random_device random;
    const auto word = [&] { return std::uint64_t{random()} << 32 | random(); };
    return {word(), word()};
}

}  // namespace

std::uint64_t siphash(std::string_view bytes, const HashKey& key) {
    static_assert(std::endian::native == std::endian::little, "words are read as they lie");
    // The initial state is "somepseudorandomlygeneratedbytes", as the paper has it.
    State state{key.low ^ 0x736f6d6570736575, key.high ^ 0x646f72616e646f6d, key.low ^ 0x6c7967656e657261,
                key.high ^ 0x7465646279746573};
    std::uint64_t last = std::uint64_t{bytes.size()} << 56;
    for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
        std::uint64_t word;
        std::memcpy(&word, bytes.data(), 8);
        state.absorb(word);
    }
    for (std::size_t i = 0; i < bytes.size(); ++i) last |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << 8 * i;
    state.absorb(last);
    state.c ^= 0xFF;
    for (int i = 0; i < 3; ++i) state.round();
    return state.a ^ state.b ^ state.c ^ state.d;
}

std::uint64_t keyed_hash(std::string_view bytes) {
    static const HashKey key = random_key();
    return siphash(bytes, key);
}

}  // namespace orrery
