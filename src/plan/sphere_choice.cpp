#include "plan/sphere_choice.hpp"

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "kernels/queues.hpp"

namespace orrery {

namespace {

struct Node {
    glm::dvec3 centre{0};
    double reach = 1;  // of none: anything that can be divided by
    double area = 0;
};

/// A sphere around both, as small as can be.
Node around(const Node& a, const Node& b) {
    if (a.area == 0) return b;
    if (b.area == 0) return a;
    const double area = a.area + b.area, apart = glm::length(b.centre - a.centre);
    if (apart + b.reach <= a.reach) return {a.centre, a.reach, area};
    if (apart + a.reach <= b.reach) return {b.centre, b.reach, area};
    const double reach = (apart + a.reach + b.reach) / 2;
    return {a.centre + (b.centre - a.centre) * ((reach - a.reach) / apart), reach, area};
}

}  // namespace

template <class Real>
SphereChoice<Real>::SphereChoice(const kernels::SphereTable<Real>& spheres, const std::vector<std::uint32_t>& balls)
    : levels_(static_cast<std::uint32_t>(std::bit_width(balls.size() - 1))) {
    const std::size_t leaves = std::size_t{1} << levels_;
    std::vector<Node> nodes(2 * leaves);
    sphere_.resize(leaves + kernels::widest, balls.front());
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const std::uint32_t b = balls[i];
        const double radius = spheres.radius[b];
        nodes[leaves + i] = {{spheres.cx[b], spheres.cy[b], spheres.cz[b]}, radius, radius * radius};
        sphere_[i] = b;
    }
    for (std::size_t k = leaves; --k > 0;) nodes[k] = around(nodes[2 * k], nodes[2 * k + 1]);
    for (auto& column : columns_) column.resize(nodes.size() + kernels::widest);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const Node& n = nodes[k];
        // A node must not sink below a horizon that one of its spheres rises above: rounding included.
        const double rounding = 8 * double{std::numeric_limits<Real>::epsilon()};
        const double reach = n.reach + rounding * (n.reach + glm::length(n.centre));
        const double numbers[] = {n.centre.x, n.centre.y, n.centre.z, reach, n.area};
        for (std::size_t c = 0; c < columns_.size(); ++c) columns_[c][k] = static_cast<Real>(numbers[c]);
    }
}

template <class Real>
void SphereChoice<Real>::put_into(kernels::SpheresOverPoints<Real>& table) const {
    table.levels = levels_;
    table.cx = columns_[0].data(), table.cy = columns_[1].data(), table.cz = columns_[2].data();
    table.reach = columns_[3].data(), table.area = columns_[4].data();
    table.sphere = sphere_.data();
}

template class SphereChoice<float>;
template class SphereChoice<double>;

}  // namespace orrery
