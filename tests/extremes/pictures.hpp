// Whole pictures, where an extreme is one of the pipeline and not of a formula.
#pragma once

#include "wavefront/scenes.hpp"

namespace orrery::extremes {

using test::add_lamp;
using test::add_point_light;
using test::add_sphere;
using test::diffuse;
using test::dvec3;
using test::glass;
using test::glossy;
using test::mirror;

/// A square picture of nothing yet.
inline Scene picture(const dvec3& eye, const dvec3& target, double fov, std::uint32_t size, std::uint32_t depth) {
    Scene scene = test::picture(eye, target, fov, depth);
    scene.settings.width = scene.settings.height = size;
    return scene;
}

/// A way to compute a picture that has bits of its own.
struct Pipeline {
    const char* mode;
    Isa isa;
    Precision precision;
};
inline std::vector<Pipeline> pipelines() {
    std::vector<Pipeline> all{{"float", best_isa(), Precision::binary32}};
    if (best_isa() != Isa::sse2 && isa_supported(Isa::sse2))
        all.push_back({"float, SSE2", Isa::sse2, Precision::binary32});
    all.push_back({"double", best_isa(), Precision::binary64});
    return all;
}

/// With the standard error of every pixel.
inline RenderResult render(Scene scene, const Pipeline& how) {
    scene.settings.precision = how.precision;
    RenderOptions options;
    options.threads = 1;
    options.isa = how.isa;
    options.standard_error = true;
    return orrery::render(Plan(std::move(scene)), options);
}

}  // namespace orrery::extremes
