// A table of a few spheres, as the planner makes it.
#pragma once

#include <array>
#include <vector>

#include "backward_error.hpp"

namespace orrery::extremes {

template <class Real>
class Spheres {
public:
    explicit Spheres(std::vector<Ball<Real>> balls) : balls_(std::move(balls)) {
        for (auto& column : columns_) column.resize(balls_.size() + 32);
        words_.resize(balls_.size() + 32);
        for (std::size_t i = 0; i < balls_.size(); ++i) {
            const auto& [c, r] = balls_[i];
            const Real values[] = {c.x, c.y, c.z, r, r * r, 1 / r};
            for (std::size_t k = 0; k < columns_.size(); ++k) columns_[k][i] = values[k];
        }
    }
    std::size_t count() const { return balls_.size(); }
    const Ball<Real>& operator[](std::size_t i) const { return balls_[i]; }
    /// The first `count` spheres, valid as long as this is.
    kernels::SphereTable<Real> table(std::size_t count) const {
        return {static_cast<std::uint32_t>(count),
                columns_[0].data(),
                columns_[1].data(),
                columns_[2].data(),
                columns_[3].data(),
                columns_[4].data(),
                columns_[5].data(),
                words_.data(),
                words_.data(),
                {}};
    }
    kernels::SphereTable<Real> table() const { return table(count()); }

private:
    std::vector<Ball<Real>> balls_;
    std::array<std::vector<Real>, 6> columns_;
    std::vector<kernels::WordOf<Real>> words_;
};

}  // namespace orrery::extremes
