#include "plan/light_choice.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "kernels/queues.hpp"
#include "plan/alias_table.hpp"
#include "plan/tables.hpp"

namespace orrery {

namespace {

constexpr double round_share = 0.25;  // of the choices by power that all lights share alike

/// Over 4 pi, which all have. Powers beyond any number count alike.
double power(const glm::dvec3& light, double area) {
    constexpr double bound = std::numeric_limits<double>::max() / (1u << 25);  // so many of them have a sum
    return std::min((light.r + light.g + light.b) * area, bound);
}

}  // namespace

std::vector<double> light_weights(const Scene& scene, LightChoice rule, bool area) {
    std::vector<double> weights;
    for (const PointLight& light : scene.point_lights)
        if (shines(light.intensity)) weights.push_back(power(light.intensity, 1));
    for (const Primitive& p : scene.primitives)
        if (area && p.emission && shines(*p.emission))
            weights.push_back(power(*p.emission, std::numbers::pi * p.radius * p.radius));
    double sum = 0;
    for (const double weight : weights) sum += weight;
    const double round = 1 / static_cast<double>(weights.size());
    for (double& weight : weights) {
        const bool by_power = rule == LightChoice::power && sum > 0;
        weight = by_power ? (1 - round_share) * (weight / sum) + round_share * round : round;
    }
    return weights;
}

template <class Real>
ChosenLights<Real>::ChosenLights(const std::vector<double>& weights,
                                 const std::vector<kernels::PointLight<Real>>& points,
                                 const std::vector<kernels::AreaLight<Real>>& areas) {
    const AliasTable choice = alias_table(weights);
    for (const AliasTable::Cell& cell : choice.cells) {
        share_.push_back(static_cast<Real>(cell.share) / static_cast<Real>(1u << AliasTable::bits));
        other_.push_back(cell.other);
    }
    const auto put = [&](std::initializer_list<Real> numbers, std::uint32_t sphere) {
        const double probability = choice.probability[sphere_.size()];
        auto column = columns_.begin();
        for (const Real number : numbers) (column++)->push_back(number);
        column->push_back(static_cast<Real>(1 / probability));
        sphere_.push_back(sphere);
        if (sphere != kernels::no_sphere) area_probability.push_back(static_cast<Real>(probability));
    };
    for (const auto& l : points) put({l.px, l.py, l.pz, 0, l.r, l.g, l.b}, kernels::no_sphere);
    for (const auto& l : areas)
        if (sphere_.size() < weights.size()) put({l.cx, l.cy, l.cz, l.radius, l.r, l.g, l.b}, l.sphere);
    const auto pad = [](auto& column) { column.resize(column.size() + kernels::widest); };
    pad(share_), pad(other_), pad(sphere_), pad(area_probability);
    for (auto& column : columns_) pad(column);
    table = {static_cast<std::uint32_t>(choice.cells.size()),
             share_.data(),
             other_.data(),
             static_cast<std::uint32_t>(weights.size()),
             columns_[0].data(),
             columns_[1].data(),
             columns_[2].data(),
             columns_[3].data(),
             columns_[4].data(),
             columns_[5].data(),
             columns_[6].data(),
             columns_[7].data(),
             sphere_.data()};
}

template class ChosenLights<float>;
template class ChosenLights<double>;

}  // namespace orrery
