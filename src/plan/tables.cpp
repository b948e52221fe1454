#include "plan/tables.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "kernels/queues.hpp"

namespace orrery {

namespace {

/// Kernels read whole vectors, and look up entry 0 for dead lanes.
template <class Columns>
void pad(Columns& columns) {
    for (auto& column : columns) column.resize(column.size() + kernels::widest);
}

template <class Real, std::size_t size>
void push3(std::array<std::vector<Real>, size>& columns, std::size_t first, const glm::dvec3& v) {
    for (int c = 0; c < 3; ++c) columns[first + static_cast<std::size_t>(c)].push_back(static_cast<Real>(v[c]));
}

/// Boxes were rounded by the builder, in float; to a double's ray that is within the margin of kernels/tree_rays.hpp.
kernels::TreeNode<double> widened(const kernels::TreeNode<float>& from) {
    kernels::TreeNode<double> to{};
    for (std::size_t side = 0; side < 6; ++side) std::ranges::copy(from.bound[side], to.bound[side]);
    std::ranges::copy(from.child, to.child);
    std::ranges::copy(from.order, to.order);
    return to;
}

}  // namespace

kernels::Scattering scattering_of(const Material& material, Integrator integrator) {
    using kernels::Scattering;
    switch (material.kind) {
        case MaterialKind::diffuse:
            return Scattering::diffuse;
        case MaterialKind::specular:
            return Scattering::specular;
        case MaterialKind::dielectric:
            return Scattering::dielectric;
        // Whitted follows the unperturbed direction (spec section 4).
        case MaterialKind::glossy:
            return integrator == Integrator::whitted ? Scattering::specular : Scattering::glossy;
        case MaterialKind::translucent:
            return integrator == Integrator::whitted ? Scattering::dielectric : Scattering::translucent;
    }
    throw std::invalid_argument("unknown material kind");
}

bool shines(const glm::dvec3& light) { return light.r != 0 || light.g != 0 || light.b != 0; }

template <class Real>
Tables<Real>::Tables(const Scene& scene, const CameraFrame& frame, const LengthUnit& in,
                     const std::vector<std::uint32_t>& order, Tree tree)
    : unit(static_cast<Real>(in.length)) {
    put_camera(scene, frame, in);
    put_materials(scene);
    put_spheres(scene, in, order);
    put_lights(scene, in);
    if constexpr (std::is_same_v<Real, float>) {
        nodes_ = std::move(tree.nodes);
    } else {
        nodes_.reserve(tree.nodes.size());
        std::ranges::transform(tree.nodes, std::back_inserter(nodes_), widened);
    }
    spheres.tree = {static_cast<std::uint32_t>(nodes_.size()), nodes_.data(), tree.extent};
}

template <class Real>
void Tables<Real>::put_camera(const Scene& scene, const CameraFrame& frame, const LengthUnit& in) {
    const Camera& from = scene.camera;
    const auto f = [](double v) { return static_cast<Real>(v); };
    const auto l = [&](double v) { return static_cast<Real>(in.in_units(v)); };
    camera = {l(from.position.x),  l(from.position.y),    l(from.position.z),   f(frame.right.x),
              f(frame.right.y),    f(frame.right.z),      f(frame.up.x),        f(frame.up.y),
              f(frame.up.z),       f(frame.ahead.x),      f(frame.ahead.y),     f(frame.ahead.z),
              f(frame.cell_width), f(-frame.cell_height), l(from.aperture / 2), l(from.focal_distance)};
    double reach = 0;
    for (const Primitive& p : scene.primitives)
        reach = std::max(reach, glm::length(p.centre - from.position) + p.radius + from.aperture / 2);
    enclosing_distance = reach > 0 ? f(2 * reach) : Real(1);
}

template <class Real>
void Tables<Real>::put_materials(const Scene& scene) {
    for (const Material& m : scene.materials) {
        push3(material_columns_, 0, m.rho);
        push3(material_columns_, 3, m.rho_t);
        material_columns_[6].push_back(static_cast<Real>(m.eta));
        material_columns_[7].push_back(static_cast<Real>(m.roughness));
    }
    pad(material_columns_);
    materials = {static_cast<std::uint32_t>(scene.materials.size()),
                 material_columns_[0].data(),
                 material_columns_[1].data(),
                 material_columns_[2].data(),
                 material_columns_[3].data(),
                 material_columns_[4].data(),
                 material_columns_[5].data(),
                 material_columns_[6].data(),
                 material_columns_[7].data()};
}

template <class Real>
void Tables<Real>::put_spheres(const Scene& scene, const LengthUnit& in, const std::vector<std::uint32_t>& order) {
    const auto f = [](double v) { return static_cast<Real>(v); };
    const auto l = [&](double v) { return static_cast<Real>(in.in_units(v)); };
    // Lights count in the scene's order: which one a random number draws does not hang on the tree.
    std::vector<std::uint32_t> light_of(scene.primitives.size());
    const auto emits = [](const Primitive& p) { return p.emission && shines(*p.emission); };
    for (std::size_t i = 0; i < light_of.size(); ++i) {
        const Primitive& p = scene.primitives[i];
        if (!emits(p)) continue;
        light_of[i] = static_cast<std::uint32_t>(area_lights.size());
        push3(emission_columns_, 0, *p.emission);
        area_lights.push_back({0, l(p.centre.x), l(p.centre.y), l(p.centre.z), l(p.radius), f(p.emission->r),
                               f(p.emission->g), f(p.emission->b)});
    }
    // Exactly what they hold: grown by doubling, the columns of 2^20 spheres would end at twice their size.
    for (auto& column : sphere_columns_) column.reserve(order.size() + kernels::widest);
    for (auto& column : sphere_words_) column.reserve(order.size() + kernels::widest);
    std::uint32_t index = 0;
    for (const std::uint32_t primitive : order) {
        const Primitive& p = scene.primitives[primitive];
        for (int c = 0; c < 3; ++c) sphere_columns_[static_cast<std::size_t>(c)].push_back(l(p.centre[c]));
        const Real radius = l(p.radius);
        sphere_columns_[3].push_back(radius);
        sphere_columns_[4].push_back(radius * radius);
        sphere_columns_[5].push_back(1 / radius);
        const auto kind = scattering_of(scene.materials[p.material], scene.settings.integrator);
        std::uint32_t surface = p.material | static_cast<std::uint32_t>(kind) << kernels::surface_material_bits;
        if (emits(p)) {
            surface |= kernels::surface_emits;
            area_lights[light_of[primitive]].sphere = index;
        }
        sphere_words_[0].push_back(surface);
        sphere_words_[1].push_back(light_of[primitive]);
        ++index;
    }
    pad(sphere_columns_);
    pad(sphere_words_);
    spheres.count = index;
    spheres.cx = sphere_columns_[0].data();
    spheres.cy = sphere_columns_[1].data();
    spheres.cz = sphere_columns_[2].data();
    spheres.radius = sphere_columns_[3].data();
    spheres.radius2 = sphere_columns_[4].data();
    spheres.inverse_radius = sphere_columns_[5].data();
    spheres.surface = sphere_words_[0].data();
    spheres.light = sphere_words_[1].data();
}

template <class Real>
void Tables<Real>::put_lights(const Scene& scene, const LengthUnit& in) {
    const auto f = [](double v) { return static_cast<Real>(v); };
    const auto l = [&](double v) { return static_cast<Real>(in.in_units(v)); };
    const auto i = [&](double v) { return static_cast<Real>(in.intensity(v)); };
    for (const PointLight& light : scene.point_lights) {
        if (!shines(light.intensity)) continue;
        point_lights.push_back({l(light.position.x), l(light.position.y), l(light.position.z), i(light.intensity.r),
                                i(light.intensity.g), i(light.intensity.b)});
    }
    const glm::dvec3& b = scene.background;
    pad(emission_columns_);
    emission = {static_cast<std::uint32_t>(area_lights.size()),
                emission_columns_[0].data(),
                emission_columns_[1].data(),
                emission_columns_[2].data(),
                nullptr,
                f(b.r),
                f(b.g),
                f(b.b),
                shines(b),
                !area_lights.empty()};
}

template <class Real>
void Tables<Real>::choose_lights(const Scene& scene, bool area) {
    ChosenLights<Real>& chosen = chosen_lights_[area ? 1 : 0];
    chosen = ChosenLights<Real>(light_weights(scene, scene.settings.light_choice, area), point_lights, area_lights);
    if (area) emission.probability = chosen.area_probability.data();
}

template class Tables<float>;
template class Tables<double>;

}  // namespace orrery
