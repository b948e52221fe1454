// How much one image differs from another.
#pragma once

#include <cstdint>
#include <optional>

#include "image/image.hpp"

namespace orrery {

/// How a mean difference stands against the noise of the two images.
struct Significance {
    /// Of the channel's mean difference, pixels being independent; and the difference over it, about normal where
    /// a and b have one expectation.
    double channel_error[3] = {};
    double channel_z[3] = {};
    /// Of all three together. The channels of a pixel come from the same paths: their errors are taken to go hand
    /// in hand, which can only make z smaller than it is.
    double error = 0;
    double z = 0;
};

/// Means are over pixels and channels, sums in double. Only pixels that are finite in every image given take part.
struct Comparison {
    std::uint64_t pixels = 0;        ///< that took part
    std::uint64_t not_finite_a = 0;  ///< pixels with a channel that is no finite number
    std::uint64_t not_finite_b = 0;

    double mse = 0;   ///< mean of (a - b)^2
    double rmse = 0;  ///< its root
    double mrse = 0;  ///< mean of (a - b)^2 / (b^2 + 0.01): b is the reference

    double largest = 0;                          ///< greatest |a - b| of a channel
    std::uint32_t largest_x = 0, largest_y = 0;  ///< the first pixel that has it
    double percentile = 0;  ///< |a - b| that 99.9 % of all channel values do not exceed (nearest rank)

    double mean_difference = 0;         ///< of a - b
    double channel_difference[3] = {};  ///< the same by channel: r, g, b

    std::optional<Significance> significance;  ///< where standard errors were given
    std::uint64_t without_error = 0;           ///< pixels left out for a standard error that is negative or not finite
};

/// What comparing takes beside the images; their difference, and a file of it, take less.
inline constexpr std::uint64_t comparison_bytes_per_pixel = 40;

/// `error_a` and `error_b` hold the standard error of each channel of each pixel; null is an image without error. All
/// images have to be of one size. Throws std::invalid_argument where they are not, or where no pixel takes part.
Comparison compare(const Image& a, const Image& b, const Image* error_a = nullptr, const Image* error_b = nullptr);

/// a - b, of the same size.
Image difference(const Image& a, const Image& b);

/// |a - b| in [0, 1] to look at: `scale` and what is above become 1, what is not finite 0. All 0 where `scale` is 0.
Image visible_difference(const Image& a, const Image& b, double scale);

}  // namespace orrery
