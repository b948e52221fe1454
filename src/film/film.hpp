// The film: per-pixel sums in double, written by the tile's owner alone.
#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "film/tiling.hpp"
#include "image/image.hpp"

namespace orrery {

/// Three doubles, one per channel.
struct Rgb64 {
    double r = 0, g = 0, b = 0;
};

/// Which contrasts of a pixel's samples tell the variance of their sum: many, each squared, or a single one that all
/// samples form together, squared in the end.
enum class Contrasting : std::uint8_t { many, one };

/// What the samples of a pixel tell about the error of their sum (contrasts.hpp says how).
struct Spread {
    Rgb64 squares;  ///< sum of squared contrasts
    /// Sum over steps from one contrast to the next: step of the square, times step of the sum of its samples. Not
    /// finite where floats do not hold it.
    Rgb skews;
    std::uint32_t members = 0;  ///< samples in those contrasts: the variance of their sum is that of the contrasts
    std::uint32_t contrasts = 0;
    std::uint32_t steps = 0;
};

/// A pixel's mean, how far it may be from the truth, and from how much that is known.
struct PixelEstimate {
    Rgb64 mean;
    Rgb64 variance;       ///< of `mean`; infinite where nothing tells, as with a single sample
    Rgb64 skew;           ///< third cumulant of `mean` over its variance: what a typical bright sample adds to it
    double degrees = 0;   ///< of freedom of `variance`
    bool blocks = false;  ///< from blocks of cells: at edges too large
};

/// Sums of samples. Sums are double because a float sum of 2^24 samples is wrong by percents.
/// Not thread safe per pixel; distinct pixels may be written by distinct threads without a lock.
class Film {
public:
    Film(std::uint32_t width, std::uint32_t height, Contrasting contrasting = Contrasting::many)
        : contrasting_(contrasting) {
        clear(width, height);
    }

    /// Makes it one of this size without any samples.
    void clear(std::uint32_t width, std::uint32_t height);
    /// What the pixels of a tile hold, to and from a film of the tile's size; those of the other colour stay. Both have
    /// the same contrasting.
    void cut(const Tile& tile, Film& patch) const;
    void paste(const Tile& tile, const Film& patch);

    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }
    std::size_t pixels() const { return pixels_.size(); }
    Contrasting contrasting() const { return contrasting_; }

    /// Whether a sample may get in: it is finite, and floats hold it.
    template <class Real>
    static bool keeps(Real r, Real g, Real b) {
        if constexpr (sizeof(Real) == 8) {
            constexpr double largest = std::numeric_limits<float>::max();  // what comes out is floats
            return std::abs(r) <= largest && std::abs(g) <= largest && std::abs(b) <= largest;
        } else {
            // One test for three channels: in double the sum of three floats cannot overflow, so it is finite exactly
            // when all three are (inf - inf is NaN, which is not finite either).
            return std::isfinite(double{r} + double{g} + double{b});
        }
    }

    /// Adds one sample to a pixel (index = y * width + x). A sample that it does not keep never
    /// gets in. Returns false when it was dropped.
    bool add(std::size_t pixel, float r, float g, float b) {
        assert(pixel < pixels_.size());
        return add_to(pixels_[pixel], r, g, b);
    }

    /// Adds `count` samples to a pixel, in order: r, g, b and one unused number each. Returns how many were dropped.
    template <class Real>
    std::uint32_t add(std::size_t pixel, const Real* rgbx, std::uint32_t count) {
        assert(pixel < pixels_.size());
        Pixel sum = pixels_[pixel];  // in registers: through memory each sample would wait for the one before
        std::uint32_t dropped = 0;
        for (const Real* const end = rgbx + std::size_t{4} * count; rgbx != end; rgbx += 4)
            dropped += add_to(sum, rgbx[0], rgbx[1], rgbx[2]) ? 0u : 1u;
        pixels_[pixel] = sum;
        return dropped;
    }

    /// All that is known of a pixel.
    struct Content {
        Rgb64 sum;
        std::uint64_t samples = 0;
        Spread spread;
        Rgb64 difference;  ///< only for Contrasting::one
    };
    Content content(std::size_t pixel) const;
    void set_content(std::size_t pixel, const Content& content);

    /// What the samples of a pixel tell about its error; whoever learns more, sets it.
    const Spread& spread(std::size_t pixel) const { return spreads_[pixel]; }
    void set_spread(std::size_t pixel, const Spread& spread) { spreads_[pixel] = spread; }

    /// The one contrast that all samples of a pixel form; only for Contrasting::one.
    Rgb64& difference(std::size_t pixel) { return differences_[pixel]; }

    /// How many samples got into a pixel.
    std::uint64_t samples(std::size_t pixel) const { return pixels_[pixel].samples; }

    /// Mean of the samples that got in; black where there is none.
    Rgb mean(std::size_t pixel) const;
    Image mean() const;

    /// What is known of a pixel; its mean is black where there is no sample.
    PixelEstimate estimate(std::size_t pixel) const;

private:
    struct Pixel {
        double r = 0, g = 0, b = 0;
        std::uint64_t samples = 0;
    };

    void copy(std::size_t to, const Film& other, std::size_t from, std::uint32_t count);

    template <class Real>
    static bool add_to(Pixel& sum, Real r, Real g, Real b) {
        if (!keeps(r, g, b)) return false;
        sum.r += double{r};
        sum.g += double{g};
        sum.b += double{b};
        ++sum.samples;
        return true;
    }

    std::uint32_t width_ = 0, height_ = 0;
    Contrasting contrasting_;
    std::vector<Pixel> pixels_;
    std::vector<Spread> spreads_;     ///< apart: what a render sums most often stays dense
    std::vector<Rgb64> differences_;  ///< empty for Contrasting::many
};

}  // namespace orrery
