#include "scene/world.hpp"

#include <algorithm>

namespace orrery::test {

Json world() {
    return Json::parse(R"({
  "cameras": [
    { "id": "eye", "type": "pinhole", "fov": 45, "aspect": 1, "distance": 5, "position": [0, 1, -8], "target": [0, 0, 0] },
    { "id": "lens", "type": "lens-based", "fov": 30, "aspect": 1.5, "position": [0, 1, -8], "target": [0, 0, 0],
      "focal distance": 7, "alpha": 0.25 }
  ],
  "materials": [
    { "id": "grey diffuse", "type": "diffuse", "rho": [0.8, 0.8, 0.8] },
    { "id": "mirror", "type": "specular reflection", "rho": [0.9, 0.8, 0.7] },
    { "id": "brushed", "type": "glossy reflection", "rho": [0.9, 0.9, 0.9], "roughness": 0.2 },
    { "id": "glass", "type": "fresnel dielectric", "rhoR": [0.9, 0.9, 0.9], "rhoT": [1, 1, 1], "eta": 1.5 },
    { "id": "milk glass", "type": "fresnel dielectric", "rhoR": [1, 1, 1], "rhoT": [1, 1, 1], "eta": 1.3, "roughness": 0.1 },
    { "id": "spare glass", "type": "fresnel dielectric", "rhoR": [1, 1, 1], "rhoT": [1, 1, 1], "eta": 1.5 }
  ],
  "shapes": [
    { "id": "ground", "type": "sphere", "centre": [0, -101, 0], "radius": 100 },
    { "id": "ball", "type": "sphere", "centre": [0, 0, 0], "radius": 1 },
    { "id": "left ball", "type": "sphere", "centre": [-2, 0, 0], "radius": 1 },
    { "id": "right ball", "type": "sphere", "centre": [2, 0, 0], "radius": 1 },
    { "id": "far ball", "type": "sphere", "centre": [0, 0, 3], "radius": 1 },
    { "id": "bulb", "type": "sphere", "centre": [0, 4, 0], "radius": 0.5 },
    { "id": "spare bulb", "type": "sphere", "centre": [0, 6, 0], "radius": 0.5 }
  ],
  "lights": [
    { "id": "lamp", "type": "point", "position": [3, 5, -3], "power": [100, 90, 80] },
    { "id": "glow", "type": "area", "shape": "bulb", "power": [30, 20, 10] },
    { "id": "spare light", "type": "area", "shape": "ball", "power": [1, 1, 1] }
  ],
  "scene": {
    "camera": "eye",
    "lights": ["lamp", "glow"],
    "primitives": [
      { "id": "ground", "type": "geometric", "shape": "ground", "material": "grey diffuse" },
      { "id": "ball", "type": "geometric", "shape": "ball", "material": "mirror" },
      { "id": "ball", "type": "geometric", "shape": "left ball", "material": "brushed" },
      { "id": "ball", "type": "geometric", "shape": "right ball", "material": "glass" },
      { "id": "ball", "type": "geometric", "shape": "far ball", "material": "milk glass" },
      { "id": "bulb", "type": "emissive", "shape": "bulb", "material": "grey diffuse", "light": "glow" }
    ],
    "background": [0.1, 0.2, 0.3],
    "renderer": {
      "type": "PT", "dimensions": [64, 48], "samples": 16, "depth": 6, "output": "../output/world.ppm",
      "estimator": "stratified", "transport": "mis", "light sampling": "cone", "roulette": "on", "tonemap": "sigmoid"
    }
  }
})");
}

ReadResult read(const Json& json) { return read_scene_text(json.dump(), "scenes/world.json"); }

std::string listing(const ReadResult& result) {
    std::string lines;
    for (const Diagnostic& diagnostic : result.diagnostics) lines += format_diagnostic("world", diagnostic) + '\n';
    return lines;
}

std::filesystem::path scenes_folder() { return ORRERY_SCENES_DIR; }

std::vector<std::filesystem::path> scene_files() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes_folder())) {
        const auto& path = entry.path();
        if (path.extension() == ".json" && path.filename() != "scene.schema.json") files.push_back(path);
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace orrery::test
