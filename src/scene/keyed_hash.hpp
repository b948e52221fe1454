// A hash that nobody can aim at: without the key, no file can be written whose strings all collide.
#pragma once

#include <cstdint>
#include <string_view>

namespace orrery {

struct HashKey {
    std::uint64_t low = 0, high = 0;
};

/// SipHash-1-3 (Aumasson and Bernstein 2012, with the rounds that Python and Rust use for their tables).
std::uint64_t siphash(std::string_view bytes, const HashKey& key);

/// siphash() with a key drawn once per process. No result may depend on it beyond where things lie in a table.
std::uint64_t keyed_hash(std::string_view bytes);

}  // namespace orrery
