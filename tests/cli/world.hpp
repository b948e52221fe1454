// A small valid scene as text, and ways to spoil it.
#pragma once

#include <nlohmann/json.hpp>

namespace orrery::test {

/// One diffuse ball under a lamp, 8 x 8 pixels, 4 samples, no output named.
inline nlohmann::json small_world() {
    return nlohmann::json::parse(R"({
        "cameras": [{"id": "c", "type": "pinhole", "fov": 45, "aspect": 1, "position": [0, 0, -4], "target": [0, 0, 0]}],
        "materials": [{"id": "m", "type": "diffuse", "rho": [0.5, 0.5, 0.5]}],
        "shapes": [{"id": "ball", "type": "sphere", "centre": [0, 0, 0], "radius": 1},
                   {"id": "bulb", "type": "sphere", "centre": [2, 3, -3], "radius": 0.5}],
        "lights": [{"id": "lamp", "type": "area", "shape": "bulb", "power": [20, 20, 20]}],
        "scene": {
            "camera": "c", "lights": ["lamp"],
            "primitives": [{"id": "ball", "type": "geometric", "shape": "ball", "material": "m"},
                           {"id": "bulb", "type": "emissive", "shape": "bulb", "material": "m", "light": "lamp"}],
            "renderer": {"type": "PT", "dimensions": [8, 8], "samples": 4, "depth": 3}
        }
    })");
}

}  // namespace orrery::test
