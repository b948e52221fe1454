// What the samples of a pixel tell about the error of their sum.
//
// A contrast is a signed sum of samples that has expectation zero, so that its square, on average, is its variance:
// that of the plain sum of the same samples, because signs do not matter to it and samples are independent. Summed over
// contrasts without common samples this is the variance of the pixel's sum, whatever the samples' distributions are;
// nothing is subtracted that could cancel, and equal samples give exactly zero.
//
// Rows visited twice: a cell's two samples differ by nothing but chance, a - b. Exact. Uniform samples are the case of
// one cell.
//
// Rows visited once, the stratified estimator: no two samples have the same distribution, and the scatter of all of
// them counts what stratification has removed. Blocks of 2 x 2 cells give a - b - c + d, whose expectation vanishes
// where the radiance is f(x) + g(y): slopes, and edges along the grid. What an oblique edge leaves makes the estimate
// too large, never too small, and the interval takes it into account (error.hpp). Measured where edges are all the
// error there is (scene 2 at 64 x 64, 256 samples), true error over estimated, relative and RMSE, mean of 8 seeds:
//     2 x 2 blocks                              0.90  0.96
//     second differences of three in a row      0.87  0.94
//     neighbours in a row, collapsed in pairs   0.74  0.75
//     scatter of all samples, unstratified      0.27  0.07
// With noise as the larger part (scene 8) all four are within 2 % for the relative error.
//
// Two sequences scrambled apart, sample by sample in turns, the Sobol' estimator: only their two sums are independent,
// so that all samples of a pixel form a single contrast. With as many samples of both it has no bias, and one degree of
// freedom: of a pixel it tells little, and may be 0 by chance, of an image as much as its pixels are many.
//
// How skewed samples are. A contrast of two samples, squared, and their sum: the covariance of both is the third
// cumulant of the sum, (a - b)^2 against a + b; so it is with four. Where cells differ, square and sum would covary
// from cell to cell without any chance being in it, so that only steps from one contrast to the next count: cells that
// lie side by side have about the same mean.
#pragma once

#include <cstdint>
#include <vector>

#include "film/film.hpp"

namespace orrery {

/// Forms the contrasts of one pixel after the other, from samples in Real. Owned by one thread.
template <class Real = float>
class Contrasts {
public:
    /// Samples come row by row of a grid of `columns` x `columns` cells, one in each cell of a row; with `twice` every
    /// row comes a second time before the next. One column visited once has no contrasts. To a film of one contrast
    /// per pixel samples come as one column, `twice`: of the two sequences in turns.
    /// What the film's pixels had before stays.
    void begin(std::uint32_t columns, bool twice);

    /// Adds the next samples of a pixel to the film's spread: r, g, b and one unused number each. A pixel's samples may
    /// come in any number of portions, one pixel at a time. A contrast with a sample that is not finite is left out.
    void add(Film& film, std::size_t pixel, const Real* rgbx, std::uint32_t count);

private:
    /// One after the other, so that sums do not depend on how a pixel's samples were cut into portions. Four lanes, of
    /// which the last stands for the unused number beside r, g and b.
    struct Sums {
        double squares[4], difference[4];
        Real skews[4];
        Real last_square[4], last_total[4];  ///< of the contrast before
        std::uint32_t contrasts, steps;
        bool stepping;  ///< whether there was one
    };

    std::uint32_t group_size() const;
    void load(Film& film, std::size_t pixel);
    void store(Film& film, std::size_t pixel) const;
    void add_rows(Contrasting contrasting, const Real* rgbx, std::uint32_t rows);
    template <Contrasting contrasting, bool checked, std::size_t count>
    static void add_contrast(Sums& sum, const Real* const (&samples)[count]);
    template <Contrasting contrasting, bool checked>
    static void add_differences(Sums& sum, const Real* row, const Real* again, std::uint32_t columns);
    template <bool checked>
    static void add_blocks(Sums& sum, const Real* row, const Real* next, std::uint32_t columns);
    template <bool checked>
    Sums sum_of_run(Sums sum, Contrasting contrasting, const Real* rgbx, std::uint32_t rows) const;

    std::uint32_t columns_ = 1;
    bool twice_ = true;
    std::size_t pixel_ = no_pixel;
    std::uint32_t rows_done_ = 0;  ///< of the present pixel
    Sums sums_{};                  ///< of the present pixel
    std::vector<Real> begun_;      ///< samples of a group of rows that the last portion left incomplete
    static constexpr std::size_t no_pixel = ~std::size_t{0};
};

extern template class Contrasts<float>;
extern template class Contrasts<double>;

}  // namespace orrery
