// Which light a vertex samples where it samples one of several: the probabilities, and the columns the kernels read.
#pragma once

#include <vector>

#include "kernels/tables.hpp"
#include "scene/scene.hpp"

namespace orrery {

/// Weights of the lights that are switched on, point lights first, then area lights (without them if `area` is false).
///
/// By power: three quarters of the choices go by emitted power, the sum of the channels of 4 pi I or of 4 pi^2 r^2 L,
/// and one quarter goes round. What is near may be lit by a weak light alone, whose share beside a strong one's could
/// be as small as it likes; so its variance is four times that of `uniform` at worst, and it is found at all.
/// (Measured: nothing to tell between none and 0.3 on 64 lamps of various powers, but on a still life with a small
/// lamp in its middle, the squared error falls by 0.26 at a tenth, by 0.4 at three.)
std::vector<double> light_weights(const Scene& scene, LightChoice rule, bool area);

/// The columns of a LightTable that say so; moves leave them where they are.
template <class Real>
class ChoiceColumns {
public:
    /// None.
    ChoiceColumns() = default;
    /// Throws std::invalid_argument for more than 2^24 lights.
    explicit ChoiceColumns(const std::vector<double>& weights);

    void put_into(kernels::LightTable<Real>& table) const;

private:
    std::vector<Real> share_;
    std::vector<kernels::WordOf<Real>> other_;
    std::vector<Real> probability_, inverse_probability_;
    std::uint32_t cells_ = 0;
};

extern template class ChoiceColumns<float>;
extern template class ChoiceColumns<double>;

}  // namespace orrery
