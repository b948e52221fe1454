// The binary tree by which a vertex chooses the smooth sphere that it looks for point lights in.
#pragma once

#include <array>
#include <vector>

#include "kernels/tables.hpp"

namespace orrery {

/// The columns of a SpheresOverPoints; moves leave them where they are.
template <class Real>
class SphereChoice {
public:
    /// None.
    SphereChoice() = default;
    /// `balls`: spheres of the table, best in an order in which neighbours are near each other. One at least.
    SphereChoice(const kernels::SphereTable<Real>& spheres, const std::vector<std::uint32_t>& balls);

    void put_into(kernels::SpheresOverPoints<Real>& table) const;
    std::uint32_t levels() const { return levels_; }

private:
    std::uint32_t levels_ = 0;
    std::array<std::vector<Real>, 5> columns_;  // centre, reach, area
    std::vector<kernels::WordOf<Real>> sphere_;
};

extern template class SphereChoice<float>;
extern template class SphereChoice<double>;

}  // namespace orrery
