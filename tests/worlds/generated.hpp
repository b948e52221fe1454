// The text of a generated scene.
#pragma once

#include <string>

#include "worlds/write_world.hpp"

namespace orrery::worlds {

inline std::string generated(Kind kind, std::uint64_t spheres, std::uint32_t seed = 0) {
    std::string text;
    write_world(make_world(kind, spheres, seed), spheres, "picture", [&](std::string_view part) { text += part; });
    return text;
}

}  // namespace orrery::worlds
