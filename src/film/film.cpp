#include "film/film.hpp"

#include <algorithm>

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

}  // namespace orrery
