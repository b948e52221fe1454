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

/// Boxes were rounded by the builder, in float; to a double's ray that is within the margin of
/// kernels/tree_traverse.hpp.
kernels::TreeNode<double> widened(const kernels::TreeNode<float>& from) {
    kernels::TreeNode<double> to{};
    for (std::size_t side = 0; side < 6; ++side) std::ranges::copy(from.bound[side], to.bound[side]);
    std::ranges::copy(from.child, to.child);
    std::ranges::copy(from.order, to.order);
    return to;
}

}  // namespace

kernels::Scattering scattering_of(const Material& material, Integrator integrator) {
    // One way of scattering for every kind of material, in the same order.
    const auto kind = static_cast<std::size_t>(material.kind);
    if (kind >= kernels::scattering_count) throw std::invalid_argument("unknown material kind");
    // Whitted follows the unperturbed direction.
    return integrator == Integrator::whitted ? kernels::scattering_traits[kind].unperturbed
                                             : static_cast<kernels::Scattering>(kind);
}

bool shines(const glm::dvec3& light) { return light.r != 0 || light.g != 0 || light.b != 0; }
bool emits(const Primitive& primitive) { return primitive.emission && shines(*primitive.emission); }

template <class Real>
Tables<Real>::Tables(const Scene& scene, const CameraFrame& frame, const LengthUnit& in,
                     const std::vector<std::uint32_t>& order, Tree tree)
    : unit(static_cast<Real>(in.length)) {
    put_camera(scene, frame, in);
    put_materials(scene);
    put_spheres(scene, in, order, put_lights(scene, in));
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
void Tables<Real>::put_spheres(const Scene& scene, const LengthUnit& in, const std::vector<std::uint32_t>& order,
                               const std::vector<std::uint32_t>& light_of) {
    const auto l = [&](double v) { return static_cast<Real>(in.in_units(v)); };
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
            light_words_[0][light_of[primitive]] = index;
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

/// Lights count in the scene's order: which one a random number draws does not hang on the tree. Returns by primitive
/// which light it is.
template <class Real>
std::vector<std::uint32_t> Tables<Real>::put_lights(const Scene& scene, const LengthUnit& in) {
    const auto put = [&](const glm::dvec3& place, double radius, const glm::dvec3& colour) {
        const double row[] = {in.in_units(place.x),
                              in.in_units(place.y),
                              in.in_units(place.z),
                              in.in_units(radius),
                              colour.r,
                              colour.g,
                              colour.b};
        for (std::size_t c = 0; c < std::size(row); ++c) light_columns_[c].push_back(static_cast<Real>(row[c]));
        light_words_[0].push_back(kernels::no_sphere);
    };
    const auto count = [&] { return static_cast<std::uint32_t>(light_words_[0].size()); };
    for (const PointLight& light : scene.point_lights) {
        const glm::dvec3& i = light.intensity;
        if (shines(i)) put(light.position, 0, {in.intensity(i.r), in.intensity(i.g), in.intensity(i.b)});
    }
    kernels::LightTable<Real>&points = lights_[0], &all = lights_[1];
    points.points = points.count = count();
    std::vector<std::uint32_t> light_of(scene.primitives.size());
    for (std::size_t i = 0; i < light_of.size(); ++i) {
        const Primitive& p = scene.primitives[i];
        if (!emits(p)) continue;
        light_of[i] = count();
        put(p.centre, p.radius, *p.emission);
    }
    all.points = points.count;
    all.count = count();
    pad(light_columns_);
    pad(light_words_);
    for (auto& table : lights_) {
        const auto column = [&](std::size_t c) { return light_columns_[c].data(); };
        table.px = column(0), table.py = column(1), table.pz = column(2), table.radius = column(3);
        table.r = column(4), table.g = column(5), table.b = column(6);
        table.sphere = light_words_[0].data();
    }
    const glm::dvec3& b = scene.background;
    background = {static_cast<Real>(b.r), static_cast<Real>(b.g), static_cast<Real>(b.b)};
    return light_of;
}

template <class Real>
void Tables<Real>::choose_lights(const Scene& scene, bool area) {
    const std::size_t which = area ? 1 : 0;
    choices_[which] = ChoiceColumns<Real>(light_weights(scene, scene.settings.light_choice, area));
    choices_[which].put_into(lights_[which]);
}

namespace {

/// Where each primitive stands in that order.
std::vector<std::uint32_t> places_in(const std::vector<std::uint32_t>& order) {
    std::vector<std::uint32_t> place(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
    return place;
}

}  // namespace

template <class Real>
void Tables<Real>::guide_to(const Scene& scene, const LengthUnit& in, const std::vector<std::uint32_t>& order,
                            const std::vector<PlannedSpot>& spots) {
    spots_ = SpotColumns<Real>(scene, in, spots, places_in(order));
    guide = spots_.table();
}

template <class Real>
void Tables<Real>::sample_caustics(const Scene& scene, const LengthUnit& in, const std::vector<std::uint32_t>& order,
                                   const std::vector<PlannedCaustic>& planned) {
    const std::vector<std::uint32_t> sphere = places_in(order);
    const auto f = [](double v) { return static_cast<Real>(v); };
    for (const PlannedCaustic& p : planned) {
        const Primitive &ball = scene.primitives[p.ball], &lamp = scene.primitives[p.lamp];
        const Material& material = scene.materials[ball.material];
        kernels::Caustic<Real> c{};
        c.ball = sphere[p.ball], c.lamp = sphere[p.lamp], c.chords = p.chords, c.obstructed = p.obstructed;
        c.light = static_cast<std::uint32_t>(spheres.light[c.lamp]);
        c.cx = spheres.cx[c.ball], c.cy = spheres.cy[c.ball], c.cz = spheres.cz[c.ball];
        c.radius = spheres.radius[c.ball], c.radius2 = spheres.radius2[c.ball];
        c.eta = f(material.eta);
        c.mirror = !kernels::traits_of(scattering_of(material, scene.settings.integrator)).is_interface;
        const glm::dvec3 w = lamp.centre - ball.centre;
        c.wx = f(in.in_units(w.x)), c.wy = f(in.in_units(w.y)), c.wz = f(in.in_units(w.z));
        c.roughness = f(p.roughness);
        c.lamp_radius = spheres.radius[c.lamp];
        if (p.roughness > 0) c.lamp_radius = f(in.in_units(blurred_radius(glm::length(w), lamp.radius, p.roughness)));
        glm::dvec3 colour = *lamp.emission;
        if (p.chords == 0) colour *= material.rho;
        if (p.chords > 0) colour *= material.rho_t * material.rho_t;
        for (std::uint32_t inner = 1; inner < p.chords; ++inner) colour *= material.rho;
        c.r = f(colour.r), c.g = f(colour.g), c.b = f(colour.b);
        c.share = f(p.share);
        put_steps(c, in.in_units(ball.radius), material);
        if (caustics_.empty() || caustics_.back().ball != c.ball)
            caustic_groups_.push_back({static_cast<std::uint32_t>(caustics_.size()), 0, f(p.rate)});
        ++caustic_groups_.back().count;
        caustics_.push_back(c);
    }
    const auto count = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
    caustics = {count(caustics_), count(caustic_groups_), caustics_.data(), caustic_groups_.data(),
                f(carried_on(scene))};
}

template <class Real>
void Tables<Real>::look_over(const Scene& scene, const std::vector<std::uint32_t>& order,
                             const std::vector<std::uint32_t>& balls) {
    // A higher one costs time, a lower one noise: at 1 and 4 the efficiency of scenes 1 and 7, path traced, was 1.2 and
    // 0.85 times that at 2, where such light is all the noise 0.5 and 1.6 times.
    constexpr Real often = 2;
    std::vector<std::uint32_t> places;
    const std::vector<bool> wanted = [&] {
        std::vector<bool> list(order.size());
        for (const std::uint32_t ball : balls) list[ball] = true;
        return list;
    }();
    for (std::uint32_t i = 0; i < order.size(); ++i)
        if (wanted[order[i]]) places.push_back(i);
    sphere_choice_ = SphereChoice<Real>(spheres, places);
    sphere_choice_.put_into(caustics.over_points);
    caustics.over_points.obstructed = any_obstructed(scene, balls);
    caustics.over_points.rate = often;
    caustics.carried = static_cast<Real>(carried_on(scene));
}

template class Tables<float>;
template class Tables<double>;

}  // namespace orrery
