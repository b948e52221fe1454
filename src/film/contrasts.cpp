#include "film/contrasts.hpp"

#include <algorithm>
#include <limits>

namespace orrery {
/// A contrast, channel by channel: plus the samples of the first half, minus those of the second. In the samples' own
/// type: its rounding is theirs, and equal ones still leave exactly zero. With `checked`, one with a sample that the
/// film does not keep is left out.
template <class Real>
template <Contrasting contrasting, bool checked, std::size_t count>
[[gnu::always_inline]] inline void Contrasts<Real>::add_contrast(Sums& sum, const Real* const (&samples)[count]) {
    if (checked)
        for (const Real* const sample : samples)
            if (!Film::keeps(sample[0], sample[1], sample[2])) return;
    Real d[4], square[4], total[4];
    for (std::uint32_t c = 0; c < 4; ++c) {
        if constexpr (count == 2) {
            d[c] = samples[0][c] - samples[1][c];
            total[c] = samples[0][c] + samples[1][c];
        } else {
            d[c] = (samples[0][c] - samples[2][c]) - (samples[3][c] - samples[1][c]);
            total[c] = (samples[0][c] + samples[2][c]) + (samples[3][c] + samples[1][c]);
        }
        square[c] = d[c] * d[c];
    }
    if (!sum.stepping) {
        std::copy(square, square + 4, sum.last_square);
        std::copy(total, total + 4, sum.last_total);
    }
    sum.steps += sum.stepping ? 1 : 0;
    sum.stepping = true;
    ++sum.contrasts;
    for (std::uint32_t c = 0; c < 4; ++c) {
        sum.squares[c] += double{d[c]} * double{d[c]};
        if constexpr (contrasting == Contrasting::one) sum.difference[c] += double{d[c]};
        sum.skews[c] += (square[c] - sum.last_square[c]) * (total[c] - sum.last_total[c]);
        sum.last_square[c] = square[c];
        sum.last_total[c] = total[c];
    }
}

/// a - b of two visits to a row, cell by cell.
template <class Real>
template <Contrasting contrasting, bool checked>
[[gnu::always_inline]] inline void Contrasts<Real>::add_differences(Sums& sum, const Real* row, const Real* again,
                                                                    std::uint32_t columns) {
    for (std::uint32_t i = 0; i < 4 * columns; i += 4) add_contrast<contrasting, checked>(sum, {row + i, again + i});
}

/// a - b - c + d of blocks side by side; in rows of odd length the last overlaps the one before.
template <class Real>
template <bool checked>
[[gnu::always_inline]] inline void Contrasts<Real>::add_blocks(Sums& sum, const Real* row, const Real* next,
                                                               std::uint32_t columns) {
    const auto add = [&](std::uint32_t x) __attribute__((always_inline)) {
        const Real* const upper = row + 4 * x;
        const Real* const lower = next + 4 * x;
        add_contrast<Contrasting::many, checked>(sum, {upper, lower + 4, upper + 4, lower});
    };
    for (std::uint32_t x = 0; x + 2 <= columns; x += 2) add(x);
    if (columns % 2 == 1) add(columns - 2);
}

/// With a run of groups more: pairs of visits, or two or three rows of cells.
template <class Real>
template <bool checked>
typename Contrasts<Real>::Sums Contrasts<Real>::sum_of_run(Sums sum, Contrasting contrasting, const Real* rgbx,
                                                           std::uint32_t rows) const {
    const std::size_t stride = std::size_t{4} * columns_;
    if (twice_ && contrasting == Contrasting::one) {
        for (std::uint32_t row = 0; row < rows; row += 2, rgbx += 2 * stride)
            add_differences<Contrasting::one, checked>(sum, rgbx, rgbx + stride, columns_);
    } else if (twice_) {
        for (std::uint32_t row = 0; row < rows; row += 2, rgbx += 2 * stride)
            add_differences<Contrasting::many, checked>(sum, rgbx, rgbx + stride, columns_);
    } else {
        for (std::uint32_t row = 0; row + 1 < rows; row += 2, rgbx += 2 * stride)
            add_blocks<checked>(sum, rgbx, rgbx + stride, columns_);
        if (rows % 2 == 1) add_blocks<checked>(sum, rgbx - stride, rgbx, columns_);
    }
    return sum;
}

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
        load(film, pixel);
        rows_done_ = 0;
        begun_.clear();
    }
    while (count > 0) {
        const std::uint32_t group = group_size();
        const auto begun = static_cast<std::uint32_t>(begun_.size() / 4);
        std::uint32_t taken = std::min(count, group - begun);
        if (taken == group) {
            // All pairs of visits at once; of rows visited once the last group is another.
            if (twice_) taken = count - count % group;
            add_rows(film.contrasting(), rgbx, taken / columns_);
        } else {
            begun_.insert(begun_.end(), rgbx, rgbx + std::size_t{4} * taken);
            if (begun + taken == group) {
                add_rows(film.contrasting(), begun_.data(), group / columns_);
                begun_.clear();
            }
        }
        rgbx += std::size_t{4} * taken;
        count -= taken;
    }
    store(film, pixel);
}

/// Two rows; where an odd number of rows is visited once, the last three, so that none is left over.
template <class Real>
std::uint32_t Contrasts<Real>::group_size() const {
    const bool last_of_odd = !twice_ && rows_done_ + 3 == columns_;
    return (last_of_odd ? 3 : 2) * columns_;
}

template <class Real>
void Contrasts<Real>::load(Film& film, std::size_t pixel) {
    const auto lanes = [](auto(&lane)[4], const auto& sum) {
        lane[0] = sum.r;
        lane[1] = sum.g;
        lane[2] = sum.b;
        lane[3] = 0;
    };
    const Spread& spread = film.spread(pixel);
    lanes(sums_.squares, spread.squares);
    lanes(sums_.skews, spread.skews);
    if (film.contrasting() == Contrasting::one) lanes(sums_.difference, film.difference(pixel));
    sums_.contrasts = spread.contrasts;
    sums_.steps = spread.steps;
    sums_.stepping = false;
}

template <class Real>
void Contrasts<Real>::store(Film& film, std::size_t pixel) const {
    Spread spread = film.spread(pixel);
    const auto& [squares, difference, skews, last_square, last_total, contrasts, steps, stepping] = sums_;
    spread.members += (contrasts - spread.contrasts) * (twice_ ? 2 : 4);
    spread.squares = {squares[0], squares[1], squares[2]};
    spread.skews = {static_cast<float>(skews[0]), static_cast<float>(skews[1]), static_cast<float>(skews[2])};
    spread.contrasts = contrasts;
    spread.steps = steps;
    film.set_spread(pixel, spread);
    if (film.contrasting() == Contrasting::one) film.difference(pixel) = {difference[0], difference[1], difference[2]};
}

template <class Real>
void Contrasts<Real>::add_rows(Contrasting contrasting, const Real* rgbx, std::uint32_t rows) {
    Sums sum = sum_of_run<false>(sums_, contrasting, rgbx, rows);
    // A sample that the film does not keep makes this no number, or in double at least very large.
    constexpr double most = sizeof(Real) == 4 ? std::numeric_limits<double>::max() : 0x1p240;
    if (!(sum.squares[0] + sum.squares[1] + sum.squares[2] <= most))
        sum = sum_of_run<true>(sums_, contrasting, rgbx, rows);
    sums_ = sum;
    rows_done_ += rows;
}

template class Contrasts<float>;
template class Contrasts<double>;

}  // namespace orrery
