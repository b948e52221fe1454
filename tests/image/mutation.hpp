// Damage to files, the same on every run and every machine.
#pragma once

#include <cstdint>

#include "image/codec.hpp"

namespace orrery::test {

/// The file with 1 to 4 kinds of damage chosen by `seed`: bits flipped, bytes and words set to extreme values, pieces
/// removed, repeated or cut off.
Bytes mutated(ByteView file, std::uint32_t seed);

/// Recomputes the checksums of a PNG's chunks as far as its chunk lengths make sense, so that damage gets past them.
void repair_png_checksums(Bytes& file);

}  // namespace orrery::test
