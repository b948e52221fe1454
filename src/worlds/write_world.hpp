// World -> scene file, in one pass and in constant memory.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "worlds/world.hpp"

namespace orrery::worlds {

/// Takes the next piece of the text.
using Sink = std::function<void(std::string_view)>;

/// Writes a scene of `spheres` spheres, one shape and one primitive a line, whose image goes beside it as `name`.png.
void write_world(const World& world, std::uint64_t spheres, std::string_view name, const Sink& sink);

}  // namespace orrery::worlds
