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
        if (area && emits(p)) weights.push_back(power(*p.emission, std::numbers::pi * p.radius * p.radius));
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
ChoiceColumns<Real>::ChoiceColumns(const std::vector<double>& weights) {
    const AliasTable choice = alias_table(weights);
    cells_ = static_cast<std::uint32_t>(choice.cells.size());
    for (const AliasTable::Cell& cell : choice.cells) {
        share_.push_back(static_cast<Real>(cell.share) / static_cast<Real>(1u << AliasTable::bits));
        other_.push_back(cell.other);
    }
    for (const double probability : choice.probability) {
        probability_.push_back(static_cast<Real>(probability));
        inverse_probability_.push_back(static_cast<Real>(1 / probability));
    }
    const auto pad = [](auto&... column) { (column.resize(column.size() + kernels::widest), ...); };
    pad(share_, other_, probability_, inverse_probability_);
}

template <class Real>
void ChoiceColumns<Real>::put_into(kernels::LightTable<Real>& table) const {
    table.cells = cells_;
    table.share = share_.data();
    table.other = other_.data();
    table.probability = probability_.data();
    table.inverse_probability = inverse_probability_.data();
}

template class ChoiceColumns<float>;
template class ChoiceColumns<double>;

}  // namespace orrery
