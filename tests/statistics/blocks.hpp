// An image as block means, each with its standard error: what two renderers can be compared by.
//
// A block of pixels has a mean that is nearly normal where a single pixel's is not, and shows where a difference is.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "film/film.hpp"
#include "statistics/moments.hpp"

namespace orrery::statistics {

/// An unbiased estimate of one number.
struct Estimate {
    double mean = 0;
    double variance = 0;                                       ///< of `mean`, itself estimated
    double degrees = std::numeric_limits<double>::infinity();  ///< of freedom of `variance`

    double standard_error() const { return std::sqrt(variance); }
};

/// Mean of the numbers seen.
Estimate estimate_of(const RunningMoments& moments);

/// Weighted mean of independent estimates; degrees of freedom by Welch and Satterthwaite.
Estimate weighted_mean(std::span<const Estimate> parts, std::span<const double> weights);

using RgbEstimate = std::array<Estimate, 3>;

/// Row-major blocks, (0,0) top left; those at the right and bottom edges hold what is left of the image.
struct BlockImage {
    std::uint32_t image_width = 0;
    std::uint32_t image_height = 0;
    std::uint32_t block_size = 1;  ///< pixels per side
    std::vector<RgbEstimate> blocks;

    std::uint32_t width() const { return (image_width + block_size - 1) / block_size; }
    std::uint32_t height() const { return (image_height + block_size - 1) / block_size; }
    const RgbEstimate& at(std::uint32_t x, std::uint32_t y) const { return blocks[std::size_t{y} * width() + x]; }

    /// Pixels in block (x, y).
    double area(std::uint32_t x, std::uint32_t y) const;

    /// Mean of the image. Takes the blocks' errors to be independent.
    RgbEstimate mean() const;
};

/// Blocks of pixels whose estimates are known and independent. Throws std::invalid_argument if the count is wrong.
BlockImage blocks_of_pixels(std::uint32_t width, std::uint32_t height, std::span<const RgbEstimate> pixels,
                            std::uint32_t block_size);

/// Blocks of K >= 2 images of one size, rendered with K independent seeds; errors from the scatter of each pixel
/// between the images, so whatever the renderer does within a pixel (stratifies, splits, kills) is accounted for.
/// Takes pixels of one image to be independent: then a block of P pixels has about P (K-1) degrees of freedom instead
/// of K-1, and few images suffice. A tail that none of them has met yet is in no error bar.
BlockImage blocks_over_seeds(std::span<const Image> images, std::uint32_t block_size);

}  // namespace orrery::statistics
