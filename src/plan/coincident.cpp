#include "plan/coincident.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace orrery {

namespace {

constexpr std::uint32_t none = 0xFFFFFFFF;
/// Of what may be near: so that a sphere rarely looks into a second cell, and finds few others in its own.
constexpr double cell_size = 64;
constexpr std::size_t comparisons_each = 256;

using Place = std::array<double, 4>;

Place place_of(const Primitive& p) { return {p.centre.x, p.centre.y, p.centre.z, p.radius}; }

double scale_of(const Place& p) { return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2]), p[3]}); }

double difference(const Place& a, const Place& b) {
    double most = 0;
    for (std::size_t c = 0; c < 4; ++c) most = std::max(most, std::abs(a[c] - b[c]));
    return most;
}

/// Spheres by cells of centre and radius, of a size in proportion to the spheres' scale; chains within a hash table.
class Cells {
public:
    Cells(const std::vector<Primitive>& spheres, double near)
        : near_(near), heads_(std::bit_ceil(2 * spheres.size() + 1), none), next_(spheres.size(), none) {
        keys_.reserve(spheres.size());
        for (const Primitive& sphere : spheres) {
            const Place place = place_of(sphere);
            const Level level = level_of(scale_of(place));
            std::uint64_t key = start(level);
            for (const double x : place) key = mixed(key, cell(x, level));
            keys_.push_back(key);
        }
    }

    void insert(std::uint32_t sphere) {
        std::uint32_t& head = head_of(keys_[sphere]);
        next_[sphere] = head;
        head = sphere;
    }

    /// Of a later one, so that it is in the cache by then: a sphere's place in the table is anywhere.
    void prefetch(std::size_t sphere) {
        if (sphere < keys_.size()) __builtin_prefetch(&head_of(keys_[sphere]));
    }

    /// Calls visit(sphere) for all in cells that something near may be in, until it returns false.
    template <class Visit>
    void visit_near(const Place& place, const Visit& visit) const {
        const double reach = near_ * scale_of(place);
        const Level low = level_of(scale_of(place) - reach), high = level_of(scale_of(place) + reach);
        if (!visit_cells(place, reach, low, 0, start(low), visit)) return;
        if (high.exponent != low.exponent) visit_cells(place, reach, high, 0, start(high), visit);
    }

private:
    std::uint32_t& head_of(std::uint64_t key) { return heads_[key & (heads_.size() - 1)]; }

    /// Scales between two powers of two have cells of one size.
    struct Level {
        int exponent;
        double cells;  ///< in a length of 1
    };
    Level level_of(double scale) const {
        // The bits of a double, as calls of ilogb and ldexp for a million spheres take longer than all else.
        const auto exponent = static_cast<int>(std::bit_cast<std::uint64_t>(scale) >> 52) - 1023;
        return {exponent,
                std::bit_cast<double>(static_cast<std::uint64_t>(1023 - exponent) << 52) / (cell_size * near_)};
    }
    static std::int64_t cell(double x, const Level& level) {
        const double place = x * level.cells;
        const auto towards_zero = static_cast<std::int64_t>(place);
        return towards_zero - (static_cast<double>(towards_zero) > place ? 1 : 0);
    }
    static std::uint64_t start(const Level& level) { return mixed(0x9E3779B97F4A7C15u, level.exponent); }
    static std::uint64_t mixed(std::uint64_t key, std::int64_t with) {
        key = (key ^ static_cast<std::uint64_t>(with)) * 0xBF58476D1CE4E5B9u;
        return key ^ key >> 29;
    }

    template <class Visit>
    bool visit_cells(const Place& place, double reach, const Level& level, std::size_t c, std::uint64_t key,
                     const Visit& visit) const {
        if (c == 4) {
            for (std::uint32_t s = heads_[key & (heads_.size() - 1)]; s != none; s = next_[s])
                if (keys_[s] == key && !visit(s)) return false;
            return true;
        }
        const std::int64_t last = cell(place[c] + reach, level);
        for (std::int64_t at = cell(place[c] - reach, level); at <= last; ++at)
            if (!visit_cells(place, reach, level, c + 1, mixed(key, at), visit)) return false;
        return true;
    }

    double near_;
    std::vector<std::uint32_t> heads_;  ///< of chains
    std::vector<std::uint32_t> next_;   ///< in the chain, by sphere
    std::vector<std::uint64_t> keys_;   ///< of their cells, by sphere
};

}  // namespace

Coincidences coincidences(const std::vector<Primitive>& primitives, double same, double near) {
    Coincidences found;
    found.nearest.apart = near;
    Cells cells(primitives, near);
    std::size_t comparisons = comparisons_each * (primitives.size() + 1024);
    for (std::uint32_t i = 0; i < primitives.size(); ++i) {
        cells.prefetch(i + std::size_t{16});
        const Place place = place_of(primitives[i]);
        const double scale = scale_of(place);
        std::uint32_t first = none;
        double apart = 0;
        std::size_t near_ones = 0;
        Twins nearest = found.nearest;
        cells.visit_near(place, [&](std::uint32_t other) {
            if (comparisons == 0) return false;
            --comparisons;
            const double by = difference(place, place_of(primitives[other])) / scale;
            if (by <= same) {
                if (other < first) first = other, apart = by;
            } else if (by <= near) {
                ++near_ones;
                if (by <= nearest.apart) nearest = {other, i, by};
            }
            return true;
        });
        if (comparisons == 0) {
            found.too_many = true;
            return found;
        }
        if (first != none) {
            found.same.push_back({first, i, apart});
            continue;
        }
        found.near += near_ones;
        found.nearest = nearest;
        cells.insert(i);
    }
    return found;
}

}  // namespace orrery
