#include "film/contrasts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orrery {
namespace {

/// Contrasts as they are summed, one after the other: a sum does not depend on how a pixel's samples were cut into
/// portions. Four lanes, of which the last stands for the unused number beside r, g and b.
struct Sums {
    double lane[4];
    std::uint64_t contrasts;
};

/// A contrast, channel by channel, squared or as part of one: plus the samples of the first half, minus those of the
/// second. In the samples' own type: its rounding is theirs, and equal ones still leave exactly zero. With `checked`,
/// one with a sample that the film does not keep is left out.
template <Contrasting contrasting, bool checked, class Real, std::size_t count>
inline void add_contrast(Sums& sum, const Real* const (&samples)[count]) {
    if (checked)
        for (const Real* const sample : samples)
            if (!Film::keeps(sample[0], sample[1], sample[2])) return;
    for (std::uint32_t c = 0; c < 4; ++c) {
        double d = 0;
        if constexpr (count == 2) {
            d = samples[0][c] - samples[1][c];
        } else {
            d = (samples[0][c] - samples[2][c]) - (samples[3][c] - samples[1][c]);
        }
        sum.lane[c] += contrasting == Contrasting::one ? d : d * d;
    }
    ++sum.contrasts;
}

/// a - b of two visits to a row, cell by cell.
template <Contrasting contrasting, bool checked, class Real>
inline void add_differences(Sums& sum, const Real* row, const Real* again, std::uint32_t columns) {
    for (std::uint32_t i = 0; i < 4 * columns; i += 4) add_contrast<contrasting, checked>(sum, {row + i, again + i});
}

/// a - b - c + d of blocks side by side; in rows of odd length the last overlaps the one before.
template <bool checked, class Real>
inline void add_blocks(Sums& sum, const Real* row, const Real* next, std::uint32_t columns) {
    const auto add = [&](std::uint32_t x) {
        const Real* const upper = row + 4 * x;
        const Real* const lower = next + 4 * x;
        add_contrast<Contrasting::many, checked>(sum, {upper, lower + 4, upper + 4, lower});
    };
    for (std::uint32_t x = 0; x + 2 <= columns; x += 2) add(x);
    if (columns % 2 == 1) add(columns - 2);
}

/// A run of groups: pairs of visits, or two or three rows of cells.
template <bool checked, class Real>
void add_run(Sums& sum, Contrasting contrasting, const Real* rgbx, std::uint32_t rows, std::uint32_t columns,
             bool twice) {
    const std::size_t stride = std::size_t{4} * columns;
    if (twice && contrasting == Contrasting::one) {
        for (std::uint32_t row = 0; row < rows; row += 2, rgbx += 2 * stride)
            add_differences<Contrasting::one, checked>(sum, rgbx, rgbx + stride, columns);
    } else if (twice) {
        for (std::uint32_t row = 0; row < rows; row += 2, rgbx += 2 * stride)
            add_differences<Contrasting::many, checked>(sum, rgbx, rgbx + stride, columns);
    } else {
        for (std::uint32_t row = 0; row + 1 < rows; row += 2, rgbx += 2 * stride)
            add_blocks<checked>(sum, rgbx, rgbx + stride, columns);
        if (rows % 2 == 1) add_blocks<checked>(sum, rgbx - stride, rgbx, columns);
    }
}

}  // namespace

template <class Real>
void Contrasts<Real>::begin(std::uint32_t columns, bool twice) {
    columns_ = columns;
    twice_ = twice;
    pixel_ = no_pixel;
    begun_.clear();
    begun_.reserve(std::size_t{12} * columns);
}

template <class Real>
void Contrasts<Real>::add(Film& film, std::size_t pixel, const Real* rgbx, std::uint32_t count) {
    if (columns_ == 1 && !twice_) return;
    if (pixel != pixel_) {
        pixel_ = pixel;
        rows_done_ = 0;
        begun_.clear();
    }
    Spread spread = film.spread(pixel);
    while (count > 0) {
        const std::uint32_t group = group_size();
        const auto begun = static_cast<std::uint32_t>(begun_.size() / 4);
        std::uint32_t taken = std::min(count, group - begun);
        if (taken == group) {
            // All pairs of visits at once; of rows visited once the last group is another.
            if (twice_) taken = count - count % group;
            add_rows(spread, film.contrasting(), rgbx, taken / columns_);
        } else {
            begun_.insert(begun_.end(), rgbx, rgbx + std::size_t{4} * taken);
            if (begun + taken == group) {
                add_rows(spread, film.contrasting(), begun_.data(), group / columns_);
                begun_.clear();
            }
        }
        rgbx += std::size_t{4} * taken;
        count -= taken;
    }
    film.set_spread(pixel, spread);
}

/// Two rows; where an odd number of rows is visited once, the last three, so that none is left over.
template <class Real>
std::uint32_t Contrasts<Real>::group_size() const {
    const bool last_of_odd = !twice_ && rows_done_ + 3 == columns_;
    return (last_of_odd ? 3 : 2) * columns_;
}

template <class Real>
void Contrasts<Real>::add_rows(Spread& spread, Contrasting contrasting, const Real* rgbx, std::uint32_t rows) {
    const Sums before{{spread.sums.r, spread.sums.g, spread.sums.b, 0}, spread.contrasts};
    Sums sum = before;
    add_run<false>(sum, contrasting, rgbx, rows, columns_, twice_);
    // A sample that the film does not keep makes this no number, or in double at least very large.
    constexpr double most = sizeof(Real) == 4 ? std::numeric_limits<double>::max() : 0x1p120;
    if (!(std::abs(sum.lane[0]) + std::abs(sum.lane[1]) + std::abs(sum.lane[2]) <= most)) {
        sum = before;
        add_run<true>(sum, contrasting, rgbx, rows, columns_, twice_);
    }
    spread.sums = {sum.lane[0], sum.lane[1], sum.lane[2]};
    spread.members += (sum.contrasts - spread.contrasts) * (twice_ ? 2 : 4);
    spread.contrasts = sum.contrasts;
    rows_done_ += rows;
}

template class Contrasts<float>;
template class Contrasts<double>;

}  // namespace orrery
