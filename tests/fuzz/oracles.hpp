// What must hold of the image of any scene.
#pragma once

#include <stdexcept>

#include "choices.hpp"
#include "scene_from_bytes.hpp"

namespace orrery::fuzz {

/// A promise that the program did not keep, in words, and the scene it is about.
struct Finding : std::runtime_error {
    Finding(const std::string& what, Scene about) : std::runtime_error(what), scene(std::move(about)) {}
    Scene scene;
};

/// Renders the scene in one way, looks at every pixel, and holds the image against that of one other way which the
/// choices name: other instruction sets, threads, waves, lengths, orders, or none. Throws Finding.
void check(const DrawnScene& drawn, Choices& choices);

}  // namespace orrery::fuzz
