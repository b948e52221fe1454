#include "worlds/palette.hpp"

namespace orrery::worlds {

World studio() {
    World world;
    world.eye = {1.1, 1.2, -2.9};
    world.target = {0, 0, 0};
    world.fov = 36;
    world.background = {0.45, 0.55, 0.75};
    world.materials = {{.id = "chalk", .type = "diffuse", .rho = {0.8, 0.78, 0.74}},
                       {.id = "brick", .type = "diffuse", .rho = {0.7, 0.25, 0.15}},
                       {.id = "moss", .type = "diffuse", .rho = {0.3, 0.5, 0.2}},
                       {.id = "slate", .type = "diffuse", .rho = {0.2, 0.3, 0.45}},
                       {.id = "brass", .type = "glossy reflection", .rho = {0.85, 0.65, 0.3}, .roughness = 0.3},
                       {.id = "mirror", .type = "specular reflection", .rho = {0.9, 0.9, 0.9}}};
    world.lamps = {{.id = "warm", .position = {-3, 4, -4}, .intensity = {150, 130, 100}},
                   {.id = "cool", .position = {4, 1, -1}, .intensity = {14, 20, 30}}};
    return world;
}

}  // namespace orrery::worlds
