#include "film/film.hpp"

#include <algorithm>
#include <limits>

namespace orrery {

Image Film::mean() const {
    Image image{width_, height_, std::vector<Rgb>(pixels_.size())};
    std::transform(pixels_.begin(), pixels_.end(), image.pixels.begin(), [](const Pixel& sum) {
        if (sum.samples == 0) return Rgb{};
        // Rounded to float once, after the division: the mean of equal samples is that sample.
        const auto count = static_cast<double>(sum.samples);
        return Rgb{static_cast<float>(sum.r / count), static_cast<float>(sum.g / count),
                   static_cast<float>(sum.b / count)};
    });
    return image;
}

PixelEstimate Film::estimate(std::size_t pixel) const {
    const Pixel& sum = pixels_[pixel];
    const Spread& spread = spreads_[pixel];
    constexpr double unknown = std::numeric_limits<double>::infinity();
    if (sum.samples == 0) return {{}, {unknown, unknown, unknown}, 0};
    const auto n = static_cast<double>(sum.samples);
    const Rgb64 mean{sum.r / n, sum.g / n, sum.b / n};
    if (spread.members == 0) return {mean, {unknown, unknown, unknown}, 0};
    const Rgb64& s = spread.sums;
    const bool one = contrasting_ == Contrasting::one;
    const Rgb64 squares = one ? Rgb64{s.r * s.r, s.g * s.g, s.b * s.b} : s;
    // The members' sum has the variance `squares`; the sum of all samples has as much more as they are more, and the
    // mean n^2 times less.
    const double scale = 1 / (static_cast<double>(spread.members) * n);
    return {mean,
            {squares.r * scale, squares.g * scale, squares.b * scale},
            one ? 1 : static_cast<double>(spread.contrasts)};
}

}  // namespace orrery
